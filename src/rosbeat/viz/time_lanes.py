"""The timeline: one lane per node, a mark per callback, an arrow per message.

A callback in which time passes has a bar. Bars of one node that overlap are stacked, downwards from
the middle of its lane.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass
from math import isfinite

from matplotlib.path import Path

from rosbeat.errors import PictureError
from rosbeat.records import NANOSECONDS, WaitRecord
from rosbeat.viz import arrows, axis, bars, frames, key, sources, theme
from rosbeat.viz.canvas import Canvas, blank, line_height, text_width, wrap
from rosbeat.viz.happenings import Happenings, Message, happenings, level_at, node_of
from rosbeat.viz.lane_words import describe, left_out
from rosbeat.viz.picture import Picture
from rosbeat.viz.runs import SLEEP, Run

_LANE = 62.0
#: Height of a bar, and from one to the next in a stack.
_BAR, _STEP = 15.0, 19.0
#: Room for the edges of a frame, above its first lane and below its last.
_ABOVE, _BELOW = 16.0, 6.0
#: From the rim of the picture to the sides of a frame.
_SIDE = 8.0
_NAMES = 170.0
_STUB = 32.0
_BENT = 14.0
_CALLBACKS = {
    "timer": ("timer callback", theme.Style(theme.BLUE, "s", "")),
    "subscription": ("subscription callback", theme.Style(theme.TAKEN, "o", "")),
    "event": ("event callback", theme.Style(theme.PURPLE, "v", "")),
    "expired": ("message too old", theme.Style(theme.ALERT, "x", "")),
}
_OTHER = ("other callback", theme.Style(theme.PURPLE, "D", ""))
_LOG = theme.Style(theme.MUTED, "|", "")
_WARNING = theme.Style(theme.ALERT, "^", "")
_FAULT = theme.Style(theme.ALERT, "X", "")
_MESSAGES = tuple(look for look in theme.STYLES if look.colour not in (theme.ALERT, theme.TAKEN))
_LOST = theme.Style(theme.ALERT, "", "--")


@dataclass(frozen=True)
class _Plan:
    """Where lanes and times are, in CSS pixels."""

    scale: axis.Scale
    levels: dict[str, float]
    bottom: float
    top: float
    frames: tuple[tuple[float, float], ...]

    def y(self, node: str, level: int) -> float:
        """The height at which a callback of a node stands, by its level in the stack."""
        return self.levels[node] - level * _STEP


@dataclass(frozen=True)
class _Stack:
    """Lanes from top to bottom, measured downwards from 0.

    Attributes:
        middles: Where the middle of each lane is.
        frames: Begin and end of the frame of each process.
        height: Of all lanes.
    """

    middles: dict[str, float]
    frames: tuple[tuple[float, float], ...]
    height: float


def timeline(
    source: sources.Observed,
    topics: str | Iterable[str] | None = None,
    until: float | None = None,
) -> Picture:
    """Draw when callbacks ran and which message made which callback run.

    A callback that sleeps or waits has a bar from its begin to its end; bars of one node that
    overlap stand one below the other. Nodes that share a process have a frame around their lanes.

    A message belongs to the subscription callbacks on its topic at its own instant, since in
    virtual time a message takes none. At most about 60 events are shown; the picture says what it
    left out.

    Args:
        source: A session, or what it observed.
        topics: Topics to show, one name or several, with the nodes that use them. By default all
            topics but the infrastructure, and all nodes.
        until: Last time to show, in seconds of virtual time.

    Returns:
        The picture.

    Raises:
        PictureError: If a topic is unknown, the time is not a number from 0 up, or nothing
            happened.
    """
    seen = sources.observed(source)
    names = [*seen.graph.topics(infrastructure=True), *(one.topic for one in seen.samples)]
    wanted = sources.topic_names(topics, tuple(dict.fromkeys(names)))
    shown = happenings(seen, wanted, _nanoseconds(until), everyone=topics is None)
    entries, note = _key(shown), left_out(shown)
    room = theme.WIDTH - 2 * theme.MARGIN
    head = key.height(entries, room) + 6
    foot = 26 + (line_height(theme.SMALL) + 6 if note else 0)
    stack = _stack(shown)
    with blank(2 * theme.MARGIN + head + stack.height + foot) as canvas:
        plan = _plan(shown, stack, canvas.height - theme.MARGIN - head)
        key.draw(canvas, entries, theme.MARGIN, canvas.height - theme.MARGIN, room)
        axis.draw(canvas, plan.scale, plan.bottom, plan.top)
        _draw(canvas, shown, plan)
        canvas.text(theme.MARGIN, theme.MARGIN, note, theme.SMALL, theme.MUTED)
    return Picture(canvas.figure, describe(shown), "Callbacks and messages over time")


def _nanoseconds(until: float | None) -> int | None:
    if until is None:
        return None
    if not isinstance(until, (int, float)) or not isfinite(until) or until < 0:
        raise PictureError(
            f"A timeline cannot end at {until!r}.",
            "`until` is a time in seconds of virtual time, from 0 up.",
            "For example `until=10`.",
        )
    return round(until * NANOSECONDS)


def _stack(shown: Happenings) -> _Stack:
    starts = {names[0]: names for names in shown.processes}
    middles: dict[str, float] = {}
    framed: list[tuple[float, float]] = []
    at = begin = 0.0
    last = ""
    for name in shown.lanes:
        if name in starts:
            at += _ABOVE
            begin, last = at, starts[name][-1]
        middles[name] = at + _LANE / 2
        at += _LANE + _STEP * _deepest(shown, name)
        if name == last:
            framed.append((begin, at))
            at += _BELOW
    return _Stack(middles, tuple(framed), at)


def _deepest(shown: Happenings, node: str) -> int:
    """The highest level in the stack of a node's callbacks."""
    pairs = zip(shown.callbacks, shown.levels, strict=True)
    levels = [level for one, level in pairs if one.node == node]
    return max([0, *levels, *(run.level for run in shown.runs if run.node == node)])


