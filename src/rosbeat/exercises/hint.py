"""Help with an exercise, one step at a time, the answer last: `hint`."""

from __future__ import annotations

from dataclasses import dataclass, replace
from importlib.resources import files
from textwrap import indent

from rosbeat.diagnosis.mistakes import MISTAKES
from rosbeat.errors import ExerciseError, called_as
from rosbeat.exercises.cells import cells_of, worked_on
from rosbeat.exercises.exercise import Exercise
from rosbeat.exercises.outcome_display import HELP, code, framed, words
from rosbeat.exercises.progress import Standing, progress_file
from rosbeat.exercises.registry import find, which_exercise

# The answers of the exercises, for the last hint.

_FOLDER = "solved"


def answer_to(exercise: str) -> str:
    """Return the cell that solves an exercise; an empty text if there is none.

    Args:
        exercise: The exercise's id.
    """
    file = files("rosbeat.exercises") / _FOLDER / f"{exercise}.txt"
    return file.read_text(encoding="utf-8").rstrip("\n") if file.is_file() else ""


def are_here() -> bool:
    """Return whether there are answers at all; what an instructor releases to a class has none."""
    return (files("rosbeat.exercises") / _FOLDER).is_dir()


def may_reveal(exercise: str) -> bool:
    """Return whether the answer is offered: after a try that was judged, or a hint.

    Args:
        exercise: The exercise's id.
    """
    standing = progress_file().standings().get(exercise, Standing())
    return are_here() and bool(standing.attempts or standing.hints or standing.answer)


# `hint`: help with an exercise, one step at a time, the answer last.

#: Where there are no answers, as in what an instructor releases to a class.
_LAST = "This was the last hint. Your instructor can tell you more."


@dataclass(frozen=True)
class Hint:
    """Hold hints as Jupyter and a terminal show them.

    Attributes:
        exercise: The exercise's id.
        hints: The hints to show, each with its number.
        answer: The cell that solves the exercise; an empty text unless its turn has come.
        next: What comes next, one sentence; may be empty.
    """

    exercise: str
    hints: tuple[tuple[str, str], ...] = ()
    answer: str = ""
    next: str = ""

    def __str__(self) -> str:
        rows = [f"{HELP} {head} {text}" for head, text in self.hints]
        if self.answer:
            cell = indent(self.answer, "    ")
            rows.append(f"{HELP} {self._answer_head}\n\n{cell}\n")
        return "\n".join([*rows, f"  {self.next}"] if self.next else rows)

    def __repr__(self) -> str:
        return str(self)

    def html(self) -> str:
        """Return the hints as HTML."""
        rows = [f"{words(f'{HELP} {head}', 'strong')} {words(text)}" for head, text in self.hints]
        if self.answer:
            rows += [words(f"{HELP} {self._answer_head}", "strong"), code(self.answer)]
        return framed(HELP, *rows, words(self.next.replace("\n  ", " ")))

    @property
    def _answer_head(self) -> str:
        return f"The answer to exercise {self.exercise}, one way among several:"

    def _repr_mimebundle_(self, **_: object) -> dict[str, str]:
        return {"text/plain": str(self), "text/html": self.html()}


@called_as('hint("03a")')
def hint(exercise: str = "", *, again: bool = False) -> Hint:
    """Show one hint more at each call, and at last the answer.

    If the last check has named a mistake, the first call after it is about that mistake.

    Args:
        exercise: The exercise's id, such as `"03a"`; by default the one that you worked on last.
        again: Show what was shown so far, and nothing new.

    Returns:
        The hint, which Jupyter shows. How many you have used is kept, also when the kernel
        restarts.

    Raises:
        ExerciseError: If there is no such exercise; it offers those of the page.
    """
    exercise = worked_on() if exercise == "" else exercise
    if exercise == "":
        raise which_exercise("hint", "hint({})")
    found = find(exercise, "hint({})")
    if (cells := cells_of()) is not None:
        cells.worked_on = found.id
    file = progress_file()
    before = file.standings().get(found.id, Standing())
    if again:
        return _all_so_far(found, before)
    standing = file.change(found.id, lambda before: _one_more(before, len(found.hints)))
    return _about(found, before) if before.lead else _newest(found, standing)


