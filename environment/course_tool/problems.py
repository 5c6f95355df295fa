"""Messages for people: progress, and problems in three parts."""

from __future__ import annotations

import os
import shutil
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
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

    def text(self) -> str:
        """Return the problem as a person reads it."""
        parts = zip(_LABELS, (self.happened, self.means, self.cure), strict=True)
        rows = [label.ljust(_WIDTH) + part.replace("\n", f"\n{'':21}") for label, part in parts]
        if self.details.strip():
            rows += ["", "Its last words:", indent(self.details.strip(), "    ")]
        return "\n".join(rows)


def say(text: str = "") -> None:
    """Print a line of progress, at once."""
    print(text, flush=True)


@contextmanager
def status_line() -> Iterator[Callable[[str], None]]:
    """Yield what shows one of many lines, in the place of the one before; at the end, none is left.

    Where nobody watches, as in a pipe or in CI, nothing is shown.
    """
    is_watched = sys.stdout.isatty() and os.environ.get("TERM", "dumb") != "dumb"

    def show(text: str) -> None:
        if is_watched and text.strip():
            width = shutil.get_terminal_size().columns - 8
            print(f"\r\x1b[K       {text.strip()[:width]}", end="", flush=True)

    try:
        yield show
    finally:
        if is_watched:
            print("\r\x1b[K", end="", flush=True)


def complain(problem: Problem) -> None:
    """Print a problem on standard error."""
    print(f"\n{problem.text()}\n", file=sys.stderr, flush=True)


def last_lines(text: str) -> str:
    """Return the last lines of what a program printed, as details of a problem."""
    return "\n".join(text.strip().splitlines()[-12:])
