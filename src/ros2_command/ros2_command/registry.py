"""List every command and verb in one place; a command that is not listed here does not exist.

This module is imported before any other, so it imports neither ROS nor the verbs.
"""

from __future__ import annotations

import argparse
import re
import sys
from argparse import ArgumentParser, Namespace
from collections.abc import Callable, Mapping, Sequence
from importlib import import_module
from typing import Any, NoReturn

from ros2_command.errors import CommandError, note
from ros2_command.names import did_you_mean

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
        about: One line for `--help`; nothing for a command without verbs, which `COMMANDS` has.
        main: Does it; an exit code, where there is one, is the command's.
        *arguments: Its arguments, in the order of `--help`.
    """

    def __init__(
        self, about: str, main: Callable[[Namespace], int | None], *arguments: Argument
    ) -> None:
        self.about, self.main, self._arguments = about, main, arguments

    def add_arguments(self, parser: ArgumentParser) -> None:
        """Declare the arguments."""
        for declare in self._arguments:
            declare(parser)


#: Each command, with one line for `--help`.
COMMANDS = {
    "action": "Various action related sub-commands",
    "bag": "Various rosbag related sub-commands",
    "completion": "Output what a shell needs to complete this command",
    "daemon": "Various daemon related sub-commands",
    "doctor": "Check ROS setup and other potential issues",
    "interface": "Show information about ROS interfaces",
    "launch": "Run a launch file",
    "node": "Various node related sub-commands",
    "param": "Various param related sub-commands",
    "pkg": "Various package related sub-commands",
    "run": "Run a package specific executable",
    "service": "Various service related sub-commands",
    "topic": "Various topic related sub-commands",
    "wtf": "Use `wtf` as alias to `doctor`",
}
#: Verbs that the full ROS 2 has and this subset has not.
LEFT_OUT_VERBS = {
    "bag": ("burst", "convert", "list", "reindex"),
    "doctor": ("hello",),
    "wtf": ("hello",),
}
#: Commands of the full ROS 2 that are not in this subset.
LEFT_OUT = (
    *("component", "control", "extension_points", "extensions", "lifecycle"),
    *("multicast", "plugin", "security", "test", "trace"),
)
WHERE_TO_GET_THE_WHOLE = (
    "The full command comes with a full ROS 2 installation:\n"
    "  on Ubuntu: https://docs.ros.org/en/jazzy/Installation.html\n"
    "  with conda on Linux, macOS and Windows (RoboStack): https://robostack.github.io"
)


def verbs_of(command: str) -> Mapping[str, Verb]:
    """Import a command, and return its verbs; one of an empty name where it has none."""
    name = "doctor" if command == "wtf" else command
    verbs: Mapping[str, Verb] = import_module(f"ros2_command.verbs.{name}").VERBS
    return verbs


def what_is_left_out(command: str, verb: str | None = None) -> tuple[str, str] | None:
    """Return what to say of a command or verb of the full ROS 2 only, None of another."""
    if command in LEFT_OUT:
        name = command
    elif verb in LEFT_OUT_VERBS.get(command, ()):
        name = f"{command} {verb}"
    else:
        return None
    return (
        f"'ros2 {name}' is left out here: this `ros2` is a subset for ROS 2 installed with pip.",
        WHERE_TO_GET_THE_WHOLE,
    )


# The parser. Only the module of the requested command is imported.

_CHOICE = re.compile(r"invalid choice: '?(?P<word>.*?)'? \(choose from (?P<names>.*)\)")


class Parser(argparse.ArgumentParser):
    """Parse, and suggest the nearest choice where a word is none of them.

    Attributes:
        left_out: What to say below the help of what this subset has not.
    """

    left_out = ""

    def error(self, message: str) -> NoReturn:
        """Print the usage, the message and perhaps a suggestion, and end with exit code 2."""
        self.print_usage(sys.stderr)
        print(f"{self.prog}: error: {message}", file=sys.stderr)
        if found := _CHOICE.search(message):
            names = [name.strip(" '") for name in found["names"].split(",")]
            note(did_you_mean(found["word"], names))
        self.exit(2)

    def print_help(self, file: Any = None) -> None:  # noqa: ANN401 - as argparse has it
        """Print the help as the original has it, and what is left out as a note."""
        super().print_help(file)
        note(self.left_out)


class LeftOut(argparse.Action):
    """Refuse an option that the full ROS 2 has and this subset has not; `const` says why."""

    def __call__(
        self,
        parser: argparse.ArgumentParser,
        namespace: argparse.Namespace,
        values: object,
        option_string: str | None = None,
    ) -> NoReturn:
        """End with a sentence, rather than go on without what was asked for."""
        raise CommandError(f"'{parser.prog} {option_string}' is left out here: {self.const}")


def leave_out(reason: str, *options: str) -> Argument:
    """Return what refuses options with a sentence.

    Args:
        reason: Why, and what to do instead.
        *options: Each option; its short form may stand before a comma.
    """

    def refuse(parser: argparse.ArgumentParser) -> None:
        for names in options:
            extra: dict[str, Any] = {"action": LeftOut, "nargs": "*", "const": reason}
            parser.add_argument(*names.split(","), **extra, help=argparse.SUPPRESS)
        before = getattr(parser, "left_out", "")
        more = ", ".join(names.rpartition(",")[2] for names in options)
        start = f"{before}, " if before else "Left out of this subset: "
        setattr(parser, "left_out", start + more)  # noqa: B010 - one of `Parser` has it

    return refuse


def words_of(argv: Sequence[str]) -> tuple[str | None, str | None]:
    """Return the first two arguments that are not options: perhaps a command and a verb."""
    words = [word for word in argv if not word.startswith("-")]
    return (words[0] if words else None, words[1] if len(words) > 1 else None)


def listing(entries: Mapping[str, str]) -> str:
    """Return the block below `Commands:`."""
    width = max(map(len, entries))
    return "\n".join(f"{name:<{width}}  {about}" for name, about in sorted(entries.items()))


def _sub(parser: Parser, call: str, entries: Mapping[str, str], dest: str) -> dict[str, Parser]:
    metavar = f"Call `{call} -h` for more detailed usage."
    group = parser.add_subparsers(
        title="Commands", description=listing(entries), metavar=metavar, dest=dest, required=False
    )
    return {
        name: group.add_parser(
            name, description=about, formatter_class=argparse.RawDescriptionHelpFormatter
        )
        for name, about in sorted(entries.items())
    }


def _fill_command(parser: Parser, command: str, verb: str | None) -> None:
    if command in LEFT_OUT_VERBS:
        parser.left_out = f"Left out of this subset: {', '.join(LEFT_OUT_VERBS[command])}"
    verbs = verbs_of(command)
    if "" in verbs:
        verbs[""].add_arguments(parser)
        return
    if command in ("topic", "service"):
        name = f"--include-hidden-{command}s"
        parser.add_argument(
            name, action="store_true", help=f"Consider hidden {command}s as well"
        )  # the original has the option in both places
    abouts = {name: one.about for name, one in verbs.items()}
    parsers = _sub(parser, f"ros2 {command} <command>", abouts, "chosen_verb")
    parser.set_defaults(chosen_parser=parser)
    if verb in parsers:
        parsers[verb].set_defaults(chosen_parser=parsers[verb])
        verbs[verb].add_arguments(parsers[verb])


def build(argv: Sequence[str]) -> Parser:
    """Make a parser for the whole command, with the arguments of the verb that argv names."""
    command, verb = words_of(argv)
    parser = Parser(
        prog="ros2",
        description="ros2 is an extensible command-line tool for ROS 2.",
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.left_out = (
        "This is a subset for ROS 2 installed with pip. Left out:\n"
        f"  {', '.join(LEFT_OUT)}\n{WHERE_TO_GET_THE_WHOLE}"
    )
    parser.add_argument(
        "--use-python-default-buffering",
        action="store_true",
        help="Do not force line buffering in stdout",
    )
    commands = _sub(parser, "ros2 <command>", COMMANDS, "chosen_command")
    parser.set_defaults(chosen_parser=parser)
    if command in commands:
        commands[command].set_defaults(chosen_parser=commands[command])
        _fill_command(commands[command], command, verb)
    return parser
