"""Every exercise of the course by its id, and the pages on which they stand."""

from __future__ import annotations

import os
import re
import sys
from collections.abc import Callable, Sequence
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
    """Hold a page and its exercises.

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
    return find(exercise, "{}").observed


def find(exercise: object, example: str) -> Exercise[Any]:
    """Return an exercise by its id.

    Args:
        exercise: The id, such as `03a`; capital letters and blanks around it do not matter.
        example: The call to show if there is none, with `{}` where the id belongs.

    Raises:
        ExerciseError: If there is no such exercise; it offers those of the page that is open.
    """
    name = str(exercise).strip().lower()
    found = EXERCISES.get(name)
    if found is None:
        here = this_page()
        near = get_close_matches(name, EXERCISES, 1) or [_offered(here)[0].id]
        near = [f"0{name}"] if f"0{name}" in EXERCISES else near  # 3a is as near to 13a
        said = f"There is no exercise {exercise!r}."
        if callable(exercise):
            handed = getattr(exercise, "__name__", type(exercise).__name__)
            said = f"The id of the exercise comes first, and `{handed}` is no id."
        raise ExerciseError(said, offer(here), f"Write for example {shown(example, near[0])}.")
    return found


def which_exercise(call: str, example: str) -> ExerciseError:
    """Return the error for a call that names no exercise."""
    page = this_page()
    near = worked_on() or _offered(page)[0].id
    return ExerciseError(
        f"`{call}` was not told which exercise is meant.",
        offer(page),
        f"Write for example {shown(example, near)}.",
    )


def shown(example: str, exercise: str) -> str:
    """Return a call with the id of an exercise in it, such as `hint("03a")`."""
    return example.format(f'"{exercise}"')


def offer(page: Page | None) -> str:
    """Return a sentence that names the exercises of a page, or of the whole course for None."""
    if page is None:
        return f"The exercises are: {', '.join(sorted(EXERCISES))}."
    listed = ", ".join(f"{one.id} ({one.title})" for one in page.exercises)
    return f"The exercises on this page are: {listed}."


def _offered(page: Page | None) -> Sequence[Exercise[Any]]:
    return page.exercises if page else list(EXERCISES.values())


#: How a page of the course is called: its number, and words.
_FILE = re.compile(r"(\d\d)_[^/]*$")
_ASKED = re.compile(r"""\b(?:check|hint)\(\s*["'](\w+)["']""")


def this_page() -> Page | None:
    """Return the page that is open in this kernel; None if that cannot be told.

    Jupyter's server names the notebook in the environment of its kernel. Elsewhere the exercises
    that the cells so far have asked for tell the page.
    """
    file = _FILE.search(os.environ.get("JPY_SESSION_NAME", ""))
    number = file[1] if file else worked_on()[:2]
    return next((page for page in PAGES if page.number and page.number == number), None)


def worked_on() -> str:
    """Return the id of the exercise that a cell of this kernel asked for last, or an empty text."""
    ipython = sys.modules.get("IPython")
    shell = ipython.get_ipython() if ipython else None
    cells = shell.user_ns.get("In", []) if shell else []
    asked = [one.lower() for cell in cells for one in _ASKED.findall(str(cell))]
    return next((one for one in reversed(asked) if one in EXERCISES), "")
