"""Compare a prediction with what happened: `predict`."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from functools import partial
from typing import Any

from IPython.display import display

from rosbeat.errors import called_as
from rosbeat.exercises.cells import cells_of
from rosbeat.exercises.deferred_output import Withheld
from rosbeat.exercises.outcome_display import OPEN, RIGHT, WRONG, framed, words

# The one number, range, or yes or no, that a text says: `about 26`, `20-30`, `No, it does not`.

#: A longer text is a tale; nobody can tell which of its words is the guess.
_LONGEST = 200
_TRUTH = {**dict.fromkeys(("yes", "y", "true"), True), **dict.fromkeys(("no", "n", "false"), False)}
_SAYS_TRUTH = re.compile(rf"({'|'.join(_TRUTH)})(?:(?:[.,;:!]|\s+it\b).*)?")
_NUMBER = r"[-+]?(?:\d{1,3}(?:,\d{3})+(?:\.\d+)?|\d+(?:\.\d+)?|\.\d+)(?:e[-+]?\d+)?"
#: A number, or two with a dash between them; what it counts, or its unit, may come after either.
_SAYS_NUMBERS = re.compile(
    r"(?:about|around|roughly|between|~)?\s*"
    rf"({_NUMBER})(?:\s*[^\W\d]*\s*(?:-|\N{{EN DASH}}|\.\.|\bto\b|\band\b)\s*({_NUMBER}))?"
    r"(?!\d)[^\d<>%*/+]*"
)


def truth_in(text: str) -> bool | None:
    """Return whether a text says yes or no; None if it says neither."""
    found = _SAYS_TRUTH.fullmatch(text.strip().casefold())
    return _TRUTH[found[1]] if found else None


def range_in(text: str) -> tuple[float, float] | None:
    """Return the lowest and the highest number that a text means; both are the same for one number.

    Args:
        text: What somebody wrote, such as `63 messages`, `about 26`, `20-30`.

    Returns:
        None if it says anything else.
    """
    text = text.strip().casefold().replace("\N{MINUS SIGN}", "-")
    found = _SAYS_NUMBERS.fullmatch(text) if len(text) <= _LONGEST else None
    if found is None:
        return None
    numbers = [float(one.replace(",", "")) for one in found.groups() if one is not None]
    return min(numbers), max(numbers)


# Whether a guess and what happened are the same for a person, whatever their types are.

#: A Float32 carries seven digits: 22.3 comes back as 22.299999237.
_FLOAT32 = 1e-6
_ADDRESS = re.compile(r" at 0x[0-9a-f]+", re.IGNORECASE)


def is_blank(guess: object) -> bool:
    """Return whether nothing was filled in: an empty text, underscores only, or nothing at all."""
    if isinstance(guess, str):
        return not guess.strip(" \t\n_\"'")
    return guess is None or guess is Ellipsis


def compared(guess: object, happened: object, tolerance: float = 0.0) -> bool | None:
    """Return whether a guess says what happened. Never raises, whatever it is given.

    Numbers compare by value, texts without regard to case and blanks, lists element by element. A
    text may say a number or a yes or no in other words: `63 messages`, `about 26`, `No, it does
    not`; and a range, `20-30`, says every number in it.

    Args:
        guess: What somebody wrote.
        happened: What happened.
        tolerance: How far apart two numbers may be.

    Returns:
        None if the two cannot be compared.
    """
    with suppress(Exception):  # what a learner hands over may do anything when it is compared
        return _compared(_plain(guess), _plain(happened), tolerance)
    return False


def form_of(happened: object) -> str:
    """Return how a guess has to be written that can be compared with what happened."""
    happened = _plain(happened)
    if isinstance(happened, bool):
        return "yes or no"
    if isinstance(happened, str):
        return "a few words"
    return "a number" if isinstance(happened, (int, float)) else "a list, such as 1, 2, 3"


def in_words(value: object) -> str:
    """Say a value in one line, as people write it."""
    try:
        text = _ADDRESS.sub("", " ".join(_in_words(_plain(value)).split()))
    except Exception:  # a broken __repr__ is no reason to end the page
        text = f"a {type(value).__name__}"
    return text if len(text) <= _LONGEST else f"{text[: _LONGEST - 4]} ..."


def _compared(guess: object, happened: object, tolerance: float) -> bool | None:
    if isinstance(happened, bool):
        said = guess if isinstance(guess, bool) else truth_in(str(guess))
        return None if said is None else said == happened
    if isinstance(happened, (int, float)):
        ends = _ends(guess)
        if ends is None:
            return None
        exact = isinstance(happened, int) and all(end.is_integer() for end in ends)
        slack = max(tolerance, 0.0 if exact else _FLOAT32 * abs(happened))
        return ends[0] - slack <= happened <= ends[1] + slack
    if isinstance(happened, (list, tuple)):
        return _compared_all(_parts(guess), happened, tolerance)
    return _squeezed(str(guess)) == _squeezed(str(happened))


def _ends(guess: object) -> tuple[float, float] | None:
    """Return the lowest and the highest number that a guess means; None if it is no number."""
    if isinstance(guess, str):
        return range_in(guess)
    if isinstance(guess, bool) or not isinstance(guess, (int, float)):
        return None
    return float(guess), float(guess)


def _compared_all(
    guesses: Sequence[object], happened: Sequence[object], tolerance: float
) -> bool | None:
    first = [_compared(_plain(one), _plain(happened[0]), 0.0) for one in guesses if happened]
    if first and all(one is None for one in first):
        return None
    return len(guesses) == len(happened) and all(
        _compared(_plain(one), _plain(other), tolerance) is True
        for one, other in zip(guesses, happened, strict=True)
    )


def _parts(guess: object) -> Sequence[object]:
    """Return the elements of a list, also of one that was written as a text, such as `1, 2, 3`."""
    if isinstance(guess, str):
        inner = guess.strip().strip("[]()").rstrip(", ")
        return [part.strip(" \"'") for part in inner.split(",")] if inner else []
    return guess if isinstance(guess, (list, tuple)) else [guess]


def _squeezed(text: str) -> str:
    return " ".join(text.split()).strip(" .!\"'").casefold()


def _plain(value: object) -> object:
    """Return arrays and numbers of NumPy as Python's own, without importing it."""
    to_list = getattr(value, "tolist", None)
    return to_list() if callable(to_list) else value


