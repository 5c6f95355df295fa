"""Publish a recording from a node, each message at its time."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Sequence
from typing import NamedTuple

from rclpy.node import Node

from rosbeat.errors import BagError
from rosbeat.records import QoS
from rosbeat.ros.recording import message_class
from rosbeat.ros.test_nodes import profile

#: Makes a node; `Session.add` takes it.
NodeFactory = Callable[[], Node]


class PlayedTopic(NamedTuple):
    """Describe a topic to publish on: its full name, its type and the QoS to offer."""

    topic: str
    type_name: str
    qos: QoS


class PlayedStep(NamedTuple):
    """Describe what to publish in one callback.

    `time_ns` counts from the creation of the node. `messages` holds pairs of a topic's index and a
    serialized message.
    """

    time_ns: int
    messages: tuple[tuple[int, bytes], ...]


def player(name: str, topics: Sequence[PlayedTopic], steps: Sequence[PlayedStep]) -> NodeFactory:
    """Return a class of node that publishes prepared messages at prepared times.

    All that one of the `steps`, which are in order of time, causes is over before the next one
    begins, also at the same instant.

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
            self._begun, self._left = self.get_clock().now(), deque(steps)
            if steps:
                self._step_timer = self.create_timer(steps[0].time_ns / 1e9, self._play)
                self._schedule()

        def _play(self) -> None:
            for topic, message in self._left.popleft().messages:
                self._topic_publishers[topic].publish(message)
            self._schedule()

        def _schedule(self) -> None:
            if not self._left:
                self._step_timer.cancel()
                return
            elapsed = (self.get_clock().now() - self._begun).nanoseconds
            self._step_timer.timer_period_ns = max(0, self._left[0].time_ns - elapsed)
            self._step_timer.reset()

    return Player


def _class_of(topic: PlayedTopic) -> type:
    try:
        return message_class(topic.type_name)
    except (ImportError, AttributeError, ValueError) as error:
        raise BagError(
            f"Messages of the type {topic.type_name} cannot be published here.",
            f"{topic.topic} has this type, but no package that defines the type is installed.",
            "Build and source the package that defines the type, or leave the topic out with "
            "`topics=[...]`.",
        ) from error
