"""A node of ours among programs: it says numbers on a topic, and hears what the programs say."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import Any

from rclpy.node import Node
from std_msgs.msg import Float32

from rosbeat.records import Endpoint
from rosbeat.runtime.session import Session
from rosbeat.runtime.waiting import poll

NAME = "outpost"


class Outpost:
    """A live session in the domain of some programs; use it in a `with` block.

    Args:
        domain_id: The domain.
        topic: A topic of numbers, `std_msgs/msg/Float32`.
    """

    def __init__(self, domain_id: int, topic: str) -> None:
        self._heard: list[tuple[float, float]] = []
        self._topic = topic
        self._session = Session(domain_id=domain_id)

    def __enter__(self) -> Outpost:
        try:
            node: Any = self._session.add(lambda: Node(NAME))
            self._publisher = node.create_publisher(Float32, self._topic, 10)
            node.create_subscription(Float32, self._topic, self._hear, 10)
            self._session.start()
        except BaseException:
            self._session.close()
            raise
        return self

    def __exit__(self, *_: object) -> None:
        self._session.close()

    def _hear(self, message: Any) -> None:  # noqa: ANN401 - rclpy carries no types
        self._heard.append((time.monotonic(), message.data))

    def listen_anew(self) -> None:
        """Forget what was heard so far."""
        self._heard.clear()

    @property
    def heard(self) -> tuple[tuple[float, float], ...]:
        """When each number came, in seconds since the first of them, and the number."""
        heard = list(self._heard)
        return tuple((at - heard[0][0], value) for at, value in heard)

    def say(self, value: float) -> None:
        """Publish a number."""
        self._publisher.publish(Float32(data=value))

    def has_listener(self) -> bool:
        """Whether somebody else listens."""
        return bool(self._publisher.get_subscription_count() > 1)

    def publishers(self) -> tuple[Endpoint, ...]:
        """What the programs publish, topics that every node has left out."""
        graph = self._session.graph()
        return tuple(
            end
            for topic in graph.topics()
            for end in graph.on(topic, "publisher")
            if end.node != f"/{NAME}"
        )

    def wait(self, until: Callable[[], object], seconds: float) -> bool:
        """Wait until something is so, at most so many seconds of wall time; say whether it is."""
        return poll(until, time.monotonic() + seconds)
