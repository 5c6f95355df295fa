"""From a path that somebody typed to a file of the workspace, and never to one outside of it."""

from __future__ import annotations

from difflib import get_close_matches
from pathlib import Path, PurePosixPath

from rosbeat.errors import WorkspaceError
from rosbeat.workspace.place import NAME, workspace

#: Folders that colcon or the course write themselves.
RESERVED = ("build", "install", "log", "kept")
_EXAMPLE = "src/sensor_simulator/sensor_simulator/temperature_publisher.py"


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
    target = _real(base, relative)
    if not target.is_relative_to(base) or target == base:
        raise _outside(typed)
    _refuse_reserved(relative, target.relative_to(base).parts[0])
    return relative, target


def _refuse_reserved(relative: PurePosixPath, real: str) -> None:
    """Refuse a folder that is not the learner's, also behind a link of another name."""
    for first in (relative.parts[0], real):
        if first in RESERVED:
            raise WorkspaceError(
                f"{relative} cannot be saved: {first} is not for files of yours.",
                "colcon and this course write build, install, log and kept themselves.",
                "Save into src, docs, scripts or resources.",
            )


def _relative(typed: str) -> PurePosixPath:
    text = typed.strip().strip("'\"")
    if not text or "\0" in text:
        raise WorkspaceError(
            "There is no path to save to.",
            "The path says which file of your workspace the text becomes.",
            f"Write it behind the command:  %%save {_EXAMPLE}",
        )
    _refuse_more_than_a_path(text)
    path = PurePosixPath(text)
    if path.is_absolute() or text.startswith("~") or ".." in path.parts:
        raise _outside(typed)
    if not path.parts or text.endswith("/"):
        raise WorkspaceError(
            f"{text} names a folder, not a file.",
            "What is saved becomes one file.",
            f"Put the file's name at the end, as in {_EXAMPLE}",
        )
    if path.parts[0] == NAME:
        raise WorkspaceError(
            f"{text} begins with the workspace itself.",
            f"Paths count from inside the workspace, so this would be {NAME} in {NAME}.",
            f"Leave the first part out:  {'/'.join(path.parts[1:]) or _EXAMPLE}",
        )
    return path


def _refuse_more_than_a_path(text: str) -> None:
    path, mark, _ = text.partition(" #")
    if mark:
        raise WorkspaceError(
            f"{text} is more than a path.",
            "All of that line would be the file's name, also what looks like a comment.",
            f"Leave the comment out:  {path.rstrip()}",
        )
    if "\\" in text:
        raise WorkspaceError(
            f"{text} has a `\\` in it.",
            "ROS 2 runs on Linux here, and there `/` stands between the parts of a path.",
            f"Write  {text.replace(chr(92), '/')}",
        )


def _real(base: Path, relative: PurePosixPath) -> Path:
    try:
        return (base / relative).resolve()
    except (OSError, RuntimeError):  # links that lead in a circle
        raise WorkspaceError(
            f"{relative} leads nowhere.",
            "A symbolic link on this path points back to itself.",
            "Remove that link, or save under another name.",
        ) from None


def _outside(typed: str) -> WorkspaceError:
    return WorkspaceError(
        f"{typed.strip()} is not a path inside your workspace.",
        f"Files are saved in {NAME} only, so that nothing else can be overwritten by mistake.",
        f"Write a path that starts inside the workspace, as in {_EXAMPLE}",
    )


def nearest(word: str, names: list[str], cutoff: float = 0.6) -> str | None:
    """Return the name that was probably meant, or None if nothing is like it.

    Args:
        word: What was typed.
        names: What would have been right.
        cutoff: How much alike they have to be, from 0 to 1.
    """
    by_lower = {name.lower(): name for name in names}
    found = get_close_matches(word.lower(), by_lower, n=1, cutoff=cutoff)
    return by_lower[found[0]] if found else None
