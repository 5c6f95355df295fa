"""Run blocking calls in virtual time.

While a session runs nodes, `time.sleep` and `rclpy.wait_for_message` in the session's thread
suspend only the simulated process that calls them (see `virtual_time`). The same holds for
`wait_for_service` and `wait_for_server`, which rclpy builds on `time.sleep`. Threads that nodes
start, and rosbeat's own code, sleep in real time.
"""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager
from operator import index
from pathlib import Path
from typing import Any

from rclpy import wait_for_message as message_waiting
from rclpy.node import Node
from rclpy.qos import QoSProfile

from rosbeat.ros.entities import Entry
from rosbeat.ros.virtual_time import VirtualTimeExecutor

_OWN = str(Path(__file__).parents[1])
#: Seconds that `time.sleep` refuses: their nanoseconds are no C `long long`.
_TOO_LONG = 2**63 / 1e9


class VirtualWaits:
    """Replace blocking functions such as `time.sleep` by versions that wait in virtual time.

    Args:
        virtual: The session's executor.
        entry_of: Returns the session's entry for a subscription.
    """

    def __init__(
        self, virtual: VirtualTimeExecutor, entry_of: Callable[[Any], Entry | None]
    ) -> None:
        self._virtual, self._entry_of = virtual, entry_of
        self._sleep = time.sleep
        self._wait_for_message = message_waiting.wait_for_message

    @contextmanager
    def installed(self, code: Iterable[object]) -> Iterator[None]:
        """Let everything that waits take virtual time in this block.

        Args:
            code: Classes and functions in whose modules `from time import sleep` may stand.
        """
        places = {
            self._sleep: self.sleep,
            self._wait_for_message: self.wait_for_message,
        }
        namespaces = [vars(time), vars(message_waiting), *_namespaces(code)]
        with _in_place_of(places, namespaces):
            yield

    def sleep(self, seconds: Any) -> None:  # noqa: ANN401 - unchecked
        """Sleep, as `time.sleep` does; in the code of a node, in virtual time."""
        own = sys._getframe(1).f_code.co_filename.startswith(_OWN)
        if own or not self._virtual.in_callback:
            self._sleep(seconds)
            return
        span = seconds if isinstance(seconds, float) else index(seconds)  # as Python does it
        if 0 <= span < _TOO_LONG:
            self._virtual.sleep(span)
        else:
            self._sleep(seconds)  # which refuses it

    def wait_for_message(
        self,
        msg_type: Any,  # noqa: ANN401 - rclpy is untyped
        node: Node,
        topic: str,
        *,
        qos_profile: QoSProfile | int = 1,
        time_to_wait: float = -1,
    ) -> tuple[bool, Any]:
        """Wait for the next message of a topic; see `rclpy.wait_for_message`."""
        if not self._virtual.in_callback:
            found: tuple[bool, Any] = self._wait_for_message(
                msg_type, node, topic, qos_profile=qos_profile, time_to_wait=time_to_wait
            )
            return found
        subscription = node.create_subscription(msg_type, topic, lambda _: None, qos_profile)
        entry = self._entry_of(subscription)
        if entry is not None:
            self._virtual.unwatch(entry)  # the caller takes the message, and no executor
        taken: list[Any] = []

        def arrived() -> bool:
            # What was stored may be taken already: see `qos_events.TakenEarly`.
            handle = subscription.handle if entry is None else entry.handle
            with handle:
                found = handle.take_message(msg_type, subscription.raw)
            taken.extend(found[:1] if found else [])
            return bool(taken)

        until = self._virtual.after(time_to_wait)
        try:
            self._virtual.block(f"a message on {subscription.topic_name}", until, arrived)
        finally:
            node.destroy_subscription(subscription)
        return (True, taken[0]) if taken else (False, None)


@contextmanager
def _in_place_of(
    places: Mapping[Any, object], namespaces: Iterable[dict[str, Any]]
) -> Iterator[None]:
    """Exchange functions wherever a name stands for them, and put them back."""
    known = {id(old): (old, new) for old, new in places.items()}
    found = [
        (names, key, *known[id(one)])
        for names in namespaces
        for key, one in names.items()
        if id(one) in known
    ]
    for names, key, _, new in found:
        names[key] = new
    try:
        yield
    finally:
        for names, key, old, new in found:
            if names.get(key) is new:
                names[key] = old


def _namespaces(code: Iterable[object]) -> list[dict[str, Any]]:
    """Return the global names that functions see, and those of classes and their bases."""
    parts: list[object] = []
    for one in code:
        bases = one.__mro__ if isinstance(one, type) else ()
        parts += [one, *(part for base in bases for part in vars(base).values())]
    found = {id(names): names for part in parts if (names := getattr(part, "__globals__", None))}
    return list(found.values())
