"""The answers of the exercises, for the last hint.

`rosbeat build` writes them into the folder `solved` beside this module, one file for each exercise,
from the lesson sources.
"""

from __future__ import annotations

from importlib.resources import files

_FOLDER = "solved"


def answer_to(exercise: str) -> str:
    """Return the cell that solves an exercise; an empty text if there is none.

    Args:
        exercise: The exercise's id.
    """
    file = files("rosbeat.exercises") / _FOLDER / f"{exercise}.txt"
    return file.read_text(encoding="utf-8").rstrip("\n") if file.is_file() else ""


def are_here() -> bool:
    """Whether there are answers at all; what an instructor releases to a class has none."""
    return (files("rosbeat.exercises") / _FOLDER).is_dir()
