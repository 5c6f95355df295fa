"""Cost of an event against the number of nodes."""

from __future__ import annotations

import time
from functools import partial
from math import log
from statistics import linear_regression, median

from actors import Neighbour
from measuring import Row

from rosbeat import Session

NODES = (1, 2, 5, 10, 20, 50, 100, 200)
#: A square in the total would be 1 here; a logarithm looks like about 0.1.
TARGET = 0.3


def measure(quick: bool) -> list[Row]:
    """Microseconds per callback; the exponent is the slope in a double logarithmic plot."""
    counts = NODES[:6] if quick else NODES
    costs = [_cost(count, 3 if quick else 5) for count in counts]
    points = zip(counts, costs, strict=True)
    rows = [Row(f"us per callback, {count:3} nodes", f"{cost:.1f}") for count, cost in points]
    slope = linear_regression([log(n) for n in counts], [log(c) for c in costs]).slope
    verdict = slope <= TARGET
    rows.append(
        Row("exponent of the cost per callback", f"{slope:.2f}", "", f"<= {TARGET}", verdict)
    )
    return rows


def _cost(count: int, repeats: int) -> float:
    with Session() as ros:
        for number in range(count):
            ros.add(partial(Neighbour, number, count))
        seconds = 200 / count + 0.2
        ros.run(0.2)
        return median(_turn(ros, seconds) for _ in range(repeats))


def _turn(ros: Session, seconds: float) -> float:
    before = _callbacks(ros)
    begin = time.perf_counter()
    ros.run(seconds, quiet=True)
    span = time.perf_counter() - begin
    return span / (_callbacks(ros) - before) * 1e6


def _callbacks(ros: Session) -> int:
    # Each node hears as often as its neighbour publishes, so callbacks are twice the messages.
    return 2 * sum(node.heard for node in ros.nodes)
