"""Build the argparse parser from the registry; only the requested verb is imported."""

from __future__ import annotations

import argparse
import re
from collections.abc import Mapping, Sequence
from typing import Any, NoReturn

from ros2_command.errors import CommandError
from ros2_command.names import did_you_mean
from ros2_command.registry import (
    COMMANDS,
    LEFT_OUT,
    WHERE_TO_GET_THE_WHOLE,
    Argument,
    load,
)

_CHOICE = re.compile(r"invalid choice: '?(?P<word>.*?)'? \(choose from (?P<names>.*)\)")


class Parser(argparse.ArgumentParser):
    """Parse, and suggest the nearest choice where a word is none of them."""

    def error(self, message: str) -> NoReturn:
        """Print the usage, the message and perhaps a suggestion, and end with exit code 2."""
        if found := _CHOICE.search(message):
            names = [name.strip(" '") for name in found["names"].split(",")]
            hint = did_you_mean(found["word"], names)
            message += f"\n{hint}" if hint else ""
        super().error(message)


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
        start = f"{parser.epilog}, " if parser.epilog else "Left out of this subset: "
        parser.epilog = start + ", ".join(names.rpartition(",")[2] for names in options)

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
    about = COMMANDS[command]
    if about.left_out:
        parser.epilog = f"Left out of this subset: {', '.join(about.left_out)}"
    if not about.verbs:
        load(command).add_arguments(parser)
        return
    if command in ("topic", "service"):
        name = f"--include-hidden-{command}s"
        parser.add_argument(
            name, action="store_true", help=f"Consider hidden {command}s as well"
        )  # the original has the option in both places
    verbs = _sub(parser, f"ros2 {command} <command>", about.verbs, "_verb")
    parser.set_defaults(_parser=parser)
    if verb in verbs:
        verbs[verb].set_defaults(_parser=verbs[verb])
        load(command, verb).add_arguments(verbs[verb])


def build(argv: Sequence[str]) -> Parser:
    """Make a parser for the whole command, with the arguments of the verb that argv names."""
    command, verb = words_of(argv)
    parser = Parser(
        prog="ros2",
        description="ros2 is an extensible command-line tool for ROS 2.",
        formatter_class=argparse.RawDescriptionHelpFormatter,
        epilog="This is a subset for ROS 2 installed with pip. Left out:\n"
        f"  {', '.join(LEFT_OUT)}\n{WHERE_TO_GET_THE_WHOLE}",
    )
    parser.add_argument(
        "--use-python-default-buffering",
        action="store_true",
        help="Do not force line buffering in stdout",
    )
    about = {name: command.about for name, command in COMMANDS.items()}
    commands = _sub(parser, "ros2 <command>", about, "_command")
    parser.set_defaults(_parser=parser)
    if command in commands:
        commands[command].set_defaults(_parser=commands[command])
        _fill_command(commands[command], command, verb)
    return parser
