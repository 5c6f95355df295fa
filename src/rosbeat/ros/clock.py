"""Give the code of nodes clocks that show the session's time, and calls that wait in it."""

from __future__ import annotations

import _thread
import queue
import sys
import threading
import time
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager
from functools import wraps
from operator import index
from pathlib import Path
from types import ModuleType
from typing import Any
from weakref import ReferenceType, ref

import rclpy.utilities
from rclpy import wait_for_message as message_waiting
from rclpy.clock import (
    Clock,
    ClockChange,
    ClockType,
    JumpHandle,
    JumpThreshold,
    ROSClock,
    TimeJump,
)
from rclpy.context import Context
from rclpy.duration import Duration
from rclpy.exceptions import NotInitializedException
from rclpy.impl.implementation_singleton import rclpy_implementation
from rclpy.node import Node
from rclpy.qos import QoSProfile
from rclpy.time import Time

from rosbeat.ros import threads
from rosbeat.ros.engine import VirtualTime
from rosbeat.ros.exception_origin import is_foreign
from rosbeat.ros.processes import Entry
from rosbeat.ros.waits import board_here

# When a session begins.

#: Seconds since 1970 at which clocks begin: 2025-01-01 in UTC. On a robot no clock begins at zero,
#: and public code takes zero for "never".
START = 1_735_689_600
#: The latest beginning that can be chosen: rcl counts nanoseconds in 63 bits.
LATEST_START = 2**63 // 1_000_000_000 // 2
#: The same of clocks that count from the start of the machine.
STEADY_START = 3_600
_STEADY_NS = STEADY_START * 1_000_000_000

# Clocks.


_POINT = rclpy_implementation.rcl_time_point_t


class VirtualClock(Clock):
    """Show the time of a session, whatever the clock's type.

    Each node has its own clock, because rcl visits all timers of a clock whenever the clock moves
    (`rcl_set_ros_time_override`): one shared clock for 10,000 timers made each step cost 0.2 ms.
    The clock moves when it is read and before one of its timers fires, so no node can read a time
    that another node has already passed.

    To rcl it is a clock of ROS time, the only type that can be set.

    Attributes:
        keeper: The engine whose time it shows.
        is_driven: Whether a program or `/clock` sets it instead, as with `use_sim_time`.
    """

    keeper: VirtualTime
    is_driven: bool
    _shown: int
    _jumps: list[ReferenceType[VirtualJump]]

    def move(self) -> None:
        """Move to the session's time."""
        time_ns = self.keeper.now
        if time_ns != self._shown and not self.is_driven:
            self._show(time_ns)

    @contextmanager
    def a_moment_later(self) -> Iterator[None]:
        """Show in this block that the least time there is has passed."""
        if self.keeper.is_live or self.is_driven:
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
            handle.set_ros_time_override(_POINT(time_ns + self._start_ns, ClockType.ROS_TIME))

    def now(self) -> Time:
        """Return the time; see rclpy."""
        if not (self.keeper.is_live or self.is_driven):
            self.keeper.clock_read()
            return Time(nanoseconds=self.keeper.now + self._start_ns, clock_type=self._clock_type)
        handle = self.handle
        with handle:
            now = handle.get_now()
        return Time(nanoseconds=now.nanoseconds, clock_type=self._clock_type)

    def sleep_until(self, until: Time, context: Context | None = None) -> bool:
        """Sleep until a time of this clock; see rclpy. `sleep_for` calls this, too."""
        home = context or rclpy.utilities.get_default_context()
        if not home.ok():
            raise NotInitializedException
        if until.clock_type != self._clock_type:
            raise ValueError("until's clock type does not match this clock's type")
        if self.keeper.is_live:
            return bool(super().sleep_until(until, context))
        was_driven = self.is_driven

        def is_broken_off() -> bool:
            return self.is_driven != was_driven or not home.ok()

        def is_over() -> bool:
            return is_broken_off() or (was_driven and self.now() >= until)

        end = None if was_driven else until.nanoseconds - self._start_ns
        if self.now() < until:
            self.keeper.block("sleep", end, is_over)
        return not is_broken_off() and self.now() >= until

    def create_jump_callback(self, threshold: Any, **callbacks: Any) -> JumpHandle:  # noqa: ANN401 - rclpy's own
        """Create a handler for clock time jumps; see rclpy. Virtual time flows and never jumps."""
        post: Any = callbacks.get("post_callback")

        def told(jump: dict[str, Any]) -> None:
            post(TimeJump(jump["clock_change"], Duration(nanoseconds=jump["delta"])))

        if callable(post):
            callbacks["post_callback"] = told
        return VirtualJump(
            clock=self,
            threshold=threshold,
            pre_callback=callbacks.get("pre_callback"),
            post_callback=callbacks.get("post_callback"),
        )

    def follow_session(self) -> None:
        """Show virtual time from now on."""
        self._shown = -1
        self._override(True)
        self.move()

    def follow_wall(self) -> None:
        """Show wall time from now on."""
        self._override(False)

    @property
    def _start_ns(self) -> int:
        steady = self._clock_type == ClockType.STEADY_TIME
        return _STEADY_NS if steady else self.keeper.start_ns

    def _override(self, active: bool) -> None:
        handle = self.handle
        with handle:
            handle.set_ros_time_override_is_enabled(active)

    def _jump(self, change: ClockChange, delta_ns: int, do: Callable[[], None]) -> None:
        """Do something that makes the clock jump, and tell those who asked for it."""
        jumps = [jump for jump in (reference() for reference in self._jumps) if jump is not None]
        meant = [jump for jump in jumps if jump.is_meant(change, delta_ns)]
        for jump in meant:
            if jump._pre_callback is not None:
                jump._pre_callback()
        do()
        for jump in meant:
            if jump._post_callback is not None:
                jump._post_callback({"clock_change": change, "delta": delta_ns})
        self.keeper.clock_set()


