"""Why two sides of a topic are not connected: one is missing, or they do not fit."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from rosbeat.diagnosis.explanation_names import difference, nearest
from rosbeat.diagnosis.explanation_parts import (
    NEAR,
    TOPIC,
    Finding,
    Mark,
    finding,
    link,
    listing,
    nodes_of,
    qos_words,
    short_type,
    verb,
)
from rosbeat.diagnosis.mistakes import UNKNOWN
from rosbeat.diagnosis.qos import incompatible, rule, words
from rosbeat.diagnosis.situation import Scene
from rosbeat.records import Endpoint, GraphSnapshot, is_hidden

_OTHER = {"publisher": "subscription", "subscription": "publisher"}
_DOES = {
    "publisher": ("publishes on", "publish on"),
    "subscription": ("subscribes to", "subscribe to"),
}


@dataclass(frozen=True)
class Sides:
    """The two sides of a topic.

    Attributes:
        topic: Its full name.
        publishers: Who publishes.
        subscriptions: Who subscribes.
    """

    topic: str
    publishers: tuple[Endpoint, ...]
    subscriptions: tuple[Endpoint, ...]

    @property
    def pairs(self) -> Iterator[tuple[Endpoint, Endpoint]]:
        """Every publisher with every subscription."""
        return ((one, other) for other in self.subscriptions for one in self.publishers)

    @property
    def missing(self) -> str:
        """The side that nobody is on, `both`, or empty."""
        if not self.publishers:
            return "publisher" if self.subscriptions else "both"
        # A publisher that is matched is heard by somebody who is not shown, as `ros2 topic echo`.
        heard = self.subscriptions or any(end.matched > 0 for end in self.publishers)
        return "" if heard else "subscription"


def sides_of(topic: str, graph: GraphSnapshot) -> Sides:
    """Return the two sides of a topic."""
    return Sides(topic, graph.on(topic, "publisher"), graph.on(topic, "subscription"))


def links(sides: Sides, scene: Scene) -> Iterator[Finding]:
    """Find everything that keeps the sides of a topic apart."""
    yield from _types(sides)
    yield from _qualities(sides)
    yield from _unconnected(sides)
    if sides.missing:
        yield _misspelled(sides, scene.graph) or _nobody(sides, scene)


# They do not fit.


def _types(sides: Sides) -> Iterator[Finding]:
    for end in sides.subscriptions:
        others = sides.publishers
        if not others or any(one.type_name == end.type_name for one in others):
            continue
        sent, asked = _two_types(others[0].type_name, end.type_name)
        yield finding(
            "type-mismatch",
            f"two message types on {sides.topic}",
            f"{nodes_of(others)} {verb(others, 'publishes', 'publish')} {sent}, and {end.node} "
            f"subscribes to {asked}. ROS connects them only if the type is the same.",
            "Decide on one type, and name it in `create_publisher` and in `create_subscription`.",
            [link(end, f"sends {sent}", f"asks for {asked}")],
        )
    yield from _other_senders(sides)


def _other_senders(sides: Sides) -> Iterator[Finding]:
    """Find publishers of a type that nobody asks for, beside one that is heard."""
    heard = {one.type_name for one in sides.subscriptions}
    others = [one for one in sides.publishers if one.type_name not in heard]
    for end in others if len(others) < len(sides.publishers) and heard else []:
        sent, asked = _two_types(end.type_name, sides.subscriptions[0].type_name)
        yield finding(
            "type-mismatch",
            f"two message types on {sides.topic}",
            f"{end.node} publishes {sent}, and {nodes_of(sides.subscriptions)} "
            f"{verb(sides.subscriptions, *_DOES['subscription'])} {asked}. ROS connects them only "
            "if the type is the same.",
            "Decide on one type, and name it in `create_publisher` and in `create_subscription`.",
            [link(end, f"sends {sent}", f"asks for {asked}")],
        )


def _two_types(one: str, other: str) -> tuple[str, str]:
    if short_type(one) == short_type(other):
        return one, other
    return short_type(one), short_type(other)


def _qualities(sides: Sides) -> Iterator[Finding]:
    for end in sides.subscriptions:
        clashing = [one for one in _same_type(end, sides.publishers) if _clash(one, end)]
        for one in clashing:
            all_do = len(clashing) == len(sides.publishers)
            yield _quality(one, end, end if all_do else one)


def _same_type(end: Endpoint, others: Iterable[Endpoint]) -> list[Endpoint]:
    return [one for one in others if one.type_name == end.type_name]


def _clash(publisher: Endpoint, subscription: Endpoint) -> tuple[str, ...]:
    return incompatible(publisher.qos, subscription.qos)


def _quality(publisher: Endpoint, subscription: Endpoint, marked: Endpoint) -> Finding:
    policies = _clash(publisher, subscription)
    offers = listing(words(publisher.qos, one) for one in policies)
    asks = listing(words(subscription.qos, one) for one in policies)
    rules = "; ".join(f"{one}: {rule(one)}" for one in policies)
    return finding(
        "qos-mismatch",
        f"{listing(policies)} of {publisher.node} and {subscription.node} do not fit"
        if len(policies) > 1
        else f"the {policies[0]} of {publisher.node} and {subscription.node} does not fit",
        f"{publisher.node} offers {offers}, and {subscription.node} asks for {asks}. The rule of "
        f"{rules}.",
        "The publisher has to offer at least what the subscription asks for. Give both sides the "
        "same QoS.",
        [link(marked, f"offers {offers}", f"asks for {asks}")],
    )


def _unconnected(sides: Sides) -> Iterator[Finding]:
    for end in sides.subscriptions:
        fitting = [one for one in _same_type(end, sides.publishers) if not _clash(one, end)]
        if not fitting or end.matched != 0:
            continue
        yield finding(
            UNKNOWN,
            f"{nodes_of(fitting)} and {end.node} are not connected",
            f"{fitting[0].node} offers {qos_words(fitting[0].qos)}, {end.node} asks for "
            f"{qos_words(end.qos)}, and the type is the same. Nothing of that stands in the way, "
            "and the middleware has not connected them.",
            "If they have only just begun, ask again in a moment. If not, look at the deadline, "
            "the lifespan and the liveliness in the QoS of both sides.",
            [link(end, "not connected")],
        )


# One side is missing.


def _misspelled(sides: Sides, graph: GraphSnapshot) -> Finding | None:
    if sides.missing == "both":
        return None
    wanted = sides.missing
    here = sides.publishers or sides.subscriptions
    name = nearest(sides.topic, _one_sided(wanted, graph))
    if not name:
        return None
    there = graph.on(name, wanted)
    pair = (sides.topic, name) if wanted == "subscription" else (name, sides.topic)
    how = difference(sides.topic, name)
    return finding(
        "topic-misspelled",
        f"{pair[0]} and {pair[1]} are two topics",
        f"{nodes_of(here)} {verb(here, *_DOES[_OTHER[wanted]])} {sides.topic}, and "
        f"{nodes_of(there)} {verb(there, *_DOES[wanted])} {name}; {how}. To ROS these are two "
        "names.",
        "Compare the two names letter by letter, and write the same one on both sides.",
        [Mark(NEAR, *pair, ("almost the", "same name"))],
    )


def _one_sided(kind: str, graph: GraphSnapshot) -> Iterator[str]:
    """Topics with somebody on this side and nobody on the other."""
    for name in visible_topics(graph):
        if sides_of(name, graph).missing == _OTHER[kind]:
            yield name


def visible_topics(graph: GraphSnapshot) -> list[str]:
    """The topics that a learner has made, sorted."""
    return [name for name in graph.topics() if not is_hidden(name)]


def _nobody(sides: Sides, scene: Scene) -> Finding:
    if sides.missing == "both":
        return _unknown(sides.topic, scene)
    if sides.missing == "publisher":
        return _no_publisher(sides, scene)
    return finding(
        "no-subscription",
        f"nobody subscribes to {sides.topic}",
        f"{nodes_of(sides.publishers)} {verb(sides.publishers, 'publishes', 'publish')} there, and "
        "no node listens: what is published goes nowhere.",
        f"Start the node that listens{_how_to_start(scene)}, and compare the topic's name in its "
        "`create_subscription`.",
    )


def _no_publisher(sides: Sides, scene: Scene) -> Finding:
    listeners = sides.subscriptions
    start = f"tart the node that publishes{_how_to_start(scene)}, and compare the topic's name in"
    # Others listen to the near one, so it may well be another topic: a question, and no verdict.
    near = nearest(sides.topic, _with_publishers(scene.graph))
    asked = (
        f"Is {near} meant, where somebody publishes? {difference(sides.topic, near).capitalize()}. "
        f"If not, s"
        if near
        else "S"
    )
    return finding(
        "no-publisher",
        f"nobody publishes on {sides.topic}",
        f"{nodes_of(listeners)} {verb(listeners, 'listens', 'listen')} there, and no node "
        f"publishes{_before(scene)}. {_published(scene.graph)}",
        f"{asked}{start} its `create_publisher`.",
        [Mark(NEAR, near, sides.topic, ("almost the", "same name"))] if near else [],
    )


def _before(scene: Scene) -> str:
    """Who published there before."""
    if not scene.former:
        return ""
    last = scene.former[-1]
    who = "another process" if last.node == "?" else last.node
    return f" now; {who} did until {last.last_ns / 1e9:.6g} s, and is no longer there"


def _published(graph: GraphSnapshot) -> str:
    return f"Topics that are published: {listing(_with_publishers(graph)) or 'none'}."


def _with_publishers(graph: GraphSnapshot) -> list[str]:
    return [name for name in visible_topics(graph) if graph.on(name, "publisher")]


def _unknown(topic: str, scene: Scene) -> Finding:
    names = visible_topics(scene.graph)
    near = nearest(topic, names)
    marks = [Mark(NEAR, near, topic, ("almost the", "same name"))] if near else []
    hint = (
        f"Did you mean {near}? Ask about that one."
        if near
        else f"Start a node that uses it{_how_to_start(scene)}, or ask about one that is there."
    )
    return finding(
        "topic-unknown",
        f"nobody uses {topic}",
        f"No node publishes on it{_before(scene)}, and none subscribes. "
        f"Topics that are used: {listing(names) or 'none'}.",
        hint,
        [Mark(TOPIC, topic, words=("nobody uses", "this name")), *marks],
    )


def _how_to_start(scene: Scene) -> str:
    if scene.domain_id < 0:
        return ", with `ros.add(...)`"
    if scene.own:
        return ", with `ros.add(...)` or in a terminal"
    return " in a terminal, with `ros2 run`"
