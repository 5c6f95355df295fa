"""Take from the pages what answers need: the imports, and the published solutions."""

from functools import cache
from pathlib import Path

from rosbeat.authoring.source import Lesson, read_lesson, with_answers

ROOT = Path(__file__).resolve().parents[2]

#: The exercises whose answers are nodes.
NODE_EXERCISES = ("00a", "00b", "03a", "03b", "03c", "04a", "04b", "04e")
#: An exercise whose solution needs another one's.
_BUILT_ON = {"13b": "13a"}


@cache
def lesson(page: str) -> Lesson:
    """Return the source of a page, by its two digits."""
    (path,) = (ROOT / "src" / "lessons").glob(f"{page}_*.py")
    return read_lesson(path)


def imports(exercise: str) -> str:
    """Return the cell of imports at the top of the exercise's page."""
    first = next(cell.source for cell in lesson(exercise[:2]).cells if cell.runs)
    return first.partition("\nviz.")[0]  # the map of the course needs no drawing here


@cache
def solution(exercise: str) -> str:
    """Return the published solution as one cell, with what it builds on if that is on its page."""
    cells = lesson(exercise[:2]).cells
    ids = (_BUILT_ON.get(exercise, exercise), exercise)
    mine = [cell for cell in cells if cell.exercise in ids]
    profiles = [cell.source for cell in cells if cell.source.startswith("LATCHED")]
    return "\n\n\n".join([*profiles, *(with_answers(cell.source) for cell in mine)]) + "\n"


def subject(exercise: str) -> str:
    """Return what the exercise's check cell hands over."""
    (cell,) = (cell for cell in lesson(exercise[:2]).cells if cell.check == exercise)
    return cell.source.rpartition(",")[2].strip(" )\n")
