"""Nodes that say in their log what they hear."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from rclpy.node import Node

from rosbeat.records import QoS
from rosbeat.runtime.feeding import BARE, message_class, profile


def hearer(name: str, topic: str, type_name: str, qos: QoS | int = 10) -> Callable[[], Node]:
    """A node that logs the field `data` of each message that it gets, and nothing else.

    Args:
        name: The node's name.
        topic: Where it listens.
        type_name: A message type with a field `data`, such as `std_msgs/msg/String`.
        qos: The quality of service that it asks for, or the depth of its queue.

    Returns:
        A function that makes the node, for `Session.add`, `observe` or the step `Add`.
    """

    class Hearer(Node):
        """Logs what it hears."""

        def __init__(self) -> None:
            super().__init__(name, **BARE)
            self.create_subscription(message_class(type_name), topic, self._hear, profile(qos))

        def _hear(self, message: Any) -> None:  # noqa: ANN401 - a message of any type
            self.get_logger().info(str(message.data))

    return Hearer