def _in_words(value: object) -> str:
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, float):
        return f"{value:.7g}"
    if isinstance(value, str):
        return value.strip() or repr(value)
    if isinstance(value, (list, tuple)):
        # More elements than letters are never shown; a page may have collected a million.
        return f"[{', '.join(_in_words(_plain(one)) for one in value[:_LONGEST])}]"
    return "nothing" if value is None else str(value)


# `predict`: a prediction made before a run, compared with what then happened.


@dataclass(frozen=True)
class Prediction:
    """Hold a prediction beside what happened, as Jupyter and a terminal show it.

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
        """Return whether it happened as predicted."""
        return self.sign == RIGHT

    def __str__(self) -> str:
        return f"{self.sign} {self.sentence}" + (f"\n  {self.because}" if self.because else "")

    def __repr__(self) -> str:
        return str(self)

    def html(self) -> str:
        """Return the prediction as HTML."""
        return framed(self.sign, words(f"{self.sign} {self.sentence}"), words(self.because))

    def _repr_mimebundle_(self, **_: object) -> dict[str, str]:
        return {"text/plain": str(self), "text/html": self.html()}


@dataclass(frozen=True, repr=False, kw_only=True)
class OpenPrediction(Prediction):
    """Ask for a prediction with a field in a browser, and show what happened only after it.

    Attributes:
        answer: Compares a guess with what happened.
        form: How a guess is written.
        withheld: What the cell has shown so far.
    """

    answer: Callable[[object], Prediction]
    form: str
    withheld: Withheld

    def _ipython_display_(self) -> None:
        # The widgets take a while to load, and only a notebook in a browser shows them.
        from rosbeat.exercises.widget_actions import ExerciseWidget

        def guess(content: Mapping[str, Any]) -> str:
            made = self.answer(str(content.get("guess", "")))
            if made.sign == OPEN:
                return words(_not_comparable(self.form))
            return end(made)

        def end(made: Prediction) -> str:
            self.withheld.release(made)
            field.passed = True
            # A page that was loaded anew since then does not find the output of the cell.
            return words(made.sentence)

        unmade = Prediction(self.sign, self.sentence)
        actions = {"guess": guess, "show": lambda _: end(unmade)}
        field = ExerciseWidget(actions, "predict", form=self.form)
        field.show()
        self.withheld.shown()


@dataclass(frozen=True, repr=False)
class MadePrediction(Prediction):
    """Show a prediction in a browser, and open what answers it below."""

    def _ipython_display_(self) -> None:
        from rosbeat.exercises.widget_actions import ExerciseWidget

        display(self._repr_mimebundle_(), raw=True)
        ExerciseWidget({}, "predict", passed=True).show()


def _not_comparable(form: str) -> str:
    # What happened is not told: the next guess is still to come.
    return f"That cannot be compared with what happened: write {form}."


@called_as('predict("20-30", reading)')
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
    cells = cells_of()
    if cells is not None:
        happened = cells.first_outcome(happened)
    if is_blank(guess):
        unmade = f"No prediction yet. It was {in_words(happened)}."
        if cells is None or cells.withheld is None or not cells.withheld.ask():
            return Prediction(OPEN, unmade)
        answer = partial(predict, happened=happened, tolerance=tolerance, because=because)
        form, kept = form_of(happened), cells.withheld
        return OpenPrediction(OPEN, unmade, answer=answer, form=form, withheld=kept)
    said, was = in_words(guess), in_words(happened)
    agrees = compared(guess, happened, tolerance)
    if agrees is None:
        return Prediction(OPEN, _not_comparable(form_of(happened)))
    made = MadePrediction if cells is not None and cells.for_a_browser else Prediction
    if not agrees:
        return made(WRONG, f"You predicted {said}, and it was {was}. Look at why.", because)
    near = "" if compared(guess, happened) else " That is close enough."
    return made(RIGHT, f"You predicted {said}, and it was {was}.{near}", because)
