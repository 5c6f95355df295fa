"""`ros2 topic find`."""

from __future__ import annotations

from argparse import ArgumentParser, Namespace

from ros2_command.graph import add_graph_arguments, open_graph
from ros2_command.names import is_hidden


def add_arguments(parser: ArgumentParser) -> None:
    """A type, and whether only the number is wanted."""
    add_graph_arguments(parser)
    add = parser.add_argument
    add("topic_type", help="Name of the ROS topic type to filter for (e.g. 'std_msgs/msg/String')")
    add("-c", "--count-topics", action="store_true",
        help="Only display the number of topics discovered")  # fmt: skip
    add("--include-hidden-topics", action="store_true", help="Consider hidden topics as well")


def main(args: Namespace) -> None:
    """Print the topics of a type."""
    with open_graph(args) as graph:
        topics = graph.settle().topics()
    found = [
        name for name, types in topics
        if args.topic_type in types and (args.include_hidden_topics or not is_hidden(name))
    ]  # fmt: skip
    for line in [len(found)] if args.count_topics else found:
        print(line)
