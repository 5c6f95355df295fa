"""Draw a timeline: one lane per node, a mark per callback, an arrow per message.

A callback in which time passes has a bar. Bars of one node that overlap are stacked, downwards from
the middle of its lane. A message belongs to the subscription callbacks on its topic at its own
instant, since in virtual time a message takes none.
"""

from __future__ import annotations

import itertools
from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from math import isfinite

from matplotlib.path import Path

from rosbeat.errors import PictureError, called_as
from rosbeat.records import (
    NANOSECONDS,
    CallbackRecord,
    Fault,
    LogRecord,
    Observation,
    Sample,
    Timed,
    WaitRecord,
    is_hidden,
)
from rosbeat.viz import arguments, theme
from rosbeat.viz.canvas import Canvas, Entry, Stroke, blank, lane_scale, smooth
from rosbeat.viz.graphs import say_shared, shared
from rosbeat.viz.picture import Picture
from rosbeat.viz.text_format import count, listing, not_shown, number, seconds

#: More messages and callbacks than this cannot be told apart in one picture.
MOST_EVENTS = 60
#: More times than this in one sentence nobody follows.
_MOST_TIMES = 5
#: The reason of a wait that is a sleep.
_SLEEP = "sleep"

_LANE = 62.0
#: Height of a bar, and from one to the next in a stack.
_BAR, _STEP = 15.0, 19.0
#: Room for the edges of a frame, above its first lane and below its last; below the key; below all.
_ABOVE, _BELOW, _HEAD, _FOOT = 16.0, 6.0, 6.0, 26.0
#: From the rim of the picture to the sides of a frame.
_SIDE = 8.0

_CALLBACKS = {
    "timer": ("timer callback", theme.Style(theme.BLUE, "s", "")),
    "subscription": ("subscription callback", theme.Style(theme.TAKEN, "o", "")),
    "event": ("event callback", theme.Style(theme.PURPLE, "v", "")),
    "expired": ("message too old", theme.Style(theme.DROPPED, "x", "")),
}
_OTHER = ("other callback", theme.Style(theme.PURPLE, "D", ""))
_LOG = theme.Style(theme.MUTED, "|", "")
_WARNING = theme.Style(theme.ALERT, "^", "")
_FAULT = theme.Style(theme.ALERT, "X", "")
#: Styles of messages: lines or dots, since dashes say in every picture that nobody takes it.
_MESSAGES = (
    theme.Style(theme.BLUE, "", "-"),
    theme.Style(theme.PURPLE, "", ":"),
    theme.Style(theme.INK, "", (0, (1, 2.6))),
)
_LOST = theme.Style(theme.DROPPED, "", "--")


# What is shown.


@dataclass(frozen=True)
class Run(Timed):
    """Hold one run of a callback.

    Attributes:
        time_ns: When it began, in nanoseconds of virtual time.
        node: Full name of the node.
        callback: Name of the callback function.
        kind: As in `CallbackRecord`; empty if it has no mark, such as a constructor that waits.
        source: As in `CallbackRecord`.
        waits: Its waits, each beginning where the one before ended; none if it took no time.
        level: Its place in the stack of runs of this node that overlap, from 0.
    """

    time_ns: int
    node: str
    callback: str
    kind: str = ""
    source: str = ""
    waits: tuple[WaitRecord, ...] = ()
    level: int = 0

    @property
    def until_ns(self) -> int:
        """Return when it ended."""
        return self.waits[-1].until_ns if self.waits else self.time_ns

    def holds(self, time_ns: int) -> bool:
        """Return whether it was under way at a time, its begin and its end not counted."""
        return self.time_ns < time_ns < self.until_ns


@dataclass(frozen=True)
class Message:
    """Hold equal messages of one instant: from one node, on one topic, to the same receivers.

    Attributes:
        time_ns: When, in nanoseconds of virtual time.
        topic: Full name of the topic.
        source: Full name of the node that published.
        targets: Full names of the nodes whose callback took it, in order; maybe none.
        number: How many messages these are.
    """

    time_ns: int
    topic: str
    source: str
    targets: tuple[str, ...]
    number: int


