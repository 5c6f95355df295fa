"""Sample a session for the panel, and send the browser as little as possible."""

from __future__ import annotations

from collections import Counter, deque
from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from math import isfinite
from typing import TYPE_CHECKING, Any

from rosbeat.records import NANOSECONDS, Fault, LogRecord, Sample
from rosbeat.viz import theme
from rosbeat.viz.arguments import paths
from rosbeat.viz.graphs import (
    Arrangement,
    Marked,
    Wiring,
    arrange,
    describe,
    node_key,
    topic_key,
    wiring,
)
from rosbeat.viz.text_format import rounded

if TYPE_CHECKING:
    from rosbeat.panel.session_adapter import SessionInstruments

#: Seconds of the strip chart, and points that it has room for: one for each look.
SPAN, POINTS = 30.0, 640
#: Seconds over which a rate is counted.
_RATE_SPAN = 2.0
#: The longest text of a message, in characters.
_LONGEST = 120
#: Log lines that the panel keeps, and how many it puts into one frame.
KEPT_LINES, LINES_PER_FRAME = 500, 100

#: Types of message that a slider can publish, and whose numbers a fault can change.
NUMERIC_TYPES = frozenset({"std_msgs/msg/Float32", "std_msgs/msg/Float64"})

#: A place in the graph, in CSS pixels along and across the flow; a time and a number in a chart.
Place = tuple[float, float]
Point = tuple[float, float | None]
Line = tuple[float, str, str, str]


@dataclass(frozen=True)
class News:
    """Hold what happened in a session since the last look.

    Attributes:
        arrivals: For each topic and publishing node, how many messages came, and the last one.
        logs: The log lines.
        faults: The exceptions that ended nodes.
    """

    arrivals: tuple[tuple[int, Sample], ...] = ()
    logs: tuple[LogRecord, ...] = ()
    faults: tuple[Fault, ...] = ()


class Sampler:
    """Sample a session, and buffer what the panel draws.

    Sampling neither slows the session down nor affects its records: each sample reads what was
    recorded since the previous one, and keeps at most one point per publisher.

    Args:
        instruments: The session's instruments.
    """

    def __init__(self, instruments: SessionInstruments) -> None:
        self._instruments = instruments
        self._charts: dict[str, TopicChart] = {}
        self._lines: deque[Line] = deque(maxlen=KEPT_LINES)
        self._new_lines: deque[Line] = deque(maxlen=LINES_PER_FRAME)
        self._new_count = 0
        self._wiring: Wiring | None = None
        self._layout: dict[str, Any] = {}
        self._state: dict[str, Any] = {}
        self._sent_state: dict[str, Any] = {}

    def look(self) -> None:
        """Look at the session once."""
        news = self._instruments.news()
        for count, newest in news.arrivals:
            self._charts.setdefault(newest.topic, TopicChart()).add(count, newest)
        lines = sorted([*map(_log_line, news.logs), *map(_fault_line, news.faults)])
        self._lines.extend(lines)
        self._new_lines.extend(lines)
        self._new_count += len(lines)
        shown = wiring(self._instruments.graph())
        if shown != self._wiring:
            self._wiring, self._layout = shown, layout(shown)
        self._state = {
            "live": self._instruments.is_live(),
            "nodes": self._instruments.conditions(),
            "graph": self._layout,
        }

    def frame(self, whole: bool) -> dict[str, Any]:
        """Return what the browser does not know yet, as JSON-compatible data.

        Args:
            whole: Whether to return everything, for a browser that has no state yet.
        """
        now = self._instruments.now_ns() / NANOSECONDS
        charts = self._charts.items()
        frame: dict[str, Any] = {
            "whole": whole,
            "time": round(now, 3),
            "topics": {
                name: chart.news(now, whole) for name, chart in charts if whole or chart.has_news
            },
            **self._log(whole),
        }
        for part, state in self._state.items():
            if whole or self._sent_state.get(part) != state:
                frame[part] = state
        self._sent_state = dict(self._state)
        return frame

    def _log(self, whole: bool) -> dict[str, Any]:
        lines = list(self._lines if whole else self._new_lines)
        left_out = 0 if whole else self._new_count - len(lines)
        self._new_lines.clear()
        self._new_count = 0
        return {"log": lines, "left_out": left_out} if lines else {}


def _log_line(record: LogRecord) -> Line:
    return round(record.time, 3), record.level, record.name, record.text


def _fault_line(fault: Fault) -> Line:
    name = fault.node.strip("/").replace("/", ".")
    where = f", line {fault.line}: {fault.code}" if fault.line else ""
    text = f"stopped in {fault.callback}: {fault.kind}: {fault.text}{where}"
    return round(fault.time, 3), "FATAL", name, text


# One topic.


