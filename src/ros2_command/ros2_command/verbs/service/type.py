"""`ros2 service type`."""

from __future__ import annotations

from argparse import ArgumentParser, Namespace

from ros2_command.graph import open_graph
from ros2_command.lookup import pick


def add_arguments(parser: ArgumentParser) -> None:
    """A service."""
    parser.add_argument("service_name", help="Name of the ROS service to get type")


def main(args: Namespace) -> None:
    """Print the types of a service."""
    with open_graph(args) as graph:
        services = graph.settle().services()
    _, types = pick(args.service_name, services, f"Unknown service '{args.service_name}'")
    print("\n".join(types))
