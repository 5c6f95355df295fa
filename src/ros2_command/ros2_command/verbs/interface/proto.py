"""`ros2 interface proto`."""

from __future__ import annotations

from argparse import ArgumentParser, Namespace
from typing import Any

from ros2_command.definitions import find_interface
from ros2_command.errors import CommandError
from ros2_command.message_text import Style, to_yaml
from ros2_command.message_types import find_type


def add_arguments(parser: ArgumentParser) -> None:
    """A type, and whether to quote its prototype."""
    parser.add_argument("--no-quotes", action="store_true",
                        help="if true output has no outer quotes.")  # fmt: skip
    parser.add_argument("type", help="Show an interface prototype (e.g. 'std_msgs/msg/String')")


def main(args: Namespace) -> None:
    """Print the YAML of a default message, for `topic pub` and `service call`."""
    interface = find_interface(args.type)
    found: Any = find_type(interface.name, interface.kind)
    if found is None:
        raise CommandError(
            f"The Python module of '{interface.name}' cannot be imported",
            "Is its workspace built, and sourced in this terminal?",
        )
    part = {"srv": "Request", "action": "Goal"}.get(interface.kind)
    text = to_yaml((getattr(found, part) if part else found)(), Style(limit=None))
    print(text if args.no_quotes else f'"{text}"')
