"""Words for people: progress, and problems in three parts."""

from __future__ import annotations

import sys
from textwrap import indent

_LABELS = ("What happened:", "What it means here:", "What to try:")
_WIDTH = 21


class Problem(Exception):  # noqa: N818 - not always an error
    """Something a person has to know: what happened, what it means here, what to try.

    Attributes:
        details: The last words of the program that failed, if one did.
    """

    def __init__(self, happened: str, means: str, cure: str, details: str = "") -> None:
        super().__init__(happened)
        self.happened = happened
        self.means = means
        self.cure = cure
        self.details = details


class Untouched(Problem):
    """A problem that came up before anything in the environment was changed."""


def three_parts(problem: Problem) -> str:
    """Return a problem as the text a person reads."""
    parts = zip(_LABELS, (problem.happened, problem.means, problem.cure), strict=True)
    text = "\n".join(label.ljust(_WIDTH) + _hang(part) for label, part in parts)
    if problem.details.strip():
        text += "\n\nIts last words:\n" + indent(problem.details.strip(), "    ")
    return text


def say(text: str = "") -> None:
    """Print a line of progress, at once."""
    print(text, flush=True)


def complain(problem: Problem) -> None:
    """Print a problem where problems go."""
    print(f"\n{three_parts(problem)}\n", file=sys.stderr, flush=True)


def _hang(text: str) -> str:
    """Indent every line but the first under the labels' column."""
    return text.replace("\n", "\n" + " " * _WIDTH)
