"""`ros2 topic hz`."""

from __future__ import annotations

import math
import time
from argparse import ArgumentParser, Namespace
from collections import deque
from collections.abc import Callable
from typing import Any

from ros2_command.graph import add_graph_arguments, open_graph
from ros2_command.listening import compile_filter, known_class, positive, subscribe
from ros2_command.untyped import Untyped


def add_arguments(parser: ArgumentParser) -> None:
    """A topic, and over how many messages to count."""
    add = parser.add_argument
    add("topic_name", help="Name of the ROS topic to listen to (e.g. '/chatter')")
    add("--window", "-w", type=positive, default=10000, metavar="WINDOW",
        help="window size, in # of messages, for calculating rate (default: 10000)")  # fmt: skip
    add("--filter", dest="filter_expr", metavar="EXPR",
        help="only measure messages matching the specified Python expression")  # fmt: skip
    add("--wall-time", action="store_true", help="calculates rate using wall time")
    add_graph_arguments(parser, daemon=False)


class Rates:
    """Intervals between messages.

    Args:
        window: How many intervals to keep.
    """

    def __init__(self, window: int) -> None:
        self._intervals: deque[float] = deque(maxlen=window)
        self._last: float | None = None
        self._news = False

    def arrived(self, now: float) -> None:
        """A message came, at this time in seconds."""
        if self._last is not None:
            self._intervals.append(now - self._last)
            self._news = True
        self._last = now

    def report(self) -> str | None:
        """Two lines, or None if nothing has come since the last report."""
        count = len(self._intervals)
        if not self._news or not count:
            return None
        self._news = False
        mean = sum(self._intervals) / count
        deviation = math.sqrt(sum((one - mean) ** 2 for one in self._intervals) / count)
        rate = 1 / mean if mean else 0.0
        return (
            f"average rate: {rate:.3f}\n\tmin: {min(self._intervals):.3f}s "
            f"max: {max(self._intervals):.3f}s std dev: {deviation:.5f}s window: {count + 1}"
        )


def main(args: Namespace) -> None:
    """Print the rate each second, for ever."""
    wanted = compile_filter(args.filter_expr)
    rates = Rates(args.window)
    with open_graph(args) as graph:
        kind = known_class(graph, args.topic_name)
        clock = _clock(args, graph.node)

        def count(message: Untyped, info: dict[str, Any]) -> None:
            if wanted(message):
                rates.arrived(clock())

        subscribe(graph, args.topic_name, kind, count, _profile())
        while True:
            graph.spin_for(1.0)
            if text := rates.report():
                print(text)


def _clock(args: Namespace, node: Untyped) -> Callable[[], float]:
    if args.use_sim_time and not args.wall_time:
        return lambda: float(node.get_clock().now().nanoseconds) / 1e9
    return time.monotonic


def _profile() -> Untyped:
    from rclpy.qos import qos_profile_sensor_data

    return qos_profile_sensor_data
