"""The node through which the instrument panel publishes and keeps the executor busy."""

from __future__ import annotations

import time
from typing import Any

from rclpy.context import Context
from rclpy.node import Node
from rclpy.timer import Timer

from rosbeat.runtime.feeding import message_class

NAME = "instrument_panel"


class Injector(Node):
    """Publishes numbers on topics, once or every second, and runs a slow callback if asked to.

    It is in the graph like any node, since a subscriber does hear it.

    Args:
        context: The session's context.
    """

    def __init__(self, context: Context) -> None:
        super().__init__(NAME, context=context, start_parameter_services=False)
        self._senders: dict[str, Any] = {}
        self._repeated: dict[str, float] = {}
        self._repeating: Timer | None = None
        self._busy: Timer | None = None
        self._busy_s = 0.0

    def send(self, topic: str, type_name: str, value: float) -> None:
        """Publish one number.

        Args:
            topic: Full name of the topic.
            type_name: Its type, one with a field `data` for a number.
            value: The number.
        """
        kind = message_class(type_name)
        if topic not in self._senders:
            self._senders[topic] = self.create_publisher(kind, topic, 10), kind
        publisher, kind = self._senders[topic]
        publisher.publish(kind(data=value))
        if topic in self._repeated:
            self._repeated[topic] = value

    def repeat(self, topic: str, value: float | None) -> None:
        """Publish a number every second on a topic of which `send` knows the type; None ends it."""
        if value is None:
            self._repeated.pop(topic, None)
        else:
            self._repeated[topic] = value
            self._repeating = self._repeating or self.create_timer(1.0, self._send_again)

    def load(self, milliseconds: float) -> None:
        """Run a callback for so long, once a second; 0 ends that."""
        self._busy_s = milliseconds / 1000
        if self._busy is None:
            self._busy = self.create_timer(1.0, self._work)

    def _send_again(self) -> None:
        for topic, value in list(self._repeated.items()):
            publisher, kind = self._senders[topic]
            publisher.publish(kind(data=value))

    def _work(self) -> None:
        # It holds the executor up as a computation does, and leaves the processor to the page.
        time.sleep(self._busy_s)
