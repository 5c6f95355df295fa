"""Findings beside a system, and facts about it, from a record of it."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

from rosbeat.exercises.scenarios import Report
from rosbeat.records import INFRASTRUCTURE_TOPICS as INFRASTRUCTURE_TOPICS
from rosbeat.records import Observation


@dataclass(frozen=True)
class GreenhouseFindings:
    """What a learner says of the greenhouse, and what it is.

    Attributes:
        said: What the learner's function gave back.
        system: A run of the greenhouse, beside which the findings are laid.
        parameters: The value of each parameter of its nodes, by `/node name`.
    """

    said: Report
    system: Observation
    parameters: dict[str, Any]


def beside_the_greenhouse(said: Report) -> GreenhouseFindings:
    """Lay findings beside a greenhouse of our own, which runs here and not where they were made.

    Args:
        said: What the learner's function gave back.
    """
    system, parameters = _watched()
    return GreenhouseFindings(said, system, dict(parameters))


@lru_cache(maxsize=1)
def _watched() -> tuple[Observation, dict[str, Any]]:
    """Run the greenhouse once: it is the same each time."""
    # Here, so that judges can be imported where ROS is not installed.
    from rosbeat.ros import test_nodes

    return test_nodes.observe_greenhouse()


def full(name: str) -> str:
    """A name with its slash: `lamp` and `/lamp` are the same, and so is a logger's `a.lamp`."""
    return "/" + name.strip().lstrip("/").replace(".", "/")


def nodes(seen: GreenhouseFindings) -> set[str]:
    """Full names of all nodes."""
    return set(seen.system.graph.nodes)


def topics(seen: GreenhouseFindings) -> list[str]:
    """Full names of all topics, those that every node brings included."""
    return list(seen.system.graph.topics(infrastructure=True))


def ends(seen: GreenhouseFindings, topic: str, kind: str) -> set[str]:
    """The nodes that have a publisher, or a subscription, on a topic."""
    return {end.node for end in seen.system.graph.on(topic, kind)}


def one_sided(seen: GreenhouseFindings, side: str, missing: str) -> set[str]:
    """Topics that have one side and not the other."""
    own = seen.system.graph.topics()
    return {one for one in own if ends(seen, one, side) and not ends(seen, one, missing)}


def type_of(seen: GreenhouseFindings, topic: str) -> str:
    """A topic's type."""
    found = (end.type_name for end in seen.system.graph.endpoints if end.name == topic)
    return next(found, "")


def depths(seen: GreenhouseFindings, node: str, topic: str) -> set[int]:
    """The depths of a node's subscriptions to a topic."""
    there = seen.system.graph.on(topic, "subscription")
    return {end.qos.depth for end in there if end.node == node}


def rate(seen: GreenhouseFindings, topic: str) -> float:
    """Messages a second on a topic; 0.0 if there are fewer than two."""
    times = [one.time for one in seen.system.samples if one.topic == topic]
    if len(times) < 2 or times[-1] == times[0]:
        return 0.0
    return (len(times) - 1) / (times[-1] - times[0])


def listed(names: Iterable[str]) -> str:
    """Names as a part of a sentence."""
    return " and ".join(sorted(names)) or "nobody"
