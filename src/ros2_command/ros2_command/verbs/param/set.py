"""`ros2 param set`."""

from __future__ import annotations

from argparse import ArgumentParser, Namespace

from ros2_command.errors import CommandError
from ros2_command.graph import open_graph
from ros2_command.nearest import did_you_mean
from ros2_command.parameters import RemoteParameters, add_parameter_arguments, open_node
from ros2_command.untyped import Untyped


def add_arguments(parser: ArgumentParser) -> None:
    """A node, one of its parameters, and the new value."""
    add_parameter_arguments(parser)
    parser.add_argument("parameter_name", help="Name of the parameter")
    parser.add_argument("value", help="Value of the parameter")


def main(args: Namespace) -> None:
    """Set a parameter; the node may refuse."""
    value = value_message(args.value)
    with open_graph(args) as graph:
        node = open_node(graph, args)
        result = _set(node, args.parameter_name, value)
        hint = "" if result.successful else _hint(node, args.parameter_name)
    if not result.successful:
        raise CommandError(f"Setting parameter failed: {result.reason}", hint)
    print("Set parameter successful")


def value_message(text: str) -> Untyped:
    """The text, read as YAML, as a `rcl_interfaces/msg/ParameterValue`.

    Raises:
        CommandError: If it is a mapping, or a number that is too large.
    """
    from rclpy.parameter import get_parameter_value

    try:
        return get_parameter_value(text)
    except (AssertionError, OverflowError, ValueError):
        raise CommandError(
            f"{text!r} cannot be the value of a parameter",
            "A value is a number, a text, true, false, or a list of one of these.",
        ) from None


def _set(node: RemoteParameters, name: str, value: Untyped) -> Untyped:
    from rcl_interfaces.msg import Parameter

    return node.call("set_parameters", parameters=[Parameter(name=name, value=value)]).results[0]


def _hint(node: RemoteParameters, name: str) -> str:
    known = node.names()
    return "" if name in known else did_you_mean(name, known, f"It has: {', '.join(known)}")
