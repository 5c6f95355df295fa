"""Find each learner's submitted pages in a folder or a zip file.

The name formats are those of Moodle's "Download all submissions", with and without folders
(`mod/assign/locallib.php`, `download_submissions`), of Canvas's "Download Submissions"
(`app/models/content_zipper.rb`), and a folder or a zip file for each learner.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import groupby
from pathlib import Path

from rosbeat.errors import GradingError
from rosbeat.grading.archives import EMPTY_FOLDER, OTHER_ARCHIVES, Allowance, File, open_upload
from rosbeat.grading.archives import opened as opened_file
from rosbeat.grading.files import printable
from rosbeat.grading.notebook import CoursePage, Notebook, read_notebook, which_page

#: The file that marks a folder as a release; see `release`.
MARKER = ".rosbeat-release.json"
#: What a remark is about that is for the instructor only: an answer that reaches for what runs and
#: observes it.
REACHES_INSIDE = "reaches-inside"


@dataclass(frozen=True)
class Remark:
    """Tell something about one file.

    Attributes:
        about: What it is: `late`, `duplicate`, `renamed`, `empty`, `wrong-course`, `unreadable`
            or `left-out`; or `manual`, a line of `manual.csv`; or
            `roster`, a line of the roster or somebody who is not on it; or `reaches-inside`, an
            page that reaches for what observes it.
        path: The file, as it was named, made safe to print.
        text: One sentence about what was found and what was done.
    """

    about: str
    path: str
    text: str


@dataclass(frozen=True)
class HandedIn:
    """Hold one page as one learner handed it in.

    Attributes:
        page: The lesson's name, such as `03_write_a_publisher`.
        notebook: What could be read of it. If it has a `problem`, nothing could.
        late: Whether the system marked it as late, or it is newer than the deadline.
        modified: When it was last changed, in seconds since 1970; 0 if unknown.
        off: The share of its points that is taken off because it is late, from 0 to 1.
    """

    page: str
    path: str
    notebook: Notebook
    late: bool
    modified: float
    off: float = 0.0


@dataclass(frozen=True)
class Submission:
    """Hold what one learner handed in.

    Attributes:
        learner: What tells this learner from others.
        system: Where it came from: `moodle`, `canvas` or `folder`.
        pages: One for each page of the course that was handed in, in the order of the course.
        remarks: What is worth telling about these files.
        unread: Files that cannot be read and may be any page, with the reason.
    """

    learner: str
    name: str
    system: str
    pages: tuple[HandedIn, ...] = ()
    remarks: tuple[Remark, ...] = ()
    unread: tuple[Remark, ...] = ()

    @property
    def called(self) -> str:
        """Return the name, with the id that tells the learner from others of that name."""
        return self.name if self.name == self.learner else f"{self.name} ({self.learner})"


@dataclass(frozen=True)
class Collection:
    """Hold what a class handed in."""

    submissions: tuple[Submission, ...]
    remarks: tuple[Remark, ...] = ()


def collect(source: Path, pages: Sequence[CoursePage]) -> Collection:
    """Find out who handed in what.

    Args:
        source: A folder or a zip file: a folder or a zip file for each learner, or what Moodle or
            Canvas lets an instructor download.
        pages: The pages of the course.

    Raises:
        GradingError: If `source` is neither a folder nor a zip file.
    """
    remarks: list[Remark] = []
    owned: list[tuple[Owner, File]] = []
    with open_upload(source) as files:
        level = _wrappers([_as_folder(file) for file in files])
        deepest = _deepest([file.parts[level:] for file in files])
        for file in files:
            owner = owner_of(file.parts[level:], deepest)
            if owner is not None:
                owned.append((owner, file))
            elif file.problem != EMPTY_FOLDER:
                text = "It is in no learner's folder, and its name names no learner."
                remarks.append(Remark("left-out", file.path, file.problem or text))
        owned.sort(key=lambda one: (one[0].id, one[1].parts))
        submissions = tuple(
            _submission(list(group), pages) for _, group in groupby(owned, lambda one: one[0].id)
        )
    return Collection(submissions, tuple(remarks))


# Whose a file is.

#: How files are called that may hold a page.
_NOTEBOOKS = (".ipynb", ".json", ".txt")
#: `Ana Muster_4711_assignsubmission_file_`, and behind it the file's name if there are no folders.
#: A learner may choose that so that it looks like another one's: the first number counts.
_MOODLE = re.compile(r"(?s)(?P<name>.+?)_(?P<id>\d+)_assignsubmission_[a-z]+(?:_(?P<file>.*))?")
#: `musterana_LATE_4711_998877_page-1.ipynb`; the number before the suffix counts attempts.
_CANVAS = re.compile(
    r"(?s)(?P<name>[^_]+)_(?P<late>LATE_)?(?P<id>\d+)_(?P<submission>\d+)_(?P<file>.+)"
)
_ATTEMPT = re.compile(r"(?s)(?P<stem>.+)-(?P<number>\d{1,3})(?P<suffix>\.\w+)")


@dataclass(frozen=True)
class Owner:
    """Hold whose a file is.

    Attributes:
        id: What tells a learner from others: the number that the system gave, or the folder's name.
        file: The file's own name, path included, without what the system added.
        system: `moodle`, `canvas` or `folder`.
        late: Whether the system marked it as late.
        attempt: Which attempt it is, if the system counts them; else 0.
    """

    id: str
    name: str
    file: str
    system: str
    late: bool = False
    attempt: int = 0


def owner_of(parts: tuple[str, ...], deepest: int | None = None) -> Owner | None:
    """Return whose a file is, or None if its path does not tell.

    Args:
        parts: Its path, folder by folder.
        deepest: In how many of these a name that Moodle or Canvas made is looked for; by default in
            all. What lies in a learner's own folder has names that the learner chose.
    """
    return _of_moodle(parts, deepest) or _of_canvas(parts, deepest) or _of_folder(parts)


def _deepest(paths: Sequence[tuple[str, ...]]) -> int | None:
    """Return in how many parts of a path a name that Moodle or Canvas made is looked for.

    It may stand anywhere, as in several downloads beside each other, unless there are folders
    without any: those are learners' own, and then only a folder's own name tells whose it is.
    """
    tried = [one for one in paths if one[-1].lower().endswith((*_NOTEBOOKS, ".zip"))]
    named = {one[0] for one in tried if _of_moodle(one) or _of_canvas(one)}
    return None if named >= {one[0] for one in tried if len(one) > 1} else 1


def _of_moodle(parts: tuple[str, ...], deepest: int | None = None) -> Owner | None:
    for place, part in enumerate(parts[:deepest]):
        found = _MOODLE.fullmatch(part)
        if found:
            rest = [found["file"] or "", *parts[place + 1 :]]
            file = "/".join(one for one in rest if one)
            return Owner(found["id"], found["name"].strip(), file, "moodle")
    return None


def _of_canvas(parts: tuple[str, ...], deepest: int | None = None) -> Owner | None:
    for place, part in enumerate(parts[:deepest]):
        found = _CANVAS.fullmatch(part)
        if not found:
            continue
        again = _ATTEMPT.fullmatch(found["file"])
        file = again["stem"] + again["suffix"] if again else found["file"]
        attempt = int(again["number"]) if again else 0
        rest = "/".join((file, *parts[place + 1 :]))
        late = bool(found["late"])
        return Owner(found["id"], found["name"].strip(), rest, "canvas", late, attempt)
    return None


def _of_folder(parts: tuple[str, ...]) -> Owner | None:
    if len(parts) == 1 and parts[0].lower().endswith(".zip"):
        parts = (parts[0][: -len(".zip")], parts[0])
    return Owner(parts[0], parts[0], "/".join(parts[1:]), "folder") if len(parts) > 1 else None


def own_path(path: str) -> str:
    """Return a file's path as its learner knows it, without what the system added."""
    owner = owner_of(tuple(path.split("/")))
    return (owner.file if owner else "") or path


