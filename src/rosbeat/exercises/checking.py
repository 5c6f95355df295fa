"""`check`: what a learner calls."""

from __future__ import annotations

from difflib import get_close_matches
from typing import Any

from rosbeat.checks.display import Shown
from rosbeat.errors import ExerciseError
from rosbeat.exercises import page_00, page_01, page_02, page_03, page_04, page_05, page_06
from rosbeat.exercises.exercise import Exercise

_PAGES = (page_00, page_01, page_02, page_03, page_04, page_05, page_06)
EXERCISES: dict[str, Exercise[Any]] = {
    exercise.id: exercise for page in _PAGES for exercise in page.EXERCISES
}


def check(exercise: str, answer: Any) -> Shown:  # noqa: ANN401 - whatever a learner hands over
    """Run the answer to an exercise and say what is right or what is missing.

    A node runs in a session of its own, in virtual time; nothing on the page changes.

    Args:
        exercise: The exercise's id, such as `"03a"`.
        answer: What the cell above made: a node class, the workspace or a terminal.

    Returns:
        The outcome, which Jupyter shows.

    Raises:
        ExerciseError: If there is no such exercise.
    """
    found = EXERCISES.get(exercise)
    if found is None:
        near = get_close_matches(str(exercise), EXERCISES, 1) or sorted(EXERCISES)[:1]
        raise ExerciseError(
            f"There is no exercise {exercise!r}.",
            f"The exercises are: {', '.join(sorted(EXERCISES))}.",
            f'Write for example check("{near[0]}", ...).',
        )
    return Shown(found.judged(found.scenario(answer)))
