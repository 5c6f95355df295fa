"""`ros2 param get`."""

from __future__ import annotations

from argparse import ArgumentParser, Namespace

from ros2_command.errors import CommandError
from ros2_command.graph import open_graph
from ros2_command.nearest import did_you_mean
from ros2_command.parameters import (
    add_parameter_arguments,
    describe_value,
    open_node,
    plain_value,
)


def add_arguments(parser: ArgumentParser) -> None:
    """A node and one of its parameters."""
    add_parameter_arguments(parser)
    parser.add_argument("parameter_name", help="Name of the parameter")
    parser.add_argument("--hide-type", action="store_true", help="Hide the type information")


def main(args: Namespace) -> None:
    """Print the value of a parameter."""
    with open_graph(args) as graph:
        node = open_node(graph, args)
        found = node.values([args.parameter_name])
        known = [] if found else node.names()
    if not found:
        hint = did_you_mean(args.parameter_name, known, f"It has: {', '.join(known)}")
        raise CommandError("Parameter not set", hint)
    if not found[0].type:
        print("Parameter not set.")
    else:
        print(plain_value(found[0]) if args.hide_type else describe_value(found[0]))