class VirtualJump(JumpHandle):
    """Handle jumps of a clock that shows virtual time, without rcl."""

    def __init__(
        self,
        *,
        clock: VirtualClock,
        threshold: JumpThreshold,
        pre_callback: Callable[[], None] | None,
        post_callback: Callable[[Any], None] | None,
    ) -> None:
        for name, callback in (("pre_callback", pre_callback), ("post_callback", post_callback)):
            if callback is not None and not callable(callback):
                raise ValueError(f"{name} must be callable if given")
        if pre_callback is None and post_callback is None:
            raise ValueError("One of pre_callback or post_callback must be callable")
        self._clock: VirtualClock | None = clock
        self._pre_callback, self._post_callback = pre_callback, post_callback
        self._threshold = threshold
        clock._jumps.append(ref(self))

    def is_meant(self, change: ClockChange, delta_ns: int) -> bool:
        """Return whether a jump passes the threshold (rcl, `clock.c`)."""
        if self._clock is None:
            return False
        if change in (ClockChange.ROS_TIME_ACTIVATED, ClockChange.ROS_TIME_DEACTIVATED):
            return bool(self._threshold.on_clock_change)
        forward, backward = self._threshold.min_forward, self._threshold.min_backward
        if delta_ns > 0:
            return forward is not None and delta_ns >= forward.nanoseconds
        return backward is not None and delta_ns < 0 and delta_ns <= backward.nanoseconds

    def unregister(self) -> None:
        """Handle no further jumps."""
        self._clock = None


class SessionClock(VirtualClock, ROSClock):
    """Give a node a ROS clock that its session moves, unless the node uses simulated time.

    With `use_sim_time`, rclpy's time source activates ROS time and sets it from `/clock`. Until a
    first message comes there, such a clock stands still, as on a robot.
    """

    _set_to: Time | None

    @property
    def ros_time_is_active(self) -> bool:
        """Return whether a program or `/clock` sets the clock."""
        return self.is_driven

    def set_ros_time_override(self, time: Time) -> None:
        """Set the time that the clock shows while ROS time is active."""
        if not isinstance(time, Time):
            raise TypeError(
                f"Time must be specified as rclpy.time.Time. Received type: {type(time)}"
            )
        self._set_to = time
        if self.is_driven:
            delta = time.nanoseconds - self.now().nanoseconds
            self._jump(ClockChange.ROS_TIME_NO_CHANGE, delta, self._show_what_was_set)

    def _set_ros_time_is_active(self, enabled: bool) -> None:
        if enabled == self.is_driven or self.keeper.is_live:
            return
        change = "ROS_TIME_ACTIVATED" if enabled else "ROS_TIME_DEACTIVATED"
        self._jump(getattr(ClockChange, change), 0, lambda: self._drive(enabled))

    def _drive(self, enabled: bool) -> None:
        self.is_driven = enabled
        if enabled:
            self._show_what_was_set()
        else:
            self._shown = -1
            self.move()

    def _show_what_was_set(self) -> None:
        time_ns = self._set_to.nanoseconds if self._set_to is not None else 0
        handle = self.handle
        with handle:
            handle.set_ros_time_override(_POINT(time_ns, ClockType.ROS_TIME))


