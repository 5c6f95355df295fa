"""Programs that never let time pass."""

from __future__ import annotations

from collections import deque

from rosbeat.errors import EndlessChainError
from rosbeat.runtime.entities import Entry

#: A message that causes a message that causes a message ... this many times, all at one instant.
LONGEST_CHAIN = 1_000
#: Timers that may fire at one instant.
MOST_FIRINGS = 10_000
_TRAIL = 24
#: From here on the names are remembered, for the error.
SUSPICIOUS = LONGEST_CHAIN - _TRAIL


class ChainGuard:
    """Counts how far each callback is from the timer that began it all.

    A burst of messages is wide but not deep, so it is never mistaken for a circle.

    Attributes:
        depth: Steps from the timer to the callback that is running; 0 for the timer itself.
    """

    def __init__(self) -> None:
        self.depth = 0
        self._firings = 0
        self._trail: deque[str] = deque(maxlen=_TRAIL)

    def instant_ends(self) -> None:
        """Time passes, so whatever happened before is no circle."""
        self._firings = 0

    def timer_fires(self, entry: Entry) -> None:
        """A timer begins a chain.

        Raises:
            EndlessChainError: If timers fire without end at one instant (a period of zero).
        """
        self.depth = 0
        self._firings += 1
        if self._firings > MOST_FIRINGS:
            self._firings = 0
            raise EndlessChainError(
                f"A timer of {entry.state.name} fired {MOST_FIRINGS} times and no time passed.",
                f"Its period is zero, so `{entry.label.name}` is always due and the clock stands.",
                "Give create_timer a period above zero, in seconds.",
            )

    def inspect(self, entry: Entry) -> None:
        """A callback is about to run more than `SUSPICIOUS` steps after a timer.

        Raises:
            EndlessChainError: If the chain is longer than any that ends.
        """
        self._trail.append(f"{entry.state.name} ({entry.label.source})")
        if self.depth > LONGEST_CHAIN:
            self._refuse()

    def _refuse(self) -> None:
        names = list(dict.fromkeys(self._trail))
        self.depth = 0
        self._trail.clear()
        raise EndlessChainError(
            f"Messages go round without end: {' -> '.join([*names, names[0]])}.",
            "Each callback causes the next one, and no time passes between them, so the clock "
            "stands still. On a real robot these nodes would keep a processor core busy for ever.",
            "Break the circle: publish from a timer, or only if something has changed.",
        )
