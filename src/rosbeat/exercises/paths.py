"""Two paths compared, as plain texts: what is wrong with the one that was typed or made."""

from __future__ import annotations

import posixpath
import shlex
from collections.abc import Iterable, Sequence
from difflib import SequenceMatcher

#: How much alike two names have to be, from 0 to 1, to be taken for one with a letter wrong.
_ALIKE = 0.75
_MOVERS = ("cd", "pushd")
_SEPARATORS = {";", "&&", "||", "|", "&"}


def alike(one: str, other: str) -> bool:
    """Whether two names differ in a letter or two, in capitals, or in the order of letters only."""
    one, other = one.lower(), other.lower()
    turned = sorted(one) == sorted(other)
    return turned or SequenceMatcher(None, one, other).ratio() >= _ALIKE


def letters(path: str) -> str:
    """Return the letters and digits of a path, small: what is left if no sign between counts."""
    return "".join(sign for sign in path.lower() if sign.isalnum())


def misspelled(path: str, wanted: str) -> bool:
    """Whether a path has the parts that were wanted, each nearly, and not all exactly."""
    parts, goals = path.split("/"), wanted.split("/")
    same = len(parts) == len(goals) and path != wanted
    return same and all(alike(part, goal) for part, goal in zip(parts, goals, strict=True))


def closeness(path: str, wanted: str) -> int:
    """Return how many parts of a path that was wanted are in another one, nearly or exactly."""
    parts = path.split("/")
    return sum(any(alike(part, goal) for part in parts) for goal in wanted.split("/"))


def led_to(start: str, path: str) -> str:
    """Return where a relative path leads, relative to the workspace.

    Args:
        start: The folder in which it is typed, relative to the workspace.
        path: The path.
    """
    return posixpath.normpath(posixpath.join(start, path))


def moves(lines: Iterable[str]) -> list[list[str]]:
    """Return the words behind each `cd` or `pushd` among lines that were typed.

    Args:
        lines: Lines of a terminal; each may hold several commands.
    """
    return [words[1:] for words in commands(lines) if words[0] in _MOVERS]


def commands(lines: Iterable[str]) -> list[list[str]]:
    """Return the words of each command among lines that were typed."""
    found: list[list[str]] = []
    for line in lines:
        found.append([])
        for word in _words(line):
            if word in _SEPARATORS:
                found.append([])
            else:
                found[-1].append(word)
    return [words for words in found if words]


def _words(line: str) -> Sequence[str]:
    lexer = shlex.shlex(line, posix=True, punctuation_chars=True)
    lexer.whitespace_split = True
    # A variable stays in one piece with its sign, and a backslash stays to be seen.
    lexer.escape = ""
    try:
        return list(lexer)
    except ValueError:  # a quote is not closed
        return line.split()


def is_absolute(words: Sequence[str]) -> bool:
    """Whether `cd` with these words leads to the same place from everywhere."""
    path = next((word for word in words if not word.startswith("-")), "")
    return not path or path.startswith(("/", "~", "$"))
