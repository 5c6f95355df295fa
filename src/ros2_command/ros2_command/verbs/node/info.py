"""`ros2 node info`."""

from __future__ import annotations

import sys
from argparse import ArgumentParser, Namespace
from typing import Any

from ros2_command.graph import Graph, add_graph_arguments, open_graph
from ros2_command.lookup import find_node
from ros2_command.names import is_hidden

Entries = list[tuple[str, list[str]]]


def add_arguments(parser: ArgumentParser) -> None:
    """A node."""
    add_graph_arguments(parser)
    parser.add_argument("node_name", help="Node name to request information")
    parser.add_argument(
        "--include-hidden", action="store_true",
        help="Display hidden topics, services, and actions as well",
    )  # fmt: skip


def main(args: Namespace) -> None:
    """Print what a node publishes, subscribes to and serves."""
    with open_graph(args) as graph:
        nodes = graph.settle().nodes(hidden=args.include_hidden)
        complaint = f"Unable to find node '{args.node_name}'"
        name = find_node(args.node_name, nodes, complaint)
        sections = _ask(graph, name)
    if (count := nodes.count(name)) > 1:
        print(
            f'There are {count} nodes in the graph with the exact name "{name}". '
            "You are seeing information about only one of them.",
            file=sys.stderr,
        )
    print(name)
    for title, entries in sections.items():
        print(show(title, entries, args.include_hidden))


def show(title: str, entries: Entries, hidden: bool) -> str:
    """A section of the output."""
    lines = [
        f"    {name}: {', '.join(types)}" for name, types in sorted(entries)
        if hidden or not is_hidden(name)
    ]  # fmt: skip
    return "\n".join([f"  {title}:", *(lines or [""])])


def _ask(graph: Graph, full: str) -> dict[str, Entries]:
    from rclpy import action

    namespace, _, name = full.rpartition("/")
    node, where = graph.node, namespace or "/"
    asked: dict[str, Any] = {
        "Subscribers": node.get_subscriber_names_and_types_by_node,
        "Publishers": node.get_publisher_names_and_types_by_node,
        "Service Servers": node.get_service_names_and_types_by_node,
        "Service Clients": node.get_client_names_and_types_by_node,
    }
    found = {title: ask(name, where) for title, ask in asked.items()}
    return found | {
        "Action Servers": action.get_action_server_names_and_types_by_node(node, name, where),
        "Action Clients": action.get_action_client_names_and_types_by_node(node, name, where),
    }