class TopicChart:
    """Collect the recent messages on one topic for the panel.

    Attributes:
        has_news: Whether the browser has something to hear of this topic; of one that falls silent
            it hears once more, for its rate.
    """

    def __init__(self) -> None:
        self.has_news = False
        self._total = 0
        self._text = self._field = ""
        self._from: Counter[str] = Counter()
        self._points: deque[Point] = deque(maxlen=POINTS)
        self._new_points: deque[Point] = deque(maxlen=POINTS)
        self._totals: deque[tuple[float, int]] = deque()

    def add(self, count: int, newest: Sample) -> None:
        """Take note of what came from one node.

        Args:
            count: Number of messages.
            newest: The last of them, the only one that is drawn.
        """
        self.has_news = True
        self._total += count
        self._from[newest.node] += count
        self._field, value = _number(newest.data)
        self._text = _words(value, newest.value)
        if value is not None:
            drawn = float(value) if isfinite(value) else None
            point = (round(newest.time_ns / NANOSECONDS, 3), drawn)
            self._points.append(point)
            self._new_points.append(point)

    def news(self, now: float, whole: bool) -> dict[str, Any]:
        """Return what the browser does not know yet, as JSON-compatible data, and mark it as known.

        Args:
            now: Seconds since the session began.
            whole: Whether to return everything rather than only what is new.
        """
        points = self._points if whole else self._new_points
        rate = round(self._rate(now), 1)
        found = {
            "total": self._total,
            "text": self._text,
            "field": self._field,
            "rate": rate,
            "points": [point for point in points if point[0] >= now - SPAN],
            "from": dict(self._from),
        }
        self._new_points.clear()
        self._from.clear()
        self.has_news = rate > 0
        return found

    def _rate(self, now: float) -> float:
        """Messages per second, over the last seconds."""
        self._totals.append((now, self._total))
        while len(self._totals) > 2 and self._totals[1][0] <= now - _RATE_SPAN:
            self._totals.popleft()
        begin, before = self._totals[0]
        return (self._total - before) / (now - begin) if now > begin else 0.0


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


# The graph: the layout of the pictures, as numbers.


def layout(shown: Wiring) -> dict[str, Any]:
    """Place a graph.

    Args:
        shown: The graph.

    Returns:
        `width` and `height` in CSS pixels; `boxes` with key, kind, name, lines of text, how many
        of them, from the top, are the name (`rows`), and place; `edges` with the keys of their
        ends, what is wrong there, and the path as SVG writes it; `words` that say the same.
    """
    shown = replace(shown, offers=())
    arranged = arrange(Marked(shown, shown))
    width, height = arranged.size
    names = {node_key(name): name for name in shown.nodes}
    names.update((topic_key(name), name) for name in shown.topics)
    return {
        "width": round(max(width, 1) + 2 * theme.MARGIN, 1),
        "height": round(max(height, 1) + 2 * theme.MARGIN, 1),
        "boxes": [_box(arranged, key, names[key]) for key in arranged.placement.boxes],
        "edges": _edges(shown, arranged),
        "numeric": [name for name, types in shown.topics.items() if NUMERIC_TYPES & set(types)],
        "words": describe(shown),
    }


def _box(arranged: Arrangement, key: str, name: str) -> dict[str, Any]:
    label, box = arranged.labels[key], arranged.placement.boxes[key]
    x, y = arranged.at((box.along, box.across))
    width, height = arranged.at((box.length, box.breadth))
    return {
        "key": key,
        "kind": "node" if label.is_node else "topic",
        "name": name,
        "lines": [line.words for line in label.lines],
        "rows": sum(line.colour == theme.INK for line in label.lines),
        "broken": label.broken,
        "x": round(x + theme.MARGIN, 1),
        "y": round(y + theme.MARGIN, 1),
        "w": round(width, 1),
        "h": round(height, 1),
    }


def _edges(shown: Wiring, arranged: Arrangement) -> list[dict[str, str]]:
    found, placed = [], arranged.placement
    for edge in shown.edges:
        link = (edge.source, edge.target)
        around = link not in placed.routes
        points = placed.returns[link] if around else placed.routes[link]
        path = _straight if around else _smooth
        words = {"from": edge.source, "to": edge.target, "fault": edge.fault}
        found.append({**words, "path": path(points, arranged)})
    return found


def _smooth(points: Sequence[Place], arranged: Arrangement) -> str:
    """Return a line that runs along the flow at each of its points."""
    parts = [f"M{_at(points[0], arranged)}"]
    for (begin, first), (end, last) in pairwise(points):
        middle = (begin + end) / 2
        corners = ((middle, first), (middle, last), (end, last))
        parts.append("C" + " ".join(_at(one, arranged) for one in corners))
    return "".join(parts)


def _straight(points: Sequence[Place], arranged: Arrangement) -> str:
    return "M" + "L".join(_at(point, arranged) for point in points)


def _at(point: Place, arranged: Arrangement) -> str:
    x, y = arranged.at(point)
    return f"{x + theme.MARGIN:.1f},{y + theme.MARGIN:.1f}"
