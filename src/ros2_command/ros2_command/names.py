"""Check and look up the names of nodes, topics, services and types that people type.

A name that is not there gets the nearest one as a suggestion.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Sequence
from difflib import SequenceMatcher, get_close_matches
from importlib import import_module
from typing import TYPE_CHECKING

from ros2_command.errors import CommandError, note
from ros2_command.untyped import Untyped

if TYPE_CHECKING:
    from types import ModuleType

    from ros2_command.graph import Graph

_PART = re.compile(r"[A-Za-z_][A-Za-z0-9_]*")
NOBODY = (
    "Nothing with that name is visible from this terminal. Is the node running? Is ROS_DOMAIN_ID "
    "the same?"
)
Entries = list[tuple[str, list[str]]]
_ENDS = ("", "Service")
_EXAMPLES = {
    "msg": "std_msgs/msg/Float32",
    "srv": "std_srvs/srv/Trigger",
    "action": "test_msgs/action/Fibonacci",
}
#: For each kind, its word, and what only its classes have.
_KINDS = {
    "msg": ("message", "get_fields_and_field_types"),
    "srv": ("service", "Response"),
    "action": ("action", "Goal"),
}


def is_hidden(name: str) -> bool:
    """Return whether one of the parts of a name begins with an underscore."""
    return any(part.startswith("_") for part in name.split("/"))


def absolute(name: str) -> str:
    """Return a name with its leading slash."""
    return name if name.startswith("/") else f"/{name}"


def full_name(name: str, namespace: str) -> str:
    """Return a node's name with its namespace."""
    return f"{namespace.rstrip('/')}/{name}"


def check_name(kind: str, name: str) -> None:
    """Refuse a name that cannot be a topic's or a service's.

    Raises:
        CommandError: With the reason.
    """
    parts = name.removeprefix("~/").removeprefix("/").split("/")
    wrong = [part for part in parts if not _PART.fullmatch(part)]
    if not wrong:
        return
    if not name or any(not part for part in wrong):
        reason = "it is empty, ends in '/', or has two '/' in a row"
    elif wrong[0][0].isdigit():
        reason = f"'{wrong[0]}' begins with a digit"
    else:
        reason = f"'{wrong[0]}' contains characters other than letters, digits and '_'"
    raise CommandError(f"{kind} name '{name}' is invalid: {reason}")


def check_node_name(name: str) -> None:
    """Refuse a name that cannot be a node's.

    Raises:
        CommandError: With the reason.
    """
    if not _PART.fullmatch(name):
        raise CommandError(
            f"'{name}' cannot be the name of a node: it may contain only letters, digits and "
            "'_', and must not begin with a digit"
        )


def nearest(word: str, names: Iterable[str], likeness: float = 0.6) -> str | None:
    """Return the name most like a word, or None if nothing is like it.

    Args:
        word: What was typed.
        names: What would have been right.
        likeness: How like it has to be, from 0 to 1 (`difflib.SequenceMatcher.ratio`), as a whole
            and in the part after the last `/`: a common namespace or package says nothing.

    Returns:
        One of the names. Capitals do not count; neither do the parts before the last `/` if the
        last part is exactly right.
    """
    by_lower = {name.lower(): name for name in names}
    tail = _tail(word.lower())
    found = [
        name for name in get_close_matches(word.lower(), by_lower, n=10, cutoff=likeness)
        if SequenceMatcher(None, _tail(name), tail).ratio() >= likeness
    ]  # fmt: skip
    if not found and tail:
        found = sorted(name for name in by_lower if _tail(name) == tail)
    return by_lower[found[0]] if found else None


def _tail(name: str) -> str:
    return name.rpartition("/")[2]


def did_you_mean(word: str, names: Iterable[str], otherwise: str = "") -> str:
    """Return a line that suggests the nearest name, or another line if there is none."""
    name = nearest(word, names)
    return f"Did you mean '{name}'?" if name else otherwise


def types_of(typed: str, entries: Entries, complaint: str, silent: bool = False) -> list[str]:
    """Return the types of a name, which has to be typed in full, as the original wants it.

    Args:
        typed: The name as typed.
        entries: Names with their types.
        complaint: The first line of the error.
        silent: Whether the original says nothing, so that the line is a note.

    Raises:
        CommandError: If there is none; the nearest name is suggested.
    """
    found = dict(entries)
    if typed not in found:
        lines = (complaint, suggestion(typed, found))
        raise CommandError(*(("", *lines) if silent else lines))
    return found[typed]


def of_type(entries: Entries, type_name: str, hidden: bool) -> list[str]:
    """Return the names that have a type; hidden ones only if they are wanted."""
    return [name for name, types in visible(entries, hidden) if type_name in types]


def visible(entries: Entries, hidden: bool) -> Entries:
    """Return the entries without those that are hidden, unless these are wanted, too."""
    return [one for one in entries if hidden or not is_hidden(one[0])]


def show_entries(entries: Entries, count: bool, types: bool) -> None:
    """Print names, with their types if wanted, or only how many there are."""
    if count:
        print(len(entries))
        return
    for name, carried in entries:
        print(f"{name} {show_types(carried)}" if types else name)


def suggestion(name: str, names: Sequence[str] | dict[str, list[str]]) -> str:
    """Return a line with the nearest name that is not hidden, or with what else could be wrong."""
    return did_you_mean(name, [one for one in names if not is_hidden(one)], NOBODY)


def show_types(types: Sequence[str]) -> str:
    """Return types in brackets."""
    return f"[{', '.join(types)}]"


