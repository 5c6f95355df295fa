"""`ros2 topic bw`."""

from __future__ import annotations

import time
from argparse import ArgumentParser, Namespace
from collections import deque
from typing import Any

from ros2_command.graph import add_graph_arguments, open_graph
from ros2_command.listening import known_class, positive, subscribe

_UNITS = (("B", 1, 0), ("KB", 1_000, 2), ("MB", 1_000_000, 2), ("GB", 1_000_000_000, 2))


def add_arguments(parser: ArgumentParser) -> None:
    """A topic, and over how many messages to count."""
    parser.add_argument("topic_name", help="Topic name to monitor for bandwidth utilization")
    parser.add_argument(
        "--window", "-w", type=positive, default=100, metavar="WINDOW",
        help="maximum window size, in # of messages, for calculating rate (default: 100)",
    )  # fmt: skip
    add_graph_arguments(parser, daemon=False)


def report(arrivals: list[tuple[float, int]], now: float) -> str | None:
    """Two lines about messages, or None if there are too few.

    Args:
        arrivals: Time in seconds and size in bytes of each message.
        now: The present time.
    """
    if len(arrivals) < 2 or now <= arrivals[0][0]:
        return None
    sizes = [size for _, size in arrivals]
    rate = sum(sizes) / (now - arrivals[0][0])
    unit, factor, digits = [one for one in _UNITS if rate >= one[1] or one[1] == 1][-1]

    def show(size: float) -> str:
        return f"{size / factor:.{digits}f} {unit}"

    return (
        f"{show(rate)}/s from {len(sizes)} messages\n\tMessage size "
        f"mean: {show(sum(sizes) / len(sizes))} min: {show(min(sizes))} max: {show(max(sizes))}"
    )


def main(args: Namespace) -> None:
    """Print bytes per second each second, for ever."""
    from rclpy.qos import qos_profile_sensor_data

    arrivals: deque[tuple[float, int]] = deque(maxlen=args.window)

    def note(data: bytes, info: dict[str, Any]) -> None:
        arrivals.append((time.monotonic(), len(data)))

    with open_graph(args) as graph:
        kind = known_class(graph, args.topic_name)
        subscribe(graph, args.topic_name, kind, note, qos_profile_sensor_data, raw=True)
        print(f"Subscribed to [{args.topic_name}]")
        while True:
            graph.spin_for(1.0)
            if text := report(list(arrivals), time.monotonic()):
                print(text)
