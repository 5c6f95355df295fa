"""Say why nothing was published on a topic, or nothing received from one.

The node was run and raised nothing; what is said of an exception comes before. What it made is in
the graph of the observation, and that says why.
"""

from __future__ import annotations

import re
from collections.abc import Collection
from dataclasses import dataclass

from rosbeat.diagnosis.exceptions import diagnose_fault
from rosbeat.diagnosis.findings import difference, nearest, short_type
from rosbeat.diagnosis.mistakes import UNKNOWN, Diagnosis
from rosbeat.diagnosis.qos import incompatible, rule, words
from rosbeat.records import ACTION_PART, INFRASTRUCTURE_TOPICS, Endpoint, Fault, Observation


@dataclass(frozen=True)
class Wire:
    """Identify a topic by name and type.

    Attributes:
        topic: Full name.
        type_name: Message type, such as `std_msgs/msg/Float32`.
    """

    topic: str
    type_name: str


def diagnose_unpublished(
    observation: Observation, wire: Wire, besides: Collection[str] = (), hint: str = ""
) -> Diagnosis | None:
    """Say why the node that was looked at published nothing on a topic.

    Args:
        observation: What it did; without a `subject` it is the node that was made last.
        wire: Where it should have published, and what.
        besides: Full names of other topics on which it is to publish as well.
        hint: Where to look if it has a publisher there and never uses it, although it runs.

    Returns:
        The mistake; None if messages of the right type were published there, by whatever node.
    """
    if any(
        (one.topic, one.type_name) == (wire.topic, wire.type_name) for one in observation.samples
    ):
        return None
    made = _made(observation, "publisher")
    here = [end for end in made if end.name == wire.topic]
    if here:
        return _wrong_type(here[0], wire) or _unused(observation, wire, besides, hint)
    others = [end for end in made if end.name not in besides]
    if others:
        return _elsewhere(others, wire, "publishes on", _published(observation))
    how = "for" if made else "at all, so nothing was published on"
    return Diagnosis(
        "no-publisher",
        f"The node has no publisher {how} {wire.topic}.",
        "The constructor needs to create something that can publish. Which method of a node does "
        "that?",
    )


def diagnose_unheard(observation: Observation, wire: Wire) -> Diagnosis | None:
    """Say why the node that was looked at got nothing from a topic on which messages came.

    Args:
        observation: What it did; without a `subject` it is the node that was made last.
        wire: What it should have listened to.

    Returns:
        The mistake; None if a callback of the node ran for the topic.
    """
    node = _subject(observation)
    listened = [one for one in observation.callbacks if one.kind == "subscription"]
    if any((one.node, one.source) == (node, wire.topic) for one in listened):
        return None
    made = _made(observation, "subscription")
    # Not of `made`: a node may be asked to listen to a topic that every node brings along.
    there = observation.graph.on(wire.topic, "subscription")
    here = next((end for end in there if end.node == node), None)
    if here:
        found = _wrong_type(here, wire) or _unfit(observation, here) or _not_run(observation, here)
        return found or Diagnosis(
            UNKNOWN,
            f"Messages were published on {wire.topic}, but the node received none of them.",
            "Is the subscription connected? Compare the QoS that it requests with the QoS that "
            "the publisher offers.",
        )
    if made:
        return _elsewhere(made, wire, "subscribes to", {})
    return Diagnosis(
        "no-subscription",
        f"The node has no subscription, so it never receives what is published on {wire.topic}.",
        "The constructor needs to create something that connects the topic with the callback. "
        "Which method of a node does that?",
    )


# What the node made.


def _made(observation: Observation, kind: str) -> list[Endpoint]:
    return [
        end
        for end in observation.graph.endpoints
        if end.kind == kind
        and end.name not in INFRASTRUCTURE_TOPICS
        and ACTION_PART not in end.name
        and end.node == _subject(observation)
    ]


def _subject(observation: Observation) -> str:
    """Return the node that was looked at; without a name the one that was made last."""
    return observation.subject or (observation.graph.nodes or ("",))[-1]


def _published(observation: Observation) -> dict[str, int]:
    """Return how many messages the node published, by topic."""
    counts: dict[str, int] = {}
    for sample in observation.samples:
        if sample.node == _subject(observation):
            counts[sample.topic] = counts.get(sample.topic, 0) + 1
    return counts


def why_raised(observation: Observation, fault: Fault) -> Diagnosis | None:
    """Return the mistake behind an exception; for a topic with two types, name both.

    Args:
        observation: The observation, which includes the nodes beside the one that raised.
        fault: The exception.
    """
    found, call = diagnose_fault(fault), fault.asked
    if found is None or found.mistake != "type-mismatch" or not call or not call.given:
        return found
    if call.method not in ("create_publisher", "create_subscription"):
        return found  # a message that was published says nothing of another node
    own, sides = call.given[0].name, ("publisher", "subscription")
    others = {
        end.name: short_type(end.type_name)
        for end in observation.graph.endpoints
        if end.kind in sides and end.name not in INFRASTRUCTURE_TOPICS and end.node != fault.node
        if short_type(end.type_name) != own
    }
    # The exception names the topic only sometimes, and the learner's line nearly always.
    said = set(re.findall(r"\w+", f"{fault.code} {fault.text}"))
    names = [name for name in others if name.rpartition("/")[2] in said] or list(others)
    if len(names) != 1:
        return found
    return Diagnosis(
        found.mistake,
        f"{found.evidence} On {names[0]}, your node uses {own} and the other side "
        f"{others[names[0]]}.",
        "All messages on a topic have the same type, so both sides have to name the same one.",
    )


