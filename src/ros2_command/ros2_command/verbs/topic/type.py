"""`ros2 topic type`."""

from __future__ import annotations

from argparse import ArgumentParser, Namespace

from ros2_command.graph import add_graph_arguments, open_graph
from ros2_command.lookup import pick


def add_arguments(parser: ArgumentParser) -> None:
    """A topic."""
    add_graph_arguments(parser)
    parser.add_argument("topic_name", help="Name of the ROS topic to get type (e.g. '/chatter')")


def main(args: Namespace) -> None:
    """Print the types of a topic."""
    with open_graph(args) as graph:
        topics = graph.settle().topics()
    _, types = pick(args.topic_name, topics, f"Unknown topic '{args.topic_name}'")
    print("\n".join(types))
