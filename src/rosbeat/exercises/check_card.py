"""The card of a check in a notebook that is open in a browser: below the words are buttons.

The card and the buttons are two outputs. So the stored card is the one that every other place
shows, and the buttons keep the focus while it changes.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any
from uuid import uuid4

from IPython.display import display, update_display

from rosbeat.exercises.cards import Shown
from rosbeat.exercises.exercise import PASSED
from rosbeat.exercises.hint import are_here, next_hint, reveal
from rosbeat.exercises.live import ExerciseWidget
from rosbeat.records import Outcome


class Card(Shown):
    """Show an outcome with buttons below it.

    Args:
        outcome: The outcome.
        judge: Judges the answer as it is now, and remembers the outcome.
        cards: The buttons that are open in this kernel, by exercise; a new card takes those of the
            one before away, which the page may not even show any more.
    """

    _live: _Live

    def __init__(
        self, outcome: Outcome, judge: Callable[[], Outcome], cards: dict[str, Any]
    ) -> None:
        super().__init__(outcome)
        object.__setattr__(self, "_live", _Live(judge, cards))

    def _ipython_display_(self) -> None:
        self._live.show(self.outcome, self._repr_mimebundle_())


class _Live:
    """Hold what is open in the browser of one card."""

    def __init__(self, judge: Callable[[], Outcome], cards: dict[str, Any]) -> None:
        self._judge, self._cards = judge, cards
        self._exercise = ""
        self._display_id = f"rosbeat-check-{uuid4().hex}"
        self._buttons: ExerciseWidget | None = None

    def show(self, outcome: Outcome, bundle: dict[str, Any]) -> None:
        self._exercise = outcome.exercise
        before = self._cards.pop(self._exercise, None)
        if before is not None:
            before.close()
        actions = {"hint": self._hint, "answer": self._answer, "again": self._again}
        self._buttons = self._cards[self._exercise] = ExerciseWidget(
            actions, "check", exercise=self._exercise, passed=outcome.status == PASSED,
            has_answer=are_here(),
        )  # fmt: skip
        display(bundle, raw=True, display_id=self._display_id)
        self._buttons.show()

    def _hint(self, _: object) -> str:
        return next_hint(self._exercise).html()

    def _answer(self, _: object) -> str:
        return reveal(self._exercise).html()

    def _again(self, _: object) -> str:
        outcome = self._judge()
        bundle = Shown(outcome)._repr_mimebundle_()
        update_display(bundle, raw=True, display_id=self._display_id)
        assert self._buttons is not None
        self._buttons.passed = outcome.status == PASSED
        return ""
