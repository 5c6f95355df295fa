"""Inject numbers, load and faults into a live session, for the instrument panel."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable
from functools import partial
from math import nan
from random import Random
from typing import Any

import rclpy.utilities
from rclpy.context import Context
from rclpy.node import Node
from rclpy.publisher import Publisher
from rclpy.timer import Timer

from rosbeat.errors import SessionError
from rosbeat.ros.launch import Maker, build_in
from rosbeat.ros.recording import Message, message_class
from rosbeat.ros.world import World, state_of

#: The name of the node through which the panel publishes.
INJECTOR = "instrument_panel"


class Injector(Node):
    """Publish numbers on topics, once or every second, and run a slow callback on request.

    The injector appears in the graph like any other node, because subscriptions do receive its
    messages.
    """

    def __init__(self, context: Context) -> None:
        super().__init__(INJECTOR, context=context, start_parameter_services=False)
        self._publishers_by_topic: dict[str, Any] = {}
        self._repeated: dict[str, float] = {}
        self._repeat_timer: Timer | None = None
        self._load_timer: Timer | None = None
        self._load_s = 0.0

    def send(self, topic: str, type_name: str, value: float) -> None:
        """Publish one number on a topic of a type with a field `data` for a number."""
        if topic not in self._publishers_by_topic:
            kind = message_class(type_name)
            self._publishers_by_topic[topic] = self.create_publisher(kind, topic, 10)
        self._publish(topic, value)
        if topic in self._repeated:
            self._repeated[topic] = value

    def repeat(self, topic: str, value: float | None) -> None:
        """Publish a number every second on a topic of which `send` knows the type; None ends it."""
        if value is None:
            self._repeated.pop(topic, None)
        else:
            self._repeated[topic] = value
            self._repeat_timer = self._repeat_timer or self.create_timer(1.0, self._send_again)

    def load(self, milliseconds: float) -> None:
        """Run a callback for so long, once a second; 0 ends that."""
        self._load_s = milliseconds / 1000
        self._load_timer = self._load_timer or self.create_timer(1.0, self._work)

    def _work(self) -> None:
        # This blocks the executor as a computation does, and leaves the processor to the page.
        time.sleep(self._load_s)

    def _send_again(self) -> None:
        for topic, value in list(self._repeated.items()):
            self._publish(topic, value)

    def _publish(self, topic: str, value: float) -> None:
        publisher = self._publishers_by_topic[topic]
        publisher.publish(publisher.msg_type(data=value))


class TopicFault:
    """Drop or change what nodes publish on one topic.

    The fault applies between a node and its publisher, before recording, so the recording contains
    what was really sent.

    Attributes:
        kind: `none`, `dropout`, `nan` or `offset`.
        amount: Of a dropout, the share of lost messages in percent; of an offset, the number to
            add.
    """

    def __init__(self, topic: str) -> None:
        self.kind, self.amount = "none", 0.0
        self._topic = topic
        # Its own generator, so that the numbers which the nodes draw stay as they are.
        self._random = Random(0)
        self._originals: dict[Publisher, Callable[[Any], None]] = {}

    def apply(self, publishers: Iterable[Publisher]) -> None:
        """Disturb these publishers, too, as far as they are on the topic."""
        for publisher in publishers:
            if publisher.topic_name == self._topic and publisher not in self._originals:
                self._originals[publisher] = publisher.publish
                publisher.publish = partial(self._publish, publisher.publish)

    def remove(self) -> None:
        """Let every publisher publish as before."""
        self.kind = "none"
        for publisher, publish in self._originals.items():
            publisher.publish = publish
        self._originals.clear()

    def _publish(self, send: Callable[[Message], None], msg: Message) -> None:
        if self.kind == "dropout" and self._random.uniform(0, 100) < self.amount:
            return
        send(self._changed(msg))

    def _changed(self, msg: Message) -> Message:
        value = getattr(msg, "data", None)
        if not isinstance(value, float):  # bytes, or what rclpy refuses in its own words
            return msg
        if self.kind == "nan":
            return type(msg)(data=nan)
        return type(msg)(data=value + self.amount) if self.kind == "offset" else msg


def restart_node(world: World, name: str, maker: Maker) -> None:
    """Make a node of this name as it was made before, and run its callbacks.

    Raises:
        SessionError: If another session is open.
        NodeConstructionError: If its constructor raises.
    """
    # A node names no context, so it would land in the session that was opened last.
    if rclpy.utilities.g_default_context is not world.context:
        raise SessionError(
            f"{name} cannot be started now.",
            "Another session is open, and a new node would belong to that session.",
            "Close the other session first, or wait until the running check has ended.",
        )
    (made,) = build_in(world, [maker.make], maker.start)
    world.makers[made] = maker
    world.spin_node(state_of(world, made))
