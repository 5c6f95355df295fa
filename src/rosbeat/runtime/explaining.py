"""What a session can see around a topic, so that it can be explained."""

from __future__ import annotations

import time
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from rosbeat.diagnosis.explanation import Explanation, explain
from rosbeat.diagnosis.explanation_links import sides_of
from rosbeat.diagnosis.situation import (
    BLOCKED,
    ENDED,
    NOT_ADDED,
    PAUSED,
    RUNNING,
    Beat,
    Condition,
    Former,
    OtherDomain,
    Scene,
    rate_of,
)
from rosbeat.records import GraphSnapshot
from rosbeat.runtime import lookups, other_domains, settling, waiting
from rosbeat.runtime.durations import duration_ns
from rosbeat.runtime.entities import NodeState
from rosbeat.runtime.interrupts import show_briefly
from rosbeat.runtime.listening import listen
from rosbeat.runtime.world import World

#: A callback that runs for so many seconds of wall time does not return.
_PATIENCE = 1.0
#: A rate is that of so many messages, the newest.
_NEWEST = 100


def explained(world: World, topic: Any, seconds: Any) -> Explanation:  # noqa: ANN401 - unchecked
    """Say why nothing arrives on a topic of a session, or that all is well.

    Args:
        world: The session.
        topic: The topic's name, with or without its slash.
        seconds: How long to listen to other processes at most, in seconds of wall time.

    Raises:
        DurationError: If `seconds` is not a number from 0 up.
        SessionError: If `topic` cannot be the name of a topic.
    """
    name = lookups.full_topic("explain", topic)
    span = duration_ns(seconds, "explain(seconds=...)") / 1e9
    try:
        return explain(name, look(world, name, span))
    except KeyboardInterrupt as interrupt:
        show_briefly(interrupt, "you stopped the looking; the session goes on.")
        raise


def look(world: World, topic: str, seconds: float) -> Scene:
    """Look at all that happens around a topic.

    Args:
        world: The session.
        topic: The topic's full name.
        seconds: How long to listen to other processes at most, in seconds of wall time.
    """
    busy = list(_busy(world))
    if world.lookout is not None:
        settling.settle(world.lookout, world.domain_id or 0)
    graph = world.graph()
    heard = listen(world, topic, graph, seconds)
    past = _past(world, topic)
    return Scene(
        graph,
        world.now(),
        (*_publishers(world, topic, past), *_subscriptions(world, topic, past), *heard.beats),
        (*busy, *(_condition(world, state) for state in world.states()), *heard.conditions),
        heard.rate_hz,
        frozenset(state.name for state in world.states()),
        virtual=world.live is None,
        waiting=world.virtual.has_work,
        domain_id=-1 if world.lookout is None else world.domain_id or 0,
        former=tuple(_former(graph, topic, past))[::-1],
        other_domains=_elsewhere(world, topic, graph),
    )


# The nodes of the session.


def _busy(world: World) -> Iterator[Condition]:
    """Whoever holds up the one thread in which all callbacks run live."""
    live = world.live
    if live is None or live.at_work is None:
        return
    work, state = live.at_work, world.state_of(live.current)
    name = world.recorder.newest_callback()
    if waiting.poll(lambda: live.at_work is not work, time.monotonic() + _PATIENCE):
        return
    if state is not None and name is not None:
        yield Condition(state.name, BLOCKED, callback=name.name)


def _condition(world: World, state: NodeState) -> Condition:
    if state.ended:
        faults = [one for one in world.recorder.faults if one.node == state.name]
        return Condition(state.name, ENDED, faults[-1] if faults else None)
    if state.spinning:
        return Condition(state.name, RUNNING)
    return Condition(state.name, PAUSED if state.paused else NOT_ADDED)


@dataclass(frozen=True)
class _Past:
    """The messages of a topic so far: number among all, who published, when in nanoseconds."""

    messages: list[tuple[int, str, int]]

    def of(self, node: str) -> list[int]:
        """When one node published."""
        return [at for _, name, at in self.messages if name == node]

    def before(self, number: int) -> int:
        """How many came before all that have this number or a higher one."""
        return sum(one[0] < number for one in self.messages)


def _past(world: World, topic: str) -> _Past:
    with world.recorder.lock:
        return _Past(world.recorder.times(topic))


def _publishers(world: World, topic: str, past: _Past) -> Iterator[Beat]:
    for state in world.states():
        counts = [tap.count for tap in state.taps if tap.topic == topic]
        if counts:
            times = past.of(state.name)[-min(sum(counts), _NEWEST) :] if sum(counts) else []
            yield Beat(
                state.name,
                "publisher",
                sum(counts),
                times[-1] if times else -1,
                rate_of(times),
                world.now() - state.born_ns,
            )


def _subscriptions(world: World, topic: str, past: _Past) -> Iterator[Beat]:
    for state in world.states():
        entries = [one for one in state.entries if (one.kind, one.name) == ("subscription", topic)]
        if entries:
            missed = past.before(min(one.born for one in entries))
            last = max(world.recorder.last_run(one.label_number) for one in entries)
            yield Beat(
                state.name,
                "subscription",
                sum(one.calls for one in entries),
                last,
                watched_ns=world.now() - state.born_ns,
                missed=missed,
                since=len(past.messages) - missed,
            )


def _former(graph: GraphSnapshot, topic: str, past: _Past) -> Iterator[Former]:
    """Who published before, if nobody does now; the last one last."""
    if graph.on(topic, "publisher"):
        return
    for node in dict.fromkeys(name for _, name, _ in reversed(past.messages)):
        times = past.of(node)
        yield Former(node, len(times), times[-1])


def _elsewhere(world: World, topic: str, graph: GraphSnapshot) -> tuple[OtherDomain, ...]:
    """Other domains, if something is missing here and other processes matter at all."""
    if world.lookout is None and world.live is None:
        return ()
    if not sides_of(topic, graph).missing:
        return ()
    return other_domains.others(topic, world.domain_id or 0)
