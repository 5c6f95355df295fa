"""Check names of nodes, topics and services, and suggest the name that was probably meant."""

from __future__ import annotations

import re
from collections.abc import Iterable
from difflib import SequenceMatcher, get_close_matches

from ros2_command.errors import CommandError

_PART = re.compile(r"[A-Za-z_][A-Za-z0-9_]*")


def is_hidden(name: str) -> bool:
    """Return whether one of the parts of a name begins with an underscore."""
    return any(part.startswith("_") for part in name.split("/"))


def absolute(name: str) -> str:
    """Return a name with its leading slash."""
    return name if name.startswith("/") else f"/{name}"


def full_name(name: str, namespace: str) -> str:
    """Return a node's name with its namespace."""
    return f"{namespace.rstrip('/')}/{name}"


def check_name(kind: str, name: str) -> None:
    """Refuse a name that cannot be a topic's or a service's.

    Raises:
        CommandError: With the reason.
    """
    parts = name.removeprefix("~/").removeprefix("/").split("/")
    wrong = [part for part in parts if not _PART.fullmatch(part)]
    if not wrong:
        return
    if not name or any(not part for part in wrong):
        reason = "it is empty, ends in '/', or has two '/' in a row"
    elif wrong[0][0].isdigit():
        reason = f"'{wrong[0]}' begins with a digit"
    else:
        reason = f"'{wrong[0]}' contains characters other than letters, digits and '_'"
    raise CommandError(f"{kind} name '{name}' is invalid: {reason}")


def check_node_name(name: str) -> None:
    """Refuse a name that cannot be a node's.

    Raises:
        CommandError: With the reason.
    """
    if not _PART.fullmatch(name):
        raise CommandError(
            f"'{name}' cannot be the name of a node: it may contain only letters, digits and "
            "'_', and must not begin with a digit"
        )


def nearest(word: str, names: Iterable[str], likeness: float = 0.6) -> str | None:
    """Return the name most like a word, or None if nothing is like it.

    Args:
        word: What was typed.
        names: What would have been right.
        likeness: How like it has to be, from 0 to 1 (`difflib.SequenceMatcher.ratio`), as a whole
            and in the part after the last `/`: a common namespace or package says nothing.

    Returns:
        One of the names. Capitals do not count; neither do the parts before the last `/` if the
        last part is exactly right.
    """
    by_lower = {name.lower(): name for name in names}
    tail = _tail(word.lower())
    found = [
        name for name in get_close_matches(word.lower(), by_lower, n=10, cutoff=likeness)
        if SequenceMatcher(None, _tail(name), tail).ratio() >= likeness
    ]  # fmt: skip
    if not found and tail:
        found = sorted(name for name in by_lower if _tail(name) == tail)
    return by_lower[found[0]] if found else None


def _tail(name: str) -> str:
    return name.rpartition("/")[2]


def did_you_mean(word: str, names: Iterable[str], otherwise: str = "") -> str:
    """Return a line that suggests the nearest name, or another line if there is none."""
    name = nearest(word, names)
    return f"Did you mean '{name}'?" if name else otherwise
