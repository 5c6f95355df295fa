"""Check an answer: `check`, as a learner and as nbgrader calls it."""

from __future__ import annotations

import os
import sys
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial
from textwrap import wrap
from typing import TYPE_CHECKING, Any, TypeAlias
from uuid import uuid4

from IPython import get_ipython
from IPython.display import display, update_display

from rosbeat.diagnosis.exceptions import first_sentence
from rosbeat.errors import ExerciseError, called_as, explain_interrupt
from rosbeat.exercises.cells import NOTHING, Cells, Shell, cells_of, worked_on
from rosbeat.exercises.certificate import keep_run
from rosbeat.exercises.exercise import PASSED, Exercise, not_attempted
from rosbeat.exercises.hint import may_reveal, next_hint, reveal
from rosbeat.exercises.outcome_display import LOOKS, Shown, output_of, words
from rosbeat.exercises.progress import progress_file
from rosbeat.exercises.registry import EXERCISES as EXERCISES
from rosbeat.exercises.registry import find, which_exercise
from rosbeat.exercises.scenarios import Answer, overheard
from rosbeat.exercises.share import share
from rosbeat.exercises.system import SystemRun
from rosbeat.page_cells import cell_to_run, link_below
from rosbeat.records import Observation, Outcome
from rosbeat.workspace.busy_notice import counting
from rosbeat.workspace.location import GRADED

if TYPE_CHECKING:
    from rosbeat.viz import Picture

# `check`: what a learner calls.


@called_as('check("03a", HumiditySensor)')
def check(exercise: str = "", answer: Answer = NOTHING) -> Shown | HandedOver:
    """Run the answer to an exercise and say what is right or what is missing.

    A node runs in a session of its own, in virtual time; nothing on the page changes. How far you
    are is kept beside your workspace; `progress()` shows it.

    Args:
        exercise: The exercise's id, such as `"03a"`; by default the one that you worked on last.
        answer: What the cell above made: a node class, the workspace or a terminal; by default
            what was checked last.

    Returns:
        The outcome, which Jupyter shows.

    Raises:
        ExerciseError: If there is no such exercise, no answer was handed over, or the cell above
            did not run; where nbgrader runs the page, also if the answer does not get all points.
    """
    if exercise == "" and answer is NOTHING:
        exercise = worked_on()
        if not exercise:
            raise which_exercise("check", "check({}, ...)")
    found = find(exercise, "check({}, ...)")
    cells = cells_of()
    if cells is not None:
        cells.ask(found.id)
    if answer is NOTHING:
        answer = _current(found, cells)
    outside = _judged_outside()
    if outside is not None:
        outside(found, answer)
        return HandedOver(found.id)
    judged = _judge(found, answer, cells)
    execution = os.environ.get(GRADED, "")
    if execution:
        return for_nbgrader(judged.outcome, execution)
    if cells is not None and cells.for_a_browser:
        again = partial(_judge_again, found, cells)
        return CheckCard(judged.outcome, judged.output, picture=judged.picture, judge=again)
    if judged.picture is not None:
        display(judged.picture)
    return Shown(judged.outcome, judged.output)


def _current(found: Exercise[Any], cells: Cells | None) -> Answer:
    """Return the answer that was checked last, as the kernel has it now.

    Raises:
        ExerciseError: If there is none.
    """
    answer = NOTHING if cells is None else cells.answer(found.id)
    if answer is NOTHING:
        raise ExerciseError(
            f"`check` was given no answer to exercise {found.id}.",
            "It needs what the cell above defines, such as a class.",
            f'Hand it over as well: check("{found.id}", ...), with its name for the three dots.',
        )
    return answer


@dataclass(frozen=True)
class Judged:
    """Hold what came of a check.

    Attributes:
        outcome: The outcome.
        picture: What there is to see; None for nothing.
        output: What the answer printed and logged, as `Shown` takes it.
    """

    outcome: Outcome
    picture: Picture | None = None
    output: tuple[tuple[str, str], ...] = ()


