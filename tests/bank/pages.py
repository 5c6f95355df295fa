"""What the bank takes from the pages: their imports, and the reference solutions."""

from functools import cache
from pathlib import Path

from rosbeat.authoring.source import Lesson, read_lesson, with_answers

ROOT = Path(__file__).resolve().parents[2]

#: The exercises whose answers are nodes.
NODE_EXERCISES = ("00a", "00b", "03a", "03b", "03c", "04a", "04b", "04c")


@cache
def lesson(page: str) -> Lesson:
    """The source of a page, by its two digits."""
    (path,) = (ROOT / "src" / "lessons").glob(f"{page}_*.py")
    return read_lesson(path)


def imports(exercise: str) -> str:
    """The cell of imports at the top of the exercise's page."""
    return next(cell.source for cell in lesson(exercise[:2]).cells if cell.runs)


@cache
def references() -> dict[str, str]:
    """The reference solution of each exercise about a node that has one, as a cell's text."""
    found = {}
    for page in sorted({exercise[:2] for exercise in NODE_EXERCISES}):
        for cell in lesson(page).cells:
            if cell.exercise in NODE_EXERCISES:
                found[cell.exercise] = with_answers(cell.source)
    return found


def subject(exercise: str) -> str:
    """What the exercise's check cell hands over: the class's name in the reference solution."""
    (cell,) = (cell for cell in lesson(exercise[:2]).cells if cell.check == exercise)
    return cell.source.rpartition(",")[2].strip(" )\n")


@cache
def references_of(exercise: str) -> str:
    """The reference solution of an exercise that builds on its page: all code of it up to there.

    Cells of that page which only show something are left out, and those that the kernel does not
    run; what the others define is kept.
    """
    page = exercise[:2]
    known = {exercise, *(page + letter for letter in "abc" if page + letter < exercise)}
    cells = [c for c in lesson(page).cells if c.exercise in known and c.runs]
    parts = [with_answers(c.source) for c in cells]
    profiles = [c.source for c in lesson(page).cells if c.source.startswith("LATCHED")]
    return "\n\n\n".join([*profiles, *parts]) + "\n"
