"""Every scenario by the id of its exercise, loaded one page at a time."""

from __future__ import annotations

from collections.abc import Callable
from importlib import import_module
from typing import Any

from rosbeat.errors import ExerciseError

Scenario = Callable[..., Any]
#: Modules of this room that have exercises, in the order of the course.
MODULES = (*(f"page_{number:02}" for number in range(14)), "system")


def scenario(exercise: str) -> Scenario:
    """Return what runs the answers to an exercise; only the module of its page is imported.

    Args:
        exercise: The id, such as `03a` or `system`.

    Returns:
        A function that takes an answer, runs it or looks at it, and gives the evidence: one of the
        kinds in `rosbeat.scenarios.evidence`. Those of page 13 take by name what else they need.

    Raises:
        ExerciseError: If there is no such exercise.
    """
    module = exercise if exercise in MODULES else f"page_{exercise[:2]}"
    found = _scenarios(module).get(exercise) if module in MODULES else None
    if found is None:
        raise ExerciseError(
            f"There is no scenario for an exercise {exercise!r}.",
            f"The exercises are: {', '.join(ids())}.",
            "Ask for one of them by its id, such as 03a.",
        )
    return found


def ids() -> tuple[str, ...]:
    """The ids of all exercises that have a scenario, in the order of the course."""
    return tuple(exercise for module in MODULES for exercise in _scenarios(module))


def _scenarios(module: str) -> dict[str, Scenario]:
    found: dict[str, Scenario] = import_module(f"rosbeat.scenarios.{module}").SCENARIOS
    return found
