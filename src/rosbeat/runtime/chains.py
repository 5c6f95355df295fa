"""Programs that never let time pass."""

from __future__ import annotations

from collections import deque

from rosbeat.errors import EndlessChainError
from rosbeat.runtime.entities import Entry

#: A message that causes a message that causes a message ... this many times, all at one instant.
LONGEST_CHAIN = 1_000
#: Callbacks that may follow from one timer, more than `SUSPICIOUS` steps after it. A circle that
#: doubles its messages at each step never gets deep, since there is ever more to do on the way.
MOST_FOLLOWERS = 100_000
#: Timers that may fire at one instant.
MOST_FIRINGS = 10_000
#: Turns that coroutines and tasks may get at one instant.
MOST_TURNS = 10_000
#: From here on followers are counted: few programs ever come here, so it costs the others nothing.
SUSPICIOUS = 12
_TRAIL = 24


class ChainGuard:
    """Counts how far each callback is from the timer that began it all.

    A burst of messages is wide but not deep, so it is never mistaken for a circle.

    Attributes:
        depth: Steps from the timer to the callback that is running; 0 for the timer itself.
    """

    def __init__(self) -> None:
        self.depth = 0
        self._firings = 0
        self._followers = 0
        self._trail: deque[str] = deque(maxlen=_TRAIL)

    def instant_ends(self) -> None:
        """Time passes, so whatever happened before is no circle."""
        self._firings = self._followers = 0

    def timer_fires(self, entry: Entry) -> None:
        """A timer begins a chain.

        Raises:
            EndlessChainError: If timers fire without end at one instant (a period of zero).
        """
        self.depth = self._followers = 0
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
            EndlessChainError: If the chain is longer or wider than any that ends.
        """
        self._followers += 1
        if max(self.depth, self._followers) > LONGEST_CHAIN - _TRAIL:
            # Names are worth their time only now.
            self._trail.append(f"{entry.state.name} ({entry.label.source})")
            if self.depth > LONGEST_CHAIN or self._followers > MOST_FOLLOWERS:
                raise self._refusal()

    def turns_without_end(self, names: list[str]) -> EndlessChainError:
        """The error for coroutines and tasks that keep one another busy for ever."""
        return EndlessChainError(
            f"Callbacks wait for each other without end: {', '.join(names)}.",
            "Each gets further whenever another has run, and no time passes meanwhile.",
            "Break the circle: begin each piece of work from a timer.",
        )

    def _refusal(self) -> EndlessChainError:
        names = list(dict.fromkeys(self._trail))
        self.depth = self._followers = 0
        self._trail.clear()
        return EndlessChainError(
            f"Messages go round without end: {' -> '.join([*names, names[0]])}.",
            "Each callback causes the next one, and no time passes between them, so the clock "
            "stands still. On a real robot these nodes would keep a processor core busy for ever.",
            "Break the circle: publish from a timer, or only if something has changed.",
        )
