"""Listening to what a node sends, at its own publishers and clients.

A recording subscription would cost a second delivery of every message, could not tell who published
and would show in the graph. A tap is put on the object that the node itself calls.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from rclpy.client import Client
from rclpy.exceptions import InvalidHandle
from rclpy.publisher import Publisher
from rclpy.qos import DurabilityPolicy, QoSCompatibility, QoSProfile, qos_check_compatible
from rclpy.serialization import deserialize_message
from rclpy.timer import Rate, Timer

from rosbeat.runtime.asking import asking
from rosbeat.runtime.messages import Memory, Raw


class PublisherTap:
    """Listens to one publisher.

    Args:
        publisher: The publisher; its `publish` is replaced by one that also tells `heard`.
        memory: Copies its messages.
        heard: Called with the copy after each message that was really published.

    Attributes:
        topic: Full topic name.
        count: Messages published so far.
    """

    def __init__(self, publisher: Publisher, memory: Memory, heard: Callable[[Any], None]) -> None:
        self.topic: str = publisher.topic_name
        self.count = 0
        self._handle = handle = publisher.handle
        self._qos: QoSProfile = publisher.qos_profile
        send, take, message_type = publisher.publish, memory.take, publisher.msg_type
        # What rclpy's own `publish` does for a message; going through it costs a message's tenth.
        send_message = handle.publish

        def publish(msg: Any) -> None:  # noqa: ANN401 - a message of any type, or its bytes
            if isinstance(msg, message_type):
                with handle:
                    send_message(msg)
                copy = take(msg)
            else:
                with asking("publish", msg):
                    if isinstance(msg, bytes):
                        # Bytes that are no message would only fail where they arrive.
                        deserialize_message(msg, message_type)
                    send(msg)  # bytes; or anything else, which rclpy refuses in its own words
                copy = Raw(msg)
            self.count += 1
            heard(copy)

        publish.__qualname__ = send.__qualname__  # for the errors of a call with other arguments
        publisher.publish = publish

    def stored_for(self, qos: QoSProfile) -> int:
        """How many stored messages a new subscription of this QoS gets from this publisher."""
        policies = (self._qos.durability, qos.durability)
        if any(policy != DurabilityPolicy.TRANSIENT_LOCAL for policy in policies):
            return 0
        if not self._is_alive():
            return 0
        compatible, _ = qos_check_compatible(self._qos, qos)
        if compatible == QoSCompatibility.ERROR:
            return 0
        return min(self.count, self._qos.depth or self.count)

    def _is_alive(self) -> bool:
        try:
            with self._handle:
                return True
        except InvalidHandle:  # destroyed, and what it had stored with it
            return False


def tap_timer(timer: Timer, moved: Callable[[], None]) -> None:
    """Listen to one timer: `moved` is called after each `reset`, which changes its deadline."""
    original = timer.reset

    def reset() -> None:
        original()
        moved()

    timer.reset = reset


def tap_rate(rate: Rate, sleep: Callable[[Callable[[], None]], None]) -> None:
    """Let `sleep` decide how one rate sleeps; it is given rate's own way."""
    original = rate.sleep
    rate.sleep = lambda: sleep(original)


def tap_client(
    client: Client,
    check: Callable[[], None],
    asked: Callable[[], None],
    wait_for: Callable[[Any, float | None], Any],
) -> None:
    """Listen to one service client.

    Args:
        client: The client; its `call_async` and `call` are replaced.
        check: Called before `call` begins; raises where it would wait for ever.
        asked: Called after each request.
        wait_for: Runs the nodes until a future is done and returns its result; used by `call`,
            which would otherwise wait for an answer that nobody is running to give.
    """
    send = client.call_async

    def call_async(request: Any) -> Any:  # noqa: ANN401
        future = send(request)
        asked()
        return future

    def call(request: Any, timeout_sec: float | None = None) -> Any:  # noqa: ANN401
        check()
        return wait_for(call_async(request), timeout_sec)

    client.call_async = call_async
    client.call = call
