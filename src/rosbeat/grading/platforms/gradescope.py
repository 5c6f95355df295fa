"""Read exports and rosters of Gradescope, and write a table like its own.

No Gradescope was at hand: the formats come from its help and from programs that read them.

- "Export Submissions" of a programming assignment: `assignment_ID_export` with a folder for each
  submission, `submission_9`, and `submission_metadata.yml`. That file has for each folder
  `:submitters:`, several in a group, with `:name:`, `:sid:` and `:email:`, and `:created_at:`
  (public programs that read `submission_metadata.yml` with these keys).
- The roster, "Adding Students and Staff" on guides.gradescope.com: columns with the first and last
  name or the full name, `SID` and `Email`.
- "Download Grades" has `SID`, `Email`, `Total Score`, `Max Points` and others. Gradescope itself
  takes neither marks nor feedback from a file: a programming assignment gets its points from an
  autograder. So the table has these columns, for wherever such a table goes next.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from datetime import datetime
from typing import TYPE_CHECKING, Any

import yaml

from rosbeat.grading.files import csv_text
from rosbeat.grading.marks import Graded
from rosbeat.grading.platforms.base import NOTEBOOKS, Owner, Platform, rest_of

if TYPE_CHECKING:
    from rosbeat.grading.archives import File

_METADATA = "submission_metadata.yml"
#: Bytes of that file; it has the output of every test of every attempt.
_MOST_BYTES = 64_000_000
_FOLDER = re.compile(r"submission_\d+")
#: All values are texts, so that an id keeps its zeros, and no tag makes an object.
_LOADER = getattr(yaml, "CBaseLoader", yaml.BaseLoader)
_COLUMNS = ("Name", "SID", "Email", "Total Score", "Max Points")


class Gradescope(Platform):
    """Describe Gradescope's programming assignment.

    Args:
        submissions: Who handed in together, by the name of the folder; None if that is not known,
            because no export has been looked at.
    """

    name = "gradescope"
    title = "Gradescope"
    roster_columns = frozenset({"sid", "email"})
    id_columns = ("sid", "email")

    def __init__(self, submissions: Mapping[str, tuple[Owner, ...]] | None = None) -> None:
        self._submissions = submissions

    def opened(self, files: Sequence[File]) -> Platform:
        """Return Gradescope with what the metadata of this export says about folders.

        A learner may hand in a file of that name. So those in the outermost folders count, and only
        if all that was handed in is in these folders. What is beside or above them is nobody's.
        """
        metadata = [file for file in files if file.parts[-1] == _METADATA]
        depth = min((len(file.parts) for file in metadata), default=0)
        outermost = [file for file in metadata if len(file.parts) == depth]
        places = {file.parts[:-1] for file in outermost}
        above = {place[:level] for place in places for level in range(len(place))}
        tried = (file for file in files if file.parts[-1].lower().endswith((*NOTEBOOKS, ".zip")))
        elsewhere = (file for file in tried if file.parts[: depth - 1] not in places)
        if any(file.is_zip or file.parts[:-1] not in above for file in elsewhere):
            return Gradescope({})
        return Gradescope({name: who for file in outermost for name, who in _read(file)})

    def owners(self, parts: tuple[str, ...]) -> tuple[Owner, ...]:
        """Return all who handed in the submission of that name."""
        path = rest_of(*parts[1:])
        if self._submissions is None:
            is_one = _FOLDER.fullmatch(parts[0])
            return (Owner(parts[0], parts[0], path, self.name),) if is_one else ()
        return tuple(
            Owner(who.id, who.name, path, self.name, handed_in=who.handed_in, details=who.details)
            for who in self._submissions.get(parts[0], ())
        )

    def is_own_file(self, name: str) -> bool:
        """Return whether it says who handed in what."""
        return name == _METADATA

    def aliases(self, learner: str, details: Mapping[str, str]) -> tuple[str, ...]:
        """Return the e-mail address."""
        return (details.get("email", ""),)

    def table(self, learners: Sequence[Graded], assignment: str) -> str:
        """Return the marks as "Download Grades" has them.

        A learner with an exercise that is held has no grade yet.
        """
        rows: list[tuple[str | float, ...]] = [_COLUMNS]
        for graded in learners:
            who = graded.name, graded.details.get("sid", ""), graded.details.get("email", "")
            rows.append((*who, "" if graded.grade is None else graded.grade, graded.out_of))
        return csv_text(rows)


def _read(file: File) -> Iterator[tuple[str, tuple[Owner, ...]]]:
    """Yield who handed in what; nothing of a file that is not as it should be."""
    if file.problem or file.size > _MOST_BYTES:
        return
    document: Any = None
    with suppress(OSError, yaml.YAMLError, UnicodeError, ValueError, RecursionError):
        document = yaml.load(file.read(), Loader=_LOADER)
    for name, entry in _mapping(document).items():
        handed_in = _seconds(_mapping(entry).get(":created_at"))
        submitters = _mapping(entry).get(":submitters")
        people = submitters if isinstance(submitters, list) else []
        owners = tuple(_owners(map(_mapping, people), handed_in))
        if isinstance(name, str) and owners:
            yield name, owners


def _mapping(value: Any) -> Mapping[Any, Any]:  # noqa: ANN401 - whatever the file has there
    return value if isinstance(value, dict) else {}


def _owners(people: Iterable[Mapping[Any, Any]], handed_in: float | None) -> Iterator[Owner]:
    known: set[str] = set()
    for person in people:
        values = (person.get(key) for key in (":name", ":sid", ":email"))
        name, sid, email = (value.strip() if isinstance(value, str) else "" for value in values)
        learner = sid or email or name
        if learner and learner not in known:
            known.add(learner)
            details = {"sid": sid, "email": email}
            yield Owner(
                learner, name or learner, "", "gradescope", handed_in=handed_in, details=details
            )


def _seconds(value: Any) -> float | None:  # noqa: ANN401 - whatever the file has there
    """Return a date in seconds since 1970: `2026-11-25 15:14:00.123456789 Z`, as Ruby writes it."""
    match = re.match(
        r"(\d{4}-\d\d-\d\d)[ T](\d\d:\d\d:\d\d)(?:\.\d+)? ?(Z|UTC|[+-]\d\d:?\d\d)?",
        value if isinstance(value, str) else "",
    )
    if match is None:
        return None
    zone = "+00:00" if match[3] in (None, "Z", "UTC") else match[3]
    zone = zone if ":" in zone else f"{zone[:3]}:{zone[3:]}"
    try:
        return datetime.fromisoformat(f"{match[1]}T{match[2]}{zone}").timestamp()
    except (ValueError, OverflowError):
        return None
