"""Subscriptions of the verbs that listen."""

from __future__ import annotations

import sys
from collections.abc import Callable
from typing import Any

from ros2_command.errors import CommandError
from ros2_command.graph import Graph
from ros2_command.lookup import suggestion, topic_class
from ros2_command.names import absolute, check_name
from ros2_command.untyped import Untyped


def subscribe(
    graph: Graph,
    topic: str,
    kind: Untyped,
    callback: Callable[[Any, dict[str, Any]], None],
    profile: Untyped,
    raw: bool = False,
    lost: Callable[[Any], None] | None = None,
) -> Untyped:
    """Subscribe to a topic.

    Args:
        graph: Where to subscribe.
        topic: The topic as typed.
        kind: The message class.
        callback: Gets each message and what is known about it.
        profile: The quality of service.
        raw: Whether the callback wants the bytes.
        lost: Gets a report if messages were lost.
    """
    from rclpy.event_handler import SubscriptionEventCallbacks

    return graph.node.create_subscription(
        kind, topic, callback, profile, raw=raw,
        event_callbacks=SubscriptionEventCallbacks(message_lost=lost),
    )  # fmt: skip


def compile_filter(text: str | None) -> Callable[[Any], bool]:
    """A condition over the message `m`.

    Raises:
        CommandError: If the text is no Python expression, or later, if it cannot be computed.
    """
    if text is None:
        return lambda message: True
    try:
        code = compile(text, "filter", "eval")
    except SyntaxError as error:
        raise CommandError(
            f"--filter {text!r} is not a Python expression: {error.msg}",
            "Write a condition over the message m, for example:  --filter 'm.data > 20'",
        ) from None

    def holds(message: Untyped) -> bool:
        try:
            return bool(eval(code, {"m": message}))
        except Exception as error:
            raise CommandError(f"--filter {text!r} failed: {error}") from None

    return holds


def known_class(graph: Graph, topic: str) -> Untyped:
    """The message class of a topic; if it is not there yet, says so and waits for it."""
    check_name("topic", topic)
    name = absolute(topic)
    graph.settle(lambda: name in dict(graph.topics()))
    if name not in dict(graph.topics()):
        print(f"WARNING: topic [{topic}] does not appear to be published yet")
        print(suggestion(name, dict(graph.topics())), file=sys.stderr)
        graph.spin_until(lambda: name in dict(graph.topics()))
    return topic_class(topic, None, graph)


def positive(text: str) -> int:
    """A whole number above zero, for argparse."""
    from argparse import ArgumentTypeError

    if not text.isdecimal() or int(text) < 1:
        raise ArgumentTypeError("value must be a positive integer")
    return int(text)
