"""Summarize what the instruments show of a patient, to judge diagnoses: plain data.

A chart says nothing about right or wrong, apart from the correct diagnoses that it holds.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass
from itertools import pairwise

from rosbeat.clinic.faults import BrokenSystem, Truth
from rosbeat.clinic.systems import Specification
from rosbeat.diagnosis.qos import incompatible
from rosbeat.records import INFRASTRUCTURE_TOPICS, NANOSECONDS, Endpoint, Observation


@dataclass(frozen=True)
class Published:
    """Summarize what one node published on one topic.

    Attributes:
        node: Full name of the node.
        topic: Full name of the topic.
        count: Number of messages.
        last: Time of the last message, in seconds; -1 if there was none.
        period: Median time between two moments at which it publishes, in seconds; 0 if unknown.
        values: Distinct published values, sorted.
    """

    node: str
    topic: str
    count: int
    last: float = -1.0
    period: float = 0.0
    values: tuple[float | str, ...] = ()


@dataclass(frozen=True)
class Received:
    """Summarize what one node could receive on one topic.

    Attributes:
        node: Full name of the node.
        topic: Full name of the topic.
        sent: Number of messages that connected publishers sent while the node was subscribed.
        before: Number of messages that they had sent before.
        last: Time of the last callback, in seconds; -1 if it never ran.
    """

    node: str
    topic: str
    sent: int
    before: int
    last: float = -1.0


@dataclass(frozen=True)
class Chart:
    """Hold what the instruments show of a patient.

    Attributes:
        seconds: How long the system has run.
        spec: The owner's specification.
        callbacks: How often callbacks of timers and subscriptions ran, by full name of the node.
        endpoints: The publishers and subscriptions, in order of creation.
        published: Summary of the published messages, by publisher.
        received: Summary of the received messages, by subscription.
        ended: Full names of the nodes that an exception has ended.
        truths: The correct diagnoses.
    """

    seconds: float
    spec: Specification
    callbacks: dict[str, int]
    endpoints: tuple[Endpoint, ...]
    published: tuple[Published, ...]
    received: tuple[Received, ...]
    ended: tuple[str, ...] = ()
    truths: tuple[Truth, ...] = ()

    @property
    def nodes(self) -> tuple[str, ...]:
        """Return the full names of the nodes."""
        return tuple(self.callbacks)

    @property
    def topics(self) -> tuple[str, ...]:
        """Return the full names of the topics, sorted."""
        return tuple(sorted({end.name for end in self.endpoints}))

    def at(self, place: str) -> list[Endpoint]:
        """Return the endpoints of a node or on a topic."""
        return [end for end in self.endpoints if place in (end.node, end.name)]

    def published_at(self, place: str) -> list[Published]:
        """Return what a node has published, or what was published on a topic."""
        return [one for one in self.published if place in (one.node, one.topic)]

    def received_at(self, place: str) -> list[Received]:
        """Return what a node has received, or what was received on a topic."""
        return [one for one in self.received if place in (one.node, one.topic)]


def chart_of(seen: Observation, broken: BrokenSystem) -> Chart:
    """Summarize what a session observed of a system."""
    endpoints = tuple(
        end
        for end in seen.graph.endpoints
        if end.kind in ("publisher", "subscription") and end.name not in INFRASTRUCTURE_TOPICS
    )
    ended = tuple(fault.node for fault in seen.faults)
    ran = Counter(one.node for one in seen.callbacks if one.kind in ("timer", "subscription"))
    starts = {node.path: node.starts_at for node in broken.system.nodes}
    return Chart(
        seen.time,
        broken.system.spec,
        {node: ran[node] for node in (*seen.graph.nodes, *ended)},
        endpoints,
        tuple(_published(seen, end) for end in endpoints if end.kind == "publisher"),
        tuple(
            _received(seen, end, endpoints, starts[end.node])
            for end in endpoints
            if end.kind == "subscription"
        ),
        ended,
        broken.truths,
    )


def _published(seen: Observation, end: Endpoint) -> Published:
    sent = [one for one in seen.samples if (one.node, one.topic) == (end.node, end.name)]
    times = sorted({one.time for one in sent})
    gaps = sorted(later - earlier for earlier, later in pairwise(times))
    return Published(
        end.node,
        end.name,
        len(sent),
        times[-1] if times else -1.0,
        gaps[len(gaps) // 2] if gaps else 0.0,
        tuple(sorted({one.value for one in sent})),
    )


def _received(
    seen: Observation, end: Endpoint, endpoints: Iterable[Endpoint], started: float
) -> Received:
    connected = {
        one.node
        for one in endpoints
        if (one.kind, one.name, one.type_name) == ("publisher", end.name, end.type_name)
        and not incompatible(one.qos, end.qos)
    }
    sent = [one for one in seen.samples if one.topic == end.name and one.node in connected]
    before = sum(one.time_ns < started * NANOSECONDS for one in sent)
    mine = (end.node, "subscription", end.name)
    times = [one.time for one in seen.callbacks if (one.node, one.kind, one.source) == mine]
    return Received(end.node, end.name, len(sent) - before, before, max(times, default=-1.0))
