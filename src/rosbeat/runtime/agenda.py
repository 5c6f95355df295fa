"""Which timer comes next."""

from __future__ import annotations

from heapq import heappop, heappush

from rclpy.exceptions import InvalidHandle

from rosbeat.runtime.entities import Entry


class Agenda:
    """The timers of all nodes, ordered by (deadline, order of creation).

    A deadline only ever moves later without the agenda being told (a longer period, say), so an
    entry that is looked at too early is simply put back. A canceled timer waits aside: a reset may
    bring it back. So each step costs the logarithm of the number of timers, not the number.

    An entry may be in the heap several times; only the place at its own `deadline` counts.
    """

    def __init__(self) -> None:
        self._heap: list[tuple[int, int, Entry]] = []
        self._aside: list[Entry] = []

    def add(self, entry: Entry, now: int) -> None:
        """Put a timer in its place; one that cannot fire now goes aside, or away for good."""
        entry.deadline = None
        if entry.state.ended:
            return
        handle = entry.handle
        try:
            with handle:
                if not entry.state.spinning or handle.is_timer_canceled():
                    self._aside.append(entry)
                    return
                wait = handle.time_until_next_call()
        except InvalidHandle:
            return  # destroyed: nobody can bring it back
        entry.deadline = now + max(0, wait)
        heappush(self._heap, (entry.deadline, entry.number, entry))

    def move(self, entry: Entry, now: int) -> None:
        """A timer was reset, so its deadline may have come nearer."""
        if entry.deadline is not None:
            self.add(entry, now)

    def next_deadline(self, now: int) -> int | None:
        """When the next timer is due, in nanoseconds, or None if there is none."""
        if self._aside:
            self._bring_back(now)
        heap = self._heap
        while heap and heap[0][2].deadline != heap[0][0]:
            heappop(heap)  # it was moved
        return heap[0][0] if heap else None

    def pop(self) -> Entry:
        """Take the first timer off the agenda; `next_deadline` has just been asked."""
        entry = heappop(self._heap)[2]
        entry.deadline = None
        return entry

    def rebuild(self, entries: list[Entry], now: int) -> None:
        """Forget everything and begin with these timers."""
        self._heap, self._aside = [], []
        for entry in entries:
            self.add(entry, now)

    def _bring_back(self, now: int) -> None:
        waiting, self._aside = self._aside, []
        for entry in waiting:
            self.add(entry, now)