def make_clock(keeper: VirtualTime, clock_type: ClockType = ClockType.ROS_TIME) -> VirtualClock:
    """Return a clock that shows the time of a session."""
    # ROSClock's constructor always returns a plain ROSClock, whatever class it is asked for.
    clock = _original_new(Clock, clock_type=ClockType.ROS_TIME)
    ros = clock_type == ClockType.ROS_TIME
    clock.__class__ = SessionClock if ros else VirtualClock
    made: VirtualClock = clock
    made._clock_type = clock_type
    made.keeper, made.is_driven, made._jumps = keeper, False, []
    if ros:
        clock._set_to = None
    keeper.clocks.add(made)
    made.follow_session()
    if keeper.is_live:
        made.follow_wall()
    return made


_original_new: Callable[..., Any] = Clock.__new__


@wraps(_original_new)
def new_clock(
    kind: type,
    *args: Any,  # noqa: ANN401 - rclpy's own
    clock_type: ClockType = ClockType.SYSTEM_TIME,
    **rest: Any,  # noqa: ANN401 - rclpy's own
) -> Any:  # noqa: ANN401 - rclpy's own
    """Make a clock; one that code of a node makes shows virtual time."""
    board = board_here()
    known = not args and not rest and isinstance(clock_type, ClockType)
    if isinstance(board, VirtualTime) and not board.is_live and known and kind in (Clock, ROSClock):
        return make_clock(board, clock_type)
    return _original_new(kind, *args, clock_type=clock_type, **rest)


# Functions that tell the time, or block.
#
# While a session runs nodes, the names below mean virtual time for the code of nodes: where they
# are defined, and in the modules that the learner wrote and that have imported them by name.
# rosbeat's own code, and threads that no node has started, see real time as ever.


_OWN = str(Path(__file__).parents[1])
#: A lock that a module has made when it was imported.
_LOCK = type(_thread.allocate_lock())
#: Seconds that `time.sleep` refuses: their nanoseconds are no C `long long`.
_TOO_LONG = 2**63 / 1e9
#: What Python's own modules have imported by name.
_LIBRARY = (time, threading, queue, message_waiting)
_REAL = {name: getattr(time, name) for name in (
    "time", "time_ns", "monotonic", "monotonic_ns", "perf_counter", "perf_counter_ns",
)}  # fmt: skip