def next_hint(exercise: str) -> Hint:
    """Show one hint more below the earlier ones, for the button below a card.

    What the card says is not repeated, and the answer has a button of its own.

    Args:
        exercise: The exercise's id.

    Raises:
        ExerciseError: If there is no such exercise.
    """
    found = find(exercise, "hint({})")
    most = len(found.hints)
    standing = progress_file().change(
        found.id, lambda before: replace(before, lead="", hints=min(before.hints + 1, most))
    )
    last = "" if standing.hints < most else "It was the last one."
    shown = tuple(_numbered(found, number) for number in range(1, standing.hints + 1))
    return Hint(found.id, shown, next=last)


def reveal(exercise: str) -> Hint:
    """Show the answer to an exercise at once, and note that it was shown.

    Args:
        exercise: The exercise's id.

    Raises:
        ExerciseError: If there is no such exercise, or no answer here.
    """
    found = find(exercise, "hint({})")
    if not are_here():
        raise ExerciseError(
            f"The answer to exercise {found.id} is not here.",
            "A course that was released to a class doesn't include the answers.",
            f'Take one hint more: hint("{found.id}").',
        )
    progress_file().change(found.id, lambda before: replace(before, answer=True))
    return Hint(found.id, answer=_answer(found.id))


def _one_more(before: Standing, there_are: int) -> Standing:
    if before.lead:
        return replace(before, lead="")
    if before.hints < there_are:
        return replace(before, hints=before.hints + 1)
    return replace(before, answer=True) if are_here() else before


def _about(exercise: Exercise[object], standing: Standing) -> Hint:
    """Return the hint about the mistake that the last check has named."""
    head = f"Your last check of {exercise.id} found: {MISTAKES[standing.mistake].title}."
    return Hint(exercise.id, ((head, standing.lead),), next=_next(exercise, standing.hints))


def _newest(exercise: Exercise[object], standing: Standing) -> Hint:
    if standing.answer and are_here():
        return Hint(exercise.id, answer=_answer(exercise.id))
    number = min(standing.hints, len(exercise.hints))
    way = _next(exercise, number)
    if number > 1:
        way += f'\n  The earlier ones again: hint("{exercise.id}", again=True)'
    return Hint(exercise.id, (_numbered(exercise, number),), next=way)


def _all_so_far(exercise: Exercise[object], standing: Standing) -> Hint:
    used = min(standing.hints, len(exercise.hints))
    shown = tuple(_numbered(exercise, number) for number in range(1, used + 1))
    if standing.answer and are_here():
        return Hint(exercise.id, shown, _answer(exercise.id))
    return Hint(exercise.id, shown, next=_next(exercise, used))


def _numbered(exercise: Exercise[object], number: int) -> tuple[str, str]:
    head = f"Hint {number} of {len(exercise.hints)} for exercise {exercise.id}:"
    return head, exercise.hints[number - 1]


def _next(exercise: Exercise[object], used: int) -> str:
    if used >= len(exercise.hints):
        return "The next one is the answer." if are_here() else _LAST
    what = "One more" if used else "For a first hint"
    return f'{what}: hint("{exercise.id}")'


#: The whole system has no cell of its own.
_ON_PAGES = (
    "# The solution pages 02 to 06 make this system step by step. They are in the folder\n"
    "# `solutions`, from 02_create_a_package.ipynb to 06_build_source_run.ipynb. The finished\n"
    "# package is in `solutions/sensor_simulator`."
)


def _answer(exercise: str) -> str:
    return answer_to(exercise) or _ON_PAGES
