"""`ros2 interface list`."""

from __future__ import annotations

from argparse import ArgumentParser, Namespace

from ros2_command.definitions import KINDS, all_interfaces
from ros2_command.verbs.interface.selection import add_kind_arguments, kinds


def add_arguments(parser: ArgumentParser) -> None:
    """Which kinds."""
    add_kind_arguments(parser)


def main(args: Namespace) -> None:
    """Print all interfaces below the headings of their kinds."""
    found = all_interfaces()
    for kind in kinds(args):
        print(f"{KINDS[kind]}:")
        for one in found:
            if one.kind == kind:
                print(f"    {one.name}")
