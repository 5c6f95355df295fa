"""Read uploads: the files of a folder, of a zip file, and of zip files inside them.

A folder of homes, as on a hub, is an upload, too: each learner's pages are in `my_course`.

Learners' files are untrusted until they are parsed. Nothing is unpacked to disk, and no link is
followed. An unreadable file stays in the list with the reason. Every limit applies to one file or
one learner, so a bad entry affects nobody else.
"""

from __future__ import annotations

import io
import os
import re
import stat
import zipfile
from collections.abc import Callable, Iterator, Sequence
from contextlib import ExitStack, contextmanager, suppress
from dataclasses import dataclass, field, replace
from datetime import datetime
from functools import partial
from pathlib import Path

from rosbeat.errors import GradingError
from rosbeat.grading.files import printable
from rosbeat.grading.platforms.base import NOTEBOOKS

#: Bytes of one file that is read: a notebook with all its outputs, or a zip file.
MOST_BYTES = 64_000_000
#: Bytes that are read for one learner, zip files unpacked, and files that are looked at.
MOST_OF_A_LEARNER, MOST_FILES = 400_000_000, 5_000
#: Zip files inside zip files: a learner's own, and one more that somebody put into it.
MOST_LEVELS = 2
#: Folders inside folders that are looked into, and entries of one zip file.
MOST_DEPTH, MOST_ENTRIES = 40, 20_000
#: Archives that are not opened. Somebody may have put their pages into one.
OTHER_ARCHIVES = (".rar", ".7z", ".tar", ".gz", ".tgz", ".bz2", ".xz", ".zst")
#: Files and folders that computers add by themselves.
_CLUTTER = {"__MACOSX", ".DS_Store", "Thumbs.db", "desktop.ini", "__pycache__"}
#: What the course makes in the home of a learner on a hub, and the names of the pages that it puts
#: there. A name that the learner chose could look like one that Moodle made for somebody else.
_LEARNERS_FOLDER, _NOTES = "my_course", ".rosbeat"
_PAGE_IN_PLACE = re.compile(r"\d\d_[a-z_]+\.ipynb")
_DRIVE = re.compile(r"[A-Za-z]:")
#: Seconds since 1970 of the year 9000.
_LAST_DATE = 221_845_392_000
EMPTY_FOLDER = "The folder is empty."
_LINK = "It is a link or not an ordinary file, so it was not followed."
_NO_COURSE = "Nobody has opened the course in this home."
_DEEP = f"It lies in more than {MOST_DEPTH} folders, one in another, so it was not looked at."
#: What each entry in the directory of a zip file begins with.
_ENTRY = b"PK\1\2"


@dataclass(frozen=True)
class File:
    """Hold one file of an upload.

    Attributes:
        parts: Its path within the upload, folder by folder; a zip file counts as a folder of its
            name without `.zip`. A folder that is empty or cannot be opened ends with an empty part.
        size: Its size in bytes.
        modified: When it was last changed, in seconds since 1970; 0 if unknown.
        read: Returns its bytes; raises OSError if they cannot be read.
        problem: Why it is not read, a sentence; or empty.
    """

    parts: tuple[str, ...]
    size: int = 0
    modified: float = 0.0
    read: Callable[[], bytes] = bytes
    problem: str = ""

    @property
    def path(self) -> str:
        """Return the path, safe to print."""
        return printable("/".join(self.parts))

    @property
    def is_zip(self) -> bool:
        """Return whether its name says that it is a zip file."""
        return self.parts[-1].lower().endswith(".zip")


@dataclass
class Allowance:
    """Count what may still be read for one learner."""

    size: int = field(default_factory=lambda: MOST_OF_A_LEARNER)
    files: int = field(default_factory=lambda: MOST_FILES)

    def read(self, file: File) -> bytes:
        """Return the bytes of a file.

        Raises:
            OSError: If it cannot be read, or if the learner has used up the allowance. The text is
                a sentence.
        """
        if file.problem:
            raise OSError(file.problem)
        if file.size > min(MOST_BYTES, self.size):
            whose = "one file" if file.size > MOST_BYTES else "one learner's files"
            raise OSError(f"It has {file.size / 1e6:.0f} MB, more than is read of {whose}.")
        self.size -= file.size
        try:
            return file.read()
        except OSError as error:
            raise OSError(f"It cannot be read: {error.strerror or error}.") from error


