"""`ros2 pkg list`."""

from __future__ import annotations

from argparse import ArgumentParser, Namespace

from ros2_command.packages import all_packages


def add_arguments(parser: ArgumentParser) -> None:
    """This verb has no arguments."""


def main(args: Namespace) -> None:
    """Print the name of every package."""
    for name in all_packages():
        print(name)
