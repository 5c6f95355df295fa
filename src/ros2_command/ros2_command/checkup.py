"""The checks of `ros2 doctor`."""

from __future__ import annotations

import os
import socket
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from ros2_command.graph import PROFILE_VARIABLE, Graph
from ros2_command.names import is_hidden

#: Topics that every node has, whether anybody listens or not.
_COMMON = ("/parameter_events", "/rosout")


@dataclass(frozen=True)
class Finding:
    """Something to know.

    Attributes:
        text: A sentence.
        error: Whether it fails its check; otherwise it is a warning.
    """

    text: str
    error: bool = False

    def __str__(self) -> str:
        return f"{'ERROR' if self.error else 'WARNING'}: {self.text}"


def check_environment() -> list[Finding]:
    """Variables that are missing, or name files that do not exist."""
    found = []
    if not os.environ.get("AMENT_PREFIX_PATH"):
        found.append(Finding("AMENT_PREFIX_PATH is not set: `ros2 run` finds no workspace. "
                             "Run `source install/setup.bash` there."))  # fmt: skip
    profile = os.environ.get(PROFILE_VARIABLE)
    if profile and not os.path.isfile(profile):
        found.append(Finding(f"{PROFILE_VARIABLE} names {profile}, which does not exist.", True))
    for prefix in os.environ.get("AMENT_PREFIX_PATH", "").split(":"):
        if prefix and not os.path.isdir(prefix):
            found.append(Finding(f"AMENT_PREFIX_PATH names {prefix}, which does not exist."))
    return found


def check_network() -> list[Finding]:
    """Whether other machines could be reached, and multicast works at all."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
        try:
            probe.setsockopt(socket.IPPROTO_IP, socket.IP_MULTICAST_LOOP, 1)
            probe.connect(("239.255.0.1", 7400))
        except OSError as error:
            text = f"Multicast does not work here ({error}): other machines cannot be found."
            return [Finding(text)]
    return []


def check_graph(graph: Graph) -> list[Finding]:
    """Topics with one side only, and pairs that cannot hear each other."""
    found = []
    for topic, _ in graph.topics():
        publishers = graph.others(graph.publishers(topic))
        subscriptions = graph.others(graph.subscriptions(topic))
        if topic in _COMMON or is_hidden(topic):
            continue
        if publishers and not subscriptions:
            found.append(Finding(f"Publisher without subscriber detected on {topic}."))
        if subscriptions and not publishers:
            found.append(Finding(f"Subscriber without publisher detected on {topic}."))
    for topic, _, _, reason in _pairs(graph):
        if reason:
            text = f"QoS compatibility error found on topic '{topic}': {reason}"
            found.append(Finding(text, error=True))
    return found


def _pairs(graph: Graph) -> Iterator[tuple[str, Any, Any, str]]:
    """Every publisher with every subscriber of its topic, and why they do not fit, if so."""
    from rclpy.qos import QoSCompatibility, qos_check_compatible

    for topic, _ in graph.topics():
        subscriptions = graph.others(graph.subscriptions(topic))
        for publisher in graph.others(graph.publishers(topic)):
            for subscription in subscriptions:
                verdict, reason = qos_check_compatible(
                    publisher.qos_profile, subscription.qos_profile
                )
                bad = verdict == QoSCompatibility.ERROR
                yield topic, publisher, subscription, reason if bad else ""


def compatibility_rows(graph: Graph) -> list[tuple[str, str]]:
    """Rows of the report about pairs of publishers and subscribers."""
    rows = []
    for topic, publisher, subscription, reason in _pairs(graph):
        rows += [
            ("topic [type]", f"{topic} [{publisher.topic_type}]"),
            ("publisher node", publisher.node_name),
            ("subscriber node", subscription.node_name),
            ("compatibility status", reason or "OK"),
        ]
    return rows or [("compatibility status", "No publisher/subscriber pairs found")]
