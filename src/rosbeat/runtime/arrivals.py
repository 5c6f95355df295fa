"""Messages that other processes publish, recorded when a node of the session gets them.

What arrives says when it was published and as the publisher's how-manieth, but neither by whom nor
whether that was this session. So the session's own publishers note when they published what; what
is not among these came from outside. Who it was is known if only one node outside publishes there.
"""

from __future__ import annotations

import time
from array import array
from collections.abc import Callable, Coroutine
from inspect import iscoroutinefunction
from typing import Any

from rclpy.subscription import Subscription

from rosbeat.records import INFRASTRUCTURE_TOPICS
from rosbeat.runtime.lookout import UNKNOWN, Lookout, owner
from rosbeat.runtime.messages import Memory, Raw, type_name
from rosbeat.runtime.recorder import Channel, Recorder

#: Who published, as long as nobody can say.
NOBODY = "?"
#: Fast DDS keeps times in fractions of a second that are no whole nanoseconds.
_SLACK_NS = 1_000


class Departures:
    """When one publisher of the session published each of its messages.

    Args:
        publisher: The publisher; its `publish` is replaced by one that also notes the time.
    """

    def __init__(self, publisher: Any) -> None:  # noqa: ANN401 - rclpy is untyped
        self._begins, self._ends = array("q"), array("q")
        self._send = publisher.publish
        publisher.publish = self._publish

    def _publish(self, msg: Any) -> None:  # noqa: ANN401 - a message of any type, or its bytes
        # Noted before it goes out: another thread may take it before `publish` has returned.
        begins, ends = self._begins, self._ends
        begins.append(time.time_ns())
        try:
            self._send(msg)
        except BaseException:
            begins.pop()
            raise
        ends.append(time.time_ns())

    def sent(self, number: int, time_ns: int) -> bool:
        """Whether the message of this number, counted from 1, was published at this time."""
        if not 0 < number <= len(self._begins):
            return False
        begin = self._begins[number - 1]
        end = self._ends[number - 1] if number <= len(self._ends) else time.time_ns()
        return begin - _SLACK_NS <= time_ns <= end + _SLACK_NS


class Arrivals:
    """Records what comes from outside of a session.

    Args:
        lookout: Knows who publishes.
        recorder: Where messages are remembered.
        now: Nanoseconds since the session began.
    """

    def __init__(self, lookout: Lookout, recorder: Recorder, now: Callable[[], int]) -> None:
        self._lookout, self._recorder, self._now = lookout, recorder, now
        self._own: dict[str, list[Departures]] = {}
        self._known: set[tuple[str, int, int]] = set()
        self._channels: dict[tuple[str, frozenset[bytes]], Channel] = {}
        self._last: dict[str, Channel] = {}
        self._types: dict[str, type] = {}

    def watch_publisher(self, publisher: Any) -> None:  # noqa: ANN401
        """Recognize what this publisher of the session sends."""
        self._own.setdefault(publisher.topic_name, []).append(Departures(publisher))

    def watch_subscription(self, subscription: Subscription) -> None:
        """Record what arrives here from outside, before the callback runs."""
        topic = subscription.topic_name
        if topic in INFRASTRUCTURE_TOPICS:
            return
        memory = Memory(subscription.msg_type)
        self._types[topic] = subscription.msg_type

        def arrived(message: Any, info: dict[str, int]) -> None:  # noqa: ANN401
            self._arrived(topic, memory, message, info)

        subscription.callback = _listening(subscription, arrived)

    def topics(self) -> set[str]:
        """Every topic on which something from outside would have been recorded."""
        return set(self._types)

    def is_own(self, topic: str, info: dict[str, int]) -> bool:
        """Whether a message that came on a topic was published by this session."""
        number, sent = info["publication_sequence_number"], info["source_timestamp"]
        return any(own.sent(number, sent) for own in self._own.get(topic, ()))

    def _arrived(self, topic: str, memory: Memory, message: Any, info: dict[str, int]) -> None:  # noqa: ANN401
        number, sent = info["publication_sequence_number"], info["source_timestamp"]
        if self.is_own(topic, info):
            return
        with self._recorder.lock:
            if (topic, number, sent) in self._known:
                return  # another node of the session got it first
            self._known.add((topic, number, sent))
            channel = self._channel(topic, memory)
            copy = Raw(message) if isinstance(message, bytes) else memory.take(message)
            self._recorder.sampler(channel)(self._now(), copy)

    def _channel(self, topic: str, memory: Memory) -> Channel:
        outside = list(filter(self._lookout.is_outside, self._lookout.publishers(topic)))
        if not outside and topic in self._last:
            return self._last[topic]  # whoever sent it has left
        key = topic, frozenset(bytes(one.endpoint_gid) for one in outside)
        name = _only_owner(outside)
        channel = self._channels.get(key)
        if channel is None:
            channel = self._recorder.channel(topic, type_name(self._types[topic]), name, memory)
        elif channel.node != name:
            channel = self._recorder.rename(channel, name)
        self._channels[key] = self._last[topic] = channel
        return channel


def _only_owner(publishers: list[Any]) -> str:
    names = {owner(one) for one in publishers}
    if len(names) != 1 or publishers[0].node_name == UNKNOWN:
        return NOBODY
    return names.pop()


def _listening(
    subscription: Subscription, arrived: Callable[[Any, dict[str, int]], None]
) -> Callable[..., Any]:
    """A callback that tells `arrived` first and then does what the subscription's own does.

    It asks for the message's information, which both executors hand to whoever takes it.
    """
    original = subscription.callback
    wants_info = subscription._callback_type is Subscription.CallbackType.WithMessageInfo

    def call(message: Any, info: dict[str, int]) -> Any:  # noqa: ANN401
        arrived(message, info)
        return original(message, info) if wants_info else original(message)

    # Executors await what a coroutine function returns, and nothing else.
    async def call_later(message: Any, info: dict[str, int]) -> Any:  # noqa: ANN401
        coroutine: Coroutine[Any, Any, Any] = call(message, info)
        return await coroutine

    return call_later if iscoroutinefunction(original) else call