def _plan(shown: Happenings, stack: _Stack, top: float) -> _Plan:
    levels = {name: top - middle for name, middle in stack.middles.items()}
    rows = [row for name in shown.lanes for row in wrap(name, _NAMES)]
    left = theme.MARGIN + max(map(text_width, rows)) + 24
    scale = axis.Scale(0.0, shown.end, left, theme.WIDTH - theme.MARGIN - 34)
    framed = tuple((top - begin, top - end) for begin, end in stack.frames)
    return _Plan(scale, levels, top - stack.height, top, framed)


def _draw(canvas: Canvas, shown: Happenings, plan: _Plan) -> None:
    for top, bottom in plan.frames:
        frames.draw(canvas, _SIDE, bottom, theme.WIDTH - _SIDE, top)
    for name, y in plan.levels.items():
        _draw_lane(canvas, name, y, plan)
    for run in shown.runs:
        _draw_run(canvas, run, plan)
    for message in shown.messages:
        _draw_message(canvas, message, shown, plan)
    _draw_callbacks(canvas, shown, plan)
    for log in shown.logs:
        look = _LOG if log.level in ("DEBUG", "INFO") else _WARNING
        # Beside the arrows that leave and reach the lane, so that none covers it.
        y = plan.y(node_of(log), level_at(shown, node_of(log), log.time_ns))
        _mark(canvas, plan.scale(log.time) + 9, y - 13, look, 6)
    for fault in shown.faults:
        y = plan.y(fault.node, level_at(shown, fault.node, fault.time_ns, fault.callback))
        _mark(canvas, plan.scale(fault.time), y, _FAULT, 11)


def _draw_lane(canvas: Canvas, name: str, y: float, plan: _Plan) -> None:
    ends = [plan.scale.left - 8, plan.scale.right + 8]
    canvas.axes.plot(ends, [y, y], color=theme.RULE, lw=2, zorder=1, solid_capstyle="round")
    rows = wrap(name, _NAMES)
    for rank, row in enumerate(rows):
        offset = (len(rows) - 1) / 2 - rank
        canvas.text(plan.scale.left - 18, y + offset * line_height(), row, align="right")


def _draw_run(canvas: Canvas, run: Run, plan: _Plan) -> None:
    last = plan.scale.last
    parts = [
        bars.Part(
            plan.scale(one.time), plan.scale(min(one.until_ns / NANOSECONDS, last)), _bar(one)
        )
        for one in run.waits
        if one.time <= last
    ]
    bars.draw(canvas, parts, plan.y(run.node, run.level), _BAR, run.callback)


def _bar(wait: WaitRecord) -> theme.Bar:
    return theme.SLEEP if wait.reason == SLEEP else theme.WAIT


