"""Cost of an event against the number of nodes, and of timers."""

from __future__ import annotations

import time
from functools import partial
from math import log
from statistics import linear_regression, median

from actors import Neighbour
from measuring import Row
from rclpy.node import Node

from rosbeat import Session

NODES = (1, 2, 5, 10, 20, 50, 100, 200)
TIMERS, _EACH = (100, 1_000, 10_000), 50
#: A square in the total would be 1 here; a logarithm looks like about 0.1.
TARGET = 0.3


def measure(quick: bool) -> list[Row]:
    """Microseconds per callback; the exponent is the slope in a double logarithmic plot."""
    counts = NODES[:6] if quick else NODES
    costs = [_cost(count, 3 if quick else 5) for count in counts]
    points = zip(counts, costs, strict=True)
    rows = [Row(f"us per callback, {count:3} nodes", f"{cost:.1f}") for count, cost in points]
    slope = linear_regression([log(n) for n in counts], [log(c) for c in costs]).slope
    rows.append(_judged("exponent of the cost per callback", slope))
    return [*rows, *_timers(quick)]


def _timers(quick: bool) -> list[Row]:
    """The same against the number of timers: 50 in each node, each node a process."""
    counts = TIMERS[:2] if quick else TIMERS
    costs = [_timer_cost(count, 3 if quick else 5) for count in counts]
    rows = [
        Row(f"us per callback, {count:6,} timers", f"{cost:.1f}")
        for count, cost in zip(counts, costs, strict=True)
    ]
    slope = linear_regression([log(n) for n in counts], [log(c) for c in costs]).slope
    return [*rows, _judged("exponent of the cost per timer", slope)]


def _judged(title: str, slope: float) -> Row:
    return Row(title, f"{slope:.2f}", "", f"<= {TARGET}", slope <= TARGET)


class _Clockwork(Node):
    """Has 50 timers, of periods between 1 and 2 s."""

    def __init__(self, number: int) -> None:
        super().__init__(f"clockwork_{number}", start_parameter_services=False)
        self.ticks = 0
        for k in range(_EACH):
            self.create_timer(1 + k / _EACH + number / 1e5, self._tick)

    def _tick(self) -> None:
        self.ticks += 1


def _timer_cost(count: int, repeats: int) -> float:
    with Session() as ros:
        nodes = [ros.add(partial(_Clockwork, number)) for number in range(count // _EACH)]
        ros.run(0.2)

        def turn() -> float:
            before = sum(node.ticks for node in nodes)
            begin = time.perf_counter()
            ros.run(20_000 / count, quiet=True)
            span = time.perf_counter() - begin
            return span / (sum(node.ticks for node in nodes) - before) * 1e6

        return median(turn() for _ in range(repeats))


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
