"""The card of a check in a notebook that is open in a browser: below the words are buttons.

The card and the buttons are two outputs. So the stored card is the one that every other place
shows, and the buttons keep the focus while it changes.
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any
from uuid import uuid4

from anywidget import AnyWidget
from IPython.display import display, update_display
from traitlets import Bool, Int, Unicode

from rosbeat.exercises.cards import Shown
from rosbeat.exercises.exercise import PASSED
from rosbeat.exercises.hint import are_here, hint, reveal
from rosbeat.exercises.live import run_between_cells, show, told
from rosbeat.records import Outcome

_HERE = Path(__file__).parent


class CheckButtons(AnyWidget):
    """Offer a hint, the answer and another run, below the card of a check.

    Args:
        exercise: The exercise's id.
        passed: Whether the check has passed; then there is nothing to offer.
        act: Called with what was clicked: `hint`, `answer` or `again`.
    """

    _esm = Unicode((_HERE / "check_card.js").read_text(encoding="utf-8")).tag(sync=True)
    _css = Unicode((_HERE / "check_card.css").read_text(encoding="utf-8")).tag(sync=True)
    exercise = Unicode().tag(sync=True)
    passed = Bool().tag(sync=True)
    has_answer = Bool().tag(sync=True)
    #: What was said last, as HTML, in a form that anybody may show.
    said = Unicode().tag(sync=True)
    #: Counts what was carried out, so that the browser knows when a click is done.
    done = Int().tag(sync=True)

    def __init__(self, exercise: str, passed: bool, act: Callable[[str], None]) -> None:
        super().__init__(exercise=exercise, passed=passed, has_answer=are_here())
        self.on_msg(lambda _widget, content, _buffers: act(str(content.get("do"))))

    def close(self) -> None:
        """Close the wire, and the one of the layout that every widget brings along."""
        if self.comm is not None:
            layout = self.layout
            super().close()
            layout.close()


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
        self._buttons: CheckButtons | None = None

    def show(self, outcome: Outcome, bundle: dict[str, Any]) -> None:
        self._exercise = outcome.exercise
        before = self._cards.pop(self._exercise, None)
        if before is not None:
            before.close()
        self._buttons = CheckButtons(self._exercise, outcome.status == PASSED, self._heard)
        self._cards[self._exercise] = self._buttons
        display(bundle, raw=True, display_id=self._display_id)
        show(self._buttons)

    def _heard(self, what: str) -> None:
        action = {"hint": self._hint, "answer": self._answer, "again": self._again}.get(what)
        if action is not None:
            run_between_cells(lambda: self._carry_out(action))

    def _carry_out(self, action: Callable[[], str]) -> None:
        said = told(action)
        assert self._buttons is not None
        with self._buttons.hold_sync():
            self._buttons.said = said
            self._buttons.done += 1

    def _hint(self) -> str:
        return hint(self._exercise).html()

    def _answer(self) -> str:
        return reveal(self._exercise).html()

    def _again(self) -> str:
        outcome = self._judge()
        bundle = Shown(outcome)._repr_mimebundle_()
        update_display(bundle, raw=True, display_id=self._display_id)
        assert self._buttons is not None
        self._buttons.passed = outcome.status == PASSED
        return ""
