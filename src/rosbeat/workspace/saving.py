"""Save text as a file of the workspace, atomically, and keep the version before.

A version with other content is copied to `kept/` before it is replaced.
"""

from __future__ import annotations

import errno
import fcntl
import os
import re
import stat
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path, PurePosixPath
from uuid import uuid4

from rosbeat.errors import WorkspaceError
from rosbeat.workspace.location import NAME, workspace

#: The folder of a workspace that holds copies of replaced files.
KEPT = "kept"
#: Folders that colcon or the course write themselves.
RESERVED = ("build", "install", "log", KEPT)
_NOT_A_PACKAGE = "COLCON_IGNORE"
_EXAMPLE = "src/sensor_simulator/sensor_simulator/temperature_publisher.py"
_SPACE = (
    "The disk, or your share of it, is full.",
    "Free some space (empty the trash, remove downloads) and run the cell again. Nothing was "
    "changed.",
)
_MAY_NOT = (
    "You have no permission to write there: the file or its folder is read-only.",
    "Add the permission with `chmod u+w`, or save under another name.",
)
_MEANINGS = {
    **dict.fromkeys((errno.ENOSPC, errno.EDQUOT), _SPACE),
    **dict.fromkeys((errno.EACCES, errno.EPERM, errno.EROFS), _MAY_NOT),
}
# No file of a ROS package has such a name: a comment behind it, or the `\` of Windows.
_NOT_A_NAME = re.compile(r"\\|\0|\s#")


@dataclass(frozen=True)
class Saved:
    """Hold what was saved.

    Attributes:
        path: The file, relative to the workspace.
        changed: Whether the file is another one than before.
        kept: The copy of the version before, relative to the workspace, if there was another.
    """

    path: PurePosixPath
    changed: bool
    kept: PurePosixPath | None = None

    def __str__(self) -> str:
        before = f" (the previous version is in {self.kept})" if self.kept else ""
        return f"saved {self.path}{before}"


def save(path: str, text: str, root: Path | None = None) -> Saved:
    """Write a file of the workspace; a version with other content is copied to `kept/` first.

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
    content = (text if text.endswith("\n") or not text else f"{text}\n").encode("utf-8")
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


def _replace(relative: PurePosixPath, target: Path, content: bytes, base: Path) -> Saved:
    mode, kept = None, None
    if target.exists():
        if not os.access(target, os.W_OK):  # to replace it, nobody would need the right
            raise PermissionError(errno.EACCES, os.strerror(errno.EACCES))
        mode = stat.S_IMODE(target.stat().st_mode)
        present = target.read_bytes()
        if present == content:
            return Saved(relative, changed=False)
        kept = keep(relative, present, base) if present.strip() else None
    target.parent.mkdir(parents=True, exist_ok=True)
    write(target, content, mode)
    return Saved(relative, changed=True, kept=kept)


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


def keep(relative: PurePosixPath, content: bytes, root: Path) -> PurePosixPath:
    """Copy content to `kept/`, unless a copy of this file has it already.

    A copy is named `setup.py-1`: with such an ending neither Python, pytest nor colcon takes it for
    code, wherever they are started.

    Args:
        relative: The file, relative to the workspace.
        content: What it holds now.
        root: The workspace.

    Returns:
        The copy, relative to the workspace.

    Raises:
        OSError: If it cannot be written; then nothing was changed.
    """
    folder = root / KEPT / relative.parent
    folder.mkdir(parents=True, exist_ok=True)
    (root / KEPT / _NOT_A_PACKAGE).touch()
    number = 1
    while (copy := folder / f"{relative.name}-{number}").exists():
        if copy.read_bytes() == content:
            break
        number += 1
    else:
        write(copy, content)
    return PurePosixPath(copy.relative_to(root))


# From the path that was typed to a file of the workspace.


def locate(typed: str, root: Path | None = None) -> tuple[PurePosixPath, Path]:
    """Return the file that a path relative to the workspace means.

    Args:
        typed: The path as typed, with `/` between its parts.
        root: The workspace, by default the learner's.

    Returns:
        The tidy relative path, and the real file: links inside the workspace are followed.

    Raises:
        WorkspaceError: If the path is none, leaves the workspace, or belongs to colcon.
    """
    relative = _relative(typed)
    base = (root or workspace()).resolve()
    target = (base / relative).resolve()
    if not target.is_relative_to(base) or target == base:
        raise _outside(typed)
    # A folder that is not the learner's, also behind a link of another name.
    for first in (relative.parts[0], target.relative_to(base).parts[0]):
        if first in RESERVED:
            raise WorkspaceError(
                f"{relative} cannot be saved: {first} is not a folder for your files.",
                "The folders build, install, log and kept belong to colcon and to this course.",
                "Save into src, docs, scripts or resources.",
            )
    return relative, target


def _relative(typed: str) -> PurePosixPath:
    text = typed.strip().strip("'\"")
    path = PurePosixPath(text)
    if not path.parts or text.endswith("/") or _NOT_A_NAME.search(text):
        raise WorkspaceError(
            f"`{text}` is not the path of a file.",
            "`%%save` needs the file in your workspace in which the text is saved: its parts are "
            "separated by `/`, and nothing comes after it.",
            f"Write the path after the command:  %%save {_EXAMPLE}",
        )
    if path.is_absolute() or text.startswith("~") or ".." in path.parts:
        raise _outside(typed)
    if path.parts[0] == NAME:
        raise WorkspaceError(
            f"{text} begins with the workspace itself.",
            f"Paths are relative to the workspace, so this one would be {NAME} in {NAME}.",
            f"Leave out the first part:  {'/'.join(path.parts[1:]) or _EXAMPLE}",
        )
    return path


def _outside(typed: str) -> WorkspaceError:
    return WorkspaceError(
        f"{typed.strip()} is not a path inside your workspace.",
        f"`%%save` writes only inside {NAME}, so that it cannot overwrite other files by mistake.",
        f"Write a path that starts inside the workspace, as in {_EXAMPLE}",
    )


# Errors of the operating system.


def trouble(doing: str, error: OSError) -> WorkspaceError:
    """Return an error for a person, from one of the operating system.

    Args:
        doing: What was not done, as in `src/a.py cannot be saved`.
        error: What the system said.
    """
    code = error.errno or 0
    reason = os.strerror(code) if code else str(error)
    means, to_try = _MEANINGS.get(
        code, ("The operating system refused.", "Fix the cause, then run the cell again.")
    )
    return WorkspaceError(f"{doing}: {reason}.", means, to_try)
