"""Text becomes a file of the workspace: whole or not at all, and never at the cost of another."""

from __future__ import annotations

import os
import stat
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
    relative, target = locate(path, base)
    content = _bytes(relative, text)
    try:
        return _replace(relative, target, content, base)
    except OSError as error:
        raise trouble(f"{relative} cannot be saved", error) from None


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
