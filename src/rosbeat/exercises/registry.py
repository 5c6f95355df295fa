"""Every exercise of the course by its id, and the pages on which they stand."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from difflib import get_close_matches
from typing import Any

from rosbeat.errors import ExerciseError
from rosbeat.exercises import (
    page_00,
    page_01,
    page_02,
    page_03,
    page_04,
    page_05,
    page_06,
    page_07,
    page_08,
    page_09,
    page_10,
    page_11,
    page_12,
    page_13,
    system,
)
from rosbeat.exercises.exercise import Exercise


@dataclass(frozen=True)
class Page:
    """A page and its exercises.

    Attributes:
        number: Two digits, or an empty text for exercises that belong to no page.
        title: The page's title.
        exercises: Its exercises, in order.
    """

    number: str
    title: str
    exercises: tuple[Exercise[Any], ...]


PAGES = (
    Page("00", "Hear the heartbeat", page_00.EXERCISES),
    Page("01", "Create a workspace", page_01.EXERCISES),
    Page("02", "Create a package", page_02.EXERCISES),
    Page("03", "Write a publisher", page_03.EXERCISES),
    Page("04", "Write a subscriber", page_04.EXERCISES),
    Page("05", "Set the entry points", page_05.EXERCISES),
    Page("06", "Build, source, run", page_06.EXERCISES),
    Page("07", "Look inside the graph", page_07.EXERCISES),
    Page("08", "Tune quality of service", page_08.EXERCISES),
    Page("09", "Test the five claims", page_09.EXERCISES),
    Page("10", "Find the fault", page_10.EXERCISES),
    Page("11", "Record and replay", page_11.EXERCISES),
    Page("12", "Go beyond topics", page_12.EXERCISES),
    Page("13", "Build your own", page_13.EXERCISES),
    Page("", "The whole system", system.EXERCISES),
)

EXERCISES: dict[str, Exercise[Any]] = {
    exercise.id: exercise for page in PAGES for exercise in page.exercises
}


def scenario(exercise: str) -> Callable[..., Any]:
    """Return what runs the answers to an exercise, and writes down what they did.

    Args:
        exercise: The id, such as `03a` or `system`.

    Raises:
        ExerciseError: If there is no such exercise.
    """
    return find(exercise, "{}").scenario


def find(exercise: object, example: str) -> Exercise[Any]:
    """Return an exercise by its id.

    Args:
        exercise: The id, such as `03a`; capital letters and blanks around it do not matter.
        example: The call to show if there is none, with `{}` where the id belongs.

    Raises:
        ExerciseError: If there is no such exercise.
    """
    name = str(exercise).strip().lower()
    found = EXERCISES.get(name)
    if found is None:
        near = get_close_matches(name, EXERCISES, 1) or sorted(EXERCISES)[:1]
        near = [f"0{name}"] if f"0{name}" in EXERCISES else near  # 3a is as near to 13a
        raise ExerciseError(
            f"There is no exercise {exercise!r}.",
            f"The exercises are: {', '.join(sorted(EXERCISES))}.",
            f"Write for example {example.format(repr(near[0]).replace(chr(39), chr(34)))}.",
        )
    return found
