"""A learner's file is copied aside before anything replaces it."""

from __future__ import annotations

import os
from pathlib import Path, PurePosixPath

#: The folder of a workspace that holds the copies.
KEPT = "kept"
_NOT_A_PACKAGE = "COLCON_IGNORE"


def keep(relative: PurePosixPath, content: bytes, root: Path) -> PurePosixPath:
    """Copy content aside, unless a copy of this file has it already.

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
    while True:
        copy = folder / f"{relative.name}-{number}"
        if _holds(copy, content) or _written(copy, content):
            return PurePosixPath(copy.relative_to(root))
        number += 1


def _holds(copy: Path, content: bytes) -> bool:
    return copy.is_file() and copy.read_bytes() == content


def _written(copy: Path, content: bytes) -> bool:
    """Whether the copy could be made; False if another one has the name."""
    try:
        number = os.open(copy, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o666)
    except FileExistsError:
        return False
    try:
        with os.fdopen(number, "wb") as file:
            file.write(content)
    except BaseException:
        copy.unlink()
        raise
    return True