@dataclass(frozen=True)
class Happenings:
    """Hold everything that one timeline shows.

    Attributes:
        lanes: Full names of the nodes, in order of creation; those that share a process together.
        topics: Full names of the topics, in order of first use.
        messages: The messages, in order.
        runs: The runs of callbacks, in order.
        logs: The log lines of the nodes in lanes.
        faults: The exceptions that ended nodes in lanes.
        end: The last time shown, in seconds.
        skipped: How many messages and callbacks came later and are not shown.
        processes: The nodes in lanes that share a process.
        start: The first time shown, in seconds.
    """

    lanes: tuple[str, ...]
    topics: tuple[str, ...]
    messages: tuple[Message, ...]
    runs: tuple[Run, ...]
    logs: tuple[LogRecord, ...]
    faults: tuple[Fault, ...]
    end: float
    skipped: int
    processes: tuple[tuple[str, ...], ...]
    start: float = 0.0

    @property
    def marked(self) -> list[Run]:
        """Return the runs that have a mark."""
        return [run for run in self.runs if run.kind]

    @property
    def long(self) -> list[Run]:
        """Return the runs that take time, and have a bar."""
        return [run for run in self.runs if run.waits]

    def level_at(self, node: str, time_ns: int) -> int:
        """Return the level of what a node begins or goes on with at an instant; the first of them.

        Args:
            node: Full name of the node.
            time_ns: The instant, in nanoseconds of virtual time.
        """
        levels = (
            run.level
            for run in self.runs
            if run.node == node and time_ns in (run.time_ns, *(wait.until_ns for wait in run.waits))
        )
        return min(levels, default=0)


def happenings(
    seen: Observation,
    topics: tuple[str, ...],
    until_ns: int | None,
    everyone: bool = False,
    since_ns: int = 0,
) -> Happenings:
    """Select what is shown.

    Args:
        seen: What a session observed.
        topics: Full names of the topics to show.
        until_ns: Last time to show, in nanoseconds, or None for as long as is readable.
        everyone: Whether nodes that have nothing to do with these topics get a lane, too.
        since_ns: First time to show, in nanoseconds.

    Raises:
        PictureError: If nothing happened on these topics in that time.
    """
    samples = [one for one in seen.samples if one.topic in topics and not is_hidden(one.node)]
    lanes = _lanes(seen, topics, samples, everyone)
    processes = shared(seen.graph.processes, lanes)
    home = {name: names for names in processes for name in names}
    lanes = tuple(dict.fromkeys(one for name in lanes for one in home.get(name, (name,))))
    # A callback that takes another topic's message has no mark; if it waits, it has a bar.
    callbacks = (
        replace(one, kind="") if one.kind == "subscription" and one.source not in topics else one
        for one in seen.callbacks
        if one.node in lanes
    )
    every = runs_of((one for one in seen.waits if one.node in lanes), callbacks)
    runs = [run for run in every if (run.kind or run.waits) and run.time_ns >= since_ns]
    samples = [one for one in samples if one.time_ns >= since_ns]
    times = sorted(one.time_ns for one in (*samples, *runs))
    last = _last(times, until_ns)
    end = _end(seen, times, last, until_ns)
    shown = [one for one in samples if one.time_ns <= last]
    return Happenings(
        lanes,
        tuple(dict.fromkeys(one.topic for one in shown)),
        _messages(shown, runs),
        tuple(stacked([run for run in runs if run.time_ns <= last])),
        tuple(
            one for one in seen.logs if _node_of(one) in lanes and since_ns <= one.time_ns <= end
        ),
        tuple(one for one in seen.faults if one.node in lanes and since_ns <= one.time_ns <= end),
        end / NANOSECONDS,
        sum(time > last for time in times),
        processes,
        since_ns / NANOSECONDS,
    )


def _node_of(log: LogRecord) -> str:
    return "/" + log.name.replace(".", "/")


def _lanes(
    seen: Observation, topics: Sequence[str], samples: list[Sample], everyone: bool
) -> tuple[str, ...]:
    """Return who takes part in these topics, and the others if wanted, in order of creation."""
    part = {one.node for one in seen.callbacks if everyone or one.source in topics}
    part |= {one.node for one in samples}
    part |= {end.node for end in seen.graph.endpoints if end.name in topics}
    part |= {one.node for one in seen.waits if everyone}
    order = dict.fromkeys((*seen.graph.nodes, *(one.node for one in seen.callbacks), *sorted(part)))
    return tuple(name for name in order if name in part and not is_hidden(name))


