"""`predict`: a prediction made before a run, compared with what then happened.

It is written in the cell that runs, so that nobody can forget to compare::

    predict("____", len(ros.messages("temperature")))
"""

from __future__ import annotations

from dataclasses import dataclass

from rosbeat.checks.frames import OPEN, RIGHT, WRONG, framed, words
from rosbeat.checks.likeness import agree, compared, form_of, is_blank, told


@dataclass(frozen=True)
class Prediction:
    """A prediction beside what happened, as Jupyter and a terminal show it.

    Attributes:
        sign: Whether they agree: a check mark, a cross, or a circle if nothing was predicted that
            can be compared.
        sentence: What was predicted, and what happened.
        because: Why it happened; may be empty.
    """

    sign: str
    sentence: str
    because: str = ""

    @property
    def was_right(self) -> bool:
        """Whether it happened as predicted."""
        return self.sign == RIGHT

    def __str__(self) -> str:
        return f"{self.sign} {self.sentence}" + (f"\n  {self.because}" if self.because else "")

    def __repr__(self) -> str:
        return str(self)

    def html(self) -> str:
        """The prediction as HTML."""
        return framed(self.sign, words(f"{self.sign} {self.sentence}"), words(self.because))

    def _repr_mimebundle_(self, **_: object) -> dict[str, str]:
        return {"text/plain": str(self), "text/html": self.html()}


def predict(
    guess: object, happened: object, *, tolerance: float = 0.0, because: str = ""
) -> Prediction:
    """Compare what you expect with what happens.

    Args:
        guess: What you expect, written before the cell runs: a number, a range such as `"20-30"`, a
            text, `"yes"` or `"no"`, or a list of these. `"____"` is no prediction yet.
        happened: What happened.
        tolerance: How far a number may be away, in the unit of the number.
        because: Why it happens; shown once there is a prediction.

    Returns:
        Both, side by side, which Jupyter shows. It costs no points to be wrong.
    """
    if is_blank(guess):
        return Prediction(OPEN, f"No prediction yet. It was {told(happened)}.")
    agrees = compared(guess, happened, tolerance)
    if agrees is None:
        asked = f"write {form_of(happened)}"
        return Prediction(OPEN, f"That cannot be compared with {told(happened)}: {asked}.")
    if not agrees:
        said, was = _apart(guess, happened)
        return Prediction(
            WRONG, f"You predicted {said}, and it was {was}. Look at why.", str(because)
        )
    near = "" if agree(guess, happened) else " That is close enough."
    sentence = f"You predicted {told(guess)}, and it was {told(happened)}.{near}"
    return Prediction(RIGHT, sentence, str(because))


def _apart(guess: object, happened: object) -> tuple[str, str]:
    """Both in words, with all their digits if they look alike without."""
    said, was = told(guess), told(happened)
    return (said, was) if said != was else (told(guess, exact=True), told(happened, exact=True))
