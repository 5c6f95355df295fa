"""Implement `ros2 completion`: print a shell's completion script, and compute the completions."""

from __future__ import annotations

from argparse import REMAINDER, ArgumentParser, Namespace
from collections.abc import Callable, Sequence
from importlib.resources import files

from ros2_command.errors import CommandError
from ros2_command.parser import build
from ros2_command.registry import COMMANDS, Verb

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


#: What the arguments of a verb are, in order.
_ARGUMENTS: dict[tuple[str, str | None], tuple[str, ...]] = {
    ("run", None): ("package", "executable"),
    **{("pkg", verb): ("package",) for verb in ("executables", "prefix", "xml")},
    **{("topic", verb): ("topic",) for verb in ("bw", "delay", "hz", "info", "type")},
    ("topic", "echo"): ("topic", "msg"),
    ("topic", "pub"): ("topic", "msg"),
    ("topic", "find"): ("msg",),
    ("node", "info"): ("node",),
    **{("param", verb): ("node",) for verb in ("dump", "list", "load")},
    **{("param", verb): ("node", "parameter") for verb in ("delete", "describe", "get", "set")},
    **{("service", verb): ("service", "srv") for verb in ("call", "echo")},
    **{("service", verb): ("service",) for verb in ("info", "type")},
    ("service", "find"): ("srv",),
    **{("action", verb): ("action",) for verb in ("info", "type")},
    ("action", "send_goal"): ("action", "goal"),
    ("bag", "record"): ("topic",),
    ("interface", "show"): ("type",),
    ("interface", "proto"): ("type",),
    ("interface", "package"): ("package",),
}


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
    command = words[0]
    if command not in COMMANDS:
        return []
    verbs = COMMANDS[command].verbs
    if verbs and len(words) == 1:
        return list(verbs)
    key, given = ((command, words[1]), words[2:]) if verbs else ((command, None), words[1:])
    wanted = _ARGUMENTS.get(key, ())
    return _SOURCES[wanted[len(given)]](given) if len(given) < len(wanted) else []


def _options(words: list[str]) -> list[str]:
    parser = build(words)
    plain = [word for word in words if not word.startswith("-")]
    for word in plain[:2]:
        group = parser._subparsers
        choices = group._group_actions[0].choices if group is not None else {}
        parser = choices.get(word, parser)  # type: ignore[union-attr]
    return list(parser._option_string_actions)


def _packages(given: list[str]) -> list[str]:
    from ros2_command.packages import all_packages

    return list(all_packages())


def _executables(given: list[str]) -> list[str]:
    from ros2_command.packages import executables, package_prefix

    return [path.name for path in executables(package_prefix(given[0]), given[0])]


def _interfaces(kind: str | None) -> Callable[[list[str]], list[str]]:
    def find(given: list[str]) -> list[str]:
        from ros2_command.definitions import all_interfaces

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


_SOURCES: dict[str, Callable[[list[str]], list[str]]] = {
    "package": _packages,
    "executable": _executables,
    "msg": _interfaces("msg"),
    "srv": _interfaces("srv"),
    "goal": _interfaces("action"),
    "type": _interfaces(None),
    "topic": _from_graph("topic"),
    "node": _from_graph("node"),
    "service": _from_graph("service"),
    "action": _from_graph("action"),
    "parameter": _parameters,
}


VERBS = {"": Verb(_main, _add_arguments)}