def _last(times: list[int], until_ns: int | None) -> int:
    """Return the last instant that is shown whole."""
    inside = [time for time in times if until_ns is None or time <= until_ns]
    if not inside:
        raise PictureError(
            "There is nothing to put on a timeline.",
            "In this time no message was published and no callback ran.",
            "Run the session longer, or choose an earlier `since` or a later `until`.",
        )
    if len(inside) <= MOST_EVENTS:
        return inside[-1]
    instants = [time for time in inside[:MOST_EVENTS] if time < inside[MOST_EVENTS]]
    return instants[-1] if instants else inside[0]


def _end(seen: Observation, times: list[int], last: int, until_ns: int | None) -> int:
    """Return where the axis ends: where the session did, unless the timeline was cut before."""
    asked = seen.time_ns if until_ns is None else min(until_ns, seen.time_ns)
    return max(asked, last) if not any(last < time <= asked for time in times) else last


def _messages(samples: list[Sample], runs: list[Run]) -> tuple[Message, ...]:
    readers: dict[tuple[int, str], dict[str, None]] = {}
    for one in runs:
        if one.kind == "subscription":
            readers.setdefault((one.time_ns, one.source), {})[one.node] = None
    alike = Counter((one.time_ns, one.topic, one.node) for one in samples)
    return tuple(
        Message(at, topic, node, tuple(readers.get((at, topic), ())), total)
        for (at, topic, node), total in alike.items()
    )


def runs_of(waits: Iterable[WaitRecord], callbacks: Iterable[CallbackRecord]) -> list[Run]:
    """Join callbacks and their waits to runs, in order of begin.

    A wait belongs to a run of the same callback that begins at the same time, or else to one whose
    last wait ends then, or else to a run that no callback tells of. Waits that took no time are
    left out.

    Args:
        waits: Waits of any nodes.
        callbacks: The runs of callbacks of these nodes.
    """
    found = [Run(one.time_ns, one.node, one.name, one.kind, one.source) for one in callbacks]
    open_ends: dict[tuple[str, str, int], list[int]] = {}
    for rank, run in enumerate(found):
        open_ends.setdefault((run.node, run.callback, run.time_ns), []).append(rank)
    for wait in sorted(waits, key=lambda one: one.time_ns):
        if wait.until_ns == wait.time_ns:
            continue
        ranks = open_ends.get((wait.node, wait.callback, wait.time_ns))
        if not ranks:
            ranks = [len(found)]
            found.append(Run(wait.time_ns, wait.node, wait.callback))
        rank = ranks.pop(0)
        found[rank] = replace(found[rank], waits=(*found[rank].waits, wait))
        open_ends.setdefault((wait.node, wait.callback, wait.until_ns), []).append(rank)
    return sorted(found, key=lambda one: one.time_ns)


def stacked(runs: Sequence[Run]) -> list[Run]:
    """Give each run its level; one that takes no time is on the first that is free.

    Args:
        runs: The runs, in order of begin.
    """
    long: list[Run] = []
    for run in (one for one in runs if one.waits):
        taken = {one.level for one in long if one.node == run.node and one.until_ns > run.time_ns}
        long.append(replace(run, level=_first_free(taken)))
    placed = iter(long)
    found = []
    for run in runs:
        taken = {one.level for one in long if one.node == run.node and one.holds(run.time_ns)}
        found.append(next(placed) if run.waits else replace(run, level=_first_free(taken)))
    return found


def _first_free(taken: set[int]) -> int:
    return next(level for level in range(len(taken) + 1) if level not in taken)


# The picture.


