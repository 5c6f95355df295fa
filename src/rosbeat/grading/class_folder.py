"""Read what the learners of a class share, from a folder into which any of them can write.

`exercises.share` writes the files. Anybody may put something else there, so nothing is believed: a
file must be an ordinary one with the name of a record file, only its end is read, and a line that
is not a record of the course is passed over. All files of one owner are one learner.
"""

from __future__ import annotations

import os
import stat
import time
from collections.abc import Callable, Iterator
from contextlib import suppress
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Annotated, Literal

from msgspec import Meta

from rosbeat.errors import GradingError, RecordError
from rosbeat.exercises.registry import EXERCISES
from rosbeat.exercises.share import DAY, FILE_NAME, LARGEST, LONGEST_NAME
from rosbeat.records_json import from_json
from rosbeat.viz.text_format import count

#: Entries of the folder that are looked at, files of one owner, and letters of a line.
_ENTRIES, _FILES, _LINE = 20_000, 4, 400
#: Seconds by which the clock of another computer may be ahead.
_AHEAD = 60


@dataclass(frozen=True)
class Record:
    """Hold what one check has written.

    Attributes:
        status: `passed` or `failed`.
        time: When, in seconds since 1970.
        mistake: Id of the named mistake; may be empty, or unknown to the course.
        name: What the learner wants to be called; may be empty.
    """

    exercise: Annotated[str, Meta(max_length=20)]
    status: Literal["passed", "failed"]
    time: int
    mistake: Annotated[str, Meta(max_length=60)] = ""
    name: Annotated[str, Meta(max_length=LONGEST_NAME)] = ""


@dataclass(frozen=True)
class Learner:
    """Hold what one learner shares."""

    records: tuple[Record, ...]

    @cached_property
    def by_exercise(self) -> dict[str, list[Record]]:
        """Return the records of each exercise."""
        found: dict[str, list[Record]] = {}
        for one in self.records:
            found.setdefault(one.exercise, []).append(one)
        return found

    @property
    def name(self) -> str:
        """Return what the learner wants to be called now; empty for no name."""
        return self.records[-1].name if self.records else ""


@dataclass(frozen=True)
class Reading:
    """Hold what was found in the folder of a class.

    Attributes:
        learners: Those who share, also if they have checked nothing yet.
        notices: What an instructor should know about the folder, as sentences.
        time: When it was read, in seconds since 1970.
    """

    learners: tuple[Learner, ...]
    notices: tuple[str, ...]
    time: float


class ClassFolder:
    """Read the folder of a class, again and again.

    Args:
        path: The folder.
        now: Returns the time, in seconds since 1970.
        owner: Returns whose a file is: all files of one owner are one learner.
    """

    def __init__(
        self,
        path: Path,
        now: Callable[[], float] = time.time,
        owner: Callable[[os.DirEntry[str]], int] = lambda entry: (
            entry.stat(follow_symlinks=False).st_uid
        ),
    ) -> None:
        self.path, self._now, self._owner = path, now, owner

    def read(self) -> Reading:
        """Return what the learners share now.

        Raises:
            GradingError: If the folder cannot be read.
        """
        now = self._now()
        try:
            found, skipped = self._files()
        except OSError as error:
            raise GradingError(
                f"The folder of the class cannot be read: {self.path}: {error.strerror}.",
                "Learners who share write into this folder.",
                "docs/instructors.md says how to create it: Where the class is stuck.",
            ) from None
        learners, unread = [], 0
        for files in found.values():
            records: list[Record] = []
            for _, name in sorted(files)[-_FILES:]:
                try:
                    records += _parsed(_end_of(self.path / name))
                except FileNotFoundError:
                    pass  # it has just been deleted
                except OSError:
                    unread += 1
            recent = (one for one in records if now - DAY < one.time <= now + _AHEAD)
            learners.append(Learner(tuple(sorted(recent, key=lambda one: one.time))))
        return Reading(tuple(learners), tuple(_notices(unread, skipped)), now)

    def _files(self) -> tuple[dict[int, list[tuple[int, str]]], int]:
        """Return dates and names of each owner's files, and how many entries were left out."""
        found: dict[int, list[tuple[int, str]]] = {}
        with os.scandir(self.path) as entries:
            for number, entry in enumerate(entries):
                if number >= _ENTRIES:
                    return found, sum(1 for _ in entries) + 1
                with suppress(OSError):  # it has just been deleted
                    state = entry.stat(follow_symlinks=False)
                    if FILE_NAME.fullmatch(entry.name) and _is_plain(state):
                        named = (state.st_mtime_ns, entry.name)
                        found.setdefault(self._owner(entry), []).append(named)
        return found, 0

    def forget(self, before: float | None = None) -> int:
        """Delete the files of learners, and return how many.

        Args:
            before: Only those that were last written before this time, in seconds since 1970.

        Raises:
            GradingError: If the folder cannot be read, or a file in it cannot be deleted.
        """
        try:
            with os.scandir(self.path) as entries:
                gone = [entry.name for entry in entries if _is_old(entry, before)]
            for name in gone:
                (self.path / name).unlink(missing_ok=True)
        except OSError as error:
            raise GradingError(
                f"What learners have shared cannot be deleted: {error.strerror}: {error.filename}.",
                "In the folder of a class, only its owner can delete everybody's files.",
                "Run the command as the owner of the folder, or ask the administrator.",
            ) from None
        return len(gone)


def _is_old(entry: os.DirEntry[str], before: float | None) -> bool:
    """Return whether an entry is a learner's, or what such a file was before its last change."""
    if not (FILE_NAME.fullmatch(entry.name) or entry.name.startswith(".saving-")):
        return False
    return before is None or entry.stat(follow_symlinks=False).st_mtime < before


def _is_plain(state: os.stat_result) -> bool:
    """Return whether it is an ordinary file with no other name, which may be somebody else's."""
    return stat.S_ISREG(state.st_mode) and state.st_nlink == 1


def _end_of(path: Path) -> bytes:
    """Return the last bytes of a file, whatever has taken its place by now.

    Raises:
        OSError: If it cannot be read.
    """
    flags = os.O_RDONLY | os.O_NOFOLLOW | os.O_NONBLOCK | os.O_NOCTTY | os.O_CLOEXEC
    number = os.open(path, flags)
    try:
        state = os.fstat(number)
        if not _is_plain(state):
            return b""
        return os.pread(number, LARGEST, max(0, state.st_size - LARGEST))
    finally:
        os.close(number)


def _parsed(content: bytes) -> Iterator[Record]:
    """Yield the records of a file, and pass over what is none."""
    for line in content.splitlines():
        if len(line) <= _LINE:
            with suppress(RecordError):
                record = from_json(Record, line, "record")
                if record.exercise in EXERCISES:
                    yield record


def _notices(unread: int, skipped: int) -> Iterator[str]:
    if unread:
        yield (
            f"{count(unread, 'file')} in the folder of the class cannot be read: learners are "
            "missing here. The folder needs a group that you are in."
        )
    if skipped:
        yield (
            f"The folder of the class has {count(skipped, 'entry', 'entries')} too many: learners "
            "may be missing here. Somebody fills it; look at the owners of the files."
        )