def _as_folder(file: File) -> tuple[str, ...]:
    return (*file.parts[:-1], file.parts[-1][: -len(".zip")], "") if file.is_zip else file.parts


def _wrappers(paths: Sequence[tuple[str, ...]]) -> int:
    """Return how many folders around everything do not tell learners apart.

    A download is often one folder with all others in it.
    """
    level = 0
    while paths and all(len(path) > level + 2 for path in paths):
        names = {path[level] for path in paths}
        if len(names) != 1 or any(_MOODLE.fullmatch(n) or _CANVAS.fullmatch(n) for n in names):
            break
        level += 1
    return level


# What one learner handed in.

#: Remarks about files that are left out, one by one; of more, only the number is told.
_MOST_LEFT_OUT = 20
_Found = tuple["Owner", HandedIn]


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
    return Submission(first.id, first.name, first.system, tuple(chosen), tuple(remarks), unread)


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
        if not file.problem and not name.endswith(_NOTEBOOKS):
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
        handed = HandedIn(page.lesson, file.path, notebook, owner.late, file.modified)
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
Nothing was written. Submissions are the zip file that Moodle or Canvas lets you download,
                 or a folder (or a zip file) for each learner with pages of the course in it, as
                 ana/03_write_a_publisher.ipynb  and  ben/03_write_a_publisher.ipynb  are."""
_TRY = "Give that zip file or folder; docs/instructors.md shows what it may look like."


def require_submissions(source: Path, found: Collection) -> None:
    """Refuse what holds no submission, so that a wrong folder is noticed.

    Raises:
        GradingError: If it is a release, or there is neither a page nor an attempt at one.
    """
    name = printable(str(source), 1000)
    if (source / MARKER).is_file():
        raise GradingError(f"{name} is what learners get, a release.", _MEANS, _TRY)
    if any(one.pages or one.unread for one in found.submissions):
        return
    remarks = [*found.remarks, *(one for each in found.submissions for one in each.remarks)]
    why = "it is empty."
    if remarks:
        why = f"no file of it is a page of this course. {remarks[0].path}: {remarks[0].text}"
    raise GradingError(f"{name} has no submission in it: {why}", _MEANS, _TRY)


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
