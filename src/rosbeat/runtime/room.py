"""A room with a heater, for scenarios: whole degrees, so that nothing depends on rounding."""

from __future__ import annotations

from collections.abc import Callable

from rclpy.node import Node
from std_msgs.msg import Bool, Float32

#: Seconds in which a room loses one degree while it is not heated.
_COOLS_IN = 5


def room(degrees: int) -> Callable[[], Node]:
    """A node that publishes its temperature each second.

    It gains one degree a second while the last message on `heater` was True, and else loses one
    in five seconds.

    Args:
        degrees: Where it begins.

    Returns:
        A function that makes the node, for `Session.add` or `observe`.
    """

    class Room(Node):
        """A room."""

        def __init__(self) -> None:
            super().__init__("room")
            self._degrees, self._heating, self._cold = degrees, False, 0
            self._readings = self.create_publisher(Float32, "temperature", 10)
            self.create_subscription(Bool, "heater", self._switch, 10)
            self.create_timer(1.0, self._let_a_second_pass)

        def _switch(self, message: Bool) -> None:
            self._heating = bool(message.data)

        def _let_a_second_pass(self) -> None:
            if self._heating:
                self._degrees += 1
            else:
                self._cold += 1
                self._degrees -= self._cold % _COOLS_IN == 0
            self._readings.publish(Float32(data=float(self._degrees)))

    return Room