# Another topic, another type.


def _elsewhere(made: list[Endpoint], wire: Wire, does: str, counts: dict[str, int]) -> Diagnosis:
    names = {end.name for end in made}
    near = nearest(wire.topic, names)
    name = near or max(sorted(names), key=lambda one: counts.get(one, 0))
    if near:
        return Diagnosis(
            "topic-misspelled",
            f"The node {does} {near} instead of {wire.topic}; {difference(near, wire.topic)}.",
            _names(near, wire.topic),
        )
    return Diagnosis(
        "wrong-topic",
        f"The node {does} {name} instead of {wire.topic}.",
        "Nodes find each other by the topic's name, so both sides have to use the same one.",
    )


def _names(name: str, wanted: str) -> str:
    if name.lower() == wanted.lower():
        return "Topic names are case-sensitive: they have to match letter by letter."
    if name.endswith(f"/{wanted.strip('/')}"):
        return (
            "The name has a prefix: a namespace, the node's own name, or an extra part. Which "
            "name does the task give?"
        )
    return (
        "Topic names have to match letter by letter. ROS reports no error for a misspelled name: "
        "it's simply another topic."
    )


def _wrong_type(end: Endpoint, wire: Wire) -> Diagnosis | None:
    if end.type_name == wire.type_name:
        return None
    return Diagnosis(
        "type-mismatch",
        f"On {wire.topic}, the node has a {end.kind} for {end.type_name} instead of "
        f"{wire.type_name}.",
        "All messages on a topic have the same type, so both sides have to name the same one.",
    )


# A publisher without messages.


def _unused(observation: Observation, wire: Wire, besides: Collection[str], hint: str) -> Diagnosis:
    counts = _published(observation)
    used = [end for end in _made(observation, "publisher") if counts.get(end.name)]
    used = [end for end in used if end.name not in besides]
    return (
        _elsewhere(used, wire, "publishes on", counts) if used else _silent(observation, wire, hint)
    )


def _silent(observation: Observation, wire: Wire, known: str) -> Diagnosis:
    ran = [one for one in observation.callbacks if one.node == _subject(observation)]
    hint = "Which line calls publish, and what calls the function that contains it?"
    if known:
        hint = known
    elif ran:
        hint = f"{ran[0].name} was called. Does it reach the line that publishes, and when?"
    elif any(one.node == _subject(observation) for one in observation.graph.timers):
        hint = "The timer never fired. Does the constructor cancel it, or shut ROS down?"
    return (_never_called(observation, wire) if not ran else None) or Diagnosis(
        "never-published",
        f"The node has a publisher on {wire.topic}, but published nothing there in "
        f"{observation.time:g} s.",
        hint,
    )


def _never_called(observation: Observation, wire: Wire) -> Diagnosis | None:
    timers = [one for one in observation.graph.timers if one.node == _subject(observation)]
    if timers:
        timer = min(timers, key=lambda one: one.period_ns)
        if timer.period_ns <= observation.time_ns:
            return None
        return Diagnosis(
            "wrong-rate",
            f"The node's timer waits {timer.period_ns / 1e9:g} s before its first call. The "
            f"check ran the node for {observation.time:g} s, and no message came on {wire.topic}.",
            "A timer's period is the time between two calls, in seconds.",
        )
    if _made(observation, "subscription"):
        return None
    return Diagnosis(
        "no-timer",
        f"The node has a publisher on {wire.topic}, but nothing ever calls one of the node's "
        "methods.",
        "A node acts only when one of its callbacks is called. What calls a callback at regular "
        "intervals?",
    )


# A subscription without messages.


def _unfit(observation: Observation, end: Endpoint) -> Diagnosis | None:
    for publisher in observation.graph.on(end.name, "publisher"):
        for policy in incompatible(publisher.qos, end.qos):
            return Diagnosis(
                "qos-mismatch",
                f"The subscription to {end.name} requests {words(end.qos, policy)}, but "
                f"{publisher.node} offers {words(publisher.qos, policy)}, so ROS does not "
                "connect them.",
                f"The rule for {policy}: {rule(policy)}.",
            )
    return None


def _not_run(observation: Observation, end: Endpoint) -> Diagnosis | None:
    ran = any((one.node, one.source) == (end.node, end.name) for one in observation.callbacks)
    sent = sum(one.topic == end.name and one.node != end.node for one in observation.samples)
    if ran or not sent or end.matched == 0:
        return None
    return Diagnosis(
        "not-spun",
        f"{end.node} is connected to {end.name}, and {sent} messages were published there, but "
        "its callback ran for none of them.",
        "A callback runs only while an executor spins its node and no other callback blocks that "
        "executor.",
    )
