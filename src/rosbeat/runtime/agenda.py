"""Which timer comes next."""

from __future__ import annotations

from heapq import heappop, heappush

from rclpy.clock import ClockType
from rclpy.exceptions import InvalidHandle

from rosbeat.runtime.entities import Entry


def is_virtual(entry: Entry) -> bool:
    """Whether a timer counts ROS time; one on a steady or system clock cannot be simulated."""
    virtual: bool = entry.entity.clock.clock_type == ClockType.ROS_TIME
    return virtual


class Agenda:
    """The timers of all nodes, ordered by (deadline, order of creation).

    A deadline only ever moves later without being called (a reset, a longer period), so an entry
    that is looked at too early is simply put back. A canceled timer waits aside: a reset may bring
    it back. So each step costs the logarithm of the number of timers, not the number.
    """

    def __init__(self) -> None:
        self._heap: list[tuple[int, int, Entry]] = []
        self._aside: list[Entry] = []

    def add(self, entry: Entry, now: int) -> None:
        """Put a timer in its place; one that cannot fire now goes aside, or away for good."""
        if entry.state.ended:
            return
        handle = entry.entity.handle
        try:
            with handle:
                if not entry.state.spinning or handle.is_timer_canceled():
                    self._aside.append(entry)
                    return
                wait = handle.time_until_next_call()
        except InvalidHandle:
            return  # destroyed: nobody can bring it back
        heappush(self._heap, (now + max(0, wait), entry.number, entry))

    def next_deadline(self, now: int) -> int | None:
        """When the next timer is due, in nanoseconds, or None if there is none."""
        if self._aside:
            self._bring_back(now)
        return self._heap[0][0] if self._heap else None

    def pop(self) -> Entry:
        """Take the first timer off the agenda."""
        return heappop(self._heap)[2]

    def rebuild(self, entries: list[Entry], now: int) -> None:
        """Forget everything and begin with these timers."""
        self._heap, self._aside = [], []
        for entry in entries:
            self.add(entry, now)

    def _bring_back(self, now: int) -> None:
        waiting, self._aside = self._aside, []
        for entry in waiting:
            self.add(entry, now)
