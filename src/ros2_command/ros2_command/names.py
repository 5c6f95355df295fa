"""Names of nodes, topics and services."""

from __future__ import annotations

import re

from ros2_command.errors import CommandError

_PART = re.compile(r"[A-Za-z_][A-Za-z0-9_]*")


def is_hidden(name: str) -> bool:
    """Whether one of the parts of a name begins with an underscore."""
    return any(part.startswith("_") for part in name.split("/"))


def absolute(name: str) -> str:
    """A name with its leading slash."""
    return name if name.startswith("/") else f"/{name}"


def full_name(name: str, namespace: str) -> str:
    """A node's name with its namespace."""
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
        reason = f"'{wrong[0]}' holds something else than letters, digits and '_'"
    raise CommandError(f"{kind} name '{name}' is invalid: {reason}")


def check_node_name(name: str) -> None:
    """Refuse a name that cannot be a node's.

    Raises:
        CommandError: With the reason.
    """
    if not _PART.fullmatch(name):
        raise CommandError(
            f"'{name}' cannot be the name of a node: it may hold letters, digits and '_' only, "
            "and must not begin with a digit"
        )