@called_as("viz.timeline(ros)")
def timeline(
    source: arguments.Observed,
    topics: str | Iterable[str] | None = None,
    until: float | None = None,
    since: float = 0.0,
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
        since: First time to show, in seconds of virtual time. What began before is left out.

    Raises:
        PictureError: If a topic is unknown, a time is not a number from 0 up, or nothing
            happened.
    """
    seen = arguments.observed(source)
    names = [*seen.graph.topics(infrastructure=True), *(one.topic for one in seen.samples)]
    wanted = arguments.topic_names(topics, tuple(dict.fromkeys(names)))
    begin_ns = _nanoseconds(since, "begin", "since")
    end_ns = None if until is None else _nanoseconds(until, "end", "until")
    shown = happenings(seen, wanted, end_ns, everyone=topics is None, since_ns=begin_ns)
    stack = _stack(shown)
    height = _HEAD + stack.height + _FOOT
    with blank(height, entries=_key(shown), note=_left_out(shown)) as canvas:
        _Drawing(canvas, shown, stack).draw()
    return Picture(canvas.figure, describe(shown), "Callbacks and messages over time")


def _nanoseconds(time: float, does: str, argument: str) -> int:
    if not isinstance(time, (int, float)) or not isfinite(time) or time < 0:
        raise PictureError(
            f"A timeline cannot {does} at {time!r}.",
            f"`{argument}` is a time in seconds of virtual time, from 0 up.",
            f"For example `{argument}=10`.",
        )
    return round(time * NANOSECONDS)


@dataclass(frozen=True)
class _Stack:
    """Hold lanes from top to bottom, measured downwards from 0 in CSS pixels.

    Attributes:
        middles: Where the middle of each lane is.
        frames: Begin and end of the frame of each process.
        height: Of all lanes.
    """

    middles: dict[str, float]
    frames: tuple[tuple[float, float], ...]
    height: float


def _stack(shown: Happenings) -> _Stack:
    deepest: Counter[str] = Counter()
    for run in shown.runs:
        deepest[run.node] = max(run.level, deepest[run.node])
    starts = {names[0] for names in shown.processes}
    ends = {names[-1] for names in shown.processes}
    middles: dict[str, float] = {}
    framed: list[tuple[float, float]] = []
    at = begin = 0.0
    for name in shown.lanes:
        if name in starts:
            at += _ABOVE
            begin = at
        middles[name] = at + _LANE / 2
        at += _LANE + _STEP * deepest[name]
        if name in ends:
            framed.append((begin, at))
            at += _BELOW
    return _Stack(middles, tuple(framed), at)


class _Drawing:
    """Draw lanes and what is on them."""

    def __init__(self, canvas: Canvas, shown: Happenings, stack: _Stack) -> None:
        self._canvas, self._shown, self._stack = canvas, shown, stack
        self._top = canvas.top - _HEAD
        self._scale = lane_scale(shown.lanes, shown.end, first=shown.start)
        self._rank = {name: k for k, name in enumerate(shown.lanes)}

    def draw(self) -> None:
        canvas, shown = self._canvas, self._shown
        canvas.time_axis(self._scale, self._top - self._stack.height, self._top)
        for begin, end in self._stack.frames:
            ends = (self._top - end, theme.WIDTH - _SIDE, self._top - begin)
            canvas.frame(_SIDE, *ends)
        for name in shown.lanes:
            canvas.lane(self._scale, self._y(name), name)
        for run in shown.long:
            self._draw_run(run)
        for message in shown.messages:
            self._draw_message(message)
        self._draw_calls()
        for log in shown.logs:
            look = _LOG if _is_plain(log) else _WARNING
            # Beside the arrows that leave and reach the lane, so that none covers it.
            y = self._y(_node_of(log), shown.level_at(_node_of(log), log.time_ns)) - 13
            self._mark(self._scale(log.time) + 9, y, look, 6)
        for fault in shown.faults:
            level = shown.level_at(fault.node, fault.time_ns)
            self._mark(self._scale(fault.time), self._y(fault.node, level), _FAULT, 11)

    def _y(self, node: str, level: int = 0) -> float:
        return self._top - self._stack.middles[node] - level * _STEP

    def _draw_run(self, run: Run) -> None:
        scale, last = self._scale, self._scale.last
        parts = [
            (scale(one.time), scale(min(one.until_ns / NANOSECONDS, last)), _bar(one))
            for one in run.waits
            if one.time <= last
        ]
        self._canvas.bar(parts, self._y(run.node, run.level), _BAR, run.callback)

    def _draw_message(self, message: Message) -> None:
        x = self._scale(message.time_ns / NANOSECONDS)
        y = self._y(message.source, self._shown.level_at(message.source, message.time_ns))
        if not message.targets:
            stroke = Stroke(_LOST.colour, _LOST.dash, 1.6)
            self._canvas.arrow(Path([(x, y - 7), (x, y - 32)]), stroke)
        look = _topic_style(self._shown, message.topic)
        for target in message.targets:
            if target in self._rank and target != message.source:
                level = self._shown.level_at(target, message.time_ns)
                end = self._y(target, level)
                end += 6 if y > end else -6
                path = Path([(x, y), (x, end)])
                if abs(self._rank[target] - self._rank[message.source]) > 1:
                    # Around the marks of the lanes between.
                    path = smooth([(x, y), (x + 14, (y + end) / 2), (x, end)], downward=True)
                self._canvas.arrow(path, Stroke(look.colour, look.dash, 1.6))

    def _draw_calls(self) -> None:
        alike = Counter((one.node, one.time, one.level, one.kind) for one in self._shown.marked)
        # The larger ones stay visible around what they caused, or came with, at the same instant;
        # after a wait they may come after it, too.
        order = sorted(alike, key=lambda one: -_size(one[-1])) if self._shown.long else alike
        for node, time, level, kind in order:
            look = _CALLBACKS.get(kind, _OTHER)[1]
            self._mark(self._scale(time), self._y(node, level), look, _size(kind))
        crowds: dict[tuple[str, float, int], int] = {}
        for (node, time, level, _), total in alike.items():
            crowds[node, time, level] = max(total, crowds.get((node, time, level), 0))
        for (node, time, level), total in crowds.items():
            if total > 1:
                x, y = self._scale(time) + 8, self._y(node, level) + 12
                self._canvas.text(x, y, f"×{total}", theme.MUTED)

    def _mark(self, x: float, y: float, look: theme.Style, size: float) -> None:
        # A rim in the card's colour keeps overlapping marks apart; a bare line has none.
        rim = look.colour if look.marker in ("|", "x") else theme.CARD
        self._canvas.mark(x, y, look, size, rim, 1.2)


def _bar(wait: WaitRecord) -> theme.Bar:
    return theme.SLEEP if wait.reason == _SLEEP else theme.WAIT


def _topic_style(shown: Happenings, topic: str) -> theme.Style:
    return _MESSAGES[shown.topics.index(topic) % len(_MESSAGES)]


def _size(kind: str) -> float:
    """Return the size of a callback's mark, in points."""
    return 10 if kind in ("timer", "expired") else 7


def _is_plain(log: LogRecord) -> bool:
    return log.level in ("DEBUG", "INFO")


def _key(shown: Happenings) -> list[Entry]:
    """Return the marks in use, each with its meaning."""
    kinds = dict.fromkeys(_CALLBACKS.get(run.kind, _OTHER) for run in shown.marked)
    entries = [Entry(words, look) for words, look in kinds]
    bars = {_bar(wait) for run in shown.runs for wait in run.waits}
    for words, bar in (("callback sleeps", theme.SLEEP), ("callback waits", theme.WAIT)):
        entries += [Entry(words, bar=bar)] if bar in bars else []
    taken = {one.topic for one in shown.messages if one.targets}
    for topic in shown.topics:
        if topic in taken:
            entries.append(Entry(f"message on {topic}", _topic_style(shown, topic)))
    rare = (
        ("message nobody took", _LOST, any(not one.targets for one in shown.messages)),
        ("log line", _LOG, any(map(_is_plain, shown.logs))),
        ("warning or error", _WARNING, not all(map(_is_plain, shown.logs))),
        ("node ended by an exception", _FAULT, bool(shown.faults)),
    )
    return entries + [Entry(words, look) for words, look, used in rare if used]


# The same in words.


def describe(shown: Happenings) -> str:
    """Tell who did what how often, which messages arrived, and what is not shown."""
    span = f"from {number(shown.start)} s to {number(shown.end)} s"
    said = [f"A timeline {span} with {count(len(shown.lanes), 'node')}."]
    said += [_say_lane(shown, name) for name in shown.lanes]
    said += say_shared(shown.processes)
    said += _say_runs(shown)
    said += [line for topic in shown.topics for line in _say_topic(shown, topic)]
    said += [
        f"At {number(one.time)} s, {one.kind} in {one.callback} ended {one.node}."
        for one in shown.faults
    ]
    return " ".join([*said, _left_out(shown)]).strip()


def _left_out(shown: Happenings) -> str:
    events = ("later message or callback", "later messages and callbacks")
    return not_shown(shown.skipped, *events)


def _say_lane(shown: Happenings, node: str) -> str:
    kinds = Counter(run.kind for run in shown.marked if run.node == node)
    done = [
        # A message that was too old is a callback that did not run.
        count(total, "message too old", "messages too old")
        if kind == "expired"
        else count(total, f"{kind} callback")
        for kind, total in kinds.items()
    ]
    logs = sum(_node_of(one) == node for one in shown.logs)
    done += [count(logs, "log line")] if logs else []
    if not done and any(run.node == node for run in shown.long):
        return f"{node} does nothing but wait."
    return f"{node}: {listing(done) or 'nothing happens'}."


def _say_topic(shown: Happenings, topic: str) -> list[str]:
    ways: Counter[tuple[str, tuple[str, ...]]] = Counter()
    for one in shown.messages:
        if one.topic == topic:
            ways[one.source, one.targets] += one.number
    return [
        f"{count(total, 'message')} on {topic} from {source} {_say_arrival(targets, total)}."
        for (source, targets), total in ways.items()
    ]


def _say_arrival(targets: tuple[str, ...], total: int) -> str:
    if not targets:
        return f"{'reaches' if total == 1 else 'reach'} nobody"
    verb = "makes" if total == 1 else "make"
    noun = "a callback" if len(targets) == 1 else "callbacks"
    return f"{verb} {noun} of {listing(targets)} run at the same instant"


def _say_runs(shown: Happenings) -> list[str]:
    """Tell which callbacks take time, how long, and what ran meanwhile."""
    kinds: dict[tuple[str, str], list[Run]] = {}
    for run in shown.long:
        kinds.setdefault((run.node, run.callback), []).append(run)
    end_ns = round(shown.end * NANOSECONDS)
    said = [line for same in kinds.values() for line in _say_durations(same, end_ns)]
    framed = {name for names in shown.processes for name in names}
    alone = ((name,) for name in dict.fromkeys(run.node for run in shown.long))
    for names in (*shown.processes, *(one for one in alone if one[0] not in framed)):
        said += _say_meanwhile(shown, names)
    return said


def _say_durations(runs: Sequence[Run], end_ns: int) -> list[str]:
    name = _name(runs[0])
    done = [run for run in runs if run.until_ns < end_ns]
    said = []
    if done:
        lengths = sorted(run.until_ns - run.time_ns for run in done)
        long = " to ".join(map(seconds, dict.fromkeys((lengths[0], lengths[-1]))))
        each = " each time" if len(done) > 1 and lengths[0] == lengths[-1] else ""
        times = _some([(run.time_ns, run.until_ns) for run in done])
        said.append(f"{name} takes {long}{each}, as it {_why(done)}: {times}.")
    said += [
        f"{name} begins at {seconds(run.time_ns)} and is not done when the timeline ends, as it "
        f"{_why([run])}."
        for run in runs
        if run.until_ns >= end_ns
    ]
    return said


def _name(run: Run) -> str:
    return f"{run.callback} of {run.node}"


def _why(runs: Sequence[Run]) -> str:
    reasons = dict.fromkeys(wait.reason for run in runs for wait in run.waits)
    others = [reason for reason in reasons if reason != _SLEEP]
    does = ["sleeps"] if _SLEEP in reasons else []
    return listing([*does, *([f"waits for {listing(others)}"] if others else [])])


def _some(spans: Sequence[tuple[int, int]]) -> str:
    times = [f"from {seconds(begin)} to {seconds(end)}" for begin, end in spans]
    if len(times) > _MOST_TIMES:
        times[_MOST_TIMES - 1 :] = [f"{len(times) - _MOST_TIMES + 1} times more"]
    return listing(times)


def _say_meanwhile(shown: Happenings, names: tuple[str, ...]) -> list[str]:
    """Tell what ran in one process while callbacks in it took their time."""
    ours = [run for run in shown.long if run.node in names]
    if not ours:
        return []
    said = _say_overlaps(ours)
    others = [run for run in shown.marked if not run.waits and run.node in names]
    inside = sum(any(run.holds(one.time_ns) for run in ours) for one in others)
    where = f"in the process of {listing(names)}"
    if inside:
        verb = "runs" if inside == 1 else "run"
        said.append(f"Meanwhile, {count(inside, 'other callback')} {verb} {where}.")
    return said or [f"Meanwhile, no other callback runs {where}."]


def _say_overlaps(runs: Sequence[Run]) -> list[str]:
    found: dict[tuple[str, str], list[tuple[int, int]]] = {}
    for one, other in itertools.combinations(runs, 2):
        begin, end = max(one.time_ns, other.time_ns), min(one.until_ns, other.until_ns)
        if begin < end:
            pair = (_name(one), _name(other))
            found.setdefault(pair[::-1] if pair[::-1] in found else pair, []).append((begin, end))
    return [
        f"Runs of {one} overlap {_some(spans)}."
        if one == other
        else f"{one} and {other} overlap {_some(spans)}."
        for (one, other), spans in found.items()
    ]
