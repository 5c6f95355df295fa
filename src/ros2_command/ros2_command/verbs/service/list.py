"""`ros2 service list`."""

from __future__ import annotations

from argparse import ArgumentParser, Namespace

from ros2_command.graph import add_graph_arguments, open_graph
from ros2_command.lookup import show_types
from ros2_command.names import is_hidden


def add_arguments(parser: ArgumentParser) -> None:
    """Which services, and how much about each."""
    add_graph_arguments(parser)
    add = parser.add_argument
    add("-t", "--show-types", action="store_true", help="Additionally show the service type")
    add("-c", "--count-services", action="store_true",
        help="Only display the number of services discovered")  # fmt: skip
    add("--include-hidden-services", action="store_true", help="Consider hidden services as well")


def main(args: Namespace) -> None:
    """Print the services of the graph."""
    with open_graph(args) as graph:
        found = graph.settle().services()
    own = f"/{graph.node_name}/"
    services = [
        (name, types) for name, types in found
        if not name.startswith(own) and (args.include_hidden_services or not is_hidden(name))
    ]  # fmt: skip
    if args.count_services:
        print(len(services))
        return
    for name, types in services:
        print(f"{name} {show_types(types)}" if args.show_types else name)
