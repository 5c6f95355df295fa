"""From a session to frames: what the browser is told, and how little of it."""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from rosbeat.panel.charts import Arrival, Chart
from rosbeat.panel.layout import layout
from rosbeat.records import NANOSECONDS, Fault, LogRecord
from rosbeat.viz.wiring import Wiring, wiring

if TYPE_CHECKING:
    from rosbeat.panel.instruments import SessionInstruments

#: Log lines that the panel keeps, and how many it puts into one frame.
KEPT_LINES, LINES_PER_FRAME = 500, 100

Line = tuple[float, str, str, str]


@dataclass(frozen=True)
class News:
    """Hold what happened in a session since the last look.

    Attributes:
        arrivals: One for each topic and publishing node that was heard.
        logs: The log lines.
        faults: The exceptions that ended nodes.
    """

    arrivals: tuple[Arrival, ...] = ()
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
        self._charts: dict[str, Chart] = {}
        self._changed: set[str] = set()
        self._lines: deque[Line] = deque(maxlen=KEPT_LINES)
        self._said = self._sent_lines = 0
        self._wiring: Wiring | None = None
        self._layout: dict[str, Any] = {}
        self._state: dict[str, Any] = {}
        self._sent_state: dict[str, Any] = {}

    def look(self) -> None:
        """Look at the session once."""
        news = self._instruments.news()
        for arrival in news.arrivals:
            topic = arrival.newest.topic
            self._charts.setdefault(topic, Chart()).add(arrival)
            self._changed.add(topic)
        for line in sorted([*map(_log_line, news.logs), *map(_fault_line, news.faults)]):
            self._lines.append(line)
            self._said += 1
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
        told = {name: chart for name, chart in self._charts.items() if self._is_told(name, whole)}
        frame: dict[str, Any] = {
            "whole": whole,
            "time": round(now, 3),
            "topics": {name: chart.news(now, whole) for name, chart in told.items()},
            **self._log(whole),
        }
        for part, state in self._state.items():
            if whole or self._sent_state.get(part) != state:
                frame[part] = state
        self._sent_state = dict(self._state)
        self._changed.clear()
        return frame

    def _is_told(self, topic: str, whole: bool) -> bool:
        """Whether a frame has something to say of a topic: for one that falls silent, its rate."""
        return whole or topic in self._changed or self._charts[topic].was_busy

    def _log(self, whole: bool) -> dict[str, Any]:
        new = len(self._lines) if whole else self._said - self._sent_lines
        taken = min(new, LINES_PER_FRAME if not whole else KEPT_LINES, len(self._lines))
        self._sent_lines = self._said
        lines = list(self._lines)[len(self._lines) - taken :]
        return {"log": lines, "left_out": new - taken} if lines else {}


def _log_line(record: LogRecord) -> Line:
    return round(record.time, 3), record.level, record.name, record.text


def _fault_line(fault: Fault) -> Line:
    name = fault.node.strip("/").replace("/", ".")
    where = f", line {fault.line}: {fault.code}" if fault.line else ""
    text = f"stopped in {fault.callback}: {fault.kind}: {fault.text}{where}"
    return round(fault.time, 3), "FATAL", name, text