@contextmanager
def open_upload(source: Path) -> Iterator[list[File]]:
    """Open a folder, a zip file, or a page.

    Yields:
        Its files, sorted by path. They can be read until the context ends; zip files among them
        are not opened, see `opened`.

    Raises:
        GradingError: If `source` is none of them.
    """
    if source.is_dir():
        yield sorted(_files_of_folder(source), key=lambda one: one.parts)
        return
    if is_page(source):
        place = source.resolve()
        yield [replace(_file(place.parent, (place.name,)), parts=(source.name,))]
        return
    try:
        archive = zipfile.ZipFile(source)
    except Exception as error:  # zipfile raises a dozen types for damaged archives
        found = "is not a zip file that can be read" if source.is_file() else "does not exist"
        raise GradingError(
            f"{printable(str(source), 1000)} {found}.",
            "Submissions are a folder, or one zip file as a learning management system makes it; a "
            "single one may also be a page, an .ipynb file.",
            "Give the folder or the zip file that you downloaded, or the page.",
        ) from error
    with archive:
        yield sorted(_files_of_zip(archive, ()), key=lambda one: one.parts)


def is_page(source: Path) -> bool:
    """Return whether a path is that of a file which may be a page, by its name."""
    return source.is_file() and source.name.lower().endswith(NOTEBOOKS)


def opened(file: File, allowed: Allowance, level: int = 0) -> Iterator[File]:
    """Open a zip file of a learner; any other file is yielded as it is.

    Yields:
        Files. A zip file that cannot be opened is yielded itself, with its problem.
    """
    if not file.is_zip or file.problem:
        allowed.files -= 1
        if allowed.files == -1:
            said = f"More than {MOST_FILES} files were handed in; the others were not looked at."
            yield File((*file.parts[:1], ""), problem=said)
        elif allowed.files >= 0:
            yield file
        return
    if level >= MOST_LEVELS:
        yield replace(file, problem="It is a zip file in a zip file in a zip file.")
        return
    try:
        data = allowed.read(file)
        if data.count(_ENTRY) > MOST_ENTRIES:
            raise OSError(f"It has more than {MOST_ENTRIES} entries, more than any submission.")
        archive = zipfile.ZipFile(io.BytesIO(data))
    except Exception as error:  # zipfile raises a dozen types for damaged archives
        said = str(error) if isinstance(error, OSError) else f"It cannot be opened: {error}."
        yield replace(file, problem=printable(said, 400))
        return
    inside = (*file.parts[:-1], file.parts[-1][: -len(".zip")])
    with archive:
        for one in _files_of_zip(archive, inside):
            yield from opened(one, allowed, level + 1)


# Folders.


def _files_of_folder(root: Path) -> Iterator[File]:
    homes = []
    with suppress(OSError), os.scandir(root) as found:  # what cannot be read is said below
        homes = [Path(one.path) for one in found if one.is_dir(follow_symlinks=False)]
    if _are_homes(root, homes):
        for home in homes:
            yield from _files_of_home(home)
        return
    failed: list[OSError] = []
    for place, folders, names in os.walk(root, onerror=failed.append):
        above = Path(place).relative_to(root).parts
        if len(above) >= MOST_DEPTH and folders:
            yield File((*above[:2], ""), problem=_DEEP)
            folders.clear()
        links = [name for name in folders if Path(place, name).is_symlink()]
        folders[:] = [name for name in folders if not _is_clutter(name) and name not in links]
        yield from (File((*above, name, ""), problem=_LINK) for name in links)
        names = [name for name in names if not _is_clutter(name)]
        if above and not folders and not names and not links:
            yield File((*above, ""), problem=EMPTY_FOLDER)
        yield from (_file(root, (*above, name)) for name in names)
    for error in failed:
        parts = Path(error.filename).relative_to(root).parts
        yield File((*parts, ""), problem=_unopened(error))


def _files_of_home(home: Path) -> Iterator[File]:
    """Yield a learner's pages, and no copies, solutions and other files of theirs."""
    problem = _course_folder(home)
    if problem == _NO_COURSE:
        yield File((home.name,), problem=problem)
        return
    try:
        names = [] if problem else sorted(os.listdir(home / _LEARNERS_FOLDER))
    except OSError as error:
        problem = _unopened(error)
    if problem:
        yield File((home.name, ""), problem=problem)
        return
    pages = [name for name in names if _PAGE_IN_PLACE.fullmatch(name)]
    for name in pages:
        found = _file(home, (_LEARNERS_FOLDER, name))
        yield replace(found, parts=(home.name, name))
    if not pages:
        yield File((home.name, ""), problem=EMPTY_FOLDER)


