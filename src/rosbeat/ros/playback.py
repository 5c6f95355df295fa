"""A node that publishes what was recorded, each message at its time."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, HistoryPolicy, QoSProfile, ReliabilityPolicy

from rosbeat.errors import BagError
from rosbeat.records import QoS
from rosbeat.ros.scenario import message_class
from rosbeat.ros.test_nodes import limits

#: Makes a node; `Session.add` takes it.
NodeFactory = Callable[[], Node]
_DEPTH = 10


@dataclass(frozen=True)
class Outlet:
    """One topic that a player publishes on.

    Attributes:
        topic: Full topic name.
        type_name: The message type, such as `std_msgs/msg/Float32`.
        qos: Quality of service to offer.
    """

    topic: str
    type_name: str
    qos: QoS


@dataclass(frozen=True)
class Turn:
    """What is published in one callback.

    Attributes:
        time_ns: When, in nanoseconds after the node was made.
        posts: Pairs of outlet, counted from 0, and serialized message.
    """

    time_ns: int
    posts: tuple[tuple[int, bytes], ...]


def player(name: str, outlets: Sequence[Outlet], turns: Sequence[Turn]) -> NodeFactory:
    """A node that publishes prepared messages at prepared times.

    What follows from one turn is over before the next one begins, also at the same instant.

    Args:
        name: The node's name.
        outlets: The topics.
        turns: What to publish, in order of time.

    Raises:
        BagError: If no installed package has a topic's type.
    """
    classes = [_class_of(outlet) for outlet in outlets]

    class Player(Node):
        """Publishes what was recorded."""

        def __init__(self) -> None:
            super().__init__(name)
            self._outlets = [
                self.create_publisher(kind, outlet.topic, _profile(outlet.qos))
                for kind, outlet in zip(classes, outlets, strict=True)
            ]
            self._begun = self.get_clock().now()
            self._next = 0
            if turns:
                self._clockwork = self.create_timer(turns[0].time_ns / 1e9, self._play)
                self._wait()

        def _play(self) -> None:
            for outlet, message in turns[self._next].posts:
                self._outlets[outlet].publish(message)
            self._next += 1
            self._wait()

        def _wait(self) -> None:
            if self._next == len(turns):
                self._clockwork.cancel()
                return
            gone = (self.get_clock().now() - self._begun).nanoseconds
            self._clockwork.timer_period_ns = max(0, turns[self._next].time_ns - gone)
            self._clockwork.reset()

    return Player


def _class_of(outlet: Outlet) -> type:
    try:
        return message_class(outlet.type_name)
    except (ImportError, AttributeError, ValueError) as error:
        raise BagError(
            f"Messages of the type {outlet.type_name} cannot be published here.",
            f"{outlet.topic} has this type, and no package that defines it is installed.",
            "Build and source the package that defines it, or leave the topic out with "
            "`topics=[...]`.",
        ) from error


def _profile(qos: QoS) -> QoSProfile:
    """What a recording says, with ROS's defaults for what it does not know."""
    best_effort, stored = qos.reliability == "BEST_EFFORT", qos.durability == "TRANSIENT_LOCAL"
    return QoSProfile(
        reliability=ReliabilityPolicy.BEST_EFFORT if best_effort else ReliabilityPolicy.RELIABLE,
        durability=DurabilityPolicy.TRANSIENT_LOCAL if stored else DurabilityPolicy.VOLATILE,
        history=HistoryPolicy.KEEP_ALL if qos.history == "KEEP_ALL" else HistoryPolicy.KEEP_LAST,
        depth=qos.depth or _DEPTH,
        **limits(qos),
    )
