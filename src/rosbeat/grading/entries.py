"""The files of an upload: of a folder, of a zip file, and of zip files in them.

Whatever a learner has handed in is hostile until it is parsed. So nothing is unpacked to the disk,
nothing is followed that leads elsewhere, and what would grow beyond all measure is not read.
"""

from __future__ import annotations

import io
import os
import stat
import zipfile
import zlib
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import partial
from pathlib import Path, PurePosixPath

from rosbeat.errors import GradingError
from rosbeat.grading.remarks import Remark, printable

#: Bytes of one file that is read at most.
MOST_BYTES = 20_000_000
#: Bytes of a zip file in a zip file, and of all that one zip file holds.
MOST_OF_A_ZIP, MOST_UNPACKED = 200_000_000, 2_000_000_000
#: How much larger than its packed form a file may be; text seldom shrinks to a hundredth.
MOST_GROWTH = 200
#: Files of one zip file.
MOST_FILES = 50_000
#: Zip files in zip files: a class in one, and a learner in each.
MOST_LEVELS = 2
#: Names of folders and files that computers add of their own accord.
_CLUTTER = {"__MACOSX", ".DS_Store", "Thumbs.db", "desktop.ini", "__pycache__"}


@dataclass(frozen=True)
class Entry:
    """One file.

    Attributes:
        parts: Its path within the upload, folder by folder; a zip file counts as a folder of its
            name without `.zip`.
        size: Its size in bytes.
        modified: When it was last changed, in seconds since 1970; 0 if unknown.
        read: Gives its bytes; raises OSError if they cannot be read.
    """

    parts: tuple[str, ...]
    size: int
    modified: float
    read: Callable[[], bytes]

    @property
    def path(self) -> str:
        """The path for people."""
        return printable("/".join(self.parts))


@dataclass(frozen=True)
class Listing:
    """What an upload holds.

    Attributes:
        entries: Its files, sorted by path.
        remarks: What was left out, and why.
    """

    entries: tuple[Entry, ...]
    remarks: tuple[Remark, ...]


def list_files(source: Path) -> Listing:
    """List the files of a folder or a zip file.

    Args:
        source: The folder or the zip file.

    Raises:
        GradingError: If there is no such thing, or it can be neither.
    """
    remarks: list[Remark] = []
    if source.is_dir():
        entries = list(_of_folder(source, remarks))
    elif source.is_file() and zipfile.is_zipfile(source):
        size, changed = source.stat().st_size, source.stat().st_mtime
        whole = Entry((), size, changed, source.read_bytes)
        entries = list(_of_zip(whole, (), remarks, 1))
    else:
        raise _no_source(source)
    return Listing(tuple(sorted(entries, key=lambda one: one.parts)), tuple(remarks))


def _no_source(source: Path) -> GradingError:
    found = "is no zip file that can be read" if source.is_file() else "is not there"
    return GradingError(
        f"{printable(str(source))} {found}.",
        "Submissions are a folder, or one zip file as a learning management system makes it.",
        "Give the folder or the zip file that you downloaded.",
    )


def _of_folder(folder: Path, remarks: list[Remark]) -> Iterator[Entry]:
    for place, folders, names in os.walk(folder, followlinks=False):
        folders[:] = sorted(name for name in folders if not _is_clutter(name))
        for name in sorted(names):
            path = Path(place, name)
            parts = path.relative_to(folder).parts
            if _is_clutter(name):
                continue
            if path.is_symlink() or not path.is_file():
                remarks.append(_refused(parts, "It is a link or no ordinary file"))
                continue
            found = path.stat()
            entry = Entry(parts, found.st_size, found.st_mtime, partial(_read, path))
            yield from _opened(entry, remarks, 0)


def _read(path: Path) -> bytes:
    with path.open("rb") as file:
        return file.read(MOST_OF_A_ZIP + 1)


