"""`ros2 param dump`."""

from __future__ import annotations

from argparse import ArgumentParser, Namespace
from typing import Any

from ros2_command.graph import open_graph
from ros2_command.parameters import add_parameter_arguments, nested, open_node, plain_value
from ros2_command.untyped import Untyped


def add_arguments(parser: ArgumentParser) -> None:
    """A node."""
    add_parameter_arguments(parser)


def main(args: Namespace) -> None:
    """Print all parameters of a node as YAML."""
    with open_graph(args) as graph:
        node = open_node(graph, args)
        names = node.names()
        values = [dumpable(value) for value in node.values(names)]
    print(text_of(node.node, dict(zip(names, values, strict=True))))


def dumpable(value: Untyped) -> Untyped:
    """A parameter's value as YAML can hold it."""
    plain = plain_value(value)
    is_bytes = isinstance(plain, list) and any(isinstance(one, bytes) for one in plain)
    return b"".join(plain) if is_bytes else plain


def text_of(node: str, parameters: dict[str, Any]) -> str:
    """The YAML of a node's parameters."""
    import yaml

    return str(
        yaml.safe_dump(
            {node: {"ros__parameters": nested(parameters)}},
            default_flow_style=False, allow_unicode=True,
        )
    )  # fmt: skip
