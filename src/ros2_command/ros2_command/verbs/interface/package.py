"""`ros2 interface package`."""

from __future__ import annotations

from argparse import ArgumentParser, Namespace

from ros2_command.definitions import package_interfaces
from ros2_command.packages import package_prefix
from ros2_command.verbs.interface.selection import add_kind_arguments, kinds


def add_arguments(parser: ArgumentParser) -> None:
    """A package, and which kinds."""
    parser.add_argument("package_name", help="Name of the ROS package (e.g. 'example_interfaces')")
    add_kind_arguments(parser)


def main(args: Namespace) -> None:
    """Print the interfaces that a package defines."""
    name = args.package_name
    for one in package_interfaces(name, package_prefix(name, "Unknown package '{}'")):
        if one.kind in kinds(args):
            print(one.name)
