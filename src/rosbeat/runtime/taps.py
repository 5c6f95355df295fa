"""Listening to what a node sends, at its own publishers and clients.

A recording subscription would cost a second delivery of every message, could not tell who published
and would show in the graph. A tap is put on the object that the node itself calls.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from rclpy.client import Client
from rclpy.duration import Duration
from rclpy.exceptions import InvalidHandle
from rclpy.publisher import Publisher
from rclpy.qos import (
    DurabilityPolicy,
    HistoryPolicy,
    QoSCompatibility,
    QoSProfile,
    ReliabilityPolicy,
    qos_check_compatible,
)
from rclpy.serialization import deserialize_message
from rclpy.timer import Rate, Timer

from rosbeat.runtime.asking import asking
from rosbeat.runtime.messages import Memory, Raw
from rosbeat.runtime.recorder import Channel
from rosbeat.runtime.stretching import limit_ns

# Fast DDS hands stored messages to reliable subscriptions only. By its own default, a subscription
# is neither that nor transient-local. A test tries all combinations.
_ASK_FOR_STORED = {DurabilityPolicy.TRANSIENT_LOCAL, DurabilityPolicy.BEST_AVAILABLE}
_ASK_AGAIN = {ReliabilityPolicy.RELIABLE, ReliabilityPolicy.BEST_AVAILABLE}
_AT_ONCE = Duration()._duration_handle


class PublisherTap:
    """Listens to one publisher.

    Args:
        publisher: The publisher; its `publish` is replaced by one that also tells `heard`.
        memory: Copies its messages.
        heard: Called with the copy after each message that was really published.

    Attributes:
        topic: Full topic name.
        count: Messages published so far.
        channel: Where its messages are recorded; None if they are not.
        lifespan_ns: How long it stores a message; 0 without a limit.
    """

    def __init__(self, publisher: Publisher, memory: Memory, heard: Callable[[Any], None]) -> None:
        self.topic: str = publisher.topic_name
        self.count = 0
        self.channel: Channel | None = None
        self._handle = handle = publisher.handle
        self._qos: QoSProfile = publisher.qos_profile
        self._type = publisher.msg_type
        self.lifespan_ns = limit_ns(self._qos.lifespan)
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

        def listen(further: Callable[[], None]) -> None:
            nonlocal heard
            before = heard

            def both(copy: Any) -> None:  # noqa: ANN401
                before(copy)
                further()

            heard = both

        self._listen = listen

    def listen(self, further: Callable[[], None]) -> None:
        """Call this, too, after each message; it costs nothing as long as nobody asks for it."""
        self._listen(further)

    def fits(self, subscription: Any) -> bool:  # noqa: ANN401 - rclpy is untyped
        """Whether a subscription of this topic is connected to this publisher."""
        return self._type is subscription.msg_type and self._offers(subscription.qos_profile)

    @property
    def stored(self) -> int:
        """How many messages are stored at most: some may have expired."""
        depth: int = self._qos.depth
        limited = self._qos.history == HistoryPolicy.KEEP_LAST
        return min(self.count, max(1, depth)) if limited else self.count

    def stores_for(self, qos: QoSProfile) -> bool:
        """Whether a new subscription of this QoS gets stored messages from this publisher."""
        own = self._qos
        if not self.count or own.durability == DurabilityPolicy.VOLATILE:
            return False
        if qos.durability not in _ASK_FOR_STORED or qos.reliability not in _ASK_AGAIN:
            return False
        if own.reliability == ReliabilityPolicy.BEST_EFFORT:
            return False
        return self._is_alive() and self._offers(qos)

    def has_delivered(self) -> bool:
        """Whether each of its subscriptions has all that it is to get, as far as is known now."""
        try:
            with self._handle:
                return bool(self._handle.wait_for_all_acked(_AT_ONCE))
        except InvalidHandle:  # destroyed by another thread: nothing more will come
            return True

    def _offers(self, qos: QoSProfile) -> bool:
        compatible, _ = qos_check_compatible(self._qos, qos)
        return bool(compatible != QoSCompatibility.ERROR)

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
