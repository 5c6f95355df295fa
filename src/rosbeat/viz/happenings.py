"""What a timeline shows: marks on lanes and messages between them, cut to a readable number."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass

from rosbeat.errors import PictureError
from rosbeat.records import (
    NANOSECONDS,
    CallbackRecord,
    Fault,
    LogRecord,
    Observation,
    Sample,
    is_hidden,
)
from rosbeat.viz.runs import Run, levels_of, runs_of
from rosbeat.viz.wiring import shared

#: More messages and callbacks than this cannot be told apart in one picture.
MOST_EVENTS = 60


@dataclass(frozen=True)
class Message:
    """Equal messages of one instant: from one node, on one topic, to the same receivers.

    Attributes:
        time: When, in seconds of virtual time.
        topic: Full name of the topic.
        source: Full name of the node that published.
        targets: Full names of the nodes whose callback took it, in order; maybe none.
        number: How many messages these are.
    """

    time: float
    topic: str
    source: str
    targets: tuple[str, ...]
    number: int


@dataclass(frozen=True)
class Happenings:
    """Everything in one timeline.

    Attributes:
        lanes: Full names of the nodes, in order of creation; those that share a process together.
        topics: Full names of the topics, in order of first use.
        messages: The messages, in order.
        callbacks: The runs of callbacks, in order.
        logs: The log lines of the nodes in lanes.
        faults: The exceptions that ended nodes in lanes.
        end: The last time shown, in seconds.
        skipped: How many messages and callbacks came later and are not shown.
        processes: The nodes in lanes that share a process.
        runs: The runs of callbacks that take time.
        levels: For every callback its place in the stack of runs of its node that overlap.
    """

    lanes: tuple[str, ...]
    topics: tuple[str, ...]
    messages: tuple[Message, ...]
    callbacks: tuple[CallbackRecord, ...]
    logs: tuple[LogRecord, ...]
    faults: tuple[Fault, ...]
    end: float
    skipped: int
    processes: tuple[tuple[str, ...], ...] = ()
    runs: tuple[Run, ...] = ()
    levels: tuple[int, ...] = ()


def happenings(
    seen: Observation, topics: tuple[str, ...], until_ns: int | None, everyone: bool = False
) -> Happenings:
    """Select what is shown.

    Args:
        seen: What a session observed.
        topics: Full names of the topics to show.
        until_ns: Last time to show, in nanoseconds, or None for as long as is readable.
        everyone: Whether nodes that have nothing to do with these topics get a lane, too.

    Raises:
        PictureError: If nothing happened on these topics in that time.
    """
    samples = [one for one in seen.samples if one.topic in topics and not is_hidden(one.node)]
    lanes = _lanes(seen, topics, samples, everyone)
    processes = shared(seen.graph.processes, lanes)
    lanes = _together(lanes, processes)
    callbacks = [one for one in seen.callbacks if _belongs(one, lanes, topics)]
    runs = runs_of((one for one in seen.waits if one.node in lanes), seen.callbacks)
    times = sorted([*(one.time_ns for one in (*samples, *callbacks)), *_more(runs, callbacks)])
    last = _last(times, until_ns)
    end = _end(seen, times, last, until_ns)
    shown = [one for one in samples if one.time_ns <= last]
    ran = tuple(one for one in callbacks if one.time_ns <= last)
    return Happenings(
        lanes,
        tuple(dict.fromkeys(one.topic for one in shown)),
        _messages(shown, callbacks),
        ran,
        tuple(one for one in seen.logs if node_of(one) in lanes and one.time_ns <= end),
        tuple(one for one in seen.faults if one.node in lanes and one.time_ns <= end),
        end / NANOSECONDS,
        sum(time > last for time in times),
        processes,
        tuple(run for run in runs if run.time_ns <= last),
        levels_of(ran, runs),
    )


def node_of(log: LogRecord) -> str:
    """Full name of the node that a log line comes from."""
    return "/" + log.name.replace(".", "/")


def level_at(
    shown: Happenings, node: str, time_ns: int, callback: str = "", topic: str = ""
) -> int:
    """The level of what a node does at an instant; the first, if it does several things.

    Args:
        shown: What the timeline shows.
        node: Full name of the node.
        time_ns: The instant, in nanoseconds of virtual time.
        callback: Name of the callback function that does it, if it is known.
        topic: The topic whose message it takes, if it takes one.
    """
    pairs = zip(shown.callbacks, shown.levels, strict=True)
    found = [
        level
        for one, level in pairs
        if (one.node, one.time_ns) == (node, time_ns)
        and callback in ("", one.name)
        and (not topic or (one.kind, one.source) == ("subscription", topic))
    ]
    if not topic:
        ours = (run for run in shown.runs if run.node == node and callback in ("", run.callback))
        found += [run.level for run in ours if run.resumes(time_ns)]
    return min(found, default=0)


def _lanes(
    seen: Observation, topics: Sequence[str], samples: list[Sample], everyone: bool
) -> tuple[str, ...]:
    """The nodes that take part in these topics, and the others if wanted, in order of creation."""
    part = {one.node for one in seen.callbacks if everyone or one.source in topics}
    part |= {one.node for one in samples}
    part |= {end.node for end in seen.graph.endpoints if end.name in topics}
    part |= {one.node for one in seen.waits if everyone}
    order = dict.fromkeys((*seen.graph.nodes, *(one.node for one in seen.callbacks), *sorted(part)))
    return tuple(name for name in order if name in part and not is_hidden(name))


def _together(lanes: tuple[str, ...], processes: tuple[tuple[str, ...], ...]) -> tuple[str, ...]:
    """The lanes with those of one process side by side, where the first of them was."""
    home = {name: names for names in processes for name in names}
    order = (one for name in lanes for one in home.get(name, (name,)))
    return tuple(dict.fromkeys(order))


def _more(runs: Sequence[Run], callbacks: Sequence[CallbackRecord]) -> list[int]:
    """When runs began of which no callback tells, such as a wait in a constructor."""
    told = {(one.node, one.name, one.time_ns) for one in callbacks}
    return [run.time_ns for run in runs if (run.node, run.callback, run.time_ns) not in told]


def _belongs(one: CallbackRecord, lanes: Sequence[str], topics: Sequence[str]) -> bool:
    if one.kind == "subscription":
        return one.node in lanes and one.source in topics
    return one.node in lanes


def _last(times: list[int], until_ns: int | None) -> int:
    """The last instant that is shown whole."""
    inside = [time for time in times if until_ns is None or time <= until_ns]
    if not inside:
        raise PictureError(
            "There is nothing to put on a timeline.",
            "In this time no message was published and no callback ran.",
            "Run the session longer, or choose a later `until`.",
        )
    if len(inside) <= MOST_EVENTS:
        return inside[-1]
    instants = [time for time in inside[:MOST_EVENTS] if time < inside[MOST_EVENTS]]
    return instants[-1] if instants else inside[0]


def _end(seen: Observation, times: list[int], last: int, until_ns: int | None) -> int:
    """Where the axis ends: where the session did, unless the timeline was cut before."""
    asked = seen.time_ns if until_ns is None else min(until_ns, seen.time_ns)
    return max(asked, last) if not any(last < time <= asked for time in times) else last


def _messages(samples: list[Sample], callbacks: list[CallbackRecord]) -> tuple[Message, ...]:
    readers: dict[tuple[int, str], dict[str, None]] = {}
    for one in callbacks:
        if one.kind == "subscription":
            readers.setdefault((one.time_ns, one.source), {})[one.node] = None
    alike = Counter((one.time_ns, one.topic, one.node) for one in samples)
    return tuple(
        Message(at / NANOSECONDS, topic, node, tuple(readers.get((at, topic), ())), number)
        for (at, topic, node), number in alike.items()
    )
