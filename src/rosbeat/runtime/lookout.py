"""A hidden node, through which a session sees the other processes of its domain."""

from __future__ import annotations

from collections import Counter, defaultdict
from itertools import count
from os import getpid
from typing import Any

from rclpy.context import Context
from rclpy.node import Node
from rclpy.parameter import Parameter

from rosbeat.runtime.entities import full_name
from rosbeat.runtime.hooks import Unwatched

#: What stands for the name of a node that has not told it yet; names of nodes arrive about 0.1 s
#: after those of their topics.
UNKNOWN = "_NODE_NAME_UNKNOWN_"
#: How many bytes of an endpoint's address all endpoints of one participant have in common.
_PARTICIPANT = 12
#: Every node of rclpy publishes here, and once only.
_EVERY_NODE = "/parameter_events"
_numbers = count(1)  # only makes names differ


class Lookout(Unwatched, Node):
    """Asks the graph, and does nothing else: no callbacks, no services, no log topic.

    Its name begins with `_`, so `ros2 node list` leaves it out as it does its own nodes. While it
    lives the session takes part in its domain, so discovery begins with the session.

    Args:
        context: The session's context.
    """

    def __init__(self, context: Context) -> None:
        super().__init__(
            f"_rosbeat_{getpid()}_{next(_numbers)}",
            context=context,
            enable_rosout=False,
            start_parameter_services=False,
            parameter_overrides=[Parameter("start_type_description_service", value=False)],
        )
        own = self.get_publishers_info_by_topic(_EVERY_NODE)
        name = self.get_name()
        self._own = next((participant(one) for one in own if one.node_name == name), b"")

    def publishers(self, topic: str) -> list[Any]:
        """Every publisher on a topic, in this process and in others."""
        return list(self.get_publishers_info_by_topic(topic))

    def subscriptions(self, topic: str) -> list[Any]:
        """Every subscription to a topic, in this process and in others."""
        return list(self.get_subscriptions_info_by_topic(topic))

    def is_outside(self, endpoint: Any) -> bool:  # noqa: ANN401 - rclpy's TopicEndpointInfo
        """Whether an endpoint belongs to another process, or to another session of this one."""
        return participant(endpoint) != self._own

    def topics(self) -> list[str]:
        """The topics that anybody uses, sorted."""
        return sorted(name for name, _ in self.get_topic_names_and_types())

    def nodes(self) -> list[str]:
        """Full names of all nodes with names, the session's own included, sorted.

        A node that has left may stay listed for good, without endpoints: if the last news of it
        is looked at after its farewell, the middleware takes it for news of somebody new
        (`GraphCache::update_participant_entities` of rmw_dds_common, which adds whom it does not
        know). So each name counts only as often as there are nodes of that name with endpoints;
        every node of rclpy has one on `/parameter_events`.
        """
        known = self.get_node_names_and_namespaces()
        listed = Counter(full_name(name, space) for name, space in known if name != UNKNOWN)
        return sorted((listed & self._with_endpoints()).elements())

    def _with_endpoints(self) -> Counter[str]:
        """How many nodes of each name have endpoints on topics, as far as that can be told."""
        found: dict[str, set[bytes]] = defaultdict(set)
        for topic in self.topics():
            for one in self.publishers(topic) + self.subscriptions(topic):
                found[owner(one)].add(participant(one))
        of_a_process = Counter(owner(one) for one in self.publishers(_EVERY_NODE))
        return of_a_process | Counter({name: len(homes) for name, homes in found.items()})


def participant(endpoint: Any) -> bytes:  # noqa: ANN401 - rclpy's TopicEndpointInfo
    """The part of an endpoint's address that all endpoints of a context have in common."""
    return bytes(endpoint.endpoint_gid[:_PARTICIPANT])


def owner(endpoint: Any) -> str:  # noqa: ANN401 - rclpy's TopicEndpointInfo
    """Full name of the node that an endpoint belongs to."""
    return full_name(endpoint.node_name, endpoint.node_namespace)
