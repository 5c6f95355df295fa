"""Find faults between two nodes: in names, types and quality of service."""

from __future__ import annotations

from collections.abc import Callable, Iterator

from rosbeat.clinic.charts import Chart, Hearing
from rosbeat.clinic.plans import Wiring
from rosbeat.diagnosis.qos import incompatible
from rosbeat.diagnosis.silence import listing
from rosbeat.records import Endpoint

_OTHER = {"publisher": "subscription", "subscription": "publisher"}


# Names of topics.


def _strays(chart: Chart) -> Iterator[tuple[Endpoint, Wiring]]:
    """Endpoints on another topic than was ordered, with the order."""
    for order in chart.orders.wiring:
        mine = [one for one in chart.ends if (one.node, one.kind) == (order.node, order.kind)]
        if mine and all(one.name != order.topic for one in mine):
            yield mine[0], order


def _last(name: str) -> str:
    return name.rpartition("/")[2]


def _is_namespace(end: Endpoint, order: Wiring) -> bool:
    return _last(end.name) == _last(order.topic)


def _is_used(chart: Chart, end: Endpoint) -> bool:
    """Whether a topic has somebody on the other side."""
    return any(one.name == end.name and one.kind == _OTHER[end.kind] for one in chart.ends)


def _misspelled(chart: Chart) -> Iterator[tuple[str, ...]]:
    for end, order in _strays(chart):
        if not _is_namespace(end, order) and not _is_used(chart, end):
            yield end.name, end.node


def _namespaced(chart: Chart) -> Iterator[tuple[str, ...]]:
    for end, order in _strays(chart):
        if _is_namespace(end, order):
            yield end.name, end.node


def _elsewhere(chart: Chart) -> Iterator[tuple[str, ...]]:
    for end, order in _strays(chart):
        if not _is_namespace(end, order) and _is_used(chart, end):
            yield end.name, end.node


def _against_name(chart: Chart, place: str, yet: Callable[[Chart, Endpoint], str]) -> str:
    """Where a name is as it was ordered, or is another kind of wrong: `yet` says why."""
    stray = next((end for end, _ in _strays(chart) if place in (end.node, end.name)), None)
    if stray is None:
        names = sorted({end.name for end in chart.at(place)})
        return f"the names used there are spelled as ordered: {listing(names)}"
    if _is_used(chart, stray):
        return f"{stray.name} has both a publisher and a subscription"
    return yet(chart, stray)


def _against_misspelled(chart: Chart, place: str) -> str:
    return _against_name(chart, place, _well_spelt)


def _against_namespace(chart: Chart, place: str) -> str:
    return _against_name(chart, place, _at_home)


def _against_elsewhere(chart: Chart, place: str) -> str:
    return _against_name(chart, place, _unused)


def _well_spelt(chart: Chart, end: Endpoint) -> str:
    return f"the last part of {end.name} is spelled as ordered"


def _at_home(chart: Chart, end: Endpoint) -> str:
    return f"{end.name} is in the namespace that the orders require"


def _unused(chart: Chart, end: Endpoint) -> str:
    others = [one.node for one in chart.at(end.name) if one.node != end.node]
    if others:
        return f"no node is on the other side of {end.name}"
    return f"only {end.node} uses {end.name}, so it is not another topic of this system"


# Types and quality of service.


def _types(chart: Chart) -> Iterator[tuple[str, ...]]:
    for topic in chart.topics:
        here = chart.at(topic)
        if len({end.type_name for end in here}) > 1:
            yield topic, *(end.node for end in here)


def _against_types(chart: Chart, place: str) -> str:
    types = sorted({f"{end.name} has {_last(end.type_name)}" for end in chart.at(place)})
    return f"all endpoints there use the same type: {listing(types)}"


