"""Simulated seconds per second, for a first publisher and subscriber that log."""

from __future__ import annotations

import time
from contextlib import redirect_stdout
from io import StringIO
from statistics import median

from actors import Monitor, Sensor
from measuring import Row

from rosbeat import Session

TARGET = 1_000


def measure(quick: bool) -> list[Row]:
    """Ten minutes at a time, printed as in a page."""
    spans = [_ten_minutes() for _ in range(3 if quick else 9)]
    rate = 600 / median(spans)
    return [
        Row("simulated seconds per second", f"{rate:,.0f}", "", f">= {TARGET:,}", rate >= TARGET)
    ]


def _ten_minutes() -> float:
    with Session(seed=1) as ros, redirect_stdout(StringIO()):
        ros.add(Sensor)
        ros.add(Monitor)
        begin = time.perf_counter()
        ros.run(600)
        span = time.perf_counter() - begin
        assert len(ros.logs()) == 1200
    return span
