"""An outcome as a learner sees it in a cell."""

from __future__ import annotations

from dataclasses import dataclass
from html import escape

from rosbeat.checks.verdicts import FAILED, NOT_ATTEMPTED, PASSED
from rosbeat.records import Outcome

#: Sign, word and border colour; the sign and the word say the same as the colour.
_LOOKS = {
    PASSED: ("\N{CHECK MARK}", "passed", "#00785a"),
    FAILED: ("\N{MULTIPLICATION SIGN}", "not there yet", "#b34700"),
    NOT_ATTEMPTED: ("\N{WHITE CIRCLE}", "not attempted yet", "#5a6b7b"),
}


@dataclass(frozen=True)
class Shown:
    """An outcome with the ways in which Jupyter and a terminal show it.

    Attributes:
        outcome: The outcome.
    """

    outcome: Outcome

    def __str__(self) -> str:
        sign, word, _ = _LOOKS[self.outcome.status]
        rows = [f"{sign} Exercise {self.outcome.exercise}: {word}. {self.outcome.evidence}".strip()]
        if self.outcome.hint:
            rows.append(f"  Hint: {self.outcome.hint}")
        return "\n".join(rows)

    def __repr__(self) -> str:
        return str(self)

    def _repr_html_(self) -> str:
        sign, word, colour = _LOOKS[self.outcome.status]
        head = f"<strong>{sign} Exercise {escape(self.outcome.exercise)}: {word}.</strong>"
        hint = f"<br><em>Hint:</em> {escape(self.outcome.hint)}" if self.outcome.hint else ""
        # No background and no text colour of its own: both are the reader's theme.
        style = f"border-left:4px solid {colour};padding:0.3em 0.8em;margin:0.3em 0"
        return f'<div style="{style}">{head} {escape(self.outcome.evidence)}{hint}</div>'