class VirtualNames:
    """Replace functions such as `time.sleep` by versions that know virtual time.

    Args:
        virtual: The session's engine.
        entry_of: Returns what the session knows of a subscription.
    """

    def __init__(self, virtual: VirtualTime, entry_of: Callable[[Any], Entry | None]) -> None:
        self._virtual, self._entry_of = virtual, entry_of
        self._wait_for_message = message_waiting.wait_for_message
        self._real_sleep = time.sleep  # a test may have put something in its place
        clocks = {
            "time": (self._wall, 1e9), "time_ns": (self._wall, 0),
            "monotonic": (self._steady, 1e9), "monotonic_ns": (self._steady, 0),
            "perf_counter": (self._steady, 1e9), "perf_counter_ns": (self._steady, 0),
        }  # fmt: skip
        self._places: dict[Any, object] = {
            self._real_sleep: self.sleep,
            threading.Lock: threads.make_lock,
            threading._allocate_lock: threads.make_lock,  # type: ignore[attr-defined] # private
            threading.RLock: threads.make_reentrant_lock,
            queue.SimpleQueue: threads.make_simple_queue,
            threading.get_ident: threads.get_ident,
            self._wait_for_message: self.wait_for_message,
        }
        for name, (read, unit) in clocks.items():
            self._places[_REAL[name]] = self._clock(_REAL[name], read, unit)

    @contextmanager
    def installed(self, code: Iterable[object]) -> Iterator[None]:
        """Let everything that waits take virtual time in this block.

        Args:
            code: Classes and functions of nodes, in whose modules `from time import sleep` may
                stand, and in the modules that these import.
        """
        namespaces = [*(module.__dict__ for module in _LIBRARY), *_namespaces(code)]
        locks = {
            value: threads.VirtualLock(self._virtual, value)
            for names in namespaces[len(_LIBRARY) :]
            for value in names.values()
            if type(value) is _LOCK
        }
        with _in_place_of({**self._places, **locks}, namespaces):
            yield

    def sleep(self, seconds: Any) -> None:  # noqa: ANN401 - unchecked
        """Sleep, as `time.sleep` does; in the code of a node, in virtual time."""
        own = sys._getframe(1).f_code.co_filename.startswith(_OWN)
        if own or not self._virtual.in_callback:
            self._real_sleep(seconds)
            return
        span = seconds if isinstance(seconds, float) else index(seconds)  # as Python does it
        if 0 <= span < _TOO_LONG:
            if self._virtual.constructor_waits is not None and not self._virtual.running:
                self._virtual.constructor_waits(round(span * 1e9), "sleep")
            else:
                self._virtual.sleep(span)
        else:
            self._real_sleep(seconds)  # which refuses it

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
            answer: tuple[bool, Any] = self._wait_for_message(
                msg_type, node, topic, qos_profile=qos_profile, time_to_wait=time_to_wait
            )
            return answer
        subscription = node.create_subscription(msg_type, topic, lambda _: None, qos_profile)
        entry = self._entry_of(subscription)
        if entry is not None:
            self._virtual.unwatch(entry)  # the caller takes the message, and no executor
        messages: list[Any] = []

        def arrived() -> bool:
            # What was stored may be taken already: see `qos_events.TakenEarly`.
            handle = subscription.handle if entry is None else entry.handle
            with handle:
                taken = handle.take_message(msg_type, subscription.raw)
            messages.extend(taken[:1] if taken else [])
            return bool(messages)

        until = self._virtual.after(time_to_wait)
        try:
            self._virtual.block(f"a message on {subscription.topic_name}", until, arrived)
        finally:
            node.destroy_subscription(subscription)
        return (True, messages[0]) if messages else (False, None)

    def _wall(self) -> int:
        return self._virtual.now + self._virtual.start_ns

    def _steady(self) -> int:
        return self._virtual.now + _STEADY_NS

    def _clock(
        self, real: Callable[[], Any], read: Callable[[], int], unit: float
    ) -> Callable[[], Any]:
        virtual = self._virtual

        @wraps(real)
        def tell() -> Any:  # noqa: ANN401 - seconds or nanoseconds
            own = sys._getframe(1).f_code.co_filename.startswith(_OWN)
            if own or not virtual.in_callback or virtual.is_live:
                return real()
            virtual.clock_read()
            return read() / unit if unit else read()

        return tell


@contextmanager
def _in_place_of(
    places: Mapping[Any, object], namespaces: Iterable[dict[str, Any]]
) -> Iterator[None]:
    """Exchange functions wherever a name stands for them, and put them back."""
    known = {id(old): (old, new) for old, new in places.items()}
    names_found = [
        (names, key, *known[id(value)])
        for names in namespaces
        for key, value in names.items()
        if id(value) in known
    ]
    for names, key, _, new in names_found:
        names[key] = new
    try:
        yield
    finally:
        for names, key, old, new in names_found:
            if names.get(key) is new:
                names[key] = old


def _namespaces(code: Iterable[object]) -> list[dict[str, Any]]:
    """Return the global names that functions see, those of classes and their bases, and onwards.

    Modules that these have imported belong to them, unless they are Python's or installed.
    """
    parts: list[object] = []
    for value in code:
        bases = value.__mro__ if isinstance(value, type) else ()
        parts += [value, *(part for base in bases for part in vars(base).values())]
    namespaces = {
        id(names): names
        for part in parts
        if (names := getattr(part, "__globals__", None)) and not _is_own(names)
    }
    waiting = [names for names in namespaces.values() if not _is_library(names)]
    while waiting:
        for names in _imported_by(waiting.pop()):
            if id(names) not in namespaces and not _is_library(names) and not _is_own(names):
                namespaces[id(names)] = names
                waiting.append(names)
    return list(namespaces.values())


def _imported_by(names: dict[str, Any]) -> Iterator[dict[str, Any]]:
    for value in list(names.values()):
        if isinstance(value, ModuleType):
            yield vars(value)
        elif isinstance(value, type) or callable(value):
            module = sys.modules.get(getattr(value, "__module__", None) or "")
            if module is not None:
                yield vars(module)


def _is_own(names: dict[str, Any]) -> bool:
    # Methods that `recording` wraps lead to it, and it reads a real clock for each callback.
    return str(names.get("__file__")).startswith(_OWN)


def _is_library(names: dict[str, Any]) -> bool:
    file = names.get("__file__")
    if isinstance(file, str) and names.get("__name__") != "__main__":
        return is_foreign(file)
    # A page, or code that was run from a text; a module in C has a specification.
    return getattr(names.get("__spec__"), "origin", None) in ("built-in", "frozen")
