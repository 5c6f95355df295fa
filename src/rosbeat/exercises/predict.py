"""Compare a prediction with what happened: `predict`."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from contextlib import suppress
from dataclasses import dataclass
from functools import partial
from math import isclose, isnan
from numbers import Real
from typing import Any

from rosbeat.errors import called_as
from rosbeat.exercises.cards import OPEN, RIGHT, WRONG, framed, words
from rosbeat.exercises.cells import cells_of
from rosbeat.exercises.withheld import Withheld

# The one number, range, or yes or no, that a text says: `about 26`, `20-30`, `No, it does not`.

#: A longer text is a tale; nobody can tell which of its words is the guess.
_LONGEST = 200

_TRUTH = {
    **dict.fromkeys(("yes", "true", "y", "yep", "yeah"), True),
    **dict.fromkeys(("no", "false", "n", "nope"), False),
}
_SHRUG = re.compile(r"\bno (idea|clue|guess|opinion|prediction|answer)\b")

_SMALL = (
    *("zero", "one", "two", "three", "four", "five", "six", "seven", "eight", "nine", "ten"),
    *("eleven", "twelve", "thirteen", "fourteen", "fifteen", "sixteen", "seventeen", "eighteen"),
    *("nineteen", "twenty"),
)
_VALUES = {word: number for number, word in enumerate(_SMALL)} | {"none": 0, "nothing": 0}
# A digit that belongs to a name, as in `Float32`, is no number, and neither is a part of `1.2.3`.
_DIGITS = (
    r"(?<!\w)(?<!\d\.)[-+]?(?:\d{1,3}(?:,\d{3})+(?:\.\d+)?|\d+(?:\.\d+)?|(?<!\.)\.\d+)"
    r"(?:e[-+]?\d+)?(?!\d|\.\d|[^\W\d]+\d)"
)
_NUMBER = re.compile(rf"{_DIGITS}|\b(?:{'|'.join(_VALUES)})\b")
#: What makes one number say something about many others.
_BOUND = re.compile(
    r"[<>%\N{LESS-THAN OR EQUAL TO}\N{GREATER-THAN OR EQUAL TO}]|\d\+|n't\b"
    r"|\b(?:more|less|fewer|over|under|above|below|least|most|up to|max|min|not|per cent)\b"
)
#: What stands between the ends of a range; a unit may come first, as in `1 s to 2 s`.
_TO = re.compile(r"\s*(?:[^\W\d]+\s*)??(?:-|\N{EN DASH}|\N{EM DASH}|\.{2,3}|\u2026|to|until)\s*")


def truth_in(text: str) -> bool | None:
    """Return whether a text says yes or no, first or last; None if neither or both."""
    text = _lowered(text)
    said = re.findall(r"[^\W_]+", text)
    if len(text) > _LONGEST or not said or _SHRUG.search(text):
        return None
    if len({_TRUTH[word] for word in said if word in _TRUTH}) != 1:
        return None
    if said[0] in _TRUTH:
        return _TRUTH[said[0]]
    return None if "not" in said else _TRUTH.get(said[-1])


def range_in(text: str) -> tuple[float, float] | None:
    """Return the lowest and the highest number that a text means; both are the same for one number.

    Args:
        text: What somebody wrote, such as `63 messages`, `three`, `20-30`.

    Returns:
        None if it holds no number, or several that are no range.
    """
    text = _lowered(text)
    if len(text) > _LONGEST or _BOUND.search(text):
        return None
    found = list(_NUMBER.finditer(text))
    numbers = [_value(one[0]) for one in found]
    if len(found) == 2 and _is_range(text, *found):
        return min(numbers), max(numbers)
    return (numbers[0], numbers[0]) if len(set(numbers)) == 1 else None


def _lowered(text: str) -> str:
    return text.casefold().translate({0x2212: "-", 0x2019: "'"})  # a minus sign, an apostrophe


def _is_range(text: str, low: re.Match[str], high: re.Match[str]) -> bool:
    between = text[low.end() : high.start()]
    if between.strip() == "and":
        return re.search(r"\bbetween\b", text[: low.start()]) is not None
    return _TO.fullmatch(between) is not None


def _value(said: str) -> float:
    """Return a number in digits or in words."""
    if any(sign.isdigit() for sign in said):
        return float(said.replace(",", ""))
    return float(_VALUES[said])


# Whether a guess and what happened are the same for a person, whatever their types are.

#: A Float32 carries seven digits: 22.3 comes back as 22.299999237.
_FLOAT32 = 1e-6
_ADDRESS = re.compile(r" at 0x[0-9a-f]+", re.IGNORECASE)


def is_blank(guess: object) -> bool:
    """Return whether nothing was filled in: an empty text, underscores only, or nothing at all."""
    if isinstance(guess, str):
        return not guess.strip(" \t\n_\"'")
    return guess is None or guess is Ellipsis


def agree(guess: object, happened: object, tolerance: object = 0.0) -> bool:
    """Return whether a guess says what happened. Never raises, whatever it is given.

    Numbers compare by value, texts without regard to case and blanks, yes and no as True and
    False, lists element by element.

    Args:
        guess: What somebody wrote.
        happened: What happened.
        tolerance: How far apart two numbers may be.
    """
    return compared(guess, happened, tolerance) is True


def compared(guess: object, happened: object, tolerance: object = 0.0) -> bool | None:
    """Return whether a guess says what happened, as `agree`; None if the two cannot be compared.

    A text may say a number or a yes or no in other words: `63 messages`, `about 26`, `No, it does
    not`; and a range, `20-30`, says every number in it.
    """
    with suppress(Exception):  # what a learner hands over may do anything when it is compared
        return _compared(_plain(guess), _plain(happened), _size(tolerance))
    return False


def form_of(happened: object) -> str:
    """Return how a guess has to be written that can be compared with what happened."""
    happened = _plain(happened)
    if isinstance(happened, bool):
        return "yes or no"
    return "a number" if isinstance(happened, Real) else "a list, such as 1, 2, 3"


def in_words(value: object, exact: bool = False) -> str:
    """Say a value in one line, as people write it.

    Args:
        value: Any value.
        exact: Whether numbers keep all their digits.
    """
    try:
        text = _ADDRESS.sub("", " ".join(_in_words(_plain(value), exact).split()))
    except Exception:  # a broken __repr__ is no reason to end the page
        text = f"a {type(value).__name__}"
    return text if len(text) <= _LONGEST else f"{text[: _LONGEST - 4]} ..."


def _compared(guess: object, happened: object, tolerance: float) -> bool | None:
    one, other = _number(guess), _number(happened)
    if one is not None and other is not None:
        return _near(one, other, tolerance)
    if isinstance(happened, bool):
        said = _truth(guess)
        return None if said is None else said == happened
    if isinstance(happened, Real):
        return _says_number(guess, happened, tolerance)
    if isinstance(guess, bool):
        return _truth(happened) == guess
    if isinstance(guess, str) and isinstance(happened, str):
        return _squeezed(guess) == _squeezed(happened)
    if isinstance(happened, (list, tuple)):
        return _compared_all(_parts(guess), list(happened), tolerance)
    return bool(guess == happened)


def _says_number(guess: object, happened: Real, tolerance: float) -> bool | None:
    """Return whether something that is no plain number says the one that happened."""
    if isinstance(guess, (list, tuple)) and len(guess) == 1:
        return _compared(_plain(guess[0]), happened, tolerance)
    if isinstance(guess, Real) and not isinstance(guess, bool):
        return guess == happened  # one of them is too large for a float
    ends, number = range_in(guess) if isinstance(guess, str) else None, _number(happened)
    if ends is None or number is None:
        return None
    inside = ends[0] <= number <= ends[1]
    return inside or any(_near(end, number, tolerance) for end in ends)


def _compared_all(guesses: list[object], happened: list[object], tolerance: float) -> bool | None:
    if happened and guesses:
        first = _plain(happened[0])
        if all(_compared(_plain(one), first, 0.0) is None for one in guesses):
            return None
    return len(guesses) == len(happened) and all(
        _compared(_plain(one), _plain(other), tolerance) is True
        for one, other in zip(guesses, happened, strict=True)
    )


def _parts(guess: object) -> list[object]:
    """Return the elements of a list, also of one that was written as a text, such as `1, 2, 3`."""
    if isinstance(guess, str):
        inner = guess.strip().strip("[]()").rstrip(", ")
        return [part.strip(" \"'") for part in inner.split(",")] if inner else []
    return list(guess) if isinstance(guess, (list, tuple)) else [guess]


def _near(one: float, other: float, tolerance: float) -> bool:
    if isnan(one) or isnan(other):
        return isnan(one) and isnan(other)
    whole = one.is_integer() and other.is_integer()
    return isclose(one, other, rel_tol=0.0 if whole else _FLOAT32, abs_tol=tolerance)


def _number(value: object) -> float | None:
    if isinstance(value, bool):
        return None
    if isinstance(value, (Real, str)):
        with suppress(ValueError, OverflowError):
            return float(value)
    return None


def _size(tolerance: object) -> float:
    size = _number(tolerance)
    return size if size is not None and size > 0 else 0.0


def _truth(value: object) -> bool | None:
    if isinstance(value, bool):
        return value
    return truth_in(value) if isinstance(value, str) else None


def _squeezed(text: str) -> str:
    return " ".join(text.split()).strip(" .!\"'").casefold()


def _plain(value: object) -> object:
    """Return arrays and numbers of NumPy as Python's own, without importing it."""
    to_list = getattr(value, "tolist", None)
    return to_list() if callable(to_list) else value