def _are_homes(root: Path, folders: Sequence[Path]) -> bool:
    """Return whether these folders are the homes of a hub, and not what learners handed in.

    They are if the course has made its notes in any of them. Learners who have reset their progress
    have none, and these may be all; then whoever lacks the course's folder has no notebook either.
    """
    opened = [home for home in folders if _course_folder(home) is None]
    if any((home / _LEARNERS_FOLDER / _NOTES).is_dir() for home in opened):
        return True
    others = [home for home in folders if _course_folder(home) == _NO_COURSE]
    names: list[Path] = []
    with suppress(OSError):
        names += root.glob("*.*")
        for home in others:
            names += (*home.glob("*.*"), *home.glob("*/*.*"))
    return bool(opened) and not any(name.suffix.lower() in (".ipynb", ".zip") for name in names)


def _course_folder(home: Path) -> str | None:
    """Return why the folder that the course makes in a home cannot be used; None if it can be."""
    for folder in (home / _LEARNERS_FOLDER, home / _LEARNERS_FOLDER / _NOTES):
        try:
            mode = folder.lstat().st_mode
        except FileNotFoundError:
            if folder.name == _NOTES:
                return None  # the progress was reset
            return _NO_COURSE
        except OSError as error:
            return _unopened(error)
        if not stat.S_ISDIR(mode):
            return _LINK
    return None


def _unopened(error: OSError) -> str:
    return f"The folder cannot be read: {error.strerror}."


def _file(root: Path, parts: tuple[str, ...]) -> File:
    found = root.joinpath(*parts).lstat()
    if not stat.S_ISREG(found.st_mode):
        return File(parts, problem=_LINK)
    # A learner of a hub may set any date, also one that is in no calendar.
    modified = min(found.st_mtime, _LAST_DATE)
    return File(parts, found.st_size, modified, partial(_read, root, parts))


def _read(root: Path, parts: tuple[str, ...]) -> bytes:
    """Return the bytes of a file, even if a learner puts a link in its path meanwhile.

    Raises:
        OSError: If there is a link, or it cannot be read.
    """
    with ExitStack() as opened:
        place = os.open(root, os.O_PATH)
        opened.callback(os.close, place)
        for name in parts[:-1]:
            place = os.open(name, os.O_PATH | os.O_DIRECTORY | os.O_NOFOLLOW, dir_fd=place)
            opened.callback(os.close, place)
        # It may have become a pipe, which would keep whoever opens it.
        file = os.open(parts[-1], os.O_RDONLY | os.O_NOFOLLOW | os.O_NONBLOCK, dir_fd=place)
        with open(file, "rb") as content:
            return content.read(MOST_BYTES + 1)


# Zip files.


def _files_of_zip(archive: zipfile.ZipFile, inside: tuple[str, ...]) -> Iterator[File]:
    """Yield the members of a zip file, and the folders that it names and that are empty."""
    found = [(one, (*inside, *_parts(one.filename))) for one in archive.infolist()]
    found = [one for one in found if one[1] and not any(map(_is_clutter, one[1]))]
    filled: set[tuple[str, ...]] = set()
    for member, parts in sorted(found, key=lambda one: -len(one[1])):  # the innermost first
        if len(parts) > MOST_DEPTH:
            yield File((*parts[:2], parts[-1]), problem=_DEEP)
        elif member.is_dir() and parts not in filled:
            yield File((*parts, ""), problem=EMPTY_FOLDER)
        elif not member.is_dir():
            read, problem = partial(_unpack, archive, member), _problem_of(member)
            yield File(parts, member.file_size, _changed(member), read, problem)
        filled.update(parts[:n] for n in range(min(len(parts), MOST_DEPTH)))


def _parts(name: str) -> tuple[str, ...]:
    """Return a member's path without what would lead out of the archive: nothing is unpacked."""
    parts = name.replace("\\", "/").split("/")
    return tuple(one for one in parts if one not in ("", ".", "..") and not _DRIVE.fullmatch(one))


def _problem_of(member: zipfile.ZipInfo) -> str:
    if stat.S_ISLNK(member.external_attr >> 16):
        return _LINK
    return "It is encrypted, so it cannot be read." if member.flag_bits & 1 else ""


def _unpack(archive: zipfile.ZipFile, member: zipfile.ZipInfo) -> bytes:
    try:
        with archive.open(member) as file:
            return file.read(min(member.file_size, MOST_BYTES) + 1)
    except Exception as error:  # zipfile raises a dozen types for damaged members
        raise OSError(f"{type(error).__name__}: {error}") from error


def _changed(member: zipfile.ZipInfo) -> float:
    """Return when a member was changed; a zip file holds local time, as deadlines are typed."""
    try:
        return datetime(*member.date_time).timestamp()
    except (ValueError, OverflowError, OSError):
        return 0.0


def _is_clutter(name: str) -> bool:
    return name in _CLUTTER or name.startswith(("._", ".ipynb_checkpoints", ".git"))
