"""An outcome as a learner sees it in a cell."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import asdict, dataclass
from typing import Any

from rosbeat.checks.frames import OPEN, RIGHT, WRONG, framed, indented, words
from rosbeat.checks.verdicts import FAILED, NOT_ATTEMPTED, PASSED
from rosbeat.diagnosis.mistakes import MISTAKES
from rosbeat.records import Outcome, Part

#: The record of an outcome in a cell's output, for programs.
MIME = "application/vnd.rosbeat.outcome+json"
VERSION = 1

#: Sign and word of each status.
LOOKS = {
    PASSED: (RIGHT, "passed"),
    FAILED: (WRONG, "not there yet"),
    NOT_ATTEMPTED: (OPEN, "not attempted yet"),
}


@dataclass(frozen=True)
class Shown:
    """An outcome with the ways in which Jupyter and a terminal show it.

    Attributes:
        outcome: The outcome.
    """

    outcome: Outcome

    def __str__(self) -> str:
        return "\n".join([f"{self._head} {indented(self.outcome.evidence)}".strip(), *self._rows()])

    def __repr__(self) -> str:
        return str(self)

    def html(self) -> str:
        """The outcome as HTML."""
        head = f"{words(self._head, 'strong')} {words(self.outcome.evidence)}"
        rows = (_labelled(label, text) for label, text in self._details())
        return framed(self._look[0], head, *rows)

    def record(self) -> dict[str, Any]:
        """The outcome as JSON-like data, with the version of its form."""
        said = {"version": VERSION, **asdict(self.outcome), "remarks": list(self.outcome.remarks)}
        parts = list(said.pop("parts"))
        return {**said, "parts": parts} if parts else said

    @property
    def _look(self) -> tuple[str, str]:
        return LOOKS[self.outcome.status]

    @property
    def _head(self) -> str:
        sign, word = self._look
        return f"{sign} Exercise {self.outcome.exercise}: {word}{self._points()}."

    def _points(self) -> str:
        if self.outcome.out_of == 1 or self.outcome.status == NOT_ATTEMPTED:
            return ""
        return f", {self.outcome.points} of {self.outcome.out_of} points"

    def _rows(self) -> Iterator[str]:
        for label, text in self._details():
            yield f"  {f'{label}: ' if label else ''}{indented(text, '    ')}"

    def _details(self) -> Iterator[tuple[str, str]]:
        """What comes below the head: a label, which may be empty, and a text."""
        for part in self.outcome.parts:
            yield _looked_at(part)
        if self.outcome.status == FAILED:
            yield _named(self.outcome.mistake)
        if self.outcome.hint:
            yield "Hint", self.outcome.hint
        for remark in self.outcome.remarks:
            yield "Remark", remark
        if self.outcome.status == FAILED:
            yield "More help", f'hint("{self.outcome.exercise}")'

    def _repr_mimebundle_(self, **_: object) -> dict[str, Any]:
        return {"text/plain": str(self), "text/html": self.html(), MIME: self.record()}


def _looked_at(part: Part) -> tuple[str, str]:
    """A requirement: what is required if it is met, and what was seen instead if it is not."""
    word = "met" if part.met else "not yet"
    extra = ", optional" if part.optional else ""
    head = f"{RIGHT if part.met else WRONG} {part.id} {word}, {part.points} of {part.out_of}{extra}"
    return head, part.text if part.met else part.evidence


def _named(mistake: str) -> tuple[str, str]:
    known = MISTAKES.get(mistake)
    if known is None:
        return "", "This is new to me: I have no name for this mistake."
    return "Mistake", f"{known.title}."


def _labelled(label: str, text: str) -> str:
    return f"{words(f'{label}:', 'em')} {words(text)}" if label else words(text)
