"""`check`: what a learner calls."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from rosbeat.checks.display import Shown
from rosbeat.exercises.progress_file import progress_file
from rosbeat.exercises.registry import EXERCISES as EXERCISES
from rosbeat.exercises.registry import find
from rosbeat.exercises.under_nbgrader import for_nbgrader
from rosbeat.records import Outcome
from rosbeat.workspace import graded_runs


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
        ExerciseError: If there is no such exercise; where nbgrader runs the page, also if the
            answer does not get all points.
    """
    found = find(exercise, "check({}, ...)")
    outcome = found.judged(found.scenario(answer))
    standing = progress_file().change(found.id, lambda before: before.after(outcome))
    told = _with_hints(outcome, standing.hints) if found.tells_hints else outcome
    execution = graded_runs.execution()
    return for_nbgrader(told, execution) if execution else Shown(told)


def _with_hints(outcome: Outcome, hints: int) -> Outcome:
    """The outcome, and how many hints were used."""
    said = f" (With {hints} hint{'' if hints == 1 else 's'}.)" if hints else ""
    return replace(outcome, evidence=f"{outcome.evidence}{said}")
