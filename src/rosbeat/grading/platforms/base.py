"""Describe a learning platform: how it names files, who is in its roster, what it lets one upload.

`Platform` is the interface. Each method has a default, so a platform writes only what it does
differently. Nothing else in `grading` knows the name of a platform.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, ClassVar

if TYPE_CHECKING:
    from rosbeat.grading.archives import File
    from rosbeat.grading.marks import Graded

#: How files are called that may hold a page.
NOTEBOOKS = (".ipynb", ".json", ".txt")


@dataclass(frozen=True)
class Owner:
    """Hold whose a file is.

    Attributes:
        id: What tells a learner from others: the number that the platform gave, or the folder's
            name.
        file: The file's own name, path included, without what the platform added; empty if the
            platform wrote the file itself.
        system: The platform's name, such as `moodle`.
        late: Whether the platform marked it as late.
        attempt: Which attempt it is, if the platform counts them; else 0.
        handed_in: When it was handed in, in seconds since 1970, if the platform says so.
        details: What the platform says of the learner besides, by column, as in a roster.
    """

    id: str
    name: str
    file: str
    system: str
    late: bool = False
    attempt: int = 0
    handed_in: float | None = None
    details: Mapping[str, str] = field(default_factory=dict)


@dataclass(frozen=True)
class Feedback:
    """Hold the feedback of one learner, in the forms that platforms take.

    Attributes:
        page: The page of `feedback/`, an HTML document.
        notebook: Returns the feedback on one lesson as a notebook.
    """

    graded: Graded
    page: str
    notebook: Callable[[str], str]


class Platform:
    """Say what one learning platform does; a subclass overrides what is not as it is here.

    A platform is listed in `platforms.PLATFORMS`. Its `name` is the value of `system` in all
    results, and the beginning of the names of the files to upload: `moodle.csv` and
    `moodle_feedback.zip`.
    """

    #: One word in small letters.
    name: ClassVar[str]
    #: Its name as a sentence has it.
    title: ClassVar[str]
    #: Whether a learner or an instructor chose the names of folders and files, not the platform.
    has_free_names: ClassVar[bool] = False
    #: Whether the date of a file in a download says when it was handed in.
    dates_files: ClassVar[bool] = True
    #: Columns that all rosters of this platform have and no other platform's, in small letters.
    #: Without any, no roster is recognized as this platform's.
    roster_columns: ClassVar[frozenset[str]] = frozenset()
    #: Columns of its roster with the learner's id in a download, the best first.
    id_columns: ClassVar[tuple[str, ...]] = ()
    #: Whether these ids are in the names of downloaded files, too. If not, the table to upload can
    #: be written for learners on the roster only.
    roster_has_ids: ClassVar[bool] = True

    # The download.

    def opened(self, files: Sequence[File]) -> Platform:
        """Return the platform as it is for one download: with what a file of its own says there."""
        return self

    def owners(self, parts: tuple[str, ...]) -> tuple[Owner, ...]:
        """Return whose a file is: several learners if they handed it in together.

        Args:
            parts: The file's path, from a part on that the platform may have named.

        Returns:
            Nobody, if the platform did not name the first part.
        """
        return ()

    def is_own_file(self, name: str) -> bool:
        """Return whether the platform adds a file of this name to each download."""
        return False

    # The roster.

    def has_roster(self, header: Collection[str]) -> bool:
        """Return whether a table with these columns, in small letters, is the platform's roster."""
        return bool(self.roster_columns) and self.roster_columns <= set(header)

    def person_id(self, cells: Mapping[str, str]) -> str:
        """Return the id of the learner in a row of the platform's roster; empty for nobody."""
        return next((cells[name] for name in self.id_columns if cells.get(name)), "")

    def aliases(self, learner: str, details: Mapping[str, str]) -> tuple[str, ...]:
        """Return what else a table may call a learner instead of the id."""
        return ()

    # The upload.

    def table(self, learners: Sequence[Graded], assignment: str) -> str:
        """Return the table of marks that the platform takes, as CSV; empty if it takes none.

        Args:
            learners: Those who handed in on this platform, at least one.
            assignment: What the assignment is called there.
        """
        return ""

    def feedback_files(self, feedback: Feedback) -> Iterator[tuple[str, str]]:
        """Yield the files of one learner in the zip of feedback that the platform takes."""
        yield from ()


def rest_of(*parts: str) -> str:
    """Return a path without its empty parts, as a learner knows it."""
    return "/".join(filter(None, parts))
