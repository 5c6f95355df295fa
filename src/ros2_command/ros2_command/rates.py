"""Compute what `ros2 topic hz`, `bw` and `delay` print about the messages that they receive."""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Sequence

_UNITS = (("B", 1, 0), ("KB", 1_000, 2), ("MB", 1_000_000, 2), ("GB", 1_000_000_000, 2))


def _statistics(name: str, values: Sequence[float], average: float, window: int) -> str:
    mean = sum(values) / len(values)
    deviation = math.sqrt(sum((one - mean) ** 2 for one in values) / len(values))
    return (
        f"average {name}: {average:.3f}\n\tmin: {min(values):.3f}s max: {max(values):.3f}s "
        f"std dev: {deviation:.5f}s window: {window}"
    )


class Rates:
    """Measure the intervals between messages.

    Args:
        window: How many intervals to keep.
    """

    def __init__(self, window: int) -> None:
        self._intervals: deque[float] = deque(maxlen=window)
        self._last: float | None = None
        self._news = False

    def arrived(self, now: float) -> None:
        """Count a message that came at this time in seconds."""
        if self._last is not None:
            self._intervals.append(now - self._last)
            self._news = True
        self._last = now

    def report(self) -> str | None:
        """Return two lines, or None if nothing has come since the last report."""
        count = len(self._intervals)
        if not self._news or not count:
            return None
        self._news = False
        mean = sum(self._intervals) / count
        return _statistics("rate", self._intervals, 1 / mean if mean else 0.0, count + 1)


class Delays:
    """Measure how long after their stamps messages arrive.

    Args:
        window: How many delays to keep.
    """

    def __init__(self, window: int) -> None:
        self._delays: deque[float] = deque(maxlen=window)
        self._last: float | None = None
        self._news = False

    def arrived(self, now: float, stamp: float) -> None:
        """Count a message that came at this time and bears this stamp, both in seconds.

        The first one only starts the clock, as in the original; so does one from an earlier time.
        """
        if self._last is None or now < self._last:
            self._delays.clear()
        else:
            self._delays.append(now - stamp)
            self._news = True
        self._last = now

    def report(self) -> str | None:
        """Return two lines, or None if nothing has come since the last report."""
        if not self._news:
            return None
        self._news = False
        mean = sum(self._delays) / len(self._delays)
        return _statistics("delay", self._delays, mean, len(self._delays))


class Bandwidth:
    """Measure bytes per second.

    Args:
        window: How many messages to keep.
    """

    def __init__(self, window: int) -> None:
        self._arrivals: deque[tuple[float, int]] = deque(maxlen=window)

    def arrived(self, now: float, size: int) -> None:
        """Count a message of so many bytes that came at this time in seconds."""
        self._arrivals.append((now, size))

    def report(self, now: float) -> str | None:
        """Return two lines, or None if there are too few messages."""
        if len(self._arrivals) < 2:
            return None
        if now <= self._arrivals[0][0]:  # time went back
            self._arrivals.clear()
            return None
        sizes = [size for _, size in self._arrivals]
        rate = sum(sizes) / (now - self._arrivals[0][0])
        unit, factor, digits = [one for one in _UNITS if rate >= one[1] or one[1] == 1][-1]

        def show(size: float) -> str:
            return f"{size / factor:.{digits}f} {unit}"

        return (
            f"{show(rate)}/s from {len(sizes)} messages\n\tMessage size "
            f"mean: {show(sum(sizes) / len(sizes))} min: {show(min(sizes))} max: {show(max(sizes))}"
        )
