"""`ros2 param list`."""

from __future__ import annotations

import re
from argparse import ArgumentParser, Namespace
from collections.abc import Callable, Sequence

from ros2_command.errors import CommandError
from ros2_command.graph import Graph, open_graph
from ros2_command.lookup import find_node
from ros2_command.parameters import KINDS, RemoteParameters, add_parameter_arguments


def add_arguments(parser: ArgumentParser) -> None:
    """A node or none, and which parameters."""
    add_parameter_arguments(parser, node="?")
    parser.add_argument("--param-prefixes", nargs="+", default=[],
                        help="Only list parameters with the provided prefixes")  # fmt: skip
    parser.add_argument("--param-type", action="store_true", help="Print parameter types")
    parser.add_argument("--filter", help="Only list parameters matching the provided regex")


def main(args: Namespace) -> None:
    """Print the parameters of one node, or of every node."""
    try:
        matches = re.compile(args.filter or "").search
    except re.error as error:
        raise CommandError(f"--filter {args.filter!r} is not a pattern: {error}") from None
    with open_graph(args) as graph:
        graph.settle()
        for line in _lines(graph, args, lambda name: matches(name) is not None):
            print(line)


def _lines(graph: Graph, args: Namespace, wanted: Callable[[str], bool]) -> list[str]:
    nodes = graph.nodes(args.include_hidden_nodes)
    if args.node_name is not None:
        nodes = [find_node(args.node_name, nodes, "Node not found")]
    lines = []
    for node in sorted(set(nodes), key=lambda name: name.rpartition("/")[2]):
        remote = RemoteParameters(graph, node)
        names = [name for name in remote.names(args.param_prefixes) if wanted(name)]
        if names and args.node_name is None:
            lines.append(f"{node}:")
        lines += _entries(remote, names, args.param_type)
    return lines


def _entries(remote: RemoteParameters, names: Sequence[str], with_type: bool) -> list[str]:
    if not with_type or not names:
        return [f"  {name}" for name in names]
    types = remote.call("get_parameter_types", names=list(names)).types
    return [f"  {name} (type: {KINDS[kind][0]})" for name, kind in zip(names, types, strict=True)]
