"""Cells that are typed into a terminal, or saved to a file.

A source has to stay Python, so what is not Python stands in it behind comment signs::

    # %% terminal="build"
    # cd ~/ROS2_and_RL_Tutorials
    # colcon build

is `%%terminal build` with two commands on the page, and `# %% save="src/..."` is `%%save src/...`.
A Python file stands there as it is.
"""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

from rosbeat.errors import LessonError

SAVE = "%%save "
_MARKER_LINE = re.compile(r" *# --- (answer|blank|end)$")


def read_magic(source: str, metadata: dict[str, Any], where: str) -> tuple[str, str]:
    """Split what a cell's marker says into the text and the magic above it.

    Args:
        source: The cell's text in the lesson source.
        metadata: What stands on the cell's marker.
        where: The file and line, for messages.

    Returns:
        The text as it stands on the page, and the magic; an empty text if there is none.

    Raises:
        LessonError: Both kinds at once, or a line that is neither Python nor behind a comment sign.
    """
    terminal, save = metadata.get("terminal"), metadata.get("save")
    if terminal and save:
        raise LessonError(f"{where}: terminal= and save= do not go together.")
    if terminal:
        # Without a command it is a line magic: a look, or a key that is pressed.
        text = _uncommented(source, where)
        return text, f"{'%%' if text else '%'}terminal {terminal}"
    if save:
        is_python = Path(save).suffix == ".py"
        return source if is_python else _uncommented(source, where), f"{SAVE}{save}"
    return source, ""


def _uncommented(source: str, where: str) -> str:
    return "\n".join(_line(line, where) for line in source.split("\n"))


def _line(line: str, where: str) -> str:
    if not line or _MARKER_LINE.match(line):
        return line
    if line == "#" or line.startswith("# "):
        return line[2:]
    raise LessonError(
        f"{where}: {line!r} stands without a comment sign.",
        "A lesson source is Python; what is typed in a terminal is not.",
        "Begin each line of this cell with '# '.",
    )
