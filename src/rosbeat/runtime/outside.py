"""The graph of the other processes in a domain, as records."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Iterator
from typing import Any

from rclpy.node import NodeNameNonExistentError
from rclpy.qos import QoSCompatibility, qos_check_compatible

from rosbeat.records import Endpoint, GraphSnapshot, QoS, is_hidden
from rosbeat.runtime.introspection import qos_of
from rosbeat.runtime.lookout import UNKNOWN, Lookout, owner

#: Every node logs on this topic, below rclpy: what a session knows of its own nodes leaves it out.
_BELOW_RCLPY = "/rosout"


def with_outside(own: GraphSnapshot, lookout: Lookout) -> GraphSnapshot:
    """A session's graph, completed by the nodes of other processes.

    They come after the session's own, sorted by name, without what is hidden. Timers are nobody's
    business but their own process's. A service's quality of service is not told either; the default
    stands in its place.
    """
    nodes = tuple(sorted(_others(lookout.nodes(), own.nodes)))
    ends = (*_topic_ends(lookout), *_service_ends(lookout, set(nodes) - set(own.nodes)))
    order = {name: rank for rank, name in enumerate(nodes)}
    shown = sorted((end for end in ends if end.node in order), key=lambda end: order[end.node])
    return GraphSnapshot((*own.nodes, *nodes), (*own.endpoints, *shown), own.timers)


def is_settled(lookout: Lookout) -> bool:
    """Whether every endpoint that is known has a node whose name is known."""
    return not any(
        one.node_name == UNKNOWN
        for topic in lookout.topics()
        for one in lookout.publishers(topic) + lookout.subscriptions(topic)
    )


def _others(names: Iterable[str], own: Iterable[str]) -> list[str]:
    """Names that are left when each of the session's own is taken out once."""
    left = Counter(name for name in names if not is_hidden(name)) - Counter(own)
    return list(left.elements())


def _topic_ends(lookout: Lookout) -> Iterator[Endpoint]:
    for topic in lookout.topics():
        if topic == _BELOW_RCLPY or is_hidden(topic):
            continue
        publishers, subscriptions = lookout.publishers(topic), lookout.subscriptions(topic)
        for one in filter(lookout.is_outside, publishers):
            matched = sum(_fits(one, other) for other in subscriptions)
            yield _endpoint(one, topic, "publisher", matched)
        for one in filter(lookout.is_outside, subscriptions):
            matched = sum(_fits(other, one) for other in publishers)
            yield _endpoint(one, topic, "subscription", matched)


def _fits(publisher: Any, subscription: Any) -> bool:  # noqa: ANN401 - rclpy's TopicEndpointInfo
    # The middleware tells a process of its own matches only; but its rule is known.
    fits, _ = qos_check_compatible(publisher.qos_profile, subscription.qos_profile)
    same = publisher.topic_type == subscription.topic_type
    return bool(same and fits != QoSCompatibility.ERROR)


def _endpoint(one: Any, topic: str, kind: str, matched: int) -> Endpoint:  # noqa: ANN401
    return Endpoint(owner(one), topic, one.topic_type, kind, qos_of(one.qos_profile), matched)


def _service_ends(lookout: Lookout, nodes: Iterable[str]) -> Iterator[Endpoint]:
    asks = (
        (lookout.get_service_names_and_types_by_node, "server"),
        (lookout.get_client_names_and_types_by_node, "client"),
    )
    for node in nodes:
        for ask, kind in asks:
            for name, types in _services(ask, node):
                yield Endpoint(node, name, types[0], kind, QoS())


def _services(ask: Callable[[str, str], Any], node: str) -> list[tuple[str, list[str]]]:
    namespace, _, name = node.rpartition("/")
    try:
        found = ask(name, namespace or "/")
    except NodeNameNonExistentError:
        return []  # it has just left
    return [(service, types) for service, types in found if not is_hidden(service)]
