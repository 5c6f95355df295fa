"""Find each learner's submitted pages in a folder or a zip file.

Whose a file is follows from its path, which a learning platform has made or not: `platforms`,
`downloads`.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import groupby
from pathlib import Path

from rosbeat.errors import GradingError, SubmissionError
from rosbeat.grading.archives import (
    EMPTY_FOLDER,
    OTHER_ARCHIVES,
    Allowance,
    File,
    is_page,
    open_upload,
)
from rosbeat.grading.archives import opened as opened_file
from rosbeat.grading.downloads import is_of_one, with_one_owner, with_owners
from rosbeat.grading.files import printable
from rosbeat.grading.platforms import own_path, platform_named
from rosbeat.grading.platforms.base import NOTEBOOKS, Owner
from rosbeat.grading.remarks import Remark
from rosbeat.page_runs.notebook import CoursePage, Notebook, read_notebook, which_page

#: The file that marks a folder as a release; see `release`.
MARKER = ".rosbeat-release.json"


@dataclass(frozen=True)
class HandedIn:
    """Hold one page as one learner handed it in.

    Attributes:
        page: The lesson's name, such as `03_write_a_publisher`.
        notebook: What could be read of it. If it has a `problem`, nothing could.
        late: Whether the platform marked it as late, or it is newer than the deadline.
        modified: When it was handed in, or last changed, in seconds since 1970; 0 if unknown.
        off: The share of its points that is taken off because it is late, from 0 to 1.
        is_dated: Whether `modified` says when it was handed in. Some platforms date every file of a
            download at the moment of the download.
    """

    page: str
    path: str
    notebook: Notebook
    late: bool
    modified: float
    off: float = 0.0
    is_dated: bool = True


@dataclass(frozen=True)
class Submission:
    """Hold what one learner handed in.

    Attributes:
        learner: What tells this learner from others.
        system: The name of the platform that it came from, or `folder`.
        pages: One for each page of the course that was handed in, in the order of the course.
        remarks: What is worth telling about these files.
        unread: Files that cannot be read and may be any page, with the reason.
        details: What the platform and the roster say of the learner besides, by column.
    """

    learner: str
    name: str
    system: str
    pages: tuple[HandedIn, ...] = ()
    remarks: tuple[Remark, ...] = ()
    unread: tuple[Remark, ...] = ()
    details: Mapping[str, str] = field(default_factory=dict)

    @property
    def called(self) -> str:
        """Return the name, with the id that tells the learner from others of that name."""
        return self.name if self.name == self.learner else f"{self.name} ({self.learner})"


@dataclass(frozen=True)
class Collection:
    """Hold what a class handed in.

    Attributes:
        submissions: One for each learner, sorted by `learner`.
        remarks: About files that are nobody's.
        is_one: Whether it is no class, but the pages of one learner.
    """

    submissions: tuple[Submission, ...]
    remarks: tuple[Remark, ...] = ()
    is_one: bool = False


def collect(source: Path, pages: Sequence[CoursePage], is_one: bool = False) -> Collection:
    """Find out who handed in what.

    Args:
        source: A folder or a zip file: a folder or a zip file for each learner, or what a learning
            platform lets an instructor download. Or the pages of one learner: a file, or a folder
            or zip file with pages directly in it.
        pages: The pages of the course.
        is_one: Whether all of it is one learner's in any case, however the folders are called.

    Raises:
        GradingError: If `source` is nothing of this.
    """
    with open_upload(source) as files:
        is_one = is_one or is_page(source) or is_of_one(files)
        owned = with_one_owner(files, _owner_of(source)) if is_one else with_owners(files)
        submissions = tuple(
            _submission(list(group), pages)
            for _, group in groupby(owned.files, lambda pair: pair[0].id)
        )
    return Collection(submissions, owned.remarks, is_one)


def _owner_of(source: Path) -> str:
    """Return the name of a learner's folder or zip file, or of the folder that a page is in."""
    place = source.resolve()
    name = place.parent.name if is_page(source) else place.name.removesuffix(".zip")
    return name or "learner"


# What one learner handed in.

#: Remarks about files that are left out, one by one; of more, only the number is told.
_MOST_LEFT_OUT = 20
_Found = tuple[Owner, HandedIn]


def _submission(files: Sequence[tuple[Owner, File]], pages: Sequence[CoursePage]) -> Submission:
    first, allowed = files[0][0], Allowance()
    reader = _Reader(pages, allowed)
    for owner, outer in files:
        for file in opened_file(outer, allowed):
            inside = "/".join(file.parts[len(outer.parts) :])
            reader.read(replace(owner, file=f"{owner.file}/{inside}") if inside else owner, file)
    lessons = [page.lesson for page in pages]
    remarks = reader.remarks
    chosen = [
        _chosen([one for one in reader.found if one[1].page == lesson], remarks)
        for lesson in sorted({one[1].page for one in reader.found}, key=lessons.index)
    ]
    remarks += reader.left_out[:_MOST_LEFT_OUT]
    if len(reader.left_out) > _MOST_LEFT_OUT:
        text = f"{len(reader.left_out) - _MOST_LEFT_OUT} more files are not notebooks."
        remarks.append(Remark("left-out", printable(first.name), text))
    unread = tuple(reader.unread)
    return Submission(
        first.id, first.name, first.system, tuple(chosen), tuple(remarks), unread, first.details
    )


