"""Parameters of other nodes, through the services that every node offers for them."""

from __future__ import annotations

from argparse import ArgumentParser, Namespace
from collections.abc import Sequence
from typing import Any

from ros2_command.errors import CommandError
from ros2_command.graph import Graph, add_graph_arguments
from ros2_command.lookup import find_node
from ros2_command.names import absolute
from ros2_command.untyped import Untyped
from ros2_command.verbs.service.call import ask

#: How long a node may take to answer, in seconds.
PATIENCE = 5.0
#: Words for the values of `rcl_interfaces/msg/ParameterType`, and the field that holds each.
KINDS = (
    ("not set", ""),
    ("boolean", "bool_value"),
    ("integer", "integer_value"),
    ("double", "double_value"),
    ("string", "string_value"),
    ("byte array", "byte_array_value"),
    ("boolean array", "bool_array_value"),
    ("integer array", "integer_array_value"),
    ("double array", "double_array_value"),
    ("string array", "string_array_value"),
)


def add_parameter_arguments(parser: ArgumentParser, node: str | None = None) -> None:
    """The options of all verbs of `ros2 param`.

    Args:
        parser: The verb's parser.
        node: `nargs` of the node's name.
    """
    add_graph_arguments(parser)
    parser.add_argument("node_name", nargs=node, help="Name of the ROS node")
    parser.add_argument(
        "--include-hidden-nodes", action="store_true", help="Consider hidden nodes as well"
    )
    if node is None:
        parser.add_argument(
            "--timeout", metavar="N", type=int, default=1,
            help="Wait for N seconds until node becomes available (default 1 seconds)",
        )  # fmt: skip


class RemoteParameters:
    """The parameters of one node.

    Args:
        graph: Where the node is.
        node: Its full name.
    """

    def __init__(self, graph: Graph, node: str) -> None:
        self._graph, self.node = graph, node

    def call(self, service: str, **fields: Untyped) -> Untyped:
        """Call one of the parameter services.

        Raises:
            CommandError: If the node does not offer it, or does not answer.
        """
        from rcl_interfaces import srv

        words = "".join(word.capitalize() for word in service.split("_"))
        kind = getattr(srv, words)
        client = self._graph.node.create_client(kind, f"{self.node}/{service}")
        if not self._graph.spin_until(client.service_is_ready, PATIENCE):
            raise CommandError(f"The node '{self.node}' does not offer its parameters")
        return ask(self._graph, client, kind.Request(**fields), PATIENCE)

    def names(self, prefixes: Sequence[str] = ()) -> list[str]:
        """The declared names, sorted."""
        return sorted(self.call("list_parameters", prefixes=list(prefixes)).result.names)

    def values(self, names: Sequence[str]) -> list[Any]:
        """The values of parameters, as messages; fewer than asked for if one is undeclared."""
        return list(self.call("get_parameters", names=list(names)).values)


def open_node(graph: Graph, args: Namespace) -> RemoteParameters:
    """The node that the arguments name.

    Raises:
        CommandError: If it is not in the graph; the nearest name is suggested.
    """
    name = absolute(args.node_name)

    def there() -> bool:
        return name in graph.nodes(hidden=True)

    graph.settle(there)
    graph.spin_until(there, float(args.timeout)) if not graph.nodes() else None
    return RemoteParameters(
        graph, find_node(args.node_name, graph.nodes(args.include_hidden_nodes), "Node not found")
    )


def plain_value(value: Untyped) -> Untyped:
    """The Python value of a `rcl_interfaces/msg/ParameterValue`; None if it is not set."""
    if not value.type:
        return None
    plain = getattr(value, KINDS[value.type][1])
    return list(plain) if hasattr(plain, "__len__") and not isinstance(plain, str) else plain


def describe_value(value: Untyped) -> str:
    """A value with its kind, as `ros2 param get` shows it."""
    kind = KINDS[value.type][0].capitalize()
    if kind.endswith(" array"):
        return f"{kind.removesuffix(' array')} values are: {plain_value(value)}"
    return f"{kind} value is: {plain_value(value)}"


def nested(parameters: dict[str, Any]) -> dict[str, Any]:
    """Parameters with dots in their names as dictionaries in dictionaries."""
    tree: dict[str, Any] = {}
    for name, value in parameters.items():
        *path, last = name.split(".")
        place = tree
        for part in path:
            inner = place.setdefault(part, {})
            if not isinstance(inner, dict):  # `a` and `a.b` are both parameters
                place, last = tree, name
                break
            place = inner
        place[last] = value
    return tree
