"""Which topic was probably meant."""

from __future__ import annotations

from collections.abc import Iterable
from difflib import SequenceMatcher

#: How like two names have to be, from 0 to 1. At 0.8 `temprature` and `temperatures` are like
#: `temperature`, and `humidity`, `status` or `temp` are not.
_LIKE = 0.8


def nearest(name: str, others: Iterable[str]) -> str:
    """Return the name that is most like `name`, or an empty text if none is like it.

    Capitals do not count. Two names that end alike are alike too, whatever stands before: a
    namespace is easily forgotten.

    Args:
        name: A full name, such as `/temperature`.
        others: Full names; `name` itself does not count.
    """
    rated = [(_likeness(name, other), other) for other in sorted(set(others) - {name})]
    best = max(rated, default=(0.0, ""), key=lambda pair: pair[0])
    return best[1] if best[0] >= _LIKE else ""


def difference(one: str, other: str) -> str:
    """Say in what two names that are alike differ, as the end of a sentence."""
    if one.lower() == other.lower():
        return "they differ in capital letters"
    if _tail(one) == _tail(other):
        return "they differ in what stands before the last slash"
    if one.strip("/_").replace("_", "") == other.strip("/_").replace("_", ""):
        return "they differ in underscores"
    return f"they differ in {_letters(one, other)}"


def _likeness(one: str, other: str) -> float:
    low, other_low = one.lower().strip("/"), other.lower().strip("/")
    alike = SequenceMatcher(None, low, other_low, autojunk=False).ratio()
    return max(alike, 0.9 if _tail(low) == _tail(other_low) else 0.0)


def _tail(name: str) -> str:
    return name.rpartition("/")[2]


def _letters(one: str, other: str) -> str:
    """How many letters: each that is missing, too much or another one counts."""
    steps = SequenceMatcher(None, one, other, autojunk=False).get_opcodes()
    apart = [(one[a:b], other[c:d]) for kind, a, b, c, d in steps if kind != "equal"]
    number = sum(max(len(here), len(there)) for here, there in apart)
    # A digit, an underscore and a slash are no letters.
    noun = "letter" if all((here + there).isalpha() for here, there in apart) else "character"
    return f"one {noun}" if number == 1 else f"{number} {noun}s"