def _draw_message(canvas: Canvas, message: Message, shown: Happenings, plan: _Plan) -> None:
    x, time_ns = plan.scale(message.time), round(message.time * NANOSECONDS)
    y = plan.y(message.source, level_at(shown, message.source, time_ns))
    rank = {name: k for k, name in enumerate(plan.levels)}
    for target in message.targets:
        if target in plan.levels and target != message.source:
            look = _topic_style(shown.topics.index(message.topic))
            stroke = arrows.Stroke(look.colour, look.dash, 1.6)
            end = plan.y(target, level_at(shown, target, time_ns, topic=message.topic))
            is_next = abs(rank[target] - rank[message.source]) == 1
            arrows.draw(canvas, _way(x, y, end, is_next), stroke)
    if not message.targets:
        stub = Path([(x, y - 7), (x, y - _STUB)])
        arrows.draw(canvas, stub, arrows.Stroke(_LOST.colour, _LOST.dash, 1.6))


def _topic_style(topic: int) -> theme.Style:
    """The style of a topic's messages; never the one that says that a message got lost."""
    return _MESSAGES[topic % len(_MESSAGES)]


def _way(x: float, start: float, end: float, is_next: bool) -> Path:
    """Straight to the next lane; around the marks of the lanes between, if there are any."""
    end += 6 if start > end else -6
    if is_next:
        return Path([(x, start), (x, end)])
    points = [(x, start), (x + _BENT, (start + end) / 2), (x, end)]
    return arrows.curve(points, downward=True)


def _draw_callbacks(canvas: Canvas, shown: Happenings, plan: _Plan) -> None:
    alike = Counter(
        (one.node, one.time, level, one.kind)
        for one, level in zip(shown.callbacks, shown.levels, strict=True)
    )
    # The larger ones stay visible around what they caused, or came with, at the same instant; after
    # a wait they may come after it, too.
    order = sorted(alike, key=lambda one: -_size(one[-1])) if shown.runs else alike
    for node, time, level, kind in order:
        _, look = _CALLBACKS.get(kind, _OTHER)
        _mark(canvas, plan.scale(time), plan.y(node, level), look, _size(kind))
    for (node, time, level), number in _crowds(alike).items():
        if number > 1:
            x, y = plan.scale(time) + 8, plan.y(node, level) + 12
            canvas.text(x, y, f"×{number}", theme.SMALL, theme.MUTED)


def _size(kind: str) -> float:
    """The size of a callback's mark, in points."""
    return 10 if kind in ("timer", "expired") else 7


def _crowds(
    alike: Counter[tuple[str, float, int, str]],
) -> dict[tuple[str, float, int], int]:
    """For each node, instant and level how often the most frequent kind of callback ran."""
    most: dict[tuple[str, float, int], int] = {}
    for (node, time, level, _), number in alike.items():
        most[node, time, level] = max(number, most.get((node, time, level), 0))
    return most


def _mark(canvas: Canvas, x: float, y: float, look: theme.Style, size: float) -> None:
    canvas.axes.plot(
        [x], [y], marker=look.marker, ms=size, color=look.colour, mec=_rim(look), mew=1.2, zorder=4
    )


def _rim(look: theme.Style) -> str:
    """A rim in the card's colour keeps overlapping marks apart; a bare line has none."""
    return look.colour if look.marker in ("|", "x") else theme.CARD


def _key(shown: Happenings) -> list[key.Entry]:
    """The marks in use, each with its meaning."""
    kinds = dict.fromkeys(_CALLBACKS.get(one.kind, _OTHER) for one in shown.callbacks)
    entries = [key.Entry(words, look) for words, look in kinds]
    looks = {_bar(wait) for run in shown.runs for wait in run.waits}
    stretches = (("callback sleeps", theme.SLEEP), ("callback waits", theme.WAIT))
    none = theme.Style("", "", "")
    entries += [key.Entry(words, none, bar=look) for words, look in stretches if look in looks]
    taken = {one.topic for one in shown.messages if one.targets}
    for number, topic in enumerate(shown.topics):
        if topic in taken:
            look = _topic_style(number)
            entries.append(
                key.Entry(f"message on {topic}", theme.Style(look.colour, "", look.dash))
            )
    rare = (
        ("message nobody took", _LOST, any(not one.targets for one in shown.messages)),
        ("log line", _LOG, any(one.level in ("DEBUG", "INFO") for one in shown.logs)),
        (
            "warning or error",
            _WARNING,
            any(one.level not in ("DEBUG", "INFO") for one in shown.logs),
        ),
        ("node ended by an exception", _FAULT, bool(shown.faults)),
    )
    return entries + [key.Entry(words, look) for words, look, used in rare if used]
