"""The one number, range, or yes or no, that a text says: `about 26`, `20-30`, `No, it does not`."""

from __future__ import annotations

import re

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
    "nineteen",
)
_TENS = ("twenty", "thirty", "forty", "fifty", "sixty", "seventy", "eighty", "ninety")
_VALUES = {
    **{word: number for number, word in enumerate(_SMALL)},
    **{word: 10 * number for number, word in enumerate(_TENS, 2)},
    **{"none": 0, "nothing": 0, "hundred": 100},
}
# A digit that belongs to a name, as in `Float32`, is no number, and neither is a part of `1.2.3`.
_DIGITS = (
    r"(?<!\w)(?<!\d\.)[-+]?(?:\d{1,3}(?:,\d{3})+(?:\.\d+)?|\d+(?:\.\d+)?|(?<!\.)\.\d+)"
    r"(?:e[-+]?\d+)?(?!\d|\.\d|[^\W\d]+\d)"
)
_WORDS = (
    rf"\b(?:(?:(?:a|one)\s+)?hundred|(?:{'|'.join(_TENS)})(?:[\s-]+(?:{'|'.join(_SMALL[1:10])}))?"
    rf"|{'|'.join(_SMALL)}|none|nothing)\b"
)
_NUMBER = re.compile(f"{_DIGITS}|{_WORDS}")
#: What makes one number say something about many others.
_BOUND = re.compile(
    r"[<>%\N{LESS-THAN OR EQUAL TO}\N{GREATER-THAN OR EQUAL TO}]|\d\+|n't\b"
    r"|\b(?:more|less|fewer|over|under|above|below|least|most|up to|max|min|not|per cent)\b"
)
#: What stands between the ends of a range; a unit may come first, as in `1 s to 2 s`.
_TO = re.compile(r"\s*(?:[^\W\d]+\s*)??(?:-|\N{EN DASH}|\N{EM DASH}|\.{2,3}|\u2026|to|until)\s*")


def truth_in(text: str) -> bool | None:
    """Whether a text says yes or no, at its beginning or its end; None if neither or both."""
    text = _plain(text)
    said = re.findall(r"[^\W_]+", text)
    if len(text) > _LONGEST or not said or _SHRUG.search(text):
        return None
    if len({_TRUTH[word] for word in said if word in _TRUTH}) != 1:
        return None
    if said[0] in _TRUTH:
        return _TRUTH[said[0]]
    return None if "not" in said else _TRUTH.get(said[-1])


def range_in(text: str) -> tuple[float, float] | None:
    """The lowest and the highest number that a text means; both are the same for one number.

    Args:
        text: What somebody wrote, such as `63 messages`, `sixty-three`, `20-30`.

    Returns:
        None if it holds no number, or several that are no range.
    """
    text = _plain(text)
    if len(text) > _LONGEST or _BOUND.search(text):
        return None
    found = list(_NUMBER.finditer(text))
    numbers = [_value(one[0]) for one in found]
    if len(found) == 2 and _is_range(text, *found):
        return min(numbers), max(numbers)
    return (numbers[0], numbers[0]) if len(set(numbers)) == 1 else None


def _plain(text: str) -> str:
    return text.casefold().translate({0x2212: "-", 0x2019: "'"})  # a minus sign, an apostrophe


def _is_range(text: str, low: re.Match[str], high: re.Match[str]) -> bool:
    between = text[low.end() : high.start()]
    if between.strip() == "and":
        return re.search(r"\bbetween\b", text[: low.start()]) is not None
    return _TO.fullmatch(between) is not None


def _value(said: str) -> float:
    """A number in digits or in words."""
    if any(sign.isdigit() for sign in said):
        return float(said.replace(",", ""))
    words = re.split(r"[\s-]+", said)
    # `a hundred` and `one hundred` are the same.
    return 100.0 if words[-1] == "hundred" else float(sum(_VALUES[word] for word in words))
