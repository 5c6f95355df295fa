"""Every exercise of the course by its id, and the pages on which they stand."""

from __future__ import annotations

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
from rosbeat.exercises.cells import worked_on
from rosbeat.exercises.exercise import Exercise
from rosbeat.workspace.location import page_number

#: With this page the package is finished; those after it come in any order that `needs` allows.
_LAST_CORE_PAGE = "06"


@dataclass(frozen=True)
class Page:
    """Hold a page and its exercises.

    Attributes:
        number: Two digits, or an empty text for exercises that belong to no page.
        title: The page's title.
        exercises: Its exercises, in order.
        lesson: The page's file without its ending; for exercises that belong to no page, that of
            the page that explains them.
        minutes: Time that a learner needs, in minutes; 0 for exercises that belong to no page.
        needs: Numbers of the pages to read first.
    """

    number: str
    title: str
    exercises: tuple[Exercise[Any], ...]
    lesson: str = ""
    minutes: int = 0
    needs: tuple[str, ...] = ()

    @property
    def heading(self) -> str:
        """Return the page's number and title."""
        return f"{self.number} {self.title}".strip()

    @property
    def elective(self) -> bool:
        """Return whether the page comes after the last one that everybody needs."""
        return self.number > _LAST_CORE_PAGE


PAGES = (
    Page("00", "Hear the heartbeat", page_00.EXERCISES, "00_hear_the_heartbeat", 35, ()),
    Page("01", "Create a workspace", page_01.EXERCISES, "01_create_a_workspace", 35, ("00",)),
    Page("02", "Create a package", page_02.EXERCISES, "02_create_a_package", 30, ("00", "01")),
    Page("03", "Write a publisher", page_03.EXERCISES, "03_write_a_publisher", 60, ("00", "02")),
    Page("04", "Write a subscriber", page_04.EXERCISES, "04_write_a_subscriber", 90, ("00", "03")),
    Page("05", "Set the entry points", page_05.EXERCISES, "05_set_the_entry_points", 35,
        ("02", "03", "04")),
    Page("06", "Build, source, run", page_06.EXERCISES, "06_build_source_run", 45, ("05",)),
    Page("07", "Look inside the graph", page_07.EXERCISES, "07_look_inside_the_graph", 45,
        ("00", "04", "06")),
    Page("08", "Tune quality of service", page_08.EXERCISES, "08_tune_quality_of_service", 45,
        ("04", "07")),
    Page("09", "Test the five claims", page_09.EXERCISES, "09_test_the_five_claims", 50,
        ("04", "06")),
    Page("10", "Find the fault", page_10.EXERCISES, "10_find_the_fault", 60, ("04", "07", "08")),
    Page("11", "Record and replay", page_11.EXERCISES, "11_record_and_replay", 45, ("04", "07")),
    Page("12", "Go beyond topics", page_12.EXERCISES, "12_beyond_topics", 50, ("04", "07")),
    Page("13", "Build your own", page_13.EXERCISES, "13_build_your_own", 100,
        ("04", "07", "08", "09")),
    Page("", "The whole system", system.EXERCISES, "06_build_source_run", 0, ("06",)),
)  # fmt: skip

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
    return ExerciseError(
        f"`{call}` was not told which exercise is meant.",
        offer(page),
        f"Write for example {shown(example, _offered(page)[0].id)}.",
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


def this_page() -> Page | None:
    """Return the page that is open in this kernel; None if that cannot be told.

    Where its file does not tell, the exercise that was worked on last does.
    """
    number = page_number() or worked_on()[:2]
    return next((page for page in PAGES if page.number and page.number == number), None)
