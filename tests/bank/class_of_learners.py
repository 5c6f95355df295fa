"""Make a class that hands in pages 03 and 04, with answers of the bank, right and wrong."""

import shutil
from collections.abc import Callable, Sequence
from copy import deepcopy
from functools import cache
from pathlib import Path

import nbformat

from bank import reading
from bank.pages import lesson, subject
from bank.reading import Answer
from rosbeat.authoring import pages
from rosbeat.exercises.registry import EXERCISES

POINTS = {one.id: one.points for one in EXERCISES.values()}
PAGES = ("03", "04")
NAMES = {page: lesson(page).name for page in PAGES}
#: These wait for a deadline or take the process along: how long they take says nothing of grading.
_SLOW = {"callback-blocks", "constructor-blocks", "exits"}


@cache
def blank(page: str) -> nbformat.NotebookNode:
    """Return the learners' page, by its two digits."""
    return pages.notebook_page(lesson(page), POINTS)


def filled(page: nbformat.NotebookNode, answers: dict[str, str]) -> nbformat.NotebookNode:
    """Return a page with texts of answers, by exercise, in the place of its blanks."""
    page = deepcopy(page)
    for cell in page.cells:
        exercise = cell.metadata.get("rosbeat", {}).get("exercise")
        cell.source = answers.get(exercise, cell.source)
    return page


#: Random numbers that no session seeds: an answer that draws them does something else each time.
_OWN_CHANCE = ("SystemRandom", "Random()", "default_rng()")


@cache
def answers_to(exercise: str, status: str) -> tuple[Answer, ...]:
    """Return answers that define what the check cell hands over, in the bank's order."""
    return tuple(
        one
        for one in reading.answers()
        if (one.exercise, one.status, one.subject) == (exercise, status, subject(exercise))
        and not any(chance in one.text for chance in _OWN_CHANCE)
        and not _SLOW & set(one.mistakes)
    )


def answers_of(number: int) -> dict[str, Answer]:
    """Return the answers of one learner: each other one is right, and no two agree for long.

    Args:
        number: Which learner of the class, from 0.
    """
    chosen = {}
    for place, exercise in enumerate(name for name in POINTS if name[:2] in PAGES):
        turn, is_wrong = divmod(number + place, 2)
        known = answers_to(exercise, "failed" if is_wrong else "passed")
        chosen[exercise] = known[turn % len(known)]
    return chosen


def texts_of(number: int) -> dict[str, str]:
    """The texts of one learner's answers, as they are in the bank."""
    return {exercise: one.text for exercise, one in answers_of(number).items()}


def distinct_texts_of(number: int) -> dict[str, str]:
    """The same with the learner's number in a comment: to the grader, no two learners agree."""
    return {name: f"{text}\n# learner {number}\n" for name, text in texts_of(number).items()}


def hand_in(
    folder: Path,
    learners: int,
    inside: str = "",
    texts: Callable[[int], dict[str, str]] = texts_of,
    numbers: Sequence[str] = PAGES,
) -> None:
    """Write what a class hands in: a folder for each learner, with their pages.

    Args:
        folder: Gets the learners' folders.
        learners: How many there are.
        inside: A folder in each learner's folder, where something wants one.
        texts: Returns the texts of a learner's answers by exercise.
        numbers: The pages that each learner hands in.
    """
    for number in range(learners):
        place = folder / f"learner_{number:04}" / inside
        place.mkdir(parents=True)
        for page in numbers:
            made = pages.to_bytes(filled(blank(page), texts(number)))
            (place / f"{NAMES[page]}.ipynb").write_bytes(made)


def nbgrader_course(folder: Path, assignment: str) -> None:
    """Make a course folder of nbgrader: its settings, and the pages as the assignment's source."""
    source = folder / "source" / assignment
    source.mkdir(parents=True)
    shutil.copy(Path(__file__).resolve().parents[2] / "docs" / "nbgrader_config.py", folder)
    for page in PAGES:
        (source / f"{NAMES[page]}.ipynb").write_bytes(pages.to_bytes(blank(page)))
