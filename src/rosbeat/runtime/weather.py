"""Sensors that say what they are told, once a second, and may be silent for a while."""

from __future__ import annotations

from collections.abc import Callable, Iterable

from rclpy.node import Node

from rosbeat.runtime.feeding import BARE, message, message_class

_FLOAT = "std_msgs/msg/Float32"


def station(name: str, topic: str, readings: Iterable[float | None]) -> Callable[[], Node]:
    """A sensor that publishes one `Float32` a second, the first after one second.

    Args:
        name: The node's name.
        topic: Where it publishes.
        readings: What it says, in order; None is a second without a message. Then it is silent.

    Returns:
        A class, for `Session.add` or a scenario.
    """
    told = tuple(readings)

    class Station(Node):
        """Says what it was told."""

        def __init__(self) -> None:
            super().__init__(name, **BARE)
            self._left = iter(told)
            self._publisher = self.create_publisher(message_class(_FLOAT), topic, 10)
            self.create_timer(1.0, self._send)

        def _send(self) -> None:
            value = next(self._left, None)
            if value is not None:
                self._publisher.publish(message(_FLOAT, float(value)))

    return Station
