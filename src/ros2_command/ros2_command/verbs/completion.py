"""Implement `ros2 completion`: print a shell's completion script, and compute the completions."""

from __future__ import annotations

from argparse import REMAINDER, ArgumentParser, Namespace
from collections.abc import Callable, Sequence
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
    source = _SOURCES.get(arguments[len(given)])
    return source(given) if source else []


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


def _packages(given: list[str]) -> list[str]:
    from ros2_command.packages import all_packages

    return list(all_packages())


def _executables(given: list[str]) -> list[str]:
    from ros2_command.packages import executables, package_prefix

    return [path.name for path in executables(package_prefix(given[0]), given[0])]


def _interfaces(kind: str | None) -> Callable[[list[str]], list[str]]:
    def find(given: list[str]) -> list[str]:
        from ros2_command.packages import all_interfaces

        return [one.name for one in all_interfaces() if kind in (None, one.kind)]

    return find


def _from_graph(what: str) -> Callable[[list[str]], list[str]]:
    def ask(given: list[str]) -> list[str]:
        from ros2_command.graph import open_graph
        from ros2_command.names import is_hidden

        with open_graph() as graph:
            graph.settle()
            if what == "node":
                return graph.nodes()
            if what == "action":
                from rclpy.action import get_action_names_and_types

                entries = get_action_names_and_types(graph.node)
            else:
                entries = graph.topics() if what == "topic" else graph.services()
        return [name for name, _ in entries if not is_hidden(name)]

    return ask


def _parameters(given: list[str]) -> list[str]:
    from ros2_command.graph import open_graph
    from ros2_command.names import absolute
    from ros2_command.verbs.param import RemoteParameters

    with open_graph() as graph:
        return RemoteParameters(graph, absolute(given[0])).names()


#: Where the values of an argument come from, by its name.
_SOURCES: dict[str, Callable[[list[str]], list[str]]] = {
    "package_name": _packages,
    "executable_name": _executables,
    "message_type": _interfaces("msg"),
    "topic_type": _interfaces("msg"),
    "service_type": _interfaces("srv"),
    "action_type": _interfaces("action"),
    "type": _interfaces(None),
    "topic_name": _from_graph("topic"),
    "topics_positional": _from_graph("topic"),
    "node_name": _from_graph("node"),
    "service_name": _from_graph("service"),
    "action_name": _from_graph("action"),
    "parameter_name": _parameters,
    "parameter_names": _parameters,
}


VERBS = {"": Verb("", _main, _add_arguments)}
