"""From what a terminal is sent to the lines that somebody would see on it."""

from __future__ import annotations

import re

#: A line is cut here. The rest of it is counted.
LONGEST_LINE = 20_000
_CONTROL = re.compile(r"[\x00-\x08\x0b-\x1f\x7f]")
_SEQUENCE = re.compile(
    r"\x1b\[(?P<args>[0-?]*)[ -/]*(?P<final>[@-~])"  # cursor, colour, erasing
    r"|\x1b[\]PX^_][^\x07\x1b]*(?:\x07|\x1b\\)?"  # titles and other strings
    r"|\x1b[ -/]*[0-~]?"
)


class LineBuilder:
    """Collects text until a line is complete."""

    def __init__(self) -> None:
        self._partial = ""
        self._cut = 0

    @property
    def partial(self) -> str:
        """What the last line holds so far, as it is seen."""
        return _whole(self._partial, self._cut)

    def feed(self, text: str) -> list[str]:
        """Take text and return the lines that it completes, as they are seen."""
        head, newline, text = text.partition("\n")
        self._extend(head)
        if not newline:
            return []
        done = [self.finish()]
        *complete, rest = text.replace("\r\n", "\n").split("\n")
        done += map(_whole, complete)
        self._extend(rest)
        return done

    def finish(self) -> str:
        """End the current line here and return it."""
        line = self.partial
        self._partial, self._cut = "", 0
        return line

    def _extend(self, text: str) -> None:
        self._partial += text
        if len(self._partial) > 2 * LONGEST_LINE:
            # A progress bar repaints one line for hours: only its last state is kept.
            line = settle(self._partial)
            self._cut += max(0, len(line) - LONGEST_LINE)
            self._partial = line[:LONGEST_LINE]


def settle(text: str) -> str:
    """Return the last state of a line that may have been repainted, without control characters."""
    if text.endswith("\r"):
        text = text.rstrip("\r")  # the terminal's own way to end a line
    if not _CONTROL.search(text):
        return text
    return _paint(text)


def _paint(text: str) -> str:
    cells: list[str] = []
    column = place = 0
    while place < len(text):
        sequence = _SEQUENCE.match(text, place)
        if sequence:
            column = _obey(sequence, cells, column)
            place = sequence.end()
        else:
            column = _put(text[place], cells, column)
            place += 1
    return "".join(cells).rstrip(" ")


def _put(character: str, cells: list[str], column: int) -> int:
    if character == "\r":
        return 0
    if character == "\b":
        return max(0, column - 1)
    if _CONTROL.match(character):
        return column
    cells[column : column + 1] = character
    return column + 1


def _obey(sequence: re.Match[str], cells: list[str], column: int) -> int:
    """Do what a control sequence asks, as far as it concerns one line."""
    if sequence["final"] == "K":
        if sequence["args"] in ("", "0"):
            del cells[column:]
        elif sequence["args"] == "2":
            cells[:] = [" "] * column
    elif sequence["final"] == "G":
        column = min(len(cells), max(0, int(sequence["args"] or 1) - 1))
    return column


def _whole(line: str, cut: int = 0) -> str:
    """Return a line as it is shown, of which so many characters were cut off before."""
    line = settle(line)
    cut += max(0, len(line) - LONGEST_LINE)
    return f"{line[:LONGEST_LINE]} ... {cut:,} more characters" if cut else line
