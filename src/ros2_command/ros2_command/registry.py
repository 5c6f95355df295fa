"""List every command and verb in one place; a command that is not listed here does not exist.

This module is imported before any other, so it imports neither ROS nor the verbs.
"""

from __future__ import annotations

from argparse import ArgumentParser, Namespace
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from importlib import import_module
from types import MappingProxyType
from typing import Any

#: Declares one argument, or several that go together, to the parser of a verb.
Argument = Callable[[ArgumentParser], object]


def argument(*names: str, **options: Any) -> Argument:  # noqa: ANN401 - as argparse has it
    """Return what declares an argument; the options are those of `ArgumentParser.add_argument`."""
    return lambda parser: parser.add_argument(*names, **options)


def flag(*names: str, help: str) -> Argument:
    """Return what declares an option without a value."""
    return argument(*names, action="store_true", help=help)


def one_of(*arguments: Argument) -> Argument:
    """Return what declares arguments that exclude each other."""

    def declare(parser: ArgumentParser) -> None:
        group: Any = parser.add_mutually_exclusive_group()  # which takes arguments as a parser does
        for one in arguments:
            one(group)

    return declare


class Verb:
    """Say how a verb is parsed, and what it does.

    Each module of `ros2_command.verbs` has a mapping `VERBS` of these, by name; the key is "" where
    a command has no verbs.

    Args:
        main: Does it; an exit code, where there is one, is the command's.
        *arguments: Its arguments, in the order of `--help`.
    """

    def __init__(self, main: Callable[[Namespace], int | None], *arguments: Argument) -> None:
        self.main, self._arguments = main, arguments

    def add_arguments(self, parser: ArgumentParser) -> None:
        """Declare the arguments."""
        for declare in self._arguments:
            declare(parser)


@dataclass(frozen=True)
class Command:
    """Describe a command of `ros2`.

    Attributes:
        about: One line for the list in `--help`.
        verbs: The one-liner of each verb; empty for a command without verbs.
        left_out: Verbs that the full ROS 2 has and this subset has not.
    """

    about: str
    verbs: Mapping[str, str] = field(default_factory=dict)
    left_out: tuple[str, ...] = ()


COMMANDS: Mapping[str, Command] = MappingProxyType(
    {
        "action": Command(
            "Various action related sub-commands",
            {
                "info": "Print information about an action",
                "list": "Output a list of action names",
                "send_goal": "Send an action goal",
                "type": "Print a action's type",
            },
        ),
        "bag": Command(
            "Various rosbag related sub-commands",
            {
                "info": "Print information about a bag to the screen",
                "play": "Play back ROS data from a bag",
                "record": "Record ROS data to a bag",
            },
            left_out=("burst", "convert", "list", "reindex"),
        ),
        "completion": Command("Output what a shell needs to complete this command"),
        "doctor": Command("Check ROS setup and other potential issues", left_out=("hello",)),
        "interface": Command(
            "Show information about ROS interfaces",
            {
                "list": "List all interface types available",
                "package": "Output a list of available interface types within one package",
                "packages": "Output a list of packages that provide interfaces",
                "proto": "Output an interface prototype",
                "show": "Output the interface definition",
            },
        ),
        "node": Command(
            "Various node related sub-commands",
            {
                "info": "Output information about a node",
                "list": "Output a list of available nodes",
            },
        ),
        "param": Command(
            "Various param related sub-commands",
            {
                "delete": "Delete parameter",
                "describe": "Show descriptive information about declared parameters",
                "dump": "Show all of the parameters of a node in a YAML file format",
                "get": "Get parameter",
                "list": "Output a list of available parameters",
                "load": "Load parameter file for a node",
                "set": "Set parameter",
            },
        ),
        "pkg": Command(
            "Various package related sub-commands",
            {
                "create": "Create a new ROS 2 package",
                "executables": "Output a list of package specific executables",
                "list": "Output a list of available packages",
                "prefix": "Output the prefix path of a package",
                "xml": "Output the XML of the package manifest or a specific tag",
            },
        ),
        "run": Command("Run a package specific executable"),
        "service": Command(
            "Various service related sub-commands",
            {
                "call": "Call a service",
                "echo": "Echo a service",
                "find": "Output a list of available services of a given type",
                "info": "Print information about a service",
                "list": "Output a list of available services",
                "type": "Output a service's type",
            },
        ),
        "topic": Command(
            "Various topic related sub-commands",
            {
                "bw": "Display bandwidth used by topic",
                "delay": "Display delay of topic from timestamp in header",
                "echo": "Output messages from a topic",
                "find": "Output a list of available topics of a given type",
                "hz": "Print the average publishing rate to screen",
                "info": "Print information about a topic",
                "list": "Output a list of available topics",
                "pub": "Publish a message to a topic",
                "type": "Print a topic's type",
            },
        ),
        "wtf": Command("Use `wtf` as alias to `doctor`", left_out=("hello",)),
    }
)

#: Commands of the full ROS 2 that are not in this subset.
LEFT_OUT = (
    *("component", "control", "daemon", "extension_points", "extensions", "launch", "lifecycle"),
    *("multicast", "plugin", "security", "test", "trace"),
)
WHERE_TO_GET_THE_WHOLE = (
    "The full command comes with a full ROS 2 installation:\n"
    "  on Ubuntu: https://docs.ros.org/en/jazzy/Installation.html\n"
    "  with conda on Linux, macOS and Windows (RoboStack): https://robostack.github.io"
)
_SAME_MODULE = MappingProxyType({"wtf": "doctor"})


def load(command: str, verb: str | None = None) -> Verb:
    """Import a verb, or a command without verbs."""
    module = import_module(f"ros2_command.verbs.{_SAME_MODULE.get(command, command)}")
    found = module.VERBS[verb or ""]
    assert isinstance(found, Verb)
    return found


def what_is_left_out(command: str, verb: str | None = None) -> str | None:
    """Return what to say of a command or verb of the full ROS 2 only, None of another."""
    known = COMMANDS.get(command)
    if known is None and command in LEFT_OUT:
        name = command
    elif known is not None and verb in known.left_out:
        name = f"{command} {verb}"
    else:
        return None
    return (
        f"'ros2 {name}' is left out here: this `ros2` is a subset for ROS 2 installed with pip.\n"
        f"{WHERE_TO_GET_THE_WHOLE}"
    )
