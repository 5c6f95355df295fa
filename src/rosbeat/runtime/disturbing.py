"""Messages that go wrong on their way: lost, not a number, or off by so much."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from functools import partial
from math import nan
from random import Random
from typing import Any

from rclpy.publisher import Publisher


class Disturbance:
    """What is wrong with the messages of one topic.

    It sits between a node and its publisher, outside of the recording: what is recorded is what
    really went out.

    Args:
        topic: Full name of the topic.

    Attributes:
        kind: `none`, `dropout`, `nan` or `offset`.
        amount: Of a dropout the share that is lost, in percent; of an offset what is added.
    """

    def __init__(self, topic: str) -> None:
        self.kind, self.amount = "none", 0.0
        self._topic = topic
        # Its own numbers, so that those which the nodes draw stay as they are.
        self._random = Random(0)
        self._before: dict[Publisher, Callable[[Any], None]] = {}

    def reach(self, publishers: Iterable[Publisher]) -> None:
        """Disturb these publishers, too, as far as they are on the topic."""
        for publisher in publishers:
            if publisher.topic_name == self._topic and publisher not in self._before:
                self._before[publisher] = publisher.publish
                publisher.publish = partial(self._publish, publisher.publish)

    def end(self) -> None:
        """Let every publisher publish as before."""
        self.kind = "none"
        for publisher, publish in self._before.items():
            publisher.publish = publish
        self._before.clear()

    def _publish(self, send: Callable[[Any], None], msg: Any) -> None:  # noqa: ANN401
        if self.kind == "dropout" and self._random.uniform(0, 100) < self.amount:
            return
        send(self._changed(msg))

    def _changed(self, msg: Any) -> Any:  # noqa: ANN401
        value = getattr(msg, "data", None)
        if not isinstance(value, float):  # bytes, or what rclpy refuses in its own words
            return msg
        if self.kind == "nan":
            return type(msg)(data=nan)
        return type(msg)(data=value + self.amount) if self.kind == "offset" else msg
