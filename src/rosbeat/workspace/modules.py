"""Which files of a package are modules, and what is in a cell that becomes one."""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path, PurePosixPath

from rosbeat.errors import WorkspaceError
from rosbeat.workspace.parsing import parse

_BLANK = re.compile(r"(?<!\w)_{4,}(?!\w)")
_MAGIC = re.compile(r"^\s*(%%?\w|!|\?)|\?\s*$|^\s*\w+\s*=\s*[%!]")


def module_name(relative: PurePosixPath, root: Path) -> str | None:
    """Return the name under which nodes import a file, or None if it is no module of a package.

    Args:
        relative: The file, relative to the workspace.
        root: The workspace.
    """
    package = next(
        (one for one in relative.parents if (root / one / "package.xml").is_file()), None
    )
    if package is None or relative.suffix != ".py":
        return None
    inside = relative.relative_to(package).with_suffix("")
    folders = inside.parts[:-1]
    if not folders or not all(part.isidentifier() for part in inside.parts):
        return None
    if folders[0] != package.name and not _all_packages(root / package, folders):
        return None
    return ".".join(folders if inside.name == "__init__" else inside.parts)


def _all_packages(start: Path, folders: tuple[str, ...]) -> bool:
    places = [start.joinpath(*folders[: depth + 1]) for depth in range(len(folders))]
    return all((place / "__init__.py").is_file() for place in places)


def blank_line(text: str) -> int:
    """Return the number of the first line that holds a blank `____`, or 0 if there is none."""
    found = _BLANK.search(text)
    return text.count("\n", 0, found.start()) + 1 if found else 0


def is_python(text: str) -> bool:
    """Whether a text can be read as Python."""
    try:
        parse(text)
    except (SyntaxError, ValueError):
        return False
    return True


def refuse_magics(text: str, transform: Callable[[str], str]) -> None:
    """Refuse a text that only IPython understands.

    Args:
        text: What is to become a file.
        transform: What IPython makes of a cell before Python reads it.

    Raises:
        WorkspaceError: If a line is a command of the notebook.
    """
    if is_python(text) or not is_python(transform(text)):
        return
    lines = [(number, line.strip()) for number, line in enumerate(text.splitlines(), 1)
             if _MAGIC.search(line) and not is_python(line.strip())]  # fmt: skip
    if lines:
        number, line = lines[0]
        raise WorkspaceError(
            f"Nothing was saved: line {number} of the file would be `{line}`.",
            "Lines with % or ! or ? are commands of the notebook, and Python on a robot has none.",
            "Put that line into a cell of its own.",
        )
