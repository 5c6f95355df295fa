"""The name that was probably meant."""

from __future__ import annotations

from collections.abc import Iterable
from difflib import get_close_matches


def nearest(word: str, names: Iterable[str], likeness: float = 0.6) -> str | None:
    """The name most like a word, or None if nothing is like it.

    Args:
        word: What was typed.
        names: What would have been right.
        likeness: How like it has to be, from 0 to 1 (`difflib.SequenceMatcher.ratio`).

    Returns:
        One of the names. Capitals do not count; neither do the parts before the last `/` if the
        last part is exactly right.
    """
    by_lower = {name.lower(): name for name in names}
    found = get_close_matches(word.lower(), by_lower, n=1, cutoff=likeness)
    if not found and (tail := word.lower().rpartition("/")[2]):
        found = sorted(name for name in by_lower if name.rpartition("/")[2] == tail)
    return by_lower[found[0]] if found else None


def did_you_mean(word: str, names: Iterable[str], otherwise: str = "") -> str:
    """A line that suggests the nearest name, or another line if there is none."""
    name = nearest(word, names)
    return f"Did you mean '{name}'?" if name else otherwise
