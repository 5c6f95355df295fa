"""Draw the flow of messages between two processes: two lanes, an arrow for each message."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from math import inf
from typing import Protocol, runtime_checkable

from matplotlib.path import Path

from rosbeat.errors import PictureError, called_as
from rosbeat.records import NANOSECONDS, LogRecord
from rosbeat.viz import theme
from rosbeat.viz.canvas import Canvas, Entry, Stroke, blank, lane_scale, line_height, text_width
from rosbeat.viz.picture import Picture
from rosbeat.viz.text_format import count, listing, not_shown

#: More messages than this cannot be told apart in one picture.
MOST = 60
#: A publisher may log after it has published, so the other side may have logged before; and a time
#: may be that of reading the line, which is late when the machine is busy.
_HASTE_NS = 2 * NANOSECONDS
# Not the 2 of `sensor2`; the unit may follow without a space, as in 22.13C.
_NUMBER = re.compile(r"(?<![\w.])[-+−]?\d+(?:\.\d+)?")

_LANE, _RIM, _HEAD, _FOOT = 150.0, 52.0, 6.0, 26.0
#: So many numbers are written beside their marks.
_VALUES = 8
_SENT = theme.Style(theme.BLUE, "s", "")
_RECEIVED = theme.Style(theme.TAKEN, "o", "")
_MESSAGE = theme.Style(theme.BLUE, "", "-")
_OTHER = theme.Style(theme.MUTED, "|", "")
#: What may become of a line without a partner, in the words of the key, and its hollow mark.
_ALONE = {
    "early": ("sent before anybody was listening", theme.Style(theme.MUTED, "D", "")),
    "lost": ("lost message", theme.Style(theme.DROPPED, "s", "")),
    "late": ("sent after the receiver's last line", theme.Style(theme.MUTED, "s", "")),
    "strange": ("not among what was sent", theme.Style(theme.PURPLE, "o", "")),
}


@runtime_checkable
class Logged(Protocol):
    """Describe what has log lines: a terminal, or a session."""

    def logs(self) -> Sequence[LogRecord]:
        """Return the log lines, in order."""
        ...


# Which lines of two logs tell of the same message.


@dataclass(frozen=True)
class Line:
    """Hold a log line with a number in it.

    Attributes:
        time_ns: When it was logged, in nanoseconds.
        words: The number as it was written.
        partner: Place of the line of the same message in the other log, or None.
        fate: `arrived` if it has a partner; otherwise, of what was sent, `early` before anything
            arrived, when nobody was listening yet, `late` after the receiver's last line, when
            nobody can say if it arrived, or `lost`; of what was received, `strange`.
    """

    time_ns: int
    words: str
    partner: int | None = None
    fate: str = "arrived"

    @property
    def value(self) -> float:
        """Return the number."""
        return float(self.words.replace("−", "-"))


@dataclass(frozen=True)
class Pairs:
    """Hold two logs, side by side.

    Attributes:
        sent: Lines of the sender that carry a number, in order.
        received: Lines of the receiver that carry a number, in order.
        others: When each side logged lines without a number, in nanoseconds.
        names: Who logged the lines of each side.
        skipped: How many later lines of the sender are left out.
    """

    sent: tuple[Line, ...]
    received: tuple[Line, ...]
    others: tuple[list[int], list[int]]
    names: tuple[str, str]
    skipped: int

    def those(self, fate: str) -> list[Line]:
        """Return the lines of one fate; of what arrived those of the sender."""
        lines = self.received if fate == "strange" else self.sent
        return [line for line in lines if line.fate == fate]


def pairs(sent: Sequence[LogRecord], received: Sequence[LogRecord]) -> Pairs:
    """Pair the lines that carry the same number, in order, as many as possible.

    The number is the first one in the text. If there is a choice, lines close in time are paired.
    """
    every, others = _numbered(sent), _numbered(received)
    here = every[:MOST]
    if len(every) > MOST:
        others = [line for line in others if line.time_ns < every[MOST].time_ns]
    there = others[: 2 * MOST]
    links = _links(here, there)
    back = {target: source for source, target in links.items()}
    first, last = min(links, default=len(here)), max((one.time_ns for one in there), default=inf)
    ours = []
    for rank, line in enumerate(here):
        fate = "late" if line.time_ns > last else "early" if rank < first else "lost"
        ours.append(_joined(line, links.get(rank), fate))
    theirs = [_joined(line, back.get(rank), "strange") for rank, line in enumerate(there)]
    skipped = len(every) - len(here)
    end = max(one.time_ns for one in (*here, *there)) if skipped else inf
    beside = _others(sent, end), _others(received, end)
    names = _name_of(sent), _name_of(received)
    return Pairs(tuple(ours), tuple(theirs), beside, names, skipped)


def _joined(line: Line, partner: int | None, alone: str) -> Line:
    return replace(line, partner=partner, fate=alone if partner is None else "arrived")


def first_number(text: str) -> str:
    """Return the first number in a text as it is written there, or an empty string."""
    found = _NUMBER.search(text)
    return found.group() if found else ""


def _numbered(records: Sequence[LogRecord]) -> list[Line]:
    found = ((one, first_number(one.text)) for one in records)
    lines = (Line(one.time_ns, words) for one, words in found if words)
    return sorted(lines, key=lambda line: line.time_ns)


def _others(records: Sequence[LogRecord], end: float) -> list[int]:
    times = (one.time_ns for one in records if not first_number(one.text))
    return [time for time in times if time <= end]


def _name_of(records: Iterable[LogRecord]) -> str:
    """Return who logged these lines: one name, or several if a process has several nodes."""
    return listing(dict.fromkeys(one.name for one in records)) or "the receiver"


def _links(here: Sequence[Line], there: Sequence[Line]) -> dict[int, int]:
    """Return the longest common subsequence; among those the one with the least time between."""
    # best[i][j]: of here[i:] and there[j:] the number of pairs, minus the time between, the pairs.
    nothing: tuple[int, int, tuple[tuple[int, int], ...]] = (0, 0, ())
    best = [[nothing] * (len(there) + 1) for _ in range(len(here) + 1)]
    for i in reversed(range(len(here))):
        for j in reversed(range(len(there))):
            choices, apart = [best[i + 1][j], best[i][j + 1]], there[j].time_ns - here[i].time_ns
            if here[i].value == there[j].value and apart >= -_HASTE_NS:
                total, time, links = best[i + 1][j + 1]
                choices.append((total + 1, time - abs(apart), ((i, j), *links)))
            best[i][j] = max(choices, key=lambda choice: choice[:2])
    return dict(best[0][0][2])


# The picture.


@called_as("viz.message_flow(sensor, monitor)")
def message_flow(
    sent: Logged | Sequence[LogRecord], received: Logged | Sequence[LogRecord]
) -> Picture:
    """Draw which messages went from one process to another, from what both have logged.

    Each log line is a mark at its time, counted from the first line. A line that tells of a message
    has a number in it: the first in its text, such as 22.13 in `Publishing: 22.13C`. A line sent
    and a line received with equal numbers are one message and joined by an arrow, in order, as many
    as possible. A mark without its partner is hollow: the message was lost. What was sent before
    the first message that arrived is not called lost, since nobody was listening yet; nor is what
    was sent after the receiver's last line.

    Args:
        sent: The terminal of the process that publishes, or its log lines.
        received: The terminal of the process that subscribes, or its log lines.

    Returns:
        The picture. Its description tells names and numbers of messages, and no times.

    Raises:
        PictureError: If these are no terminals or log lines, or no line of `sent` has a number.
    """
    shown = pairs(_records(sent), _records(received))
    if not shown.sent:
        raise PictureError(
            "There is no message to draw.",
            "A line that tells of a message has a number in it, and none of those sent has one.",
            "Let the publisher log what it publishes, and wait for some lines.",
        )
    height = _HEAD + 2 * _RIM + _LANE + _FOOT
    note = not_shown(shown.skipped, "later message")
    with blank(height, entries=_key(shown), note=note) as canvas:
        _Drawing(canvas, shown).draw()
    return Picture(canvas.figure, describe(shown), "Messages from one process to another")


def _records(given: object) -> tuple[LogRecord, ...]:
    if isinstance(given, Logged) and not isinstance(given, type):
        given = given.logs()
    if isinstance(given, Iterable) and not isinstance(given, (str, bytes)):
        items = tuple(given)
        if all(isinstance(item, LogRecord) for item in items):
            return items
    raise PictureError(
        f"A flow of messages cannot be drawn from {type(given).__name__!r}.",
        "It is drawn from what two processes have logged: first the sender, then the receiver.",
        'Give it two terminals, such as `workspace.terminal("sensor")`.',
    )


def _key(shown: Pairs) -> list[Entry]:
    """Return the marks in use, each with its meaning."""
    usual = {"line of the sender": _SENT, "line of the receiver": _RECEIVED, "message": _MESSAGE}
    found = [Entry(*one) for one in usual.items() if shown.those("arrived")]
    alone = [Entry(*look, theme.CARD) for fate, look in _ALONE.items() if shown.those(fate)]
    return [*found, *alone, *([Entry("other log line", _OTHER)] if any(shown.others) else [])]


class _Drawing:
    """Draw two lanes and what is between them."""

    def __init__(self, canvas: Canvas, shown: Pairs) -> None:
        self._canvas, self._shown = canvas, shown
        self._sender = canvas.top - _HEAD - _RIM
        self._receiver = self._sender - _LANE
        times = [line.time_ns for line in shown.sent + shown.received]
        times += shown.others[0] + shown.others[1]
        self._start = min(times)
        self._scale = lane_scale(shown.names, (max(times) - self._start) / NANOSECONDS, 100.0)

    def draw(self) -> None:
        shown = self._shown
        ends = (self._receiver - _RIM, self._sender + _RIM)
        self._canvas.time_axis(self._scale, *ends)
        lost = [f"{len(shown.those('lost'))} lost"] if shown.those("lost") else []
        self._draw_lane(0, self._sender, [f"{len(shown.sent)} sent", *lost])
        self._draw_lane(1, self._receiver, [f"{len(shown.received)} received"])
        stroke = Stroke(_MESSAGE.colour, _MESSAGE.dash, 1.3)
        for line in shown.those("arrived"):
            way = [(self._x(line.time_ns), self._sender), (self._end(line), self._receiver + 6)]
            self._canvas.arrow(Path(way), stroke)
        for line in shown.sent:
            self._mark(line, self._sender, _SENT)
        for line in shown.received:
            self._mark(line, self._receiver, _RECEIVED)
        self._write_values()

    def _x(self, time_ns: int) -> float:
        return self._scale((time_ns - self._start) / NANOSECONDS)

    def _end(self, line: Line) -> float:
        """Return where a message's arrow ends; where it begins if it has none."""
        received = self._shown.received
        return self._x((line if line.partner is None else received[line.partner]).time_ns)

    def _draw_lane(self, side: int, y: float, sums: Sequence[str]) -> None:
        self._canvas.lane(self._scale, y, self._shown.names[side], has_text_below=True)
        for rank, words in enumerate(sums, 1):
            colour = theme.DROPPED_TEXT if words.endswith("lost") else theme.MUTED
            at = y - rank * line_height() - 3
            self._canvas.text(self._scale.left - 18, at, words, colour, "right")
        for at_ns in self._shown.others[side]:
            self._canvas.mark(self._x(at_ns), y, _OTHER, 9, layer=3)

    def _mark(self, line: Line, y: float, look: theme.Style) -> None:
        """Draw a mark, hollow if the message has no partner."""
        x = self._x(line.time_ns)
        if line.partner is not None:
            self._canvas.mark(x, y, look, 7, theme.CARD, 0.8)
        else:
            look = _ALONE[line.fate][1]
            self._canvas.mark(x, y, look, 7, width=1.6, layer=5, fill=theme.CARD)

    def _write_values(self) -> None:
        """Write the first few numbers beside both marks of their message, where there is room."""
        free, written = self._scale.left - 60, 0
        more = (theme.MUTED, "center")
        for line in self._shown.sent:
            half = text_width(line.words) / 2
            x, end = self._x(line.time_ns), self._end(line)
            if min(x, end) - half > free and written < _VALUES:
                self._canvas.text(x, self._sender + 20, line.words, *more)
                if line.partner is not None:
                    words = self._shown.received[line.partner].words
                    self._canvas.text(end, self._receiver - 20, words, *more)
                free, written = max(x, end) + half + 5, written + 1


# The same in words.


def describe(shown: Pairs) -> str:
    """Tell what became of the messages, without times."""
    sender, receiver = shown.names
    fates = ("arrived", "lost", "late", "early", "strange")
    arrived, lost, late, early, strange = (len(shown.those(fate)) for fate in fates)
    every = "all" if arrived == len(shown.sent) > 1 else str(arrived or "none")
    sums = [f"{every} arrived at {receiver}"]
    sums += [f"{lost or 'none'} {_was(lost or 1)} lost"] if arrived else []
    sums += [f"{late} {_was(late)} sent after its last line"] if late else []
    said = [f"{sender} sent {count(len(shown.sent), 'message')}: {listing(sums)}."]
    if early:
        which = "The first one" if early == 1 else f"The first {early}"
        said.append(f"{which} {_was(early)} sent before anybody was listening.")
    if strange:
        verb = "has" if strange == 1 else "have"
        lines = count(strange, "line")
        said.append(f"{lines} of {receiver} {verb} a number that {sender} did not log.")
    return " ".join([*said, not_shown(shown.skipped, "later message")]).strip()


def _was(number: int) -> str:
    return "was" if number == 1 else "were"
