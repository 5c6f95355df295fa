"""Text becomes a file of the workspace: whole or not at all, and never at the cost of another."""

from __future__ import annotations

import fcntl
import os
import stat
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path, PurePosixPath
from uuid import uuid4

from rosbeat.errors import WorkspaceError
from rosbeat.workspace.keeping import keep
from rosbeat.workspace.locating import locate
from rosbeat.workspace.place import workspace
from rosbeat.workspace.troubles import trouble


@dataclass(frozen=True)
class Saved:
    """What was saved.

    Attributes:
        path: The file, relative to the workspace.
        changed: Whether the file is another one than before.
        kept: The copy of the version before, relative to the workspace, if there was another.
    """

    path: PurePosixPath
    changed: bool
    kept: PurePosixPath | None = None

    def __str__(self) -> str:
        before = f" (the version before is in {self.kept})" if self.kept else ""
        return f"saved {self.path}{before}"


def save(path: str, text: str, root: Path | None = None) -> Saved:
    """Write a file of the workspace; a version with another content is copied aside first.

    Args:
        path: The file, relative to the workspace. Missing folders are made.
        text: All of its content; it gets a line end if it has none.
        root: The workspace, by default the learner's.

    Returns:
        What was done. A file that holds this text already is not touched.

    Raises:
        WorkspaceError: If the path leaves the workspace, or the file cannot be written. Then
            whatever was there is there still.
    """
    base = (root or workspace()).resolve()
    relative, _ = locate(path, base)
    return save_bytes(path, _bytes(relative, text), base)


def save_bytes(path: str, content: bytes, root: Path | None = None) -> Saved:
    """Write a file of the workspace as `save` does, with exactly these bytes.

    Args:
        path: The file, relative to the workspace.
        content: All of its content.
        root: The workspace, by default the learner's.

    Returns:
        What was done.

    Raises:
        WorkspaceError: As with `save`.
    """
    base = (root or workspace()).resolve()
    relative, target = locate(path, base)
    try:
        base.mkdir(parents=True, exist_ok=True)
        with only_writer(base):
            return _replace(relative, target, content, base)
    except OSError as error:
        raise trouble(f"{relative} cannot be saved", error) from None


@contextmanager
def only_writer(folder: Path) -> Iterator[None]:
    """Hold back other pages that save into a workspace, until this one has finished.

    Two that replace one file at once would each keep the same version before, and one of the two
    new versions would be lost.

    Args:
        folder: The workspace.
    """
    number = os.open(folder, os.O_RDONLY)
    try:
        with suppress(OSError):  # some network file systems have no such locks
            fcntl.flock(number, fcntl.LOCK_EX)
        yield
    finally:
        os.close(number)


def _bytes(relative: PurePosixPath, text: str) -> bytes:
    ended = text if text.endswith("\n") or not text else text + "\n"
    try:
        return ended.encode("utf-8")
    except UnicodeEncodeError as error:
        line = ended.count("\n", 0, error.start) + 1
        raise WorkspaceError(
            f"{relative} cannot be saved: line {line} holds a character that is none.",
            "Half of a character was pasted, and no file can hold that.",
            f"Delete what looks odd in line {line} and type it again.",
        ) from None


def _replace(relative: PurePosixPath, target: Path, content: bytes, base: Path) -> Saved:
    mode, kept = None, None
    if target.exists():
        mode = _mode_of(relative, target)
        present = target.read_bytes()
        if present == content:
            return Saved(relative, changed=False)
        kept = keep(relative, present, base) if present.strip() else None
    target.parent.mkdir(parents=True, exist_ok=True)
    write(target, content, mode)
    return Saved(relative, changed=True, kept=kept)


def _mode_of(relative: PurePosixPath, target: Path) -> int:
    """The rights of a file that may be replaced."""
    if not target.is_file():
        raise WorkspaceError(
            f"{relative} cannot be saved: there is a folder of that name, or a device.",
            "A file cannot have the name of something else that is there.",
            "Choose another name, or rename what is there.",
        )
    if not os.access(target, os.W_OK):
        raise WorkspaceError(
            f"{relative} cannot be saved: the file is write-protected.",
            "Somebody took the right to write away, perhaps you, to keep the file as it is.",
            f"Allow it with  chmod u+w {relative}  in the workspace, or save under another name.",
        )
    return stat.S_IMODE(target.stat().st_mode)


def write(target: Path, content: bytes, mode: int | None = None) -> None:
    """Put a file in place in one step, so that nobody ever sees half of it.

    Args:
        target: The file; its folder exists.
        content: All of its bytes.
        mode: Its rights, by default those of a new file.

    Raises:
        OSError: If it cannot be written; then nothing was changed.
    """
    beside = target.with_name(f".saving-{uuid4().hex[:12]}")
    number = os.open(beside, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o666)
    try:
        with os.fdopen(number, "wb") as file:
            file.write(content)
            if mode is not None:
                os.fchmod(file.fileno(), mode)
        os.replace(beside, target)
    except BaseException:
        beside.unlink(missing_ok=True)
        raise
