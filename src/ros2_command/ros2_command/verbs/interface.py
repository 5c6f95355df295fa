"""Implement `ros2 interface`: show definitions of messages, services and actions."""

from __future__ import annotations

import sys
from argparse import Namespace
from typing import Any

from ros2_command.errors import CommandError, UsageError
from ros2_command.packages import (
    KINDS,
    all_interfaces,
    find_interface,
    package_interfaces,
    package_prefix,
    show_lines,
)
from ros2_command.registry import Verb, argument, flag, one_of


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


def _package(args: Namespace) -> None:
    name = args.package_name
    for one in package_interfaces(name, package_prefix(name, "Unknown package '{}'")):
        if one.kind in _kinds(args):
            print(one.name)


def _packages(args: Namespace) -> None:
    for name in sorted({one.package for one in all_interfaces() if one.kind in _kinds(args)}):
        print(name)


def _proto(args: Namespace) -> None:
    from ros2_command.messages import Style, to_yaml
    from ros2_command.names import find_type

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


def _show(args: Namespace) -> None:
    name = sys.stdin.readline().strip() if args.type == "-" else args.type
    if not name:
        raise UsageError("the passed value is empty")
    comments = "all" if args.all_comments else "none" if args.no_comments else "top"
    for line in show_lines(find_interface(name), comments):
        print(line)


_ONLY = [
    argument(short, f"--only-{word}", action="append_const", dest="kinds", const=kind,
             help=f"Print out only {title}")
    for kind, short, word, title in (
        ("msg", "-m", "msgs", "messages"), ("srv", "-s", "srvs", "services"),
        ("action", "-a", "actions", "actions"),
    )
]  # fmt: skip
VERBS = {
    "list": Verb("List all interface types available", _list, *_ONLY),
    "package": Verb(
        "Output a list of available interface types within one package",
        _package,
        argument("package_name", help="Name of the ROS package (e.g. 'example_interfaces')"),
        *_ONLY,
    ),
    "packages": Verb("Output a list of packages that provide interfaces", _packages, *_ONLY),
    "proto": Verb(
        "Output an interface prototype",
        _proto,
        flag("--no-quotes", help="if true output has no outer quotes."),
        argument("type", help="Show an interface prototype (e.g. 'std_msgs/msg/String')"),
    ),
    "show": Verb(
        "Output the interface definition",
        _show,
        one_of(
            flag("--all-comments", help="Show all comments, including for nested types"),
            flag("--no-comments", help="Show no comments or whitespace"),
        ),
        argument("type", help="Show an interface definition (e.g. 'std_msgs/msg/String'); "
                 "'-' reads the type from standard input"),
    ),
}  # fmt: skip
