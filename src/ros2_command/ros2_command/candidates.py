"""What could come next on a command line."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from ros2_command.errors import CommandError
from ros2_command.parser import build
from ros2_command.registry import COMMANDS

#: What the arguments of a verb are, in order.
_ARGUMENTS: dict[tuple[str, str | None], tuple[str, ...]] = {
    ("run", None): ("package", "executable"),
    **{("pkg", verb): ("package",) for verb in ("executables", "prefix", "xml")},
    **{("topic", verb): ("topic",) for verb in ("bw", "hz", "info", "type")},
    ("topic", "echo"): ("topic", "msg"),
    ("topic", "pub"): ("topic", "msg"),
    ("topic", "find"): ("msg",),
    ("node", "info"): ("node",),
    **{("param", verb): ("node", "parameter") for verb in ("dump", "get", "list", "set")},
    ("service", "call"): ("service", "srv"),
    ("service", "type"): ("service",),
    ("interface", "show"): ("type",),
    ("interface", "proto"): ("type",),
    ("interface", "package"): ("package",),
}


def candidates(words: Sequence[str]) -> list[str]:
    """The words that could stand in the place of the last one.

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
            entries = graph.topics() if what == "topic" else graph.services()
        return [name for name, _ in entries if not is_hidden(name)]

    return ask


def _parameters(given: list[str]) -> list[str]:
    from ros2_command.graph import open_graph
    from ros2_command.names import absolute
    from ros2_command.parameters import RemoteParameters

    with open_graph() as graph:
        return RemoteParameters(graph, absolute(given[0])).names()


_SOURCES: dict[str, Callable[[list[str]], list[str]]] = {
    "package": _packages,
    "executable": _executables,
    "msg": _interfaces("msg"),
    "srv": _interfaces("srv"),
    "type": _interfaces(None),
    "topic": _from_graph("topic"),
    "node": _from_graph("node"),
    "service": _from_graph("service"),
    "parameter": _parameters,
}
