"""The deadlines of publishers and subscriptions, counted by the session's clock.

A deadline is the longest time from one message to the next. Whoever has one and an event callback
for it is called each time it passes: a publisher's counts from what it has published, a
subscription's from what has arrived there from any publisher that it is connected to. Nothing is
missed before the first message has come; then one is missed in each period of silence, even when
no publisher is left. Who is busy or paused is told afterwards, of all that were missed, in one
event. Fast DDS does the same by the wall clock, and a test compares the two.

A message that comes exactly at the deadline is in time: what timers do at an instant goes first.
"""

from __future__ import annotations

from collections.abc import Callable
from heapq import heappop, heappush
from typing import Any

from rclpy.event_handler import (
    EventHandler,
    QoSOfferedDeadlineMissedInfo,
    QoSRequestedDeadlineMissedInfo,
)
from rclpy.exceptions import InvalidHandle

from rosbeat.runtime.entities import Entry

Work = tuple[Callable[..., Any], tuple[Any, ...]]


class _Counted:
    """What rclpy's two info objects have, which can be written in C only."""

    total_count = 0
    total_count_change = 0


class _Offered(_Counted, QoSOfferedDeadlineMissedInfo):
    """What a publisher's callback is given."""


class _Requested(_Counted, QoSRequestedDeadlineMissedInfo):
    """What a subscription's callback is given."""


class Deadline:
    """The deadline of one publisher or subscription.

    Args:
        handler: What rclpy has made of the learner's callback.
        endpoint: The publisher or subscription.
        period_ns: The longest time from one message to the next.

    Attributes:
        due: When it will be missed next, in nanoseconds; None before the first message.
        total: How often it was missed.
        untold: How many of these its callback has not been told of.
    """

    def __init__(self, handler: EventHandler, endpoint: Any, period_ns: int) -> None:  # noqa: ANN401
        self._endpoint, self._callback = endpoint.handle, handler.callback
        self._info = _Offered if "PUBLISHER" in handler.event_type.name else _Requested
        self._period = period_ns
        self.due: int | None = None
        self.total = self.untold = 0

    def heard(self, now: int) -> None:
        """A message has come: begin to count."""
        self.due = now + self._period

    def forget(self) -> None:
        """Wait for a message before anything is missed again."""
        self.due, self.untold = None, 0

    def miss(self) -> None:
        """It has passed."""
        assert self.due is not None
        self.due += self._period
        self.total += 1
        self.untold += 1

    def is_alive(self) -> bool:
        """Whether its endpoint has not been destroyed."""
        try:
            with self._endpoint:
                return True
        except InvalidHandle:
            return False

    def take(self, _: Entry, __: object) -> Work | None:
        """What the callback has not been told of; see `direct`."""
        if not self.untold:
            return None
        info = self._info()
        info.total_count, info.total_count_change = self.total, self.untold
        self.untold = 0
        return self._callback, (info,)


class Deadlines:
    """The deadlines of a session, in order of (when they pass, order of creation).

    A message moves its deadline later, which costs no more than a number: the heap learns of it
    when the earlier time has come.
    """

    def __init__(self) -> None:
        self._heap: list[tuple[int, int, Entry, Deadline]] = []
        self._known: list[tuple[Entry, Deadline]] = []

    def __bool__(self) -> bool:
        return bool(self._known)

    def add(self, entry: Entry, deadline: Deadline) -> Callable[[int], None]:
        """Count a deadline from now on.

        Returns:
            What is to be called at each message, with the time.
        """
        self._known.append((entry, deadline))

        def heard(now: int) -> None:
            begins = deadline.due is None
            deadline.heard(now)
            if begins:
                self._push(entry, deadline)

        return heard

    def next_due(self) -> int | None:
        """When the next one passes, in nanoseconds; None if none will."""
        heap = self._heap
        while heap:
            at, _, entry, deadline = heap[0]
            if entry.state.ended or not deadline.is_alive():
                heappop(heap)
                self._known.remove((entry, deadline))
            elif deadline.due != at:  # a message came, or all was forgotten
                heappop(heap)
                self._push(entry, deadline)
            else:
                return at
        return None

    def pass_next(self) -> Entry:
        """The next one passes; `next_due` has just been asked. Return whose callback is due."""
        _, _, entry, deadline = heappop(self._heap)
        deadline.miss()
        self._push(entry, deadline)
        return entry

    def look_anew(self) -> None:
        """Put everything in order again: a run was broken off."""
        self._heap.clear()
        for entry, deadline in self._known:
            self._push(entry, deadline)

    def forget(self) -> None:
        """Count nothing until further messages come: real time has taken over, or has ended."""
        self._heap.clear()
        for _, deadline in self._known:
            deadline.forget()

    def _push(self, entry: Entry, deadline: Deadline) -> None:
        if deadline.due is not None:
            heappush(self._heap, (deadline.due, entry.number, entry, deadline))
