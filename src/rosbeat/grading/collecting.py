"""From a folder or a zip file to who handed in what."""

from __future__ import annotations

from collections.abc import Iterable, Sequence, Set
from dataclasses import dataclass
from datetime import datetime
from itertools import groupby
from pathlib import Path

from rosbeat.grading.course_pages import CoursePage, which_page
from rosbeat.grading.entries import MOST_BYTES, Entry, list_files
from rosbeat.grading.learners import Whose, own_path, whose, without_wrapper
from rosbeat.grading.notebook import Notebook, read_notebook
from rosbeat.grading.remarks import Remark, printable

#: Why one of several files of a page counts, in the order in which `_rank` compares them.
_DECIDES = (
    "of the other one nothing can be read",
    "it is the last attempt",
    "it is the newest, by the date of the file",
    "the dates are the same, and it has more cells",
)


@dataclass(frozen=True)
class HandedIn:
    """One page as one learner handed it in.

    Attributes:
        page: The lesson's name, such as `03_write_a_publisher`.
        path: Where it was found.
        notebook: What could be read of it.
        late: Whether the system has marked it as late, or it is newer than the deadline.
        modified: When it was last changed, in seconds since 1970; 0 if unknown.
    """

    page: str
    path: str
    notebook: Notebook
    late: bool
    modified: float


@dataclass(frozen=True)
class Submission:
    """What one learner handed in.

    Attributes:
        learner: What tells this learner from others.
        name: What the learner is called.
        system: Where it came from: `moodle`, `canvas` or `folder`.
        pages: One for each page of the course that was handed in, in the order of the course.
        remarks: What is worth telling about these files.
    """

    learner: str
    name: str
    system: str
    pages: tuple[HandedIn, ...]
    remarks: tuple[Remark, ...]


@dataclass(frozen=True)
class Collection:
    """What a class handed in.

    Attributes:
        submissions: One for each learner, sorted by `learner`.
        remarks: About files that belong to no learner.
    """

    submissions: tuple[Submission, ...]
    remarks: tuple[Remark, ...]


def collect(source: Path, pages: Sequence[CoursePage], due: float | None = None) -> Collection:
    """Find out who handed in what.

    Args:
        source: A folder or a zip file: a folder or a zip file for each learner, or what Moodle or
            Canvas lets an instructor download.
        pages: The pages of the course.
        due: The deadline, in seconds since 1970; files that were changed later are late.

    Raises:
        GradingError: If `source` is neither a folder nor a zip file.
    """
    listing = list_files(source)
    level = without_wrapper([entry.parts for entry in listing.entries])
    owned: list[tuple[Whose, Entry]] = []
    remarks = list(listing.remarks)
    for entry in listing.entries:
        owner = whose(entry.parts[level:])
        if owner is None:
            text = "It lies in no learner's folder, and its name names none, so it is left out."
            remarks.append(Remark("left-out", entry.path, text))
        else:
            owned.append((owner, entry))
    owned.sort(key=lambda one: (one[0].id, one[1].parts))
    submissions = [
        _submission(list(group), pages, due)
        for _, group in groupby(owned, key=lambda one: one[0].id)
    ]
    submissions += _without_files(listing.remarks, level, {one.learner for one in submissions})
    return Collection(tuple(sorted(submissions, key=lambda one: one.learner)), tuple(remarks))


def _without_files(remarks: Iterable[Remark], level: int, known: Set[str]) -> Iterable[Submission]:
    """Learners of whom every file was refused: they have a line, too, which says why."""
    found: dict[str, tuple[Whose, list[Remark]]] = {}
    for remark in remarks:
        parts = tuple(remark.path.split("/"))[level:]
        owner = whose(parts) if ".." not in parts[:1] else None
        if owner is not None and owner.id not in known:
            found.setdefault(owner.id, (owner, []))[1].append(remark)
    for owner, said in found.values():
        yield Submission(owner.id, owner.name, owner.system, (), tuple(said))


def _submission(
    files: Sequence[tuple[Whose, Entry]], pages: Sequence[CoursePage], due: float | None
) -> Submission:
    remarks: list[Remark] = []
    found = [one for owner, entry in files for one in _read(owner, entry, pages, due, remarks)]
    first = files[0][0]
    order = [page.lesson for page in pages]
    chosen = [
        _newest([one for one in found if one[1].page == lesson], remarks)
        for lesson in sorted({one[1].page for one in found}, key=order.index)
    ]
    return Submission(first.id, first.name, first.system, tuple(chosen), tuple(remarks))