class _Reader:
    """Read the files of one learner, and keep what is found and what is worth telling."""

    def __init__(self, pages: Sequence[CoursePage], allowed: Allowance) -> None:
        self._pages = pages
        self._allowed = allowed
        self.found: list[_Found] = []
        self.remarks: list[Remark] = []
        self.unread: list[Remark] = []
        self.left_out: list[Remark] = []

    def read(self, owner: Owner, file: File) -> None:
        """Read one file."""
        if file.problem == EMPTY_FOLDER:
            self.remarks.append(Remark("empty", file.path, file.problem))
            return
        if not owner.file and not file.problem:
            return  # the platform's own, about this learner
        notebook = self._notebook(file)
        if notebook.problem:
            self._unreadable(owner, file, notebook)
            return
        page = which_page(notebook, owner.file, self._pages)
        if page is None:
            text = "It is a notebook, but not a page of this course, so it is left out."
            self.remarks.append(Remark("wrong-course", file.path, text))
            return
        if page.lesson not in owner.file:
            text = f"By its content, this is the page {page.lesson}; it has another name."
            self.remarks.append(Remark("renamed", file.path, text))
        self._keep(owner, file, notebook, page)

    def _notebook(self, file: File) -> Notebook:
        name = file.parts[-1].lower()
        if not file.problem and not name.endswith(NOTEBOOKS):
            is_archive = name.endswith(OTHER_ARCHIVES)
            what = "an archive of a kind that is not opened" if is_archive else "not a notebook"
            return Notebook(problem=f"The file is {what}.")
        try:
            return read_notebook(self._allowed.read(file))
        except OSError as error:
            return Notebook(problem=printable(str(error), 400))

    def _unreadable(self, owner: Owner, file: File, notebook: Notebook) -> None:
        """Note a file that cannot be read; one that may hold a page waits for a person."""
        named = next((page for page in self._pages if page.lesson in owner.file), None)
        name = file.parts[-1].lower()
        is_attempt = ".ipynb" in name or name.endswith((".zip", *OTHER_ARCHIVES)) or not name
        if named is None and not is_attempt:
            self.left_out.append(Remark("left-out", file.path, notebook.problem))
            return
        about = "empty" if "is empty" in notebook.problem else "unreadable"
        remark = Remark(about, file.path, notebook.problem)
        self.remarks.append(remark)
        if named is None:
            self.unread.append(remark)
        else:
            self._keep(owner, file, notebook, named)

    def _keep(self, owner: Owner, file: File, notebook: Notebook, page: CoursePage) -> None:
        modified = file.modified if owner.handed_in is None else owner.handed_in
        dated = owner.handed_in is not None or platform_named(owner.system).dates_files
        handed = HandedIn(page.lesson, file.path, notebook, owner.late, modified, is_dated=dated)
        self.found.append((owner, handed))


def _chosen(found: Sequence[_Found], remarks: list[Remark]) -> HandedIn:
    """Return the last readable attempt; then the newest; then the one with most cells."""
    best = max(found, key=_rank)[1]
    text = (
        f"The page is there {len(found)} times; {own_path(best.path)} counts: of those that can be "
        "read the last attempt, then the newest, then the one with most cells."
    )
    remarks += [Remark("duplicate", one.path, text) for _, one in found if one is not best]
    return best


def _rank(one: _Found) -> tuple[bool, int, float, int]:
    cells = one[1].notebook.cells
    return bool(cells), one[0].attempt, one[1].modified, len(cells)


# What cannot be submissions.

_MEANS = """\
Nothing was written. Submissions are the zip file that Moodle, Canvas or another platform
                 lets you download, or a folder (or a zip file) for each learner with pages of
                 the course in it, as
                 ana/03_write_a_publisher.ipynb  and  ben/03_write_a_publisher.ipynb  are."""
_TRY = "Give that zip file or folder; docs/instructors.md shows what it may look like."


def require_submissions(source: Path, found: Collection) -> None:
    """Refuse what holds no submission, so that a wrong folder is noticed.

    Raises:
        GradingError: If it is a release, or there is neither a page nor an attempt at one.
        SubmissionError: If it is the submission of one learner, and no page of it can be read.
    """
    name = printable(str(source), 1000)
    if (source / MARKER).is_file():
        raise GradingError(f"{name} is what learners get, a release.", _MEANS, _TRY)
    if found.is_one:
        _require_page(name, found)
        return
    if any(one.pages or one.unread for one in found.submissions):
        return
    remarks = [*found.remarks, *(one for each in found.submissions for one in each.remarks)]
    why = "it is empty."
    if remarks:
        why = f"no file of it is a page of this course. {remarks[0].path}: {remarks[0].text}"
    raise GradingError(f"{name} has no submission in it: {why}", _MEANS, _TRY)


def _require_page(name: str, found: Collection) -> None:
    pages = [page for each in found.submissions for page in each.pages]
    if any(not page.notebook.problem for page in pages):
        return
    remarks = [*(one for each in found.submissions for one in each.remarks), *found.remarks]
    why = "it is empty."
    if remarks:
        text = f"{remarks[0].text[:1].lower()}{remarks[0].text[1:]}"
        why = text if name.endswith(remarks[0].path) else f"{remarks[0].path}: {text}"
    raise SubmissionError(
        f"{name} cannot be graded: {why}",
        "No page of this course can be read there, so no exercise was judged.",
        "Save the page in Jupyter, and hand in that file, such as 03_write_a_publisher.ipynb.",
    )


def require_apart(source: Path, out: Path) -> None:
    """Refuse a folder of results among the submissions: the next run would take it for a learner.

    Raises:
        GradingError: If one is in the other's place, or in it.
    """
    if out.resolve().is_relative_to(source.resolve()):
        raise GradingError(
            f"The results would be inside the folder of submissions, {printable(str(source))}.",
            "The next run would take them for something that was handed in; nothing was written.",
            "Name a folder beside it:  --out ~/class/grades",
        )
