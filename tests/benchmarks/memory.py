"""Memory for each recorded message."""

from __future__ import annotations

import gc
import tracemalloc
from collections.abc import Callable
from functools import partial

from actors import Sink, Source
from measuring import Row
from rclpy.node import Node
from std_msgs.msg import Header

from rosbeat import Session


class NumberSource(Source):
    """Publishes another number each time; equal ones would share their memory."""

    def send(self) -> None:
        for _ in range(self.burst):
            self.message.data += 0.5
            self.publisher.publish(self.message)


class HeaderSource(Node):
    """Publishes messages within messages."""

    def __init__(self) -> None:
        super().__init__("headers")
        self.publisher = self.create_publisher(Header, "headers", 10)
        self.create_timer(0.001, self.send)

    def send(self) -> None:
        for number in range(10):
            self.publisher.publish(Header(frame_id=f"frame {number}"))


def measure(quick: bool) -> list[Row]:
    """A number, with and without a listener, and a nested message."""
    messages = 20_000 if quick else 200_000
    cases: dict[str, tuple[Callable[[], Node], ...]] = {
        "a number": (partial(NumberSource, 10),),
        "a number and its callback": (partial(NumberSource, 10), Sink),
        "a nested message": (HeaderSource,),
    }
    return [
        Row(f"bytes per recorded message: {name}", f"{_bytes(nodes, messages):.0f}")
        for name, nodes in cases.items()
    ]


def _bytes(nodes: tuple[Callable[[], Node], ...], messages: int) -> float:
    with Session() as ros:
        for node in nodes:
            ros.add(node)
        ros.run(0.1)
        gc.collect()
        tracemalloc.start()
        before, _ = tracemalloc.get_traced_memory()
        ros.run(messages / 10_000, quiet=True)
        gc.collect()
        after, _ = tracemalloc.get_traced_memory()
        tracemalloc.stop()
    return (after - before) / messages
