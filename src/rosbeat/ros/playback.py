"""A node that publishes a recording, each message at its time."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from rclpy.node import Node

from rosbeat.errors import BagError
from rosbeat.records import QoS
from rosbeat.ros.recording import message_class
from rosbeat.ros.test_nodes import profile

#: Makes a node; `Session.add` takes it.
NodeFactory = Callable[[], Node]


@dataclass(frozen=True)
class PlayedTopic:
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
class PlayedStep:
    """What is published in one callback.

    Attributes:
        time_ns: When, in nanoseconds after the node was made.
        messages: Pairs of topic, counted from 0, and serialized message.
    """

    time_ns: int
    messages: tuple[tuple[int, bytes], ...]


def player(name: str, topics: Sequence[PlayedTopic], steps: Sequence[PlayedStep]) -> NodeFactory:
    """Return a node that publishes prepared messages at prepared times.

    All that one step causes is over before the next one begins, also at the same instant.

    Args:
        name: The node's name.
        topics: The topics.
        steps: What to publish, in order of time.

    Raises:
        BagError: If no installed package has a topic's type.
    """
    classes = [_class_of(topic) for topic in topics]

    class Player(Node):
        """Publishes what was recorded."""

        def __init__(self) -> None:
            super().__init__(name)
            self._topic_publishers = [
                self.create_publisher(kind, one.topic, profile(one.qos))
                for kind, one in zip(classes, topics, strict=True)
            ]
            self._begun = self.get_clock().now()
            self._next = 0
            if steps:
                self._step_timer = self.create_timer(steps[0].time_ns / 1e9, self._play)
                self._schedule()

        def _play(self) -> None:
            for number, message in steps[self._next].messages:
                self._topic_publishers[number].publish(message)
            self._next += 1
            self._schedule()

        def _schedule(self) -> None:
            if self._next == len(steps):
                self._step_timer.cancel()
                return
            elapsed = (self.get_clock().now() - self._begun).nanoseconds
            self._step_timer.timer_period_ns = max(0, steps[self._next].time_ns - elapsed)
            self._step_timer.reset()

    return Player


def _class_of(topic: PlayedTopic) -> type:
    try:
        return message_class(topic.type_name)
    except (ImportError, AttributeError, ValueError) as error:
        raise BagError(
            f"Messages of the type {topic.type_name} cannot be published here.",
            f"{topic.topic} has this type, and no package that defines it is installed.",
            "Build and source the package that defines it, or leave the topic out with "
            "`topics=[...]`.",
        ) from error
