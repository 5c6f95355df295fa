"""Give nodes clocks that show the session's time, and let calls that wait take virtual time."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager
from operator import index
from pathlib import Path
from typing import Any

from rclpy import wait_for_message as message_waiting
from rclpy.clock import ClockType, ROSClock
from rclpy.context import Context
from rclpy.impl.implementation_singleton import rclpy_implementation
from rclpy.node import Node
from rclpy.qos import QoSProfile
from rclpy.time import Time

from rosbeat.ros.processes import Entry
from rosbeat.ros.virtual_time import VirtualTimeExecutor

# Clocks.


_POINT = rclpy_implementation.rcl_time_point_t


class SessionClock(ROSClock):
    """Give a node a ROS clock that only its session moves.

    Each node has its own clock, because rcl visits all timers of a clock whenever the clock moves
    (`rcl_set_ros_time_override`): one shared clock for 10,000 timers made each step cost 0.2 ms.
    The clock moves when it is read and before one of its timers fires, so no node can read a time
    that another node has already passed.

    rclpy's time source would set a node's clock from the parameter `use_sim_time` and from
    `/clock` messages; both calls are accepted and change nothing.
    """

    keeper: VirtualTimeExecutor
    _shown: int

    def set_ros_time_override(self, time: Time) -> None:
        """Accept rclpy's call and keep the session's own time."""

    def _set_ros_time_is_active(self, enabled: bool) -> None:
        """Accept rclpy's call; `follow_session` and `follow_wall` decide."""

    def follow_session(self) -> None:
        """Show virtual time from now on."""
        self._shown = -1
        self.move()
        super()._set_ros_time_is_active(True)

    def follow_wall(self) -> None:
        """Show wall time from now on, as a clock does without `use_sim_time`."""
        super()._set_ros_time_is_active(False)

    def move(self) -> None:
        """Move to the session's time."""
        time_ns = self.keeper.now
        if time_ns != self._shown:
            self._show(time_ns)

    @contextmanager
    def a_moment_later(self) -> Iterator[None]:
        """Show in this block that the least time there is has passed."""
        if self.keeper.is_live:
            yield
            return
        self._show(self.keeper.now + 1)
        try:
            yield
        finally:
            self.move()

    def _show(self, time_ns: int) -> None:
        self._shown = time_ns
        # Without the detour through `Time` and the method of rclpy's clock.
        handle = self.handle
        with handle:
            handle.set_ros_time_override(_POINT(time_ns, ClockType.ROS_TIME))

    def now(self) -> Time:
        """Return the time; see rclpy."""
        if not self.keeper.is_live:
            self.move()
        return super().now()

    def sleep_until(self, until: Time, context: Context | None = None) -> bool:
        """Sleep until a time of this clock; see rclpy. `sleep_for` calls this, too."""
        if self.keeper.is_live:
            return bool(super().sleep_until(until, context))
        self.keeper.sleep_until(until.nanoseconds)
        return True


def make_clock(keeper: VirtualTimeExecutor) -> SessionClock:
    """Return a clock that shows the time of a session."""
    # ROSClock's constructor always returns a plain ROSClock, whatever class it is asked for.
    clock = ROSClock()
    clock.__class__ = SessionClock
    made: SessionClock = clock
    made.keeper = keeper
    made.follow_session()
    if keeper.is_live:
        made.follow_wall()
    return made


# Functions that block.
#
# While a session runs nodes, `time.sleep` and `rclpy.wait_for_message` in the session's thread
# suspend only the simulated process that calls them (see `virtual_time`). The same holds for
# `wait_for_service` and `wait_for_server`, which rclpy builds on `time.sleep`. Threads that nodes
# start, and rosbeat's own code, sleep in real time.


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
