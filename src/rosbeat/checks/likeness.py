"""Whether a guess and what happened are the same for a person, whatever their types are."""

from __future__ import annotations

import re
from collections.abc import Mapping
from contextlib import suppress
from math import isclose, isnan
from numbers import Real

from rosbeat.checks.guesses import range_in, truth_in

_LONGEST = 200
#: A Float32 carries seven digits: 22.3 comes back as 22.299999237.
_FLOAT32 = 1e-6
_ADDRESS = re.compile(r" at 0x[0-9a-f]+", re.IGNORECASE)


def is_blank(guess: object) -> bool:
    """Whether nothing was filled in: an empty text, underscores only, or nothing at all."""
    if isinstance(guess, str):
        return not guess.strip(" \t\n_\"'")
    return guess is None or guess is Ellipsis


def agree(guess: object, happened: object, tolerance: object = 0.0) -> bool:
    """Whether a guess says what happened. Never raises, whatever it is given.

    Numbers compare by value, texts without regard to case and blanks, yes and no as True and
    False, lists element by element.

    Args:
        guess: What somebody wrote.
        happened: What happened.
        tolerance: How far apart two numbers may be.
    """
    return compared(guess, happened, tolerance) is True


def compared(guess: object, happened: object, tolerance: object = 0.0) -> bool | None:
    """Whether a guess says what happened, as `agree`; None if the two cannot be compared.

    A text may say a number or a yes or no in other words: `63 messages`, `about 26`, `No, it does
    not`; and a range, `20-30`, says every number in it.
    """
    with suppress(Exception):  # what a learner hands over may do anything when it is compared
        return _compared(_plain(guess), _plain(happened), _size(tolerance))
    return False


def form_of(happened: object) -> str:
    """How a guess has to be written that can be compared with what happened."""
    happened = _plain(happened)
    if isinstance(happened, bool):
        return "yes or no"
    return "a number" if isinstance(happened, Real) else "a list, such as 1, 2, 3"


def told(value: object, exact: bool = False) -> str:
    """Say a value in one line, as people write it.

    Args:
        value: Any value.
        exact: Whether numbers keep all their digits.
    """
    try:
        text = _ADDRESS.sub("", " ".join(_told(_plain(value), exact).split()))
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
    """Whether something that is no plain number says the one that happened."""
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
    if happened and guesses and not any(_is_like(one, happened[0]) for one in guesses):
        return None
    return len(guesses) == len(happened) and all(
        _compared(_plain(one), _plain(other), tolerance) is True
        for one, other in zip(guesses, happened, strict=True)
    )


def _is_like(guess: object, happened: object) -> bool:
    """Whether two elements can be compared at all."""
    return _compared(_plain(guess), _plain(happened), 0.0) is not None


def _parts(guess: object) -> list[object]:
    """The elements of a list, also of one that was written as a text, such as `1, 2, 3`."""
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
    """Arrays and numbers of NumPy as Python's own, without importing it."""
    to_list = getattr(value, "tolist", None)
    return to_list() if callable(to_list) else value


def _told(value: object, exact: bool) -> str:
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, float):
        return repr(value) if exact else f"{value:.6g}"
    if isinstance(value, str):
        return repr(value) if exact or not value.strip() else value.strip()
    if isinstance(value, (list, tuple)):
        # More elements than letters are never shown; a page may have collected a million.
        return f"[{', '.join(_told(_plain(one), exact) for one in value[:_LONGEST])}]"
    if isinstance(value, Mapping):
        inside = (f"{_told(key, exact)}: {_told(one, exact)}" for key, one in value.items())
        return f"{{{', '.join(inside)}}}"
    return "nothing" if value is None else str(value)
