"""`check`: what a learner calls."""

from __future__ import annotations

from typing import Any

from rosbeat.checks.display import Shown
from rosbeat.exercises.progress_file import progress_file
from rosbeat.exercises.registry import EXERCISES as EXERCISES
from rosbeat.exercises.registry import find


def check(exercise: str, answer: Any) -> Shown:  # noqa: ANN401 - whatever a learner hands over
    """Run the answer to an exercise and say what is right or what is missing.

    A node runs in a session of its own, in virtual time; nothing on the page changes. How far you
    are is kept beside your workspace; `progress()` shows it.

    Args:
        exercise: The exercise's id, such as `"03a"`.
        answer: What the cell above made: a node class, the workspace or a terminal.

    Returns:
        The outcome, which Jupyter shows.

    Raises:
        ExerciseError: If there is no such exercise.
    """
    found = find(exercise, "check({}, ...)")
    outcome = found.judged(found.scenario(answer))
    progress_file().change(found.id, lambda before: before.after(outcome))
    return Shown(outcome)
