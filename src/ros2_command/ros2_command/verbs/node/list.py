"""`ros2 node list`."""

from __future__ import annotations

import sys
from argparse import ArgumentParser, Namespace

from ros2_command.graph import add_graph_arguments, open_graph

SHARED_NAME = (
    "WARNING: Be aware that there are nodes in the graph that share an exact name, "
    "which can have unintended side effects."
)


def add_arguments(parser: ArgumentParser) -> None:
    """Which nodes, and whether only their number."""
    add_graph_arguments(parser)
    parser.add_argument(
        "-a", "--all", action="store_true", help="Display all nodes even hidden ones"
    )
    parser.add_argument(
        "-c",
        "--count-nodes",
        action="store_true",
        help="Only display the number of nodes discovered",
    )


def main(args: Namespace) -> None:
    """Print the nodes of the graph."""
    with open_graph(args) as graph:
        names = graph.settle(names_only=True).nodes(hidden=args.all)
    if args.count_nodes:
        print(len(names))
        return
    if len(set(names)) < len(names):
        print(SHARED_NAME, file=sys.stderr)
    for name in names:
        print(name)
