"""Turn the output of a terminal into lines, store them, and show them on a page.

A library such as pyte emulates a screen of a fixed width, cell by cell, at 0.2 MB/s. A page needs
lines of any length and none of the screen: of a line that is repainted, the last state.
"""

from __future__ import annotations

import re
import sys
import textwrap
from collections import deque
from collections.abc import Callable, Iterable
from functools import lru_cache
from itertools import islice
from typing import TYPE_CHECKING, NamedTuple

from rosbeat.records import LogRecord

if TYPE_CHECKING:
    from pygments.lexer import Lexer
    from pygments.token import _TokenType

#: Characters after which a line is cut; the rest of it is counted.
LONGEST_LINE = 20_000
#: The history keeps so many lines, and so many characters in them.
KEPT_LINES, KEPT_CHARACTERS = 20_000, 4_000_000
#: So many lines of a command are shown at once; of more, the last ones.
FIRST, LAST = 500, 20
#: Columns of a remark; the lines of programs are never wrapped.
WIDTH = 100

Show = Callable[[str], None]

PROMPT, REMARK = "#008a67", "#0076ed"
STRING, VARIABLE, WORD, QUIET = "#be5f00", "#a245ff", "#3d6dff", "#7b7b7b"

#: A prompt: up to the first `$ ` or `> `; see `environment.prompt`.
_PROMPT = re.compile(r".*?[$>] ")
_BOLD, _END = "\x1b[1m", "\x1b[0m"

_CONTROL = re.compile(r"[\x00-\x08\x0b-\x1f\x7f]")
_SEQUENCE = re.compile(
    r"\x1b\[[0-?]*[ -/]*[@-~]"  # cursor, colour, erasing
    r"|\x1b[\]PX^_][^\x07\x1b]*(?:\x07|\x1b\\)?"  # titles and other strings
    r"|\x1b[ -/]*[0-~]?"
)
_OVERSTRUCK = re.compile(r"[^\x08]\x08")  # bold letters of a manual page
_NUMBERS = re.compile(r"[-+]?\d[\d.]*")
_QUOTED = re.compile(r"`[^`\n]*`")
# `textwrap` breaks lines at blanks only: what is to be typed stays in one piece.
_HELD = "\u00a0"
_LOG = re.compile(
    r"\[(?P<level>DEBUG|INFO|WARN|ERROR|FATAL)\] "
    r"(?:\[(?P<seconds>\d+)\.(?P<fraction>\d{1,9})\] )?"
    r"\[(?P<name>[^\]]+)\]: (?P<text>.*)"
)


class Line(NamedTuple):
    """Hold one line of a terminal.

    Attributes:
        number: Its number, counted from the terminal's beginning.
        time_ns: When it was read, in nanoseconds since the epoch.
        text: The line, without its end.
        typed: Whether it was typed; otherwise it was printed.
    """

    number: int
    time_ns: int
    text: str
    typed: bool = False


class History:
    """Keep the newest lines; the owner's lock protects it."""

    def __init__(self) -> None:
        self._lines: deque[Line] = deque()
        self._size = 0
        self.end = 0

    def add(self, text: str, time_ns: int, typed: bool = False) -> None:
        """Append a line; forget the oldest ones if there are too many."""
        self._lines.append(Line(self.end, time_ns, text, typed))
        self._size += len(text)
        self.end += 1
        while len(self._lines) > KEPT_LINES or self._size > KEPT_CHARACTERS:
            self._size -= len(self._lines.popleft().text)

    def since(self, number: int) -> list[Line]:
        """Return the lines from that number on, as far as they are kept."""
        missing = self.end - max(number, self.end - len(self._lines))
        return list(islice(reversed(self._lines), missing))[::-1]

    def text(self) -> str:
        """Return everything that is kept, and how much is not."""
        gone = self.end - len(self._lines)
        note = [f"... {gone:,} earlier lines are not kept ..."] if gone else []
        return "\n".join([*note, *(line.text for line in self._lines)])


# From characters to lines.


class LineBuilder:
    """Collect text until a line is complete."""

    def __init__(self) -> None:
        self._partial = ""
        self._cut = 0

    @property
    def partial(self) -> str:
        """Return the last state of the line that is not complete yet."""
        return _whole(self._partial, self._cut)

    def feed(self, text: str) -> list[str]:
        """Take text, and return the lines that it completes, each by its last state."""
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
            line = _settled(self._partial)
            self._cut += max(0, len(line) - LONGEST_LINE)
            self._partial = line[:LONGEST_LINE]


def _whole(line: str, cut: int = 0) -> str:
    """Return a line as it is shown, of which so many characters were cut off before."""
    line = _settled(line)
    cut += max(0, len(line) - LONGEST_LINE)
    return f"{line[:LONGEST_LINE]} ... {cut:,} more characters" if cut else line


def _settled(text: str) -> str:
    """Return the last state of a line that may have been repainted, without control characters."""
    text = text.rstrip("\r")  # the terminal's own way to end a line
    if not _CONTROL.search(text):
        return text
    repainted = _OVERSTRUCK.sub("", _SEQUENCE.sub("", text).rpartition("\r")[2])
    return _CONTROL.sub("", repainted).rstrip(" ")


def log_records(lines: Iterable[Line]) -> tuple[LogRecord, ...]:
    """Return a record for every line that ROS's logging wrote, in order.

    Args:
        lines: Lines of a terminal. One without a stamp gets the time at which it was read.
    """
    matches = ((line, _LOG.match(line.text)) for line in lines if not line.typed)
    return tuple(_record(line, match) for line, match in matches if match)


