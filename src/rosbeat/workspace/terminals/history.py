"""What a terminal has shown, line by line, as far back as memory should reach."""

from __future__ import annotations

from typing import NamedTuple

#: So much is kept: lines, and characters in them.
KEPT_LINES, KEPT_CHARACTERS = 20_000, 4_000_000


class Line(NamedTuple):
    """One line of a terminal.

    Attributes:
        number: Counted from the terminal's beginning.
        time_ns: When it was read, in nanoseconds since the epoch.
        text: The line, without its end.
        typed: Whether it was typed; otherwise it was printed.
    """

    number: int
    time_ns: int
    text: str
    typed: bool = False


class History:
    """Keeps the newest lines; the owner's lock protects it."""

    def __init__(self) -> None:
        self._lines: list[Line] = []
        self._first = 0
        self._size = 0

    @property
    def end(self) -> int:
        """The number that the next line gets."""
        return self._first + len(self._lines)

    def add(self, text: str, time_ns: int, typed: bool = False) -> None:
        """Append a line."""
        self._lines.append(Line(self.end, time_ns, text, typed))
        self._size += len(text)
        if len(self._lines) > 2 * KEPT_LINES or self._size > 2 * KEPT_CHARACTERS:
            self._forget()

    def since(self, number: int) -> list[Line]:
        """Return the lines from that number on, as far as they are kept."""
        return self._lines[max(0, number - self._first) :]

    def text(self) -> str:
        """Return everything that is kept, and how much is not."""
        kept = self._newest()
        gone = kept[0].number if kept else 0
        note = [f"... {gone:,} earlier lines are not kept ..."] if gone else []
        return "\n".join([*note, *(line.text for line in kept)])

    def _newest(self) -> list[Line]:
        """Return at most as much as is promised: trimming itself is done now and then only."""
        room = KEPT_CHARACTERS
        begin = len(self._lines)
        while begin and len(self._lines) - begin < KEPT_LINES:
            room -= len(self._lines[begin - 1].text)
            if room < 0:
                break
            begin -= 1
        return self._lines[begin:]

    def _forget(self) -> None:
        self._lines = self._newest()
        self._first = self._lines[0].number if self._lines else self._first
        self._size = sum(len(line.text) for line in self._lines)
