"""Implement `ros2 completion`: print a shell's completion script, and compute the completions."""

from __future__ import annotations

import math
import re
from argparse import REMAINDER, Action, ArgumentParser, Namespace
from collections.abc import Iterable, Mapping, Sequence
from importlib.resources import files

from ros2_command.errors import CommandError
from ros2_command.names import Entries, absolute, type_class, visible
from ros2_command.registry import COMMANDS, Verb, build, verbs_of

_BASH = """_ros2_complete() {
    local IFS=$'\\n'
    COMPREPLY=($(ros2 completion words "${COMP_WORDS[@]:1:COMP_CWORD}" 2>/dev/null))
}
complete -o default -F _ros2_complete ros2
"""


def _add_arguments(parser: ArgumentParser) -> None:
    parser.description = (
        "Output what a shell needs to complete this command:\n"
        '  eval "$(ros2 completion bash)"    (zsh: after `autoload bashcompinit && bashcompinit`)\n'
        "  ros2 completion profile           (the file for FASTRTPS_DEFAULT_PROFILES_FILE)"
    )
    parser.add_argument("what", choices=["bash", "zsh", "words", "profile"])
    parser.add_argument("words", nargs=REMAINDER, help="The words typed so far (with 'words')")


def _main(args: Namespace) -> None:
    if args.what == "words":
        print("\n".join(candidates(args.words)))
    elif args.what == "profile":
        print(files("ros2_command") / "data" / "fastdds.xml")
    else:
        print(_BASH, end="")


def candidates(words: Sequence[str]) -> list[str]:
    """Return the words that could stand in the place of the last one.

    Args:
        words: What is typed after `ros2`; the last one is incomplete, perhaps empty.
    """
    *done, started = words or [""]
    try:
        found = _options(done) if started.startswith("-") else _next(done)
    except (CommandError, SystemExit):
        found = []
    # In a quotation that is open already, the shell writes the marks itself.
    plain = [one.strip('"') for one in found] if started.startswith(_QUOTES) else list(found)
    return sorted({one for one in plain if one.startswith(started.lstrip("".join(_QUOTES)))})


#: The marks with which a quotation begins.
_QUOTES = ('"', "'")


def _next(done: Sequence[str]) -> Iterable[str]:
    words = [word for word in done if not word.startswith("-")]
    if not words:
        return COMMANDS
    if words[0] not in COMMANDS:
        return []
    verbs = verbs_of(words[0])
    if "" not in verbs and len(words) == 1:
        return verbs
    parser, names = _parser_of(done), words[:1] if "" in verbs else words[:2]
    place = done.index(names[-1]) + 1  # the verb's own words follow it
    given, wanted = _given(parser, done[place:])
    if wanted is None or [*names, wanted.dest] == ["pkg", "create", "package_name"]:
        return []  # the last of these wants a new name
    return wanted.choices or _values(wanted.dest, given, names)


def _given(parser: ArgumentParser, words: Sequence[str]) -> tuple[dict[str, str], Action | None]:
    """Sort the words after a verb.

    Args:
        parser: The verb's parser.
        words: What is typed, without the word that is to be completed.

    Returns:
        The positional arguments by name, and what the next word belongs to.
    """
    places = [one for one in parser._actions if not one.option_strings]
    given: dict[str, str] = {}
    option, left = None, 0.0
    for word in words:
        if left and not word.startswith("-"):
            left -= 1
        elif word.startswith("-"):
            name, sign, _ = word.partition("=")
            option = _option(parser, name)
            left = 0.0 if sign or option is None else _count(option)
        elif places:
            given[places[0].dest] = word
            places = places if places[0].nargs in ("+", "*") else places[1:]
    if left and option is not None:
        return given, option
    return given, places[0] if places else None


def _option(parser: ArgumentParser, name: str) -> Action | None:
    """Return the option of a name, which may be shortened."""
    known = parser._option_string_actions
    long = [one for one in known if name.startswith("--") and one.startswith(name)]
    return known.get(name) or (known[long[0]] if len(long) == 1 else None)


def _count(option: Action) -> float:
    """Return how many words after an option are its own at most."""
    if isinstance(option.nargs, int):
        return option.nargs
    return 1 if option.nargs in (None, "?") else math.inf