def _record(line: Line, match: re.Match[str]) -> LogRecord:
    when = line.time_ns
    if match["seconds"]:
        when = int(match["seconds"]) * 10**9 + int(match["fraction"].ljust(9, "0"))
    return LogRecord(when, match["level"], match["name"], match["text"], "", 0)


# From lines to the page.


class Display:
    """Show the lines of one command as they come; of very many, the first and the last.

    Args:
        show: Takes one line.
    """

    def __init__(self, show: Show) -> None:
        self._show = show
        self._room = FIRST
        self._late: deque[Line] = deque(maxlen=LAST)
        self._next = 0

    def add(self, line: Line) -> None:
        """Show a line now, or keep it for the end."""
        if self._room > 0:
            self._room -= 1
            self._next = line.number + 1
            self._show_line(line)
        else:
            self._late.append(line)

    def end(self) -> None:
        """Show the last lines, after the number of those that are left out."""
        if self._late and self._late[0].number > self._next:
            say(self._show, f"{self._late[0].number - self._next:,} lines left out")
        for line in self._late:
            self._show_line(line)
        self._late.clear()

    def _show_line(self, line: Line) -> None:
        self._show(Typed(line.text) if line.typed else line.text)


def new_only(lines: Iterable[Line], show: Show) -> Show:
    """Return a function that shows a line unless it is like one before, whatever its numbers.

    A node that publishes every second may or may not print one more line before Ctrl+C reaches it.
    What it said all the time says nothing about how it ends.

    Args:
        lines: The lines before.
        show: Takes each line that is new.
    """
    known = {_NUMBERS.sub("#", line.text) for line in lines if not line.typed}

    def show_new(text: str) -> None:
        if text and _NUMBERS.sub("#", text) not in known:
            show(text)

    return show_new


def say(show: Show, text: str) -> None:
    """Show a remark of the course, each of its lines behind a `#` as a comment in a shell.

    Args:
        show: Takes one line.
        text: One line or more; what stands between backquotes is never broken.
    """
    for line in text.splitlines():
        held = _QUOTED.sub(lambda quoted: quoted[0].replace(" ", _HELD), line)
        parts = textwrap.wrap(held, WIDTH - 2, break_long_words=False, break_on_hyphens=False)
        for part in parts or [""]:
            show(Remark(f"# {part.replace(_HELD, ' ')}".rstrip()))


# Colours of prompt, command, output and remarks of the course.
#
# A cell prints while the command runs, so colours are control sequences in what is printed, which
# Jupyter turns into HTML, in notebooks that are not trusted as well. HTML of our own would have to
# replace itself line by line, and such outputs cannot be compared.
#
# Control sequences do not know whether the page is light or dark. Each colour here has a contrast
# of at least 4.3:1 against the white page of JupyterLab and against its dark one (#111111); one
# colour cannot have more than 4.35:1 against both. What programs print keeps the colour of the
# page.


class Typed(str):
    """Hold a line that was typed: a prompt and a command, or a key such as `^C`."""

    __slots__ = ()


class Remark(str):
    """Hold a line that the course says."""

    __slots__ = ()


def print_line(line: str) -> None:
    """Print a line of a terminal; in colour if Jupyter shows what is printed.

    Args:
        line: A `Typed`, a `Remark`, or text that a program printed.
    """
    print(coloured(line) if _is_page() else line)


def coloured(line: str) -> str:
    """Return a line with control sequences for its colours; without them it is the same.

    Args:
        line: A `Typed`, a `Remark`, or text that a program printed.
    """
    if isinstance(line, Remark):
        return _in(REMARK, line)
    if not isinstance(line, Typed):
        return line
    found = _PROMPT.match(line)
    if found is None:
        return _in(PROMPT, line)
    return _in(PROMPT, found[0]) + _command(line[found.end() :])


def _is_page() -> bool:
    """Return whether what is printed goes to a notebook, and not into a file or a test."""
    return type(sys.stdout).__module__ == "ipykernel.iostream"


def _command(text: str) -> str:
    """Return a command in bold, with the colours of its strings, variables and words of bash."""
    colour, parts = "", []
    for kind, part in _lexer().get_tokens(text):
        wanted = _colour(kind) if part.strip() else colour
        parts += [part] if wanted == colour else [_ink(wanted), part]
        colour = wanted
    return f"{_BOLD}{''.join(parts)}{_END}"


def _in(colour: str, text: str) -> str:
    return f"{_ink(colour)}{text}{_END}"


def _ink(colour: str) -> str:
    """Return the control sequence for a colour; for no colour, the one for the page's own."""
    if not colour:
        return "\x1b[39m"
    red, green, blue = (int(colour[at : at + 2], 16) for at in (1, 3, 5))
    return f"\x1b[38;2;{red};{green};{blue}m"


def _colour(kind: _TokenType) -> str:
    from pygments.token import Comment, Keyword, Name, String

    if kind in Comment:
        return QUIET
    if kind in String.Interpol or kind in Name.Variable:
        return VARIABLE
    if kind in String:
        return STRING
    return WORD if kind in Keyword or kind in Name.Builtin else ""


@lru_cache(maxsize=1)
def _lexer() -> Lexer:
    from pygments.lexers.shell import BashLexer

    # A blank or an empty line at either end belongs to the command.
    return BashLexer(stripnl=False, ensurenl=False)
