"""`colcon build` in a folder that is no workspace.

colcon reads whatever lies below the folder it is called in, and runs every setup.py that it finds.
One `cd ..` too many, and that is the whole checkout of the course, or everybody's temporary files.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

_COLCON = re.compile(
    r"\s*colcon(?:\s+--log-(?:base|level)[=\s]\S+)*\s+(?:build|test)"
    r"(?=\s|$|[;&|])(?P<options>[^;&|]*)"
)
# Who names the folders knows them; help reads none.
_CHOSEN = re.compile(r"(?<!\S)(?:--base-paths|--paths|--help|-h)(?=[\s=]|$)")


def builds_outside(line: str, folder: Path, workspace: Path) -> bool:
    """Tell whether a command would let colcon read a folder that is no workspace.

    Args:
        line: The command; only what it begins with is judged.
        folder: Where it is typed.
        workspace: The learner's workspace.
    """
    colcon = _COLCON.match(line)
    if not colcon or _CHOSEN.search(colcon["options"]):
        return False
    folder, workspace = folder.resolve(), workspace.resolve()
    inside = folder == workspace or workspace in folder.parents
    return not inside and not _in_another(folder, workspace)


def words(here: str, exists: bool) -> str:
    """Say why nothing is typed, and where to go.

    Args:
        here: The folder of the terminal, as its prompt names it.
        exists: Whether there is a workspace to go to.
    """
    way = 'Go there first: `cd "$ROS2_WORKSPACE"`.' if exists else "Page 01 makes the workspace."
    return (
        f"nothing was typed: the terminal is in `{here}`, which is outside of your workspace. "
        f"colcon would build everything that lies below it. {way}"
    )


def _in_another(folder: Path, workspace: Path) -> bool:
    """Tell whether this is some other workspace; a folder around the learner's own is none."""
    around = {workspace, *workspace.parents}
    return any(_holds_package(one) for one in (folder, *folder.parents) if one not in around)


def _holds_package(folder: Path) -> bool:
    return any(any(_manifests(folder / "src", depth)) for depth in ("*", "*/*"))


def _manifests(source: Path, depth: str) -> Iterator[Path]:
    try:
        yield from source.glob(f"{depth}/package.xml")
    except OSError:  # a folder that nobody may read is no workspace
        return
