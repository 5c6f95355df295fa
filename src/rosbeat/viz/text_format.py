"""Format counts, lists, times and numbers for descriptions and labels. Pure functions."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from difflib import get_close_matches
from itertools import groupby

from rosbeat.records import NANOSECONDS


def count(number: int, noun: str, plural: str = "") -> str:
    """Return a number with its noun: `1 node`, `2 nodes`, `no nodes`."""
    many = plural or f"{noun}s"
    return f"{number or 'no'} {noun if number == 1 else many}"


def not_shown(number: int, noun: str, plural: str = "") -> str:
    """Tell how many things a picture has left out; an empty string if none."""
    verb = "is" if number == 1 else "are"
    return f"{count(number, noun, plural)} {verb} not shown." if number else ""


def listing(names: Iterable[str], last: str = "and") -> str:
    """Join names as a sentence has them: `a`, `a and b`, `a, b and c`."""
    items = list(names)
    if len(items) < 2:
        return "".join(items)
    return f"{', '.join(items[:-1])} {last} {items[-1]}"


def number(value: float) -> str:
    """Write a number in at most six significant digits, with a true minus: `20`, `−1.5`."""
    return f"{value:.6g}".replace("-", "−")


def rounded(value: float) -> str:
    """Write a measured number in four significant digits, from 1,000 up in six."""
    return number(value if abs(value) >= 1000 else float(f"{value:.4g}"))


def seconds(time_ns: int) -> str:
    """Write a time in nanoseconds as seconds: `0 s`, `1.5 s`; nothing is rounded away."""
    whole, rest = divmod(abs(time_ns), NANOSECONDS)
    decimals = f".{rest:09d}".rstrip("0").rstrip(".")
    return f"{'−' if time_ns < 0 else ''}{whole}{decimals} s"


def ranges(numbers: Sequence[int], most: int = 8) -> str:
    """Join ascending whole numbers, with runs drawn together: `1 to 5, 8 and 9`.

    After `most` runs comes only how many numbers follow, since nobody listens to longer lists.
    """
    # In a run, the difference between a number and its rank is the same.
    groups = groupby(enumerate(numbers), key=lambda one: one[1] - one[0])
    runs = [[number for _, number in group] for _, group in groups]
    parts: list[str] = []
    for run in runs[:most]:
        parts += [f"{run[0]} to {run[-1]}"] if len(run) > 2 else map(str, run)
    rest = sum(map(len, runs[most:]))
    return listing([*parts, f"{rest} more"] if rest else parts)


def sentence_case(text: str) -> str:
    """Return the text with its first letter as a capital, the others as they are."""
    return text[:1].upper() + text[1:]


def nearest(name: str, known: Iterable[str]) -> str:
    """Return the known name most like `name`, or an empty string when none is like it."""
    by_bare = {item.lstrip("/"): item for item in known}
    hits = get_close_matches(name.lstrip("/"), sorted(by_bare), n=1, cutoff=0.5)
    return by_bare[hits[0]] if hits else ""
