"""Topics, types and nodes by the names people type."""

from __future__ import annotations

from collections.abc import Sequence

from ros2_command.errors import CommandError
from ros2_command.graph import Graph
from ros2_command.message_types import find_type, is_message
from ros2_command.names import absolute, is_hidden
from ros2_command.nearest import did_you_mean
from ros2_command.untyped import Untyped

NOBODY = (
    "No node that can be seen from here has it. Is the node running? Is ROS_DOMAIN_ID the same?"
)


def pick(
    typed: str, entries: Sequence[tuple[str, list[str]]], complaint: str
) -> tuple[str, list[str]]:
    """The entry of a name, with or without its leading slash.

    Args:
        typed: The name as typed.
        entries: Names with their types.
        complaint: The first line of the error.

    Raises:
        CommandError: If there is none; the nearest name is suggested.
    """
    found = dict(entries)
    name = absolute(typed)
    if name not in found:
        raise CommandError(complaint, suggestion(name, found))
    return name, found[name]


def suggestion(name: str, names: Sequence[str] | dict[str, list[str]]) -> str:
    """The nearest name that is not hidden, or what else could be wrong."""
    return did_you_mean(name, [one for one in names if not is_hidden(one)], NOBODY)


def show_types(types: Sequence[str]) -> str:
    """Types in brackets."""
    return f"[{', '.join(types)}]"


def message_class(name: str, graph: Graph | None = None) -> Untyped:
    """The class of a message type.

    Raises:
        CommandError: If there is none of that name.
    """
    found = find_type(name, "msg")
    if found is None or not is_message(found):
        raise CommandError("The passed message type is invalid", type_hint(name, "msg"))
    return found


def type_hint(name: str, kind: str) -> str:
    """The nearest type of a kind, or how a type is written."""
    from ros2_command.definitions import all_interfaces

    example = {"msg": "std_msgs/msg/Float32", "srv": "std_srvs/srv/Trigger"}[kind]
    how = f"A type is written like {example}."
    try:
        names = [one.name for one in all_interfaces() if one.kind == kind]
    except CommandError:
        return how
    return did_you_mean(name, names, how)


def topic_class(typed: str, type_name: str | None, graph: Graph) -> Untyped:
    """The message class of a topic: the one that is given, or the one that the graph tells.

    Raises:
        CommandError: If it cannot be known, or does not exist, or nobody publishes it.
    """
    name = absolute(typed)
    types = dict(graph.topics()).get(name, [])
    if type_name is None:
        if not types:
            print(f"WARNING: topic [{typed}] does not appear to be published yet")
            raise CommandError(
                "Could not determine the type for the passed topic",
                suggestion(name, dict(graph.topics())),
            )
        if len(types) > 1:
            raise CommandError(
                f"Cannot echo topic '{typed}', as it contains more than one type: "
                f"{show_types(types)}",
                "Say which one you want, after the topic.",
            )
        type_name = types[0]
    found = message_class(type_name)
    parts = type_name.split("/")
    full = f"{parts[0]}/msg/{parts[-1]}"
    if types and full not in types:
        raise CommandError(
            f"The topic '{typed}' carries {show_types(types)}, not {full}",
            "Messages of another type are never received. Leave the type out, or correct it.",
        )
    return found


def find_node(typed: str, nodes: Sequence[str], complaint: str) -> str:
    """The full name of a node.

    Raises:
        CommandError: If there is none of that name; the nearest one is suggested.
    """
    name = absolute(typed)
    if name not in nodes:
        raise CommandError(complaint, suggestion(name, list(nodes)))
    return name