def _unfit(chart: Chart) -> Iterator[tuple[str, ...]]:
    for topic in chart.topics:
        pairs = [pair for pair in _pairs(chart, topic) if incompatible(pair[0].qos, pair[1].qos)]
        if pairs:
            yield topic, *dict.fromkeys(end.node for pair in pairs for end in pair)


def _pairs(chart: Chart, topic: str) -> Iterator[tuple[Endpoint, Endpoint]]:
    ends = [end for end in chart.ends if end.name == topic]
    for one in ends:
        for other in ends:
            if (one.kind, other.kind) == ("publisher", "subscription"):
                yield one, other


def _against_unfit(chart: Chart, place: str) -> str:
    said = [_matched(chart, end) for end in chart.at(place) if end.name != place]
    said = said or [_matched(chart, end) for end in chart.at(place)]
    return listing(said)


def _matched(chart: Chart, end: Endpoint) -> str:
    sides = [one for one in chart.ends if one.name == end.name and one.kind == _OTHER[end.kind]]
    noun = f"{_OTHER[end.kind]}{'' if len(sides) == 1 else 's'}"
    if not sides:
        return f"{end.name} has no endpoint that {end.node} could be incompatible with"
    fitting = [one for one in sides if _fits(one, end)]
    return f"{end.node} is matched with {len(fitting)} of {len(sides)} {noun} on {end.name}"


def _fits(one: Endpoint, other: Endpoint) -> bool:
    publisher, subscription = (one, other) if one.kind == "publisher" else (other, one)
    return not incompatible(publisher.qos, subscription.qos)


# Queues, and who came too late.


def _short_queue(chart: Chart) -> Iterator[tuple[str, ...]]:
    for one in chart.hearings:
        lost = 0 < one.count < one.sent and one.node in _alive(chart)
        if lost and any(depth < chart.orders.burst for depth in _depths(chart, one)):
            yield one.node, one.topic


def _depths(chart: Chart, one: Hearing) -> list[int]:
    mine = (one.node, one.topic, "subscription")
    return [end.qos.depth for end in chart.ends if (end.node, end.name, end.kind) == mine]


def _alive(chart: Chart) -> list[str]:
    ended = {fault.node for fault in chart.faults}
    return [node for node in chart.nodes if node not in ended]


def _against_short_queue(chart: Chart, place: str) -> str:
    burst = chart.orders.burst
    at_once = "one message arrives" if burst == 1 else f"{burst} messages arrive"
    said = [
        f"the queue of {end.node} on {end.name} holds {end.qos.depth}, and {at_once} at once"
        for end in chart.at(place)
        if end.kind == "subscription"
    ]
    return listing(said) or "it has no subscription, so it has no queue for incoming messages"


def _late(chart: Chart) -> Iterator[tuple[str, ...]]:
    for one in chart.hearings:
        if one.before and not one.sent and not one.count:
            speakers = [talk.node for talk in chart.talks if talk.topic == one.topic]
            yield one.topic, one.node, *speakers


def _against_late(chart: Chart, place: str) -> str:
    said = [_since(one) for one in _hearings(chart, place)]
    return listing(said) or "it has no subscription that could have missed a message"


def _since(one: Hearing) -> str:
    if one.before:
        return (
            f"{one.sent} messages reached the queue of {one.node} after it subscribed to "
            f"{one.topic}"
        )
    return f"no message was published on {one.topic} before {one.node} subscribed"


def _hearings(chart: Chart, place: str) -> list[Hearing]:
    """Of a node its own; of a topic all of it."""
    return [one for one in chart.hearings if place in (one.node, one.topic)]


SIGNS = {
    "topic-misspelled": (_misspelled, _against_misspelled),
    "wrong-namespace": (_namespaced, _against_namespace),
    "wrong-topic": (_elsewhere, _against_elsewhere),
    "type-mismatch": (_types, _against_types),
    "qos-mismatch": (_unfit, _against_unfit),
    "depth-too-small": (_short_queue, _against_short_queue),
    "first-messages-lost": (_late, _against_late),
}
