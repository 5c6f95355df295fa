"""Decide what comes next: timers and sleepers by time, and programs that never let time pass.

This module knows neither rclpy nor greenlets. It orders whatever has a time, and counts.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Iterable
from heapq import heappop, heappush
from itertools import count
from typing import Protocol

from rosbeat.errors import EndlessChainError


class Timed(Protocol):
    """Describe what the schedule orders: a timer, or a call that waits until a time.

    Attributes:
        due_ns: When it is due, in nanoseconds; None while the schedule does not hold it.
        order: Which of several that are due at one instant comes first: the one that was set first.
    """

    due_ns: int | None
    order: int


class Periodic(Timed, Protocol):
    """Describe a timer."""

    @property
    def is_over(self) -> bool:
        """Return whether nothing can make it fire again."""

    def remaining_ns(self) -> int | None:
        """Return the nanoseconds until it is due; None while it is canceled or nobody spins it."""


class Named(Protocol):
    """Describe what has a name.

    Attributes:
        name: The name of a node.
    """

    name: str


class Schedule:
    """Order timers and sleepers by (time, order in which they were set).

    A timer only ever moves later without the schedule being told (a longer period, for example), so
    one that is popped too early is simply put back. A canceled timer is set aside, because a reset
    may bring it back. So each step costs the logarithm of the number of timers.

    An item may be in the heap several times; only the position at its own `due_ns` counts.
    """

    def __init__(self) -> None:
        # The count is there so that items themselves are never compared.
        self._heap: list[tuple[int, int, int, Timed]] = []
        self._count = count().__next__
        self._aside: list[Periodic] = []

    def add(self, item: Timed, due_ns: int) -> None:
        """Put something in its place."""
        item.due_ns = due_ns
        heappush(self._heap, (due_ns, item.order, self._count(), item))

    def add_timer(self, timer: Periodic, now: int) -> None:
        """Put a timer in its place; one that cannot fire now goes aside, or away for good."""
        timer.due_ns = None
        if timer.is_over:
            return
        remaining = timer.remaining_ns()
        if remaining is None:
            self._aside.append(timer)
        else:
            self.add(timer, now + max(0, remaining))

    def drop(self, item: Timed) -> None:
        """Forget something that is no longer due."""
        item.due_ns = None

    def next_due(self, now: int) -> int | None:
        """Return when the next item is due, in nanoseconds, or None if there is none."""
        if self._aside:
            waiting, self._aside = self._aside, []
            for timer in waiting:
                self.add_timer(timer, now)
        heap = self._heap
        while heap and heap[0][3].due_ns != heap[0][0]:
            heappop(heap)  # it was moved or dropped
        return heap[0][0] if heap else None

    def pop(self) -> Timed:
        """Take the first item off; `next_due` has just been asked."""
        item = heappop(self._heap)[3]
        item.due_ns = None
        return item

    def first(self) -> Timed:
        """Return the first item; `next_due` has just been asked."""
        return self._heap[0][3]

    def rebuild(
        self, timers: Iterable[Periodic], sleepers: Iterable[tuple[Timed, int]], now: int
    ) -> None:
        """Forget everything, and begin with these timers and sleepers."""
        self._heap, self._aside = [], []
        for timer in timers:
            self.add_timer(timer, now)
        for sleeper, due_ns in sleepers:
            self.add(sleeper, due_ns)


# Programs that never let time pass.


#: A message that causes a message that causes a message ... this many times, all at one instant.
LONGEST_CHAIN = 1_000
#: Callbacks that may follow from one timer, more than `SUSPICIOUS` steps after it. A circle that
#: doubles its messages at each step never gets deep, since there is ever more to do on the way.
MOST_FOLLOWERS = 100_000
#: Times that a timer may fire, or a call may go on, at one instant.
MOST_FIRINGS = 10_000
#: Steps that tasks may take at one instant.
MOST_TURNS = 100_000
#: From here on followers are counted: few programs ever come here, so it costs the others nothing.
SUSPICIOUS = 12
_TRAIL = 24


class ChainGuard:
    """Count how far each callback is from the timer that began its chain: its `depth`.

    A burst of messages is wide but not deep, so it is never mistaken for an endless chain.
    """

    def __init__(self) -> None:
        self.depth = 0
        self._firings = self._turns = 0
        self._followers = 0
        self._trail: deque[str] = deque(maxlen=_TRAIL)

    def instant_ends(self) -> None:
        """Forget the counts of this instant: time passes, so what happened before is no circle."""
        self._firings = self._followers = self._turns = 0

    def timer_fires(self, node: str, callback: str) -> None:
        """Begin a chain at a timer.

        Raises:
            EndlessChainError: If the timer keeps firing at one instant, because its period is zero.
        """
        self.depth = self._followers = 0
        self._firings += 1
        if self._firings > MOST_FIRINGS:
            self._firings = 0
            raise EndlessChainError(
                f"A timer of {node} fired {MOST_FIRINGS} times while no time passed.",
                f"The timer's period is zero, so `{callback}` is always due and virtual "
                "time cannot advance.",
                "Give create_timer a period above zero, in seconds.",
            )

    def wakes(self, name: str, callback: str, count: int) -> None:
        """Check a call that has gone on so many times at one instant.

        Raises:
            EndlessChainError: If calls go on without end at one instant.
        """
        if count > MOST_FIRINGS:
            raise EndlessChainError(
                f"{callback} of {name} waited {MOST_FIRINGS} times while no time passed.",
                "The call is in a loop, and each wait ends immediately: either its timeout is "
                "zero, or ROS has been shut down. On a real robot, the loop would keep a "
                "processor core busy forever.",
                "Wait with a timeout above zero, and leave the loop when `rclpy.ok()` is False.",
            )

    def turn(self, nodes: Iterable[Named]) -> None:
        """Check a task that takes another step, in the process of these nodes.

        Raises:
            EndlessChainError: If tasks take steps without end at one instant.
        """
        self._turns += 1
        if self._turns > MOST_TURNS:
            self._turns = 0
            listed = list(dict.fromkeys(node.name for node in nodes))
            raise EndlessChainError(
                f"Callbacks wait for each other endlessly: {', '.join(listed)}.",
                "Each callback continues whenever another one has run, so virtual time cannot "
                "advance.",
                "Break the loop: start each piece of work from a timer.",
            )

    def inspect(self, node: str, source: str) -> None:
        """Check the length and width of a callback's chain.

        This is called only more than `SUSPICIOUS` steps after a timer.

        Raises:
            EndlessChainError: If the chain is longer or wider than any that ends.
        """
        self._followers += 1
        if max(self.depth, self._followers) > LONGEST_CHAIN - _TRAIL:
            # Names are worth their time only now.
            self._trail.append(f"{node} ({source})")
            if self.depth > LONGEST_CHAIN or self._followers > MOST_FOLLOWERS:
                names = list(dict.fromkeys(self._trail))
                self.depth = self._followers = 0
                self._trail.clear()
                raise EndlessChainError(
                    "Callbacks trigger each other in an endless loop: "
                    f"{' -> '.join([*names, names[0]])}.",
                    "Each callback triggers the next one, so virtual time cannot advance. On a "
                    "real robot, these nodes would keep a processor core busy forever.",
                    "Break the loop: publish from a timer, or only when a value has changed.",
                )