def _judge_again(found: Exercise[Any], cells: Cells) -> Judged:
    return _judge(found, _current(found, cells), cells)


def _judge(found: Exercise[Any], answer: Answer, cells: Cells | None) -> Judged:
    """Judge an answer, remember the outcome, and return what came of it.

    Raises:
        ExerciseError: If the cell above did not run, so that the answer is an earlier one.
        KeyboardInterrupt: If Interrupt was pressed.
    """
    is_blank = cells is not None and cells.refuse_stale(found.id)
    seen = picture = None
    output: tuple[tuple[str, str], ...] = ()
    if is_blank:
        verdict = found.outcome(not_attempted())
    else:
        try:
            with counting(f"checking exercise {found.id}"), overheard() as printed:
                seen = found.observed(answer)
                _refuse_unready(seen)
                verdict, picture = found.judged(seen), found.picture(seen)
        except KeyboardInterrupt as interrupt:
            explain_interrupt(
                interrupt,
                f"you stopped the check of exercise {found.id}.",
                "There is no verdict; what an earlier check said still counts, and your answer is "
                "unchanged.",
                "Run the check again. If it seemed to take for ever, look for a loop in your "
                "answer that doesn't end.",
            )
            raise
        output = output_of(seen, printed, verdict.status)
    standing = progress_file().change(found.id, lambda before: before.after(verdict))
    share(verdict)
    if verdict.status == PASSED and isinstance(seen, SystemRun):
        keep_run(seen)
    verdict = _with_hints(verdict, standing.hints) if found.tells_hints else verdict
    return Judged(verdict, picture, output)


def _refuse_unready(seen: object) -> None:
    """Refuse to judge an answer that needs a cell which has not run since the kernel started.

    Raises:
        ExerciseError: If it raised for want of a name that a cell above defines.
    """
    said = getattr(seen, "problem", "")  # of a function
    if isinstance(seen, Observation) and seen.faults:
        said = f"{seen.faults[0].kind}: {seen.faults[0].text}"
    cell = cell_to_run(said)
    if cell is not None:
        link_below(cell)
        raise ExerciseError(
            f"Your answer could not be checked: {first_sentence(said)}.",
            "No cell that has run since the kernel started defines that name, so there is no "
            "verdict.",
            f"Run the cell above {cell}, then this check again.",
        )


def _with_hints(outcome: Outcome, hints: int) -> Outcome:
    """Return the outcome with the number of hints that were used."""
    said = f" (With {hints} hint{'' if hints == 1 else 's'}.)" if hints else ""
    return replace(outcome, evidence=f"{outcome.evidence}{said}")


@dataclass(frozen=True, repr=False)
class CheckCard(Shown):
    """Show an outcome with buttons below it, in a notebook that is open in a browser.

    The card and the buttons are two outputs. So the stored card is the one that every other place
    shows, and the buttons keep the focus while it changes.

    Attributes:
        picture: What there is to see above the card; None for nothing.
        judge: Judges the answer as it is now, and remembers the outcome; None if nobody can.
    """

    picture: Picture | None = None
    judge: Callable[[], Judged] | None = None

    _has_buttons = True

    def _ipython_display_(self) -> None:
        # The widgets take a while to load, and only a notebook in a browser shows them.
        from rosbeat.exercises.widget_actions import ExerciseWidget

        exercise, display_id = self.outcome.exercise, f"rosbeat-check-{uuid4().hex}"

        def show(judged: Judged, how: Callable[..., object]) -> None:
            if self.picture is not None:  # there is a place for one
                picture = {"text/plain": ""} if judged.picture is None else _bundle(judged.picture)
                how(picture, raw=True, display_id=f"{display_id}-picture")
            card = replace(self, outcome=judged.outcome, output=judged.output)
            how(card._repr_mimebundle_(), raw=True, display_id=display_id)

        def again(_: object) -> str:
            if self.judge is None:
                return ""
            judged = self.judge()
            show(judged, update_display)
            buttons.passed = judged.outcome.status == PASSED
            buttons.has_answer = may_reveal(exercise)
            _, word = LOOKS[judged.outcome.status]
            # A page that was loaded anew since then does not find the card.
            return words(f"Checked the cell above as it last ran: {word}.")

        def one_more_hint(_: object) -> str:
            shown = next_hint(exercise)
            buttons.has_answer = may_reveal(exercise)
            return shown.html()

        actions = {
            "hint": one_more_hint,
            "answer": lambda _: reveal(exercise).html(),
            "again": again,
        }
        show(Judged(self.outcome, self.picture, self.output), display)
        is_passed = self.outcome.status == PASSED
        buttons = ExerciseWidget(
            actions, "check", exercise=exercise, passed=is_passed, has_answer=may_reveal(exercise)
        )
        buttons.show()


