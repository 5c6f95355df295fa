"""Ask for a prediction with a field, in a notebook that is open in a browser."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any

from rosbeat.exercises.cards import OPEN
from rosbeat.exercises.live import ExerciseWidget
from rosbeat.exercises.withheld import Withheld

if TYPE_CHECKING:
    from rosbeat.exercises.predict import Prediction


def ask(
    unmade: Prediction, answer: Callable[[object], Prediction], form: str, withheld: Withheld
) -> None:
    """Display a field, and show what happened only after an answer.

    Args:
        unmade: What is said without a prediction.
        answer: Compares a guess with what happened.
        form: How a guess is written.
        withheld: What the cell has shown so far.
    """

    def guess(content: Mapping[str, Any]) -> str:
        made = answer(str(content.get("guess", "")))
        if made.sign == OPEN:
            return f"That cannot be compared with what happened: write {form}."
        return end(made)

    def end(made: Prediction) -> str:
        withheld.release(made)
        field.passed = True
        return "What happened is below."

    field = ExerciseWidget({"guess": guess, "show": lambda _: end(unmade)}, "predict", form=form)
    field.show()
    withheld.shown()
