"""`ros2 interface show`."""

from __future__ import annotations

import sys
from argparse import ArgumentParser, Namespace

from ros2_command.definitions import find_interface, show_lines
from ros2_command.errors import UsageError


def add_arguments(parser: ArgumentParser) -> None:
    """A type, and which comments to show."""
    group = parser.add_mutually_exclusive_group()
    group.add_argument("--all-comments", action="store_true",
                       help="Show all comments, including for nested types")  # fmt: skip
    group.add_argument("--no-comments", action="store_true",
                       help="Show no comments or whitespace")  # fmt: skip
    parser.add_argument("type", help="Show an interface definition (e.g. 'std_msgs/msg/String'); "
                        "'-' reads the type from standard input")  # fmt: skip


def main(args: Namespace) -> None:
    """Print a definition with nested types expanded."""
    name = sys.stdin.readline().strip() if args.type == "-" else args.type
    if not name:
        raise UsageError("argument type: the passed value is empty")
    comments = "all" if args.all_comments else "none" if args.no_comments else "top"
    for line in show_lines(find_interface(name), comments):
        print(line)