def _bundle(picture: Picture) -> dict[str, Any]:
    """Return a picture in the forms in which Jupyter shows it."""
    data, _ = get_ipython().display_formatter.format(picture)
    return dict(data)


# Where a page is graded, the judge is elsewhere: what is observed here is handed out.

#: Takes an answer to an exercise.
Take: TypeAlias = Callable[[Exercise[Any], Answer], None]
_HELD_AS = "_rosbeat_judged_outside"


@dataclass(frozen=True)
class HandedOver:
    """Say that an answer was handed to a judge elsewhere.

    Attributes:
        exercise: The exercise's id.
    """

    exercise: str


def hand_over_to(shell: Shell, take: Take) -> None:
    """Let `check` hand the answers of a shell's page to somebody else, and judge nothing itself.

    Args:
        shell: The shell.
        take: Gets each exercise with the answer to it.
    """
    setattr(shell, _HELD_AS, take)


def _judged_outside() -> Take | None:
    ipython = sys.modules.get("IPython")
    found: Take | None = getattr(ipython and ipython.get_ipython(), _HELD_AS, None)
    return found


# Outcomes as nbgrader counts them.

#: `nbgrader validate` cuts lines at 87 characters, its own indentation of 4 included.
_WIDTH = 80


class NotPassedError(ExerciseError):
    """Tell nbgrader that an answer does not get all points."""

    def _render_traceback_(self) -> list[str]:
        """Return the text alone, for IPython: where in rosbeat it was raised helps nobody."""
        return self.what.splitlines()


class AllPoints(Shown):
    """Show an outcome with all points; the cell has no result that could be taken for a number."""

    def _ipython_display_(self) -> None:
        display(Shown(self.outcome))


class SomePoints(Shown):
    """Show an outcome with some of the points; their number is the result of the cell."""

    def _repr_mimebundle_(self, **_: object) -> dict[str, Any]:
        return {**super()._repr_mimebundle_(), "text/plain": f"{self.outcome.points:g}"}


def for_nbgrader(outcome: Outcome, execution: str) -> Shown:
    """Say an outcome so that nbgrader gives the points for it that the course gives.

    Args:
        outcome: The outcome.
        execution: Why nbgrader runs the page: `autograde`, where points are noted, or `validate`,
            where a learner reads why there are not all of them.

    Returns:
        What Jupyter shows.

    Raises:
        NotPassedError: If there are no points; under `validate`, if there are not all of them.
    """
    if outcome.points >= outcome.out_of:
        return AllPoints(outcome)
    if execution == "validate":
        rows = str(Shown(outcome)).splitlines()
        raise NotPassedError("\n".join(line for row in rows for line in _lines(row)))
    if outcome.points > 0:
        return SomePoints(outcome)
    display(Shown(outcome))
    raise NotPassedError(f"Exercise {outcome.exercise}: 0 of {outcome.out_of} points.")


def _lines(row: str) -> list[str]:
    """Return a row in lines that nbgrader does not cut, indented as the row is."""
    inside = " " * (len(row) - len(row.lstrip()) + 2)
    return wrap(row, _WIDTH, subsequent_indent=inside) or [""]
