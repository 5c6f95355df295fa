"""`ros2 topic info`."""

from __future__ import annotations

from argparse import ArgumentParser, Namespace
from collections.abc import Sequence
from typing import Any

from ros2_command.graph import add_graph_arguments, open_graph
from ros2_command.lookup import pick


def add_arguments(parser: ArgumentParser) -> None:
    """A topic, and whether its endpoints are wanted."""
    add_graph_arguments(parser)
    parser.add_argument("topic_name", help="Name of the ROS topic to get info (e.g. '/chatter')")
    parser.add_argument(
        "-v", "--verbose", action="store_true",
        help="Prints detailed information like the node name, node namespace, topic type, "
        "topic type hash, topic endpoint type, GID and QoS Profile of the publishers and "
        "subscribers to this topic",
    )  # fmt: skip


def main(args: Namespace) -> None:
    """Print the types of a topic and its endpoints."""
    with open_graph(args) as graph:
        topics = graph.settle().topics()
        name, types = pick(args.topic_name, topics, f"Unknown topic '{args.topic_name}'")
        publishers = graph.others(graph.publishers(name))
        subscriptions = graph.others(graph.subscriptions(name))
    end = "\n\n" if args.verbose else "\n"
    print("Type:", types[0] if len(types) == 1 else types, end=end)
    print("Publisher count:", len(publishers), end=end)
    _show(publishers if args.verbose else ())
    print("Subscription count:", len(subscriptions), end=end)
    _show(subscriptions if args.verbose else ())


def _show(endpoints: Sequence[Any]) -> None:
    for one in endpoints:
        print(one, end="\n\n")
