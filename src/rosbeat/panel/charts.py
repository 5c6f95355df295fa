"""What is drawn of one topic: its newest value, how many came, and half a minute of points."""

from __future__ import annotations

from collections import Counter, deque
from dataclasses import dataclass
from math import isfinite
from typing import Any

from rosbeat.records import NANOSECONDS, Sample
from rosbeat.viz.sources import paths
from rosbeat.viz.words import rounded

#: Seconds of the strip chart, and points that it has room for: one for each look.
SPAN, POINTS = 30.0, 640
#: Seconds over which a rate is counted.
_RATE_SPAN = 2.0
_LONGEST = 120

Point = tuple[float, float | None]


@dataclass(frozen=True)
class Arrival:
    """Hold what came from one node on one topic since the last look.

    Attributes:
        count: How many messages.
        newest: The last of them.
    """

    count: int
    newest: Sample


class Chart:
    """Collect the recent messages on one topic for the panel.

    Attributes:
        total: Number of messages since the session began.
        text: The newest message, as text.
        field: Name of the field that is drawn; empty if it is the only one.
        since: Number of messages of each node since the last frame.
        was_busy: Whether the last frame told the browser that messages arrive.
    """

    def __init__(self) -> None:
        self.total = 0
        self.text = self.field = ""
        self.since: Counter[str] = Counter()
        self.was_busy = False
        self._points: deque[Point] = deque(maxlen=POINTS)
        self._added = self._sent = 0
        self._counts: deque[tuple[float, int]] = deque()

    def add(self, arrival: Arrival) -> None:
        """Take note of what came from one node."""
        newest = arrival.newest
        self.total += arrival.count
        self.since[newest.node] += arrival.count
        self.field, value = _number(newest.data)
        self.text = _words(value, newest.value)
        if value is not None:
            drawn = float(value) if isfinite(value) else None
            self._points.append((round(newest.time_ns / NANOSECONDS, 3), drawn))
            self._added += 1

    def rate(self, now: float) -> float:
        """Return the recent message rate, in messages per second.

        Args:
            now: Seconds since the session began.
        """
        self._counts.append((now, self.total))
        while len(self._counts) > 2 and self._counts[1][0] <= now - _RATE_SPAN:
            self._counts.popleft()
        begin, before = self._counts[0]
        return (self.total - before) / (now - begin) if now > begin else 0.0

    def news(self, now: float, whole: bool) -> dict[str, Any]:
        """Return what the browser does not know yet, as JSON-compatible data, and mark it as known.

        Args:
            now: Seconds since the session began.
            whole: Whether to return everything rather than only what is new.
        """
        count = len(self._points) if whole else min(self._added - self._sent, len(self._points))
        points = list(self._points)[len(self._points) - count :]
        rate = round(self.rate(now), 1)
        found = {
            "total": self.total,
            "text": self.text,
            "field": self.field,
            "rate": rate,
            "points": [point for point in points if point[0] >= now - SPAN],
            "from": dict(self.since),
        }
        self._sent, self.was_busy = self._added, rate > 0
        self.since.clear()
        return found


def _number(data: dict[str, Any]) -> tuple[str, float | None]:
    """The first number of a message that is not in its header, with its path."""
    for name, value in paths(data):
        if isinstance(value, bool | int | float) and not name.startswith("header."):
            return name if len(data) > 1 else "", value
    return "", None


def _words(value: float | None, whole: Any) -> str:  # noqa: ANN401 - any plain value
    if isinstance(whole, bool) or value is None:
        text = whole if isinstance(whole, str) else repr(whole)
        return text if len(text) <= _LONGEST else f"{text[: _LONGEST - 1]}…"
    return rounded(value)
