"""Measuring several ways of doing one thing in one run, turn by turn."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from statistics import median


@dataclass(frozen=True)
class Row:
    """One line of the table.

    Attributes:
        what: What was measured.
        value: The result, with its unit.
        ratio: Against what, and how much.
        target: What is wanted of it, or an empty string.
        met: Whether it is as wanted.
    """

    what: str
    value: str
    ratio: str = ""
    target: str = ""
    met: bool = True


def interleaved(ways: Mapping[str, Callable[[], None]], repeats: int) -> dict[str, float]:
    """Median seconds of each way; they take turns, so that a disturbance hits all alike."""
    times: dict[str, list[float]] = {name: [] for name in ways}
    for _ in range(repeats + 1):
        for name, way in ways.items():
            begin = time.perf_counter()
            way()
            times[name].append(time.perf_counter() - begin)
    return {name: median(spans[1:]) for name, spans in times.items()}  # the first turn warms up


def table(rows: list[Row]) -> str:
    """The rows as text, in columns."""
    cells = [("", "measured", "ratio", "target", "")]
    cells += [(r.what, r.value, r.ratio, r.target, _verdict(r)) for r in rows]
    widths = [max(len(row[column]) for row in cells) for column in range(5)]
    lines = [
        "  ".join(text.ljust(width) for text, width in zip(row, widths, strict=True))
        for row in cells
    ]
    return "\n".join(line.rstrip() for line in lines)


def _verdict(row: Row) -> str:
    return "" if not row.target else "met" if row.met else "MISSED"