def _options(words: Sequence[str]) -> list[str]:
    return list(_parser_of(words)._option_string_actions)


def _parser_of(words: Sequence[str]) -> ArgumentParser:
    """Return the parser of the command or verb that the words begin with."""
    parser: ArgumentParser = build(words)
    for word in [word for word in words if not word.startswith("-")][:2]:
        group = parser._subparsers
        choices = group._group_actions[0].choices if group is not None else {}
        parser = choices.get(word, parser)  # type: ignore[union-attr] # parsers by their names
    return parser


#: What a shell reads in double quotes, and how that is written there.
_SPECIAL, _ESCAPE = re.compile(r'(["\\$`])'), r"\\\1"
#: The kind of interface that an argument names; None for any.
_TYPES = {
    "message_type": "msg",
    "topic_type": "msg",
    "service_type": "srv",
    "action_type": "action",
    "type": None,
}
#: Arguments that name what is in the graph, and what each of them names.
_NAMES = {
    "node_name": "node",
    "topic_name": "topic",
    "topic": "topic",
    "topics": "topic",
    "topics_positional": "topic",
    "exclude_topics": "topic",
    "service_name": "service",
    "action_name": "action",
}
#: Verbs whose argument `node_name` is a name for a node of their own.
_OWN_NODE = (["topic", "pub"], ["bag", "record"], ["pkg", "create"])


def _values(argument: str, given: Mapping[str, str], names: list[str]) -> list[str]:
    """Return what an argument may be.

    Args:
        argument: Its name in the parser.
        given: The arguments before it.
        names: The command, and its verb, if it has any.
    """
    from ros2_command import packages

    if argument == "package_name":
        return list(packages.all_packages())
    if argument == "executable_name":
        package = given["package_name"]
        return [one.name for one in packages.executables(packages.package_prefix(package), package)]
    if argument in _TYPES:
        kind = _TYPES[argument]
        of_name = _own_types(given)
        return of_name or [
            one.name for one in packages.all_interfaces() if kind in (None, one.kind)
        ]
    if argument in ("values", "goal"):
        return _prototype(given)
    if argument in ("launch_file_name", "launch_arguments"):
        from ros2_command.verbs.launch import words_after

        return words_after(given["package_name"], given.get("launch_file_name"))
    if argument in ("parameter_name", "parameter_names"):
        return _parameters(given["node_name"])
    if argument in _NAMES and not (argument == "node_name" and names in _OWN_NODE):
        return [name for name, _ in visible(_entries(_NAMES[argument]), hidden=False)]
    return []


def _own_types(given: Mapping[str, str]) -> list[str]:
    """Return the types of the topic, service or action that is named before the type."""
    for argument, name in given.items():
        if argument in _NAMES:
            return dict(_entries(_NAMES[argument])).get(absolute(name), [])
    return []


def _entries(what: str) -> Entries:
    """Return the nodes, topics, services or actions of the graph, with their types."""
    from ros2_command.graph import open_graph

    with open_graph() as graph:
        graph.settle()
        if what == "node":
            return [(name, []) for name in graph.nodes()]
        if what == "action":
            from rclpy.action import get_action_names_and_types

            return list(get_action_names_and_types(graph.node))
        return graph.services() if what == "service" else graph.topics()


def _prototype(given: Mapping[str, str]) -> list[str]:
    """Return values to fill in: those of a new message, on one line and in quotes."""
    from ros2_command.messages import prototype

    argument, name = next((one for one in given.items() if one[0] in _TYPES), ("", ""))
    kind = type_class(name, _TYPES.get(argument) or "msg")
    part = {"srv": "Request", "action": "Goal"}.get(_TYPES.get(argument) or "")
    text = prototype(getattr(kind, part)() if part else kind())
    return [f'"{_SPECIAL.sub(_ESCAPE, text)}"']


def _parameters(node: str) -> list[str]:
    from ros2_command.graph import open_graph
    from ros2_command.verbs.param import RemoteParameters

    with open_graph() as graph:
        return RemoteParameters(graph, absolute(node)).names()


VERBS = {"": Verb("", _main, _add_arguments)}
