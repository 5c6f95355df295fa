"""Implement `ros2 node`: list nodes, and show what each of them does."""

from __future__ import annotations

import sys
from argparse import Namespace
from typing import Any

from ros2_command.graph import Graph, add_graph_arguments, open_graph
from ros2_command.names import Entries, check_node, visible
from ros2_command.registry import Verb, argument, flag

SHARED_NAME = (
    "WARNING: Be aware that there are nodes in the graph that share an exact name, "
    "which can have unintended side effects."
)


def _list(args: Namespace) -> None:
    with open_graph(args) as graph:
        names = graph.settle(names_only=True).nodes(hidden=args.all)
    if args.count_nodes:
        print(len(names))
        return
    if len(set(names)) < len(names):
        print(SHARED_NAME, file=sys.stderr)
    for name in names:
        print(name)


def _info(args: Namespace) -> None:
    with open_graph(args) as graph:
        nodes = graph.settle().nodes(hidden=args.include_hidden)
        name = args.node_name
        check_node(name, nodes, f"Unable to find node '{name}'")
        sections = _ask(graph, name)
    if (count := nodes.count(name)) > 1:
        print(
            f'There are {count} nodes in the graph with the exact name "{name}". '
            "You are seeing information about only one of them.",
            file=sys.stderr,
        )
    print(name)
    for title, entries in sections.items():
        print(section(title, entries, args.include_hidden))


def section(title: str, entries: Entries, hidden: bool) -> str:
    """Return a section of the output."""
    lines = [f"    {name}: {', '.join(types)}" for name, types in visible(sorted(entries), hidden)]
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


VERBS = {
    "info": Verb(
        "Output information about a node",
        _info,
        add_graph_arguments,
        argument("node_name", help="Node name to request information"),
        flag("--include-hidden", help="Display hidden topics, services, and actions as well"),
    ),
    "list": Verb(
        "Output a list of available nodes",
        _list,
        add_graph_arguments,
        flag("-a", "--all", help="Display all nodes even hidden ones"),
        flag("-c", "--count-nodes", help="Only display the number of nodes discovered"),
    ),
}  # fmt: skip