def _in_words(value: object, exact: bool) -> str:
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, float):
        return repr(value) if exact else f"{value:.6g}"
    if isinstance(value, str):
        return repr(value) if exact or not value.strip() else value.strip()
    if isinstance(value, (list, tuple)):
        # More elements than letters are never shown; a page may have collected a million.
        return f"[{', '.join(_in_words(_plain(one), exact) for one in value[:_LONGEST])}]"
    if isinstance(value, Mapping):
        inside = (f"{_in_words(key, exact)}: {_in_words(one, exact)}" for key, one in value.items())
        return f"{{{', '.join(inside)}}}"
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
        from rosbeat.exercises.live import ExerciseWidget

        def guess(content: Mapping[str, Any]) -> str:
            made = self.answer(str(content.get("guess", "")))
            if made.sign == OPEN:
                return words(f"That cannot be compared with what happened: write {self.form}.")
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
    if is_blank(guess):
        unmade = f"No prediction yet. It was {in_words(happened)}."
        cells = cells_of()
        if cells is None or cells.withheld is None or not cells.withheld.ask():
            return Prediction(OPEN, unmade)
        answer = partial(predict, happened=happened, tolerance=tolerance, because=because)
        form = "a few words" if isinstance(happened, str) else form_of(happened)
        return OpenPrediction(OPEN, unmade, answer=answer, form=form, withheld=cells.withheld)
    agrees = compared(guess, happened, tolerance)
    if agrees is None:
        asked = f"write {form_of(happened)}"
        return Prediction(OPEN, f"That cannot be compared with {in_words(happened)}: {asked}.")
    if not agrees:
        said, was = _apart(guess, happened)
        return Prediction(
            WRONG, f"You predicted {said}, and it was {was}. Look at why.", str(because)
        )
    near = "" if agree(guess, happened) else " That is close enough."
    sentence = f"You predicted {in_words(guess)}, and it was {in_words(happened)}.{near}"
    return Prediction(RIGHT, sentence, str(because))


def _apart(guess: object, happened: object) -> tuple[str, str]:
    """Return both in words, with all their digits if they look alike without."""
    said, was = in_words(guess), in_words(happened)
    return (
        (said, was)
        if said != was
        else (in_words(guess, exact=True), in_words(happened, exact=True))
    )
