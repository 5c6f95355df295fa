"""Summarize a patient's observation as a chart: plain data, small enough to be stored and judged.

A chart holds what the diagnostic questions need: which nodes exist, which are connected, what was
published, what was received, which nodes have ended. It says nothing about right or wrong.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise

from rosbeat.clinic.plans import FLOAT, STRING, Orders, Truth
from rosbeat.diagnosis.qos import incompatible
from rosbeat.records import (
    INFRASTRUCTURE_TOPICS,
    NANOSECONDS,
    Endpoint,
    Fault,
    Observation,
    Sample,
)


@dataclass(frozen=True)
class Member:
    """Describe a node of a patient.

    Attributes:
        node: Full name of the node.
        started: When the node logged that it had started, in seconds.
        callbacks: How often callbacks of its timers and subscriptions ran.
        ticks: How often its timers fired.
        due: How often its timers should have fired.
        spun: Whether an executor runs its callbacks.
    """

    node: str
    started: float
    callbacks: int
    ticks: int
    due: int
    spun: bool = True


@dataclass(frozen=True)
class Talk:
    """Summarize what one node published on one topic.

    Attributes:
        node: Full name of the node.
        topic: Full name of the topic.
        count: Number of messages.
        first: Time of the first message, in seconds; -1 if there was none.
        last: Time of the last message, in seconds; -1 if there was none.
        gap: Median time between two moments at which it publishes, in seconds; 0 if unknown.
        values: Distinct published numbers, sorted; empty if the messages are no numbers.
        texts: Distinct published strings, sorted; empty if the messages are no strings.
    """

    node: str
    topic: str
    count: int
    first: float = -1.0
    last: float = -1.0
    gap: float = 0.0
    values: tuple[float, ...] = ()
    texts: tuple[str, ...] = ()


@dataclass(frozen=True)
class Hearing:
    """Summarize what one node received on one topic.

    Attributes:
        node: Full name of the node.
        topic: Full name of the topic.
        count: How often its callback ran for this topic.
        sent: Number of messages that connected publishers sent while the node was subscribed.
        before: Number of messages that they had sent before.
        last: Time of the last callback, in seconds; -1 if it never ran.
    """

    node: str
    topic: str
    count: int
    sent: int
    before: int
    last: float = -1.0


@dataclass(frozen=True)
class Chart:
    """Hold everything that the instruments show of a patient.

    Attributes:
        number: Number of the patient.
        seconds: How long the system has run.
        orders: The owner's specification.
        members: The nodes, in order of creation.
        ends: The publishers and subscriptions, in order of creation.
        talks: Summary of the published messages, by publisher.
        hearings: Summary of the received messages, by subscription.
        faults: Exceptions that ended a node.
        truths: The correct diagnoses.
    """

    number: int
    seconds: float
    orders: Orders
    members: tuple[Member, ...] = ()
    ends: tuple[Endpoint, ...] = ()
    talks: tuple[Talk, ...] = ()
    hearings: tuple[Hearing, ...] = ()
    faults: tuple[Fault, ...] = ()
    truths: tuple[Truth, ...] = ()

    @property
    def nodes(self) -> tuple[str, ...]:
        """Return the full names of the nodes."""
        return tuple(one.node for one in self.members)

    @property
    def topics(self) -> tuple[str, ...]:
        """Return the full names of the topics, sorted."""
        return tuple(sorted({end.name for end in self.ends}))

    def hears(self, node: str) -> tuple[Hearing, ...]:
        """Return what a node has received, by topic."""
        return tuple(one for one in self.hearings if one.node == node)

    def at(self, place: str) -> tuple[Endpoint, ...]:
        """Return the endpoints of a node or on a topic."""
        return tuple(end for end in self.ends if place in (end.node, end.name))


def chart(
    observation: Observation,
    orders: Orders,
    unspun: Collection[str] = (),
    number: int = 0,
    truths: Sequence[Truth] = (),
) -> Chart:
    """Write down what the instruments show.

    Args:
        observation: What the session saw.
        orders: What the owner ordered.
        unspun: Nodes whose callbacks nobody runs.
        number: Number of the patient.
        truths: What is the matter.
    """
    ends = tuple(
        end
        for end in observation.graph.endpoints
        if end.kind in ("publisher", "subscription") and end.name not in INFRASTRUCTURE_TOPICS
    )
    return Chart(
        number,
        observation.time,
        orders,
        tuple(_members(observation, unspun)),
        ends,
        tuple(_talk(observation, end) for end in ends if end.kind == "publisher"),
        tuple(_hearing(observation, end, ends) for end in ends if end.kind == "subscription"),
        observation.faults,
        tuple(truths),
    )


def _members(seen: Observation, unspun: Collection[str]) -> Iterator[Member]:
    ended = {fault.node: fault.time_ns for fault in seen.faults}
    for node in dict.fromkeys((*seen.graph.nodes, *ended)):
        born = _born(seen, node)
        alive = ended.get(node, seen.time_ns) - born
        timers = [one for one in seen.graph.timers if one.node == node]
        ran = [one for one in seen.callbacks if one.node == node]
        yield Member(
            node,
            born / NANOSECONDS,
            sum(one.kind in ("timer", "subscription") for one in ran),
            sum(one.kind == "timer" for one in ran),
            sum(alive // one.period_ns for one in timers),
            node not in unspun,
        )


def _born(seen: Observation, node: str) -> int:
    """When a node started: every node of the clinic says so."""
    name = node.strip("/").replace("/", ".")
    return next((line.time_ns for line in seen.logs if line.name == name), 0)


def _talk(seen: Observation, end: Endpoint) -> Talk:
    said = [one for one in seen.samples if (one.node, one.topic) == (end.node, end.name)]
    if not said:
        return Talk(end.node, end.name, 0)
    values = sorted({float(one.value) for one in said}) if end.type_name == FLOAT else []
    texts = sorted({str(one.value) for one in said}) if end.type_name == STRING else []
    return Talk(
        end.node,
        end.name,
        len(said),
        said[0].time,
        said[-1].time,
        _gap(said),
        tuple(values),
        tuple(texts),
    )


def _gap(said: Sequence[Sample]) -> float:
    times = sorted({one.time_ns for one in said})
    gaps = sorted(b - a for a, b in pairwise(times))
    return gaps[len(gaps) // 2] / NANOSECONDS if gaps else 0.0


def _hearing(seen: Observation, end: Endpoint, ends: Sequence[Endpoint]) -> Hearing:
    connected = {
        one.node
        for one in ends
        if (one.kind, one.name, one.type_name) == ("publisher", end.name, end.type_name)
        and not incompatible(one.qos, end.qos)
    }
    born = _born(seen, end.node)
    sent = [one for one in seen.samples if one.topic == end.name and one.node in connected]
    ran = [one for one in seen.callbacks
           if (one.node, one.kind, one.source) == (end.node, "subscription", end.name)]  # fmt: skip
    before = sum(one.time_ns < born for one in sent)
    last = ran[-1].time if ran else -1.0
    return Hearing(end.node, end.name, len(ran), len(sent) - before, before, last)
