"""What is worth showing after Ctrl+C.

A node that publishes every second may or may not have printed one more line before the key reached
it. What it said all the time says nothing about how it ends, and stays in the terminal's history.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable

from rosbeat.workspace.terminals.history import Line

_NUMBERS = re.compile(r"[-+]?\d[\d.]*")


def shapes(lines: Iterable[Line]) -> frozenset[str]:
    """Return the printed lines with every number made the same."""
    return frozenset(_shape(line.text) for line in lines if not line.typed)


class NewOnly:
    """Shows a line unless one of the same shape was there before; no empty lines either.

    Args:
        known: The shapes that were there.
        show: Takes what is shown.
    """

    def __init__(self, known: frozenset[str], show: Callable[[str], None]) -> None:
        self._known, self._show = known, show

    def __call__(self, text: str) -> None:
        """Show a line, or do not."""
        if text and _shape(text) not in self._known:
            self._show(text)


def _shape(text: str) -> str:
    return _NUMBERS.sub("#", text)