def find_type(name: str, kind: str) -> Untyped | None:
    """Return the class of a type.

    Args:
        name: `pkg/msg/Name`, or `pkg/Name`.
        kind: `msg`, `srv` or `action`, for the short form.

    Returns:
        The class, or None if there is none of that name.
    """
    parts = name.split("/")
    if len(parts) == 2:
        parts.insert(1, kind)
    if len(parts) != 3 or not all(part.isidentifier() for part in parts):
        return None
    try:
        module = import_module(f"{parts[0]}.{parts[1]}")
    except ImportError:
        return None
    found = getattr(module, parts[2], None) or _hidden_class(module, parts[2])
    return found if isinstance(found, type) else None


def _hidden_class(module: ModuleType, name: str) -> Untyped | None:
    """Return the class of what an action has on its hidden topics and services, or None.

    The module has `Fibonacci` only; the graph also tells of `Fibonacci_FeedbackMessage`, which is
    `Fibonacci.Impl.FeedbackMessage`, and of the service `Fibonacci_SendGoal`.
    """
    whole, _, part = name.rpartition("_")
    action = getattr(module, whole, None)
    places = ((action, part), *((getattr(action, "Impl", None), f"{part}{end}") for end in _ENDS))
    return next(
        (getattr(place, member) for place, member in places if hasattr(place, member)), None
    )


def full_type(name: str, kind: str) -> str:
    """Return a type's name in its long form, `pkg/kind/Name`."""
    return name.replace("/", f"/{kind}/") if name.count("/") == 1 else name


def type_class(name: str, kind: str) -> Untyped:
    """Return the class of a message, service or action type.

    Args:
        name: `pkg/kind/Name`, or `pkg/Name`.
        kind: `msg`, `srv` or `action`.

    Raises:
        CommandError: If there is none of that name, or it is of another kind.
    """
    word, mark = _KINDS[kind]
    found = find_type(name, kind)
    if found is not None and kind == "srv" and not hasattr(found, mark):
        raise CommandError("The passed type is not a service", type_hint(name, kind))
    if not hasattr(found, mark):
        raise CommandError(f"The passed {word} type is invalid", type_hint(name, kind))
    return found


def type_hint(name: str, kind: str) -> str:
    """Return a line with the nearest type of a kind, or with what else is wrong with a name."""
    from ros2_command.packages import all_interfaces, all_packages

    how = f"A type is written like {_EXAMPLES[kind]}."
    try:
        names = [one.name for one in all_interfaces() if one.kind == kind]
        package = full_type(name, kind).split("/")[0]
        if name.count("/") in (1, 2) and package not in all_packages():
            how = _not_sourced(package)
    except CommandError:
        return how
    return did_you_mean(name, names, how)


def _not_sourced(package: str) -> str:
    return (
        f"This terminal knows no package '{package}'. If it is in a workspace of yours, build "
        "that, and run `source install/setup.bash` there, in this terminal."
    )


def class_in_graph(name: str, kind: str, owner: str) -> Untyped:
    """Return the class of a type that the graph tells of.

    Args:
        name: The type, `pkg/kind/Name`.
        kind: What it has to be.
        owner: What carries the type, for the note; empty if somebody has typed it.

    Raises:
        CommandError: If this terminal cannot load it.
    """
    word, mark = _KINDS[kind]
    found = find_type(name, kind)
    if found is None or not hasattr(found, mark):
        carried = f"{owner} carries that type, and this terminal cannot load it."
        why = [carried, _not_sourced(name.split("/")[0])] if owner else [type_hint(name, kind)]
        raise CommandError(f"The {word} type '{name}' is invalid", *why)
    return found


def topic_class(typed: str, type_name: str | None, graph: Graph) -> Untyped:
    """Return the message class of a topic: the one that is given, or the one of the graph.

    Raises:
        CommandError: If it cannot be known, or does not exist.
    """
    name = absolute(typed)
    types = dict(graph.topics()).get(name, [])
    if type_name is not None:
        found = type_class(type_name, "msg")
        if types and (full := full_type(type_name, "msg")) not in types:
            raise CommandError(
                "",
                f"The topic '{typed}' carries {show_types(types)}, not {full}",
                "Messages of another type are never received. Leave the type out, or correct it.",
            )
        return found
    if not types:
        print(f"WARNING: topic [{typed}] does not appear to be published yet")
        raise CommandError(
            "Could not determine the type for the passed topic",
            suggestion(name, dict(graph.topics())),
        )
    if len(types) > 1:
        raise CommandError(
            f"Cannot echo topic '{typed}', as it contains more than one type: {show_types(types)}",
            "Give the type that you want after the topic.",
        )
    return class_in_graph(types[0], "msg", f"The topic '{typed}'")


def check_node(name: str, nodes: Sequence[str], complaint: str) -> None:
    """Refuse the full name of a node that is not there.

    Raises:
        CommandError: With the nearest name.
    """
    if name not in nodes:
        raise CommandError(complaint, suggestion(name, list(nodes)))


def wait_for_server(
    graph: Graph, ready: Callable[[], bool], what: str, typed: str, asked: str,
    entries: Callable[[], Entries],
) -> None:  # fmt: skip
    """Wait until somebody offers a service or an action; after a while say that nobody does.

    Args:
        graph: Where the client is.
        ready: Whether a server is there.
        what: `service` or `action`.
        typed: Its name as typed.
        asked: Its type, `pkg/kind/Name`.
        entries: Tells the names and types of the graph.

    Raises:
        CommandError: If it is offered with another type.
    """
    graph.settle(ready)
    if ready():
        return
    name = absolute(typed)
    found = {one: types for one, types in entries() if types != [asked] or one != name}
    if name in found:
        others = [one for one in found[name] if one != asked]
        raise CommandError(
            "",
            f"The {what} '{name}' has the type {show_types(others)}, not {asked}",
            "A request with another type is never answered.",
        )
    note(f"No node offers '{name}'. {suggestion(name, found)}")
    graph.spin_until(ready)
