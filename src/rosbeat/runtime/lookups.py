"""From what a caller names to what a session has of it."""

from __future__ import annotations

from typing import Any

from rclpy.exceptions import InvalidTopicNameException
from rclpy.node import Node
from rclpy.validate_full_topic_name import validate_full_topic_name

from rosbeat.errors import SessionError
from rosbeat.records import LogRecord, Observation, Sample
from rosbeat.runtime import refusals
from rosbeat.runtime.entities import NodeState
from rosbeat.runtime.world import World


def state_of(world: World, node: Node) -> NodeState:
    """What is known of a node.

    Raises:
        NodeClassError: If it does not belong to the session.
    """
    state = world.state_of(node)
    if state is None:
        raise refusals.foreign_node(node, world.name_of(node))
    return state


def find(world: World, node: Node | str) -> NodeState:
    """A node, given itself or by name.

    Raises:
        SessionError: If the session has no such node.
    """
    if isinstance(node, Node):
        return state_of(world, node)
    name = "/" + str(node).lstrip("/")
    state = world.named(name)
    if state is None:
        raise refusals.no_such_node(name, [other.name for other in world.states()])
    return state


def samples(world: World, topic: Any) -> tuple[Sample, ...]:  # noqa: ANN401 - unchecked input
    """The messages of a topic.

    Raises:
        UnknownTopicError: If it never had a publisher.
        SessionError: If `topic` is not a name.
    """
    name = "/" + refusals.check_name("messages", topic).lstrip("/")
    known = world.known_topics()
    if name not in known:
        raise refusals.unknown_topic(name, known, world.graph())
    return tuple(world.recorder.samples(name))


def log_lines(world: World, node: Node | str | None) -> tuple[LogRecord, ...]:
    """The log lines of one node, or of all.

    Raises:
        SessionError: If `node` is neither a name nor a node that is or was in the session.
    """
    records = tuple(world.recorder.logs)
    if node is None:
        return records
    wanted = _name_of(world, node).strip("/").replace("/", ".")
    return tuple(record for record in records if record.name == wanted)


def observation(world: World, seed: int) -> Observation:
    """Everything that was recorded so far, as plain data."""
    recorder = world.recorder
    return Observation(
        world.now(),
        seed,
        tuple(recorder.samples()),
        tuple(recorder.logs),
        tuple(recorder.callbacks()),
        tuple(recorder.faults),
        world.graph(),
    )


def _name_of(world: World, node: Node | str) -> str:
    if not isinstance(node, Node):
        return refusals.check_name("logs", node)
    name = world.name_of(node)
    if name is None:
        raise refusals.foreign_node(node)
    return name


def full_topic(call: str, topic: Any) -> str:  # noqa: ANN401 - unchecked input
    """The full name of a topic, such as `/temperature`; nobody need use it.

    Args:
        call: Who asks, for the error.
        topic: What was typed.

    Raises:
        SessionError: If it is no text, or ROS does not allow it as a name.
    """
    name = "/" + refusals.check_name(call, topic).lstrip("/")
    try:
        validate_full_topic_name(name)
    except InvalidTopicNameException as error:
        raise SessionError(
            f"{topic!r} cannot be the name of a topic.",
            f"ROS does not allow it: {_reason(error)}.",
            "Names have letters, digits, `_` and `/`, and no part of them begins with a digit: "
            "`room_1/temperature`.",
        ) from None
    return name


def _reason(error: InvalidTopicNameException) -> str:
    """What is wrong, from an exception that also repeats the name and draws an arrow below it."""
    parts = str(error).split("\n")[0].split(":")
    return parts[1].strip() if len(parts) > 1 else "it breaks the rules for names"
