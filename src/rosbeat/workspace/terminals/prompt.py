"""The short prompt that a page shows: the folder, as a person would say it."""

from __future__ import annotations

from pathlib import Path

#: Shown before the lines that continue a command, as bash does it.
CONTINUED = "> "


def prompt(folder: Path, parent: Path, home: Path) -> str:
    """Return what stands before a command.

    Args:
        folder: Where the shell is.
        parent: The folder that holds the workspace; what is below it is named from there.
        home: The user's home, which is called `~`.
    """
    return f"{_name(folder, parent, home)}$ "


def _name(folder: Path, parent: Path, home: Path) -> str:
    if folder == home:
        return "~"
    if folder == parent:
        return parent.name or "/"
    if parent in folder.parents:
        return str(folder.relative_to(parent))
    return f"~/{folder.relative_to(home)}" if home in folder.parents else str(folder)
