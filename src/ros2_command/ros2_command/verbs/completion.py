"""Implement `ros2 completion`: print a shell's completion script, and compute the completions."""

from __future__ import annotations

from argparse import REMAINDER, ArgumentParser, Namespace
from collections.abc import Sequence
from importlib.resources import files

from ros2_command.errors import CommandError
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
    plain = [word for word in done if not word.startswith("-")]
    try:
        found = _options(done) if started.startswith("-") else _next(plain)
    except (CommandError, SystemExit):
        found = []
    return sorted({one for one in found if one.startswith(started)})


def _next(words: list[str]) -> list[str]:
    if not words:
        return list(COMMANDS)
    if words[0] not in COMMANDS:
        return []
    verbs = verbs_of(words[0])
    if "" not in verbs and len(words) == 1:
        return list(verbs)
    given = words[1:] if "" in verbs else words[2:]
    arguments = [one.dest for one in _parser_of(words)._actions if not one.option_strings]
    if len(given) >= len(arguments) or words[:2] == ["pkg", "create"]:  # which wants a new name
        return []
    return _values(arguments[len(given)], given)


def _options(words: list[str]) -> list[str]:
    return list(_parser_of(words)._option_string_actions)


def _parser_of(words: list[str]) -> ArgumentParser:
    """Return the parser of the command or verb that the words begin with."""
    parser: ArgumentParser = build(words)
    for word in [word for word in words if not word.startswith("-")][:2]:
        group = parser._subparsers
        choices = group._group_actions[0].choices if group is not None else {}
        parser = choices.get(word, parser)  # type: ignore[union-attr] # parsers by their names
    return parser


#: The kind of interface that an argument names; None for any.
_TYPES = {
    "message_type": "msg",
    "topic_type": "msg",
    "service_type": "srv",
    "action_type": "action",
    "type": None,
}


def _values(argument: str, given: Sequence[str]) -> list[str]:
    """Return what an argument may be.

    Args:
        argument: Its name in the parser.
        given: The arguments before it.
    """
    from ros2_command import packages

    if argument == "package_name":
        return list(packages.all_packages())
    if argument == "executable_name":
        found = packages.executables(packages.package_prefix(given[0]), given[0])
        return [path.name for path in found]
    if argument in _TYPES:
        kind = _TYPES[argument]
        return [one.name for one in packages.all_interfaces() if kind in (None, one.kind)]
    if argument in ("launch_file_name", "launch_arguments"):
        from ros2_command.verbs.launch import words_after

        return words_after(given[0], given[1] if len(given) > 1 else None)
    if argument in ("parameter_name", "parameter_names"):
        return _parameters(given[0])
    return _from_graph(argument)


def _from_graph(argument: str) -> list[str]:
    from ros2_command.graph import open_graph
    from ros2_command.names import visible

    if argument not in ("node_name", "topic_name", "topics_positional", "service_name",
                        "action_name"):  # fmt: skip
        return []
    with open_graph() as graph:
        graph.settle()
        if argument == "node_name":
            return graph.nodes()
        if argument == "action_name":
            from rclpy.action import get_action_names_and_types

            entries = get_action_names_and_types(graph.node)
        else:
            entries = graph.services() if argument == "service_name" else graph.topics()
    return [name for name, _ in visible(entries, hidden=False)]


def _parameters(node: str) -> list[str]:
    from ros2_command.graph import open_graph
    from ros2_command.names import absolute
    from ros2_command.verbs.param import RemoteParameters

    with open_graph() as graph:
        return RemoteParameters(graph, absolute(node)).names()


VERBS = {"": Verb("", _main, _add_arguments)}
