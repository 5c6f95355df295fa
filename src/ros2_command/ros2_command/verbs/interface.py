"""Implement `ros2 interface`: show definitions of messages, services and actions."""

from __future__ import annotations

import sys
from argparse import ArgumentParser, Namespace
from typing import Any

from ros2_command.definitions import (
    KINDS,
    all_interfaces,
    find_interface,
    package_interfaces,
    show_lines,
)
from ros2_command.errors import CommandError, UsageError
from ros2_command.packages import package_prefix
from ros2_command.registry import Verb

_OPTIONS = {"msg": ("-m", "msgs", "messages"), "srv": ("-s", "srvs", "services"),
            "action": ("-a", "actions", "actions")}  # fmt: skip


def _add_kinds(parser: ArgumentParser) -> None:
    for kind, (short, word, title) in _OPTIONS.items():
        parser.add_argument(
            short, f"--only-{word}", action="append_const", dest="kinds", const=kind,
            help=f"Print out only {title}",
        )  # fmt: skip


def _kinds(args: Namespace) -> list[str]:
    """Return the kinds asked for, all of them if none is."""
    return [kind for kind in KINDS if not args.kinds or kind in args.kinds]


def _list(args: Namespace) -> None:
    found = all_interfaces()
    for kind in _kinds(args):
        print(f"{KINDS[kind]}:")
        for one in found:
            if one.kind == kind:
                print(f"    {one.name}")


def _add_package(parser: ArgumentParser) -> None:
    parser.add_argument("package_name", help="Name of the ROS package (e.g. 'example_interfaces')")
    _add_kinds(parser)


def _package(args: Namespace) -> None:
    name = args.package_name
    for one in package_interfaces(name, package_prefix(name, "Unknown package '{}'")):
        if one.kind in _kinds(args):
            print(one.name)


def _packages(args: Namespace) -> None:
    for name in sorted({one.package for one in all_interfaces() if one.kind in _kinds(args)}):
        print(name)


def _add_proto(parser: ArgumentParser) -> None:
    parser.add_argument("--no-quotes", action="store_true",
                        help="if true output has no outer quotes.")  # fmt: skip
    parser.add_argument("type", help="Show an interface prototype (e.g. 'std_msgs/msg/String')")


def _proto(args: Namespace) -> None:
    from ros2_command.lookup import find_type
    from ros2_command.message_text import Style, to_yaml

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


def _add_show(parser: ArgumentParser) -> None:
    group = parser.add_mutually_exclusive_group()
    group.add_argument("--all-comments", action="store_true",
                       help="Show all comments, including for nested types")  # fmt: skip
    group.add_argument("--no-comments", action="store_true",
                       help="Show no comments or whitespace")  # fmt: skip
    parser.add_argument("type", help="Show an interface definition (e.g. 'std_msgs/msg/String'); "
                        "'-' reads the type from standard input")  # fmt: skip


def _show(args: Namespace) -> None:
    name = sys.stdin.readline().strip() if args.type == "-" else args.type
    if not name:
        raise UsageError("argument type: the passed value is empty")
    comments = "all" if args.all_comments else "none" if args.no_comments else "top"
    for line in show_lines(find_interface(name), comments):
        print(line)


VERBS = {
    "list": Verb(_add_kinds, _list),
    "package": Verb(_add_package, _package),
    "packages": Verb(_add_kinds, _packages),
    "proto": Verb(_add_proto, _proto),
    "show": Verb(_add_show, _show),
}