def _opened(entry: Entry, remarks: list[Remark], level: int) -> Iterator[Entry]:
    """The entry itself, or what is in it if it is a zip file."""
    if not entry.parts[-1].lower().endswith(".zip"):
        yield entry
    elif level >= MOST_LEVELS:
        remarks.append(_refused(entry.parts, "It is a zip file in a zip file in a zip file"))
    elif entry.size > MOST_OF_A_ZIP:
        remarks.append(_too_large(entry))
    else:
        inner = (*entry.parts[:-1], entry.parts[-1][: -len(".zip")])
        yield from _of_zip(entry, inner, remarks, level + 1)


def _of_zip(
    whole: Entry, inside: tuple[str, ...], remarks: list[Remark], level: int
) -> Iterator[Entry]:
    try:
        archive = zipfile.ZipFile(io.BytesIO(whole.read()))
        members = archive.infolist()
    except (zipfile.BadZipFile, OSError, ValueError, NotImplementedError, RecursionError) as error:
        text = f"It cannot be opened as a zip file: {printable(str(error))}."
        remarks.append(Remark("unreadable", whole.path, text))
        return
    if len(members) > MOST_FILES or sum(one.file_size for one in members) > MOST_UNPACKED:
        text = f"It claims to hold {len(members)} files, more or larger than any class hands in."
        remarks.append(Remark("too-large", whole.path or "the zip file", text))
        return
    for member in members:
        yield from _of_member(archive, member, inside, remarks, level)


def _of_member(
    archive: zipfile.ZipFile,
    member: zipfile.ZipInfo,
    inside: tuple[str, ...],
    remarks: list[Remark],
    level: int,
) -> Iterator[Entry]:
    names = tuple(member.filename.replace("\\", "/").split("/"))
    parts = (*inside, *(name for name in names if name not in ("", ".")))
    if member.is_dir() or any(map(_is_clutter, parts)):
        return
    why = _why_refused(member)
    if why:
        remarks.append(_refused(parts, why))
        return
    entry = Entry(parts, member.file_size, _changed(member), partial(_unpack, archive, member))
    if entry.size > MOST_OF_A_ZIP:
        remarks.append(_too_large(entry))
        return
    yield from _opened(entry, remarks, level)


def _why_refused(member: zipfile.ZipInfo) -> str:
    path = PurePosixPath(member.filename.replace("\\", "/"))
    if path.is_absolute() or ".." in path.parts or ":" in "".join(path.parts[:1]):
        return "Its path leads out of the zip file"
    if stat.S_ISLNK(member.external_attr >> 16):
        return "It is a link"
    if member.flag_bits & 1:
        return "It is encrypted"
    if member.file_size > MOST_GROWTH * max(member.compress_size, 10_000):
        return "It would grow beyond all measure when it is unpacked"
    return ""


def _unpack(archive: zipfile.ZipFile, member: zipfile.ZipInfo) -> bytes:
    try:
        with archive.open(member) as file:
            return file.read(min(member.file_size, MOST_OF_A_ZIP) + 1)
    except (zipfile.BadZipFile, zlib.error, NotImplementedError, RuntimeError) as error:
        raise OSError(f"it cannot be unpacked: {error}") from error


def _changed(member: zipfile.ZipInfo) -> float:
    """When a file was changed; a zip file has the time of a clock on a wall, as deadlines do."""
    from datetime import datetime

    try:
        return datetime(*member.date_time).timestamp()
    except (ValueError, OverflowError, OSError):
        return 0.0


def _is_clutter(name: str) -> bool:
    return name in _CLUTTER or name.startswith(("._", ".ipynb_checkpoints", ".git"))


def _refused(parts: tuple[str, ...], why: str) -> Remark:
    return Remark("refused", printable("/".join(parts)), f"{why}, so it is left alone.")


def _too_large(entry: Entry) -> Remark:
    text = f"It has {entry.size / 1e6:.0f} MB, more than is read of anything handed in."
    return Remark("too-large", entry.path, text)