def _read(
    owner: Whose,
    entry: Entry,
    pages: Sequence[CoursePage],
    due: float | None,
    remarks: list[Remark],
) -> Iterable[tuple[Whose, HandedIn]]:
    """The page in a file; nothing, and a remark, if there is none."""
    if not entry.parts[-1].lower().endswith((".ipynb", ".json", ".txt")):
        is_typed = any("_assignsubmission_onlinetext" in part for part in entry.parts)
        what = (
            "It is text that was typed into Moodle, no notebook"
            if is_typed
            else "It is no notebook"
        )
        text = f"{what}, so it is left out."
        remarks.append(Remark("left-out", entry.path, text))
        return
    notebook = _notebook(entry)
    if notebook.problem:
        about = "empty" if "empty" in notebook.problem else "unreadable"
        about = "half-uploaded" if notebook.cut else about
        remarks.append(Remark(about, entry.path, notebook.problem))
        if not notebook.cut:
            return
    page = which_page(notebook, owner.file, pages)
    if page is None:
        text = "It is a notebook, and no page of this course, so it is left out."
        if not notebook.problem:
            remarks.append(Remark("wrong-course", entry.path, text))
        return
    remarks += _of_page(owner, entry, notebook, page)
    late = owner.late or _is_after(owner, entry, due)
    if late:
        remarks.append(Remark("late", entry.path, _lateness(owner, entry)))
    yield owner, HandedIn(page.lesson, entry.path, notebook, late, entry.modified)


def _is_after(owner: Whose, entry: Entry, due: float | None) -> bool:
    """Whether the file's date is after the deadline.

    Canvas dates every file of a download at the moment of the download (`get_output_stream` in
    `content_zipper.rb`), and writes LATE into the names of those that are.
    """
    return due is not None and owner.system != "canvas" and entry.modified > due


def _lateness(owner: Whose, entry: Entry) -> str:
    if owner.late:
        return "Its name says that it was handed in late."
    try:
        date = f"{datetime.fromtimestamp(entry.modified):%Y-%m-%d %H:%M}"
    except (ValueError, OverflowError, OSError):
        date = "far in the future"
    return f"The date of the file, {date}, is after the deadline."


def _notebook(entry: Entry) -> Notebook:
    if entry.size > MOST_BYTES:
        size = f"{entry.size / 1e6:.0f} MB"
        return Notebook(problem=f"The file has {size}, more than any page; it was not read.")
    try:
        return read_notebook(entry.read())
    except OSError as error:
        return Notebook(problem=f"The file cannot be read: {printable(str(error))}.")


def _of_page(owner: Whose, entry: Entry, notebook: Notebook, page: CoursePage) -> list[Remark]:
    remarks = [Remark("mended", entry.path, one) for one in notebook.repairs]
    if notebook.cut and notebook.cells:
        there = sum(cell.id in page.ids for cell in notebook.cells) or len(notebook.cells)
        text = f"The file is not whole: {there} of the page's {len(page.cells)} cells are there."
        remarks.append(Remark("half-uploaded", entry.path, text))
    if page.lesson not in owner.file:
        text = f"By what is on it, this is the page {page.lesson}; it has another name."
        remarks.append(Remark("renamed", entry.path, text))
    return remarks


def _newest(found: Sequence[tuple[Whose, HandedIn]], remarks: list[Remark]) -> HandedIn:
    """The last attempt of which anything can be read; then the newest; then who has most cells."""
    best = max(found, key=_rank)
    for one in found:
        if one is not best:
            text = f"The page is there {len(found)} times; {own_path(best[1].path)} counts: "
            text += f"{_why(_rank(best), _rank(one))}."
            remarks.append(Remark("duplicate", one[1].path, text))
    return best[1]


def _rank(one: tuple[Whose, HandedIn]) -> tuple[bool, int, float, int]:
    cells = one[1].notebook.cells
    return bool(cells), one[0].attempt, one[1].modified, len(cells)


def _why(best: tuple[float, ...], other: tuple[float, ...]) -> str:
    """What decided between two files; see `_rank`."""
    for why, mine, its in zip(_DECIDES, best, other, strict=True):
        if mine != its:
            return why
    return "nothing tells them apart, and it is the first by name"
