"""Output on the page: at once, and never more than a page can bear."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable

from rosbeat.workspace.terminals.history import Line
from rosbeat.workspace.terminals.remarks import say

#: So many lines of one command are shown at once; of more, the last ones.
FIRST, LAST = 500, 20


class Display:
    """Shows lines of one command.

    Args:
        show: Takes one line.
        first: How many lines are shown as they come.
        last: How many are shown in the end, if there were more.
    """

    def __init__(self, show: Callable[[str], None], first: int = FIRST, last: int = LAST) -> None:
        self._show = show
        self._room = first
        self._late: deque[Line] = deque(maxlen=last)
        self._next: int | None = None

    def add(self, line: Line) -> None:
        """Show a line now, or keep it for the end."""
        if self._room > 0:
            self._room -= 1
            self._next = line.number + 1
            self._show(line.text)
        else:
            self._late.append(line)

    def end(self) -> None:
        """Show the last lines, after the number of those that are left out."""
        if self._late:
            left_out = self._late[0].number - (self._next or 0)
            if left_out:
                say(self._show, f"{left_out:,} lines left out")
        for line in self._late:
            self._show(line.text)
        self._late.clear()
