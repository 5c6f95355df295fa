"""Message and service classes by their names."""

from __future__ import annotations

from importlib import import_module

from ros2_command.untyped import Untyped


def find_type(name: str, kind: str) -> Untyped | None:
    """The class of a type.

    Args:
        name: `pkg/msg/Name`, or `pkg/Name`.
        kind: `msg` or `srv`, for the short form.

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
    found = getattr(module, parts[2], None)
    return found if isinstance(found, type) else None


def is_message(found: Untyped) -> bool:
    """Whether a class is a message's."""
    return hasattr(found, "get_fields_and_field_types")


def is_service(found: Untyped) -> bool:
    """Whether a class is a service's."""
    return hasattr(found, "Request") and hasattr(found, "Response")
