"""`ros2 interface packages`."""

from __future__ import annotations

from argparse import ArgumentParser, Namespace

from ros2_command.definitions import all_interfaces
from ros2_command.verbs.interface.selection import add_kind_arguments, kinds


def add_arguments(parser: ArgumentParser) -> None:
    """Which kinds."""
    add_kind_arguments(parser)


def main(args: Namespace) -> None:
    """Print the packages that define interfaces."""
    for name in sorted({one.package for one in all_interfaces() if one.kind in kinds(args)}):
        print(name)
