"""Fill messages from YAML, as `topic pub` and `service call` accept it."""

from __future__ import annotations

import array
import sys
from argparse import ArgumentParser
from collections.abc import Callable
from typing import Any

from ros2_command.errors import CommandError
from ros2_command.lookup import find_type
from ros2_command.message_text import is_message_value
from ros2_command.names import did_you_mean
from ros2_command.untyped import Untyped

FAILED = "Failed to populate field: "
_TIME = "builtin_interfaces/msg/Time"
_HEADER = "std_msgs/msg/Header"

#: Puts the present time into the stamps for which `auto` or `now` was written.
Stamper = Callable[[Any], None]


def read_yaml(text: str) -> Untyped:
    """Return the one YAML document of a text.

    Raises:
        CommandError: If it is broken, or there are several.
    """
    import yaml

    try:
        return yaml.safe_load(text)
    except yaml.YAMLError as error:
        mark = getattr(error, "problem_mark", None)
        place = f" (line {mark.line + 1}, column {mark.column + 1})" if mark else ""
        raise CommandError(
            f"The value is not valid YAML: {getattr(error, 'problem', None) or error}{place}",
            "Write a space after each colon, and quotes around the whole, for example: "
            '"{data: 25.5}"',
        ) from None


def add_value_arguments(parser: ArgumentParser, name: str, about: str) -> None:
    """Add the arguments of verbs that send a message.

    Args:
        parser: The verb's parser.
        name: Of the positional argument.
        about: Its help.
    """
    parser.add_argument(name, nargs="?", help=about)
    parser.add_argument("--stdin", action="store_true", help="Read values from standard input")


def value_text(values: str | None, stdin: bool) -> str:
    """Return the text of the values: the argument, or standard input."""
    return sys.stdin.read() if stdin else "{}" if values is None else values


def fill(message: Untyped, values: Untyped) -> list[Stamper]:
    """Set the fields of a message.

    Returns:
        What to call with the present time before each sending, to renew its stamps.

    Raises:
        CommandError: If a field does not exist, or cannot take its value.
    """
    if not isinstance(values, dict):
        raise CommandError(
            f"{FAILED}Value '{values}' is expected to be a dictionary but is a "
            f"{type(values).__name__}"
        )
    known = message.get_fields_and_field_types()
    stampers: list[Stamper] = []
    for name, value in values.items():
        if name not in known:
            raise CommandError(
                f"{FAILED}'{type(message).__name__}' object has no attribute '{name}'",
                did_you_mean(str(name), known, f"It has: {', '.join(known) or 'no fields'}"),
            )
        kind = message.SLOT_TYPES[list(known).index(name)]
        stampers += _fill_field(message, name, kind, value)
    return stampers


def _fill_field(message: Untyped, name: str, kind: Untyped, value: Untyped) -> list[Stamper]:
    special = _special(message, name, value)
    if special is not None:
        return special
    old = getattr(message, name)
    if is_message_value(old):
        return fill(old, value)
    if _is_message_array(kind):
        return _fill_messages(message, name, kind, value)
    try:
        message._check_fields = True  # numbers out of range are refused, not sent
        setattr(message, name, _convert(old, kind, value))
    except AssertionError as error:
        reason = " ".join(str(error).split())
        raise CommandError(f"{FAILED}{reason}: {value!r} does not fit") from None
    except (TypeError, ValueError, OverflowError) as error:
        raise CommandError(f"{FAILED}{error}") from None
    finally:
        message._check_fields = False
    return []


def _special(message: Untyped, name: str, value: Untyped) -> list[Stamper] | None:
    """Return the stampers for `auto` and `now`, or None if the value is neither."""
    type_name = message.get_fields_and_field_types()[name].replace("/", "/msg/")
    if value == "auto" and type_name == _HEADER:
        return [lambda now: setattr(getattr(message, name), "stamp", now)]
    if value == "now" and type_name == _TIME:
        return [lambda now: setattr(message, name, now)]
    return None


def _is_message_array(kind: Untyped) -> bool:
    return hasattr(getattr(kind, "value_type", None), "namespaced_name")


def _fill_messages(message: Untyped, name: str, kind: Untyped, value: Untyped) -> list[Stamper]:
    if not isinstance(value, list):
        raise CommandError(f"{FAILED}'{type(value).__name__}' object is not iterable")
    element = find_type("/".join(kind.value_type.namespaced_name()), "msg")
    assert element is not None, "the class of a field is loaded with the message"
    items, stampers = [], []
    for one in value:
        items.append(element())
        stampers += fill(items[-1], one)
    if hasattr(kind, "size") and len(items) != kind.size:
        raise CommandError(f"{FAILED}'{name}' holds {kind.size} elements, not {len(items)}")
    setattr(message, name, items)
    return stampers


def _convert(old: Untyped, kind: Untyped, value: Untyped) -> Untyped:
    if isinstance(old, array.array):
        return array.array(old.typecode, value)
    if hasattr(old, "dtype"):
        import numpy

        return numpy.array(value, dtype=old.dtype)
    if isinstance(old, bytes):
        return bytes([value]) if isinstance(value, int) else str(value).encode("latin-1")
    if isinstance(old, list):
        return _convert_list(kind, value)
    return type(old)(value)


def _convert_list(kind: Untyped, value: Untyped) -> list[Any]:
    items = list(value) if not isinstance(value, str) else None
    if items is None:
        raise TypeError("'str' object is not a list")
    if getattr(kind.value_type, "typename", None) == "octet":
        return [bytes([one]) if isinstance(one, int) else one for one in items]
    if hasattr(kind.value_type, "typename"):
        return items
    return [str(one) for one in items]
