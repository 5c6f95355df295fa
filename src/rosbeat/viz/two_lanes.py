"""What crossed between two processes: two lanes of log lines, an arrow for each message."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from matplotlib.path import Path

from rosbeat.errors import PictureError
from rosbeat.records import NANOSECONDS, LogRecord
from rosbeat.viz import arrows, axis, key, theme
from rosbeat.viz.canvas import Canvas, blank, line_height, text_width, wrap
from rosbeat.viz.crossing_words import describe, left_out, name_of
from rosbeat.viz.pairs import Line, Pairs, first_number, pairs
from rosbeat.viz.picture import Picture

_LANE = 150.0
_RIM = 52.0
_NAMES = 170.0
_VALUES = 8
_SENT = theme.Style(theme.BLUE, "s", "")
_RECEIVED = theme.Style(theme.TAKEN, "o", "")
_MESSAGE = theme.Style(theme.BLUE, "", "-")
_LOST = theme.Style(theme.ALERT, "s", "")
_LATE = theme.Style(theme.MUTED, "s", "")
_STRANGE = theme.Style(theme.PURPLE, "o", "")
_OTHER = theme.Style(theme.MUTED, "|", "")


@dataclass(frozen=True)
class _Side:
    """One lane: whose it is, how many messages it has, its lines without a number."""

    name: str
    sums: tuple[str, ...]
    others: tuple[int, ...]
    y: float


@dataclass(frozen=True)
class _Plan:
    """What is drawn, and where times are."""

    shown: Pairs
    sender: _Side
    receiver: _Side
    start_ns: int
    scale: axis.Scale

    def x(self, time_ns: int) -> float:
        """Where a time is, in CSS pixels."""
        return self.scale((time_ns - self.start_ns) / NANOSECONDS)


def crossing(sent: Sequence[LogRecord], received: Sequence[LogRecord]) -> Picture:
    """Draw which messages crossed from one process to another, from what both have logged.

    Each log line is a mark at its time, counted from the first line. A line that tells of a message
    has a number in it: the first in its text, such as 22.13 in `Publishing: 22.13C`. A line sent
    and a line received with equal numbers are one message and joined by an arrow, in order, as many
    as possible. A mark without its partner is hollow: the message was lost, as those are that came
    before anybody listened. Only what was sent after the receiver's last line is not called lost.

    Args:
        sent: Log lines of the process that publishes, such as `Terminal.logs()` has them.
        received: Log lines of the process that subscribes.

    Returns:
        The picture. Its description tells names and numbers of messages, and no times.

    Raises:
        PictureError: If these are no log lines, or no line of `sent` has a number.
    """
    ours, theirs = _records(sent), _records(received)
    shown = pairs(ours, theirs)
    if not shown.sent:
        raise PictureError(
            "There is no message to draw.",
            "A line that tells of a message has a number in it, and none of those sent has one.",
            "Let the publisher log what it publishes, and wait for some lines.",
        )
    entries = _key(shown, _others(ours, shown), _others(theirs, shown))
    room = theme.WIDTH - 2 * theme.MARGIN
    note = left_out(shown)
    head = key.height(entries, room) + 6
    foot = 26 + (line_height(theme.SMALL) + 6 if note else 0)
    with blank(2 * theme.MARGIN + head + 2 * _RIM + _LANE + foot) as canvas:
        plan = _plan(ours, theirs, shown, canvas.height - theme.MARGIN - head)
        key.draw(canvas, entries, theme.MARGIN, canvas.height - theme.MARGIN, room)
        axis.draw(canvas, plan.scale, plan.receiver.y - _RIM, plan.sender.y + _RIM)
        _draw(canvas, plan)
        canvas.text(theme.MARGIN, theme.MARGIN, note, theme.SMALL, theme.MUTED)
    words = describe(shown, plan.sender.name, plan.receiver.name)
    return Picture(canvas.figure, words, "Messages from one process to another")


def _records(given: object) -> tuple[LogRecord, ...]:
    if isinstance(given, Iterable) and not isinstance(given, (str, bytes)):
        items = tuple(given)
        if all(isinstance(item, LogRecord) for item in items):
            return items
    raise PictureError(
        f"What crossed cannot be drawn from {type(given).__name__!r}.",
        "It is drawn from the log lines of two processes: those sent, then those received.",
        'Give it lines of two terminals: `workspace.terminal("sensor").logs()`.',
    )


def _others(records: Sequence[LogRecord], shown: Pairs) -> tuple[int, ...]:
    """When the lines without a number were logged, as far as the picture goes."""
    last = max(line.time_ns for line in shown.sent + shown.received)
    times = (one.time_ns for one in records if not first_number(one.text))
    return tuple(at for at in times if not shown.skipped or at <= last)


def _plan(
    ours: tuple[LogRecord, ...], theirs: tuple[LogRecord, ...], shown: Pairs, top: float
) -> _Plan:
    here = _side(ours, shown, _sent_sums(shown), top - _RIM)
    there = _side(theirs, shown, (f"{len(shown.received)} received",), top - _RIM - _LANE)
    times = [line.time_ns for line in shown.sent + shown.received]
    times += here.others + there.others
    start, end = min(times), max(times)
    wide = max(text_width(row) for side in (here, there) for row in wrap(side.name, _NAMES))
    left = theme.MARGIN + max(wide, 100.0) + 24
    scale = axis.Scale(0.0, (end - start) / NANOSECONDS, left, theme.WIDTH - theme.MARGIN - 34)
    return _Plan(shown, here, there, start, scale)


def _side(records: tuple[LogRecord, ...], shown: Pairs, sums: tuple[str, ...], y: float) -> _Side:
    return _Side(name_of(records), sums, _others(records, shown), y)


def _sent_sums(shown: Pairs) -> tuple[str, ...]:
    return f"{len(shown.sent)} sent", *([f"{len(shown.lost)} lost"] if shown.lost else [])


def _draw(canvas: Canvas, plan: _Plan) -> None:
    for side in (plan.sender, plan.receiver):
        _draw_lane(canvas, plan, side)
    for line in plan.shown.arrived:
        _draw_arrow(canvas, plan, line)
    for line in plan.shown.sent:
        look = _LOST if line in plan.shown.lost else _LATE
        _draw_mark(canvas, plan, line, plan.sender, _SENT if line.partner is not None else look)
    for line in plan.shown.received:
        _draw_mark(
            canvas, plan, line, plan.receiver, _STRANGE if line.partner is None else _RECEIVED
        )
    _draw_values(canvas, plan)


def _draw_lane(canvas: Canvas, plan: _Plan, side: _Side) -> None:
    ends = [plan.scale.left - 8, plan.scale.right + 8]
    canvas.axes.plot(ends, [side.y] * 2, color=theme.RULE, lw=2, zorder=1, solid_capstyle="round")
    x, rows = plan.scale.left - 18, wrap(side.name, _NAMES)
    y = side.y + (len(rows) - 1) * line_height()
    for rank, row in enumerate(rows):
        canvas.text(x, y - rank * line_height(), row, align="right")
    for rank, words in enumerate(side.sums, 1):
        colour = theme.ALERT_TEXT if words.endswith("lost") else theme.MUTED
        canvas.text(
            x, side.y - rank * line_height(theme.SMALL) - 3, words, theme.SMALL, colour, "right"
        )
    for at in side.others:
        canvas.axes.plot([plan.x(at)], [side.y], marker="|", ms=9, color=theme.MUTED, zorder=3)


def _draw_arrow(canvas: Canvas, plan: _Plan, line: Line) -> None:
    ends = [(plan.x(line.time_ns), plan.sender.y), (_end(plan, line), plan.receiver.y + 6)]
    arrows.draw(canvas, Path(ends), arrows.Stroke(_MESSAGE.colour, _MESSAGE.dash, 1.3))


def _draw_mark(canvas: Canvas, plan: _Plan, line: Line, side: _Side, look: theme.Style) -> None:
    hollow = line.partner is None
    canvas.axes.plot(
        [plan.x(line.time_ns)],
        [side.y],
        marker=look.marker,
        ms=7,
        mfc=theme.CARD if hollow else look.colour,
        mec=look.colour if hollow else theme.CARD,
        mew=1.6 if hollow else 0.8,
        zorder=5 if hollow else 4,
    )


def _draw_values(canvas: Canvas, plan: _Plan) -> None:
    """Write the first few numbers beside both marks of their message, where there is room."""
    free, written = plan.scale.left - 60, 0
    for line in plan.shown.sent:
        half = text_width(line.words, theme.SMALL) / 2
        x, end = plan.x(line.time_ns), _end(plan, line)
        if min(x, end) - half > free and written < _VALUES:
            canvas.text(x, plan.sender.y + 20, line.words, theme.SMALL, theme.MUTED, "center")
            if line.partner is not None:
                words = plan.shown.received[line.partner].words
                canvas.text(end, plan.receiver.y - 20, words, theme.SMALL, theme.MUTED, "center")
            free, written = max(x, end) + half + 5, written + 1


def _end(plan: _Plan, line: Line) -> float:
    """Where a message's arrow ends, in CSS pixels; where it begins if it has none."""
    return plan.x((line if line.partner is None else plan.shown.received[line.partner]).time_ns)


def _key(shown: Pairs, *others: tuple[int, ...]) -> list[key.Entry]:
    """The marks in use, each with its meaning."""
    hollow = theme.CARD
    entries = (
        (key.Entry("line of the sender", _SENT), shown.arrived),
        (key.Entry("line of the receiver", _RECEIVED), shown.arrived),
        (key.Entry("message", _MESSAGE), shown.arrived),
        (key.Entry("lost message", _LOST, hollow), shown.lost),
        (key.Entry("sent after the receiver's last line", _LATE, hollow), shown.late),
        (key.Entry("not among what was sent", _STRANGE, hollow), shown.strange),
        (key.Entry("other log line", _OTHER), any(others)),
    )
    return [entry for entry, used in entries if used]
