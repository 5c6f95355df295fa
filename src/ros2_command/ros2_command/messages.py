"""Format messages as YAML and CSV, as `topic echo` shows them, and fill them from YAML.

Upstream's rosidl_runtime_py, which does this there, is on no registry.
"""

from __future__ import annotations

import array
import sys
from argparse import ArgumentParser, ArgumentTypeError, Namespace
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import Any

from ros2_command.errors import CommandError
from ros2_command.names import did_you_mean, find_type
from ros2_command.registry import Argument, argument, flag, one_of
from ros2_command.untyped import Untyped


@dataclass(frozen=True)
class Style:
    """Say how to show a message.

    Attributes:
        limit: Arrays and strings longer than this are cut; None shows all.
        no_arr: Show only the type and length of arrays.
        no_str: Show only the length of strings.
        flow: Show arrays inline.
    """

    limit: int | None = 128
    no_arr: bool = False
    no_str: bool = False
    flow: bool = False


def add_style_arguments(parser: ArgumentParser, field: Argument | None = None) -> None:
    """Add the options of verbs that show messages.

    Args:
        parser: The verb's parser.
        field: Declares what one of them has after the first option.
    """
    add = parser.add_argument
    add("--csv", action="store_true", help="Output all recursive fields separated by commas")
    if field is not None:
        field(parser)
    add("--full-length", "-f", action="store_true",
        help="Output all elements for arrays, bytes, and strings")  # fmt: skip
    add("--truncate-length", "-l", type=_unsigned, default=128,
        help="The length to truncate arrays, bytes, and strings to (default: 128)")  # fmt: skip
    add("--no-arr", action="store_true", help="Don't print array fields of messages")
    add("--no-str", action="store_true", help="Don't print string fields of messages")
    add("--flow-style", action="store_true", help="Print collections in the flow style")


def _unsigned(text: str) -> int:
    if not text.isdecimal():
        raise ArgumentTypeError("value must be non-negative integer")
    return int(text)


def style_of(args: Namespace) -> Style:
    """Return the style that the options ask for."""
    limit = None if args.full_length else args.truncate_length
    return Style(limit, args.no_arr, args.no_str, args.flow_style)


def is_message_value(value: Untyped) -> bool:
    """Return whether a value is a message."""
    return hasattr(value, "get_fields_and_field_types")


def is_array(value: Untyped) -> bool:
    """Return whether a value is a sequence of values, and not a text."""
    if isinstance(value, list | tuple | array.array):
        return True
    # An array of a fixed size is one of NumPy's; its elements have a dtype, too, but no dimension.
    return getattr(value, "ndim", 0) > 0


def fields_of(message: Untyped) -> Iterable[tuple[str, Any, Any]]:
    """Yield name, type and value of each field, in the order of the definition."""
    for name, kind in zip(message.get_fields_and_field_types(), message.SLOT_TYPES, strict=True):
        yield name, kind, getattr(message, name)


def to_plain(message: Untyped, style: Style) -> dict[str, Any]:
    """Return a message as dictionaries, lists and plain values."""
    return {name: _plain(value, kind, style) for name, kind, value in fields_of(message)}


def _plain(value: Untyped, kind: Untyped, style: Style) -> Untyped:
    if is_message_value(value):
        return to_plain(value, style)
    if isinstance(value, str | bytes):
        return _plain_text(value, style)
    if not is_array(value):
        return value.item() if hasattr(value, "item") else value
    if style.no_arr and kind is not None:
        return _array_summary(value, kind)
    cut = style.limit is not None and len(value) > style.limit
    items = value[: style.limit] if cut else value
    plain = [_plain(item, None, style) for item in items]
    return _Inline([*plain, *(["..."] if cut else [])])


class _Inline(list[Any]):
    """Mark a list that may be shown on one line."""


def _plain_text(value: str | bytes, style: Style) -> str:
    if style.no_str and isinstance(value, str):
        return f"<string length: <{len(value)}>>"
    text = value if isinstance(value, str) else value.decode("latin-1")
    if style.limit is not None and len(text) > style.limit:
        return text[: style.limit] + "..."
    return text


def _array_summary(value: Untyped, kind: Untyped) -> str:
    element = _type_name(kind.value_type)
    if hasattr(kind, "size"):
        return f"<array type: {element}[{len(value)}]>"
    bound = f"[{kind.maximum_size}]" if hasattr(kind, "maximum_size") else ""
    return f"<sequence type: {element}{bound}, length: {len(value)}>"


def _type_name(kind: Untyped) -> str:
    if hasattr(kind, "typename"):
        return str(kind.typename)
    if hasattr(kind, "namespaced_name"):
        return "/".join(kind.namespaced_name())
    return "wstring" if "WString" in type(kind).__name__ else "string"


def plain_to_yaml(value: Untyped, flow: bool = False, one_line: bool = False) -> str:
    """Return dictionaries, lists and plain values as YAML that ends in a newline.

    Args:
        value: What to write.
        flow: Whether arrays stand on one line.
        one_line: Whether all of it does.
    """
    import yaml

    class Dumper(yaml.SafeDumper):
        def ignore_aliases(self, data: Untyped) -> bool:
            return True

    def inline(dumper: Untyped, data: _Inline) -> Untyped:
        return dumper.represent_sequence(
            "tag:yaml.org,2002:seq", data, flow_style=flow or one_line or None
        )

    Dumper.add_representer(_Inline, inline)
    return str(
        yaml.dump(
            value, Dumper=Dumper, allow_unicode=True, sort_keys=False, width=float("inf"),
            default_flow_style=one_line,
        )
    )  # fmt: skip


def to_yaml(message: Untyped, style: Style) -> str:
    """Return a message as YAML that ends in a newline."""
    return plain_to_yaml(to_plain(message, style), style.flow)


def prototype(message: Untyped) -> str:
    """Return a message as YAML on one line, as it is typed in a command."""
    return plain_to_yaml(to_plain(message, Style(limit=None)), one_line=True).strip()


def to_csv(message: Untyped, style: Style) -> str:
    """Return all values of a message on one line.

    As in the original, an empty value that nothing stands before takes no column.
    """
    return _joined(_cell(value, kind, style) for _, kind, value in fields_of(message))


def _joined(cells: Iterable[str]) -> str:
    line = ""
    for cell in cells:
        line += f",{cell}" if line else cell
    return line


def _cell(value: Untyped, kind: Untyped, style: Style) -> str:
    if is_message_value(value):
        return to_csv(value, style)
    if isinstance(value, str | bytes):
        return _csv_text(value, style)
    if not is_array(value):
        return str(value)
    if style.no_arr and kind is not None:
        return _array_summary(value, kind)
    cut = style.limit is not None and len(value) > style.limit
    cells = [_cell(item, None, style) for item in (value[: style.limit] if cut else value)]
    return _joined([*cells, *(["..."] if cut else [])])


def _csv_text(value: str | bytes, style: Style) -> str:
    if style.no_str and isinstance(value, str):
        return f"<string length: <{len(value)}>>"
    if style.limit is None or len(value) <= style.limit:
        return str(value)
    cut = value[: style.limit]
    return str(cut + b"..." if isinstance(cut, bytes) else f"{cut}...")


# Values.

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


def value_arguments(name: str, about: str) -> Argument:
    """Return what declares the arguments of verbs that send a message.

    Args:
        name: Of the positional argument.
        about: Its help.
    """
    return one_of(
        argument(name, nargs="?", default="{}", help=about),
        flag("--stdin", help="Read values from standard input"),
    )


def value_text(values: str, stdin: bool) -> str:
    """Return the text of the values: the argument, or standard input."""
    return sys.stdin.read() if stdin else values


class FieldError(CommandError):
    """Say that a field does not exist, or cannot take its value.

    Args:
        text: What is wrong.
        kind: The name of the exception that the original has for it, which some verbs show.
        *notes: What to try.
    """

    def __init__(self, text: str, kind: str, *notes: str) -> None:
        super().__init__(f"Failed to populate field: {text}", *notes)
        self.as_exception = f"{kind}({text!r})"


def fill(message: Untyped, values: Untyped, stamps: bool = True) -> list[Stamper]:
    """Set the fields of a message.

    Args:
        message: The message.
        values: A dictionary, as YAML has it.
        stamps: Whether `auto` and `now` stand for the present time, as they do for `topic pub`.

    Returns:
        What to call with the present time before each sending, to renew its stamps.

    Raises:
        FieldError: If a field does not exist, or cannot take its value.
    """
    if not isinstance(values, dict):
        kind = type(values).__name__
        text = f"Value '{values}' is expected to be a dictionary but is a {kind}"
        raise FieldError(text, "TypeError")
    known = message.get_fields_and_field_types()
    stampers: list[Stamper] = []
    for name, value in values.items():
        if name not in known:
            has = f"It has: {', '.join(known) or 'no fields'}"
            raise FieldError(
                f"'{type(message).__name__}' object has no attribute '{name}'",
                "AttributeError",
                did_you_mean(str(name), known, has),
            )
        kind = message.SLOT_TYPES[list(known).index(name)]
        stampers += _fill_field(message, name, kind, value, stamps)
    return stampers


def _fill_field(
    message: Untyped, name: str, kind: Untyped, value: Untyped, stamps: bool
) -> list[Stamper]:
    special = _special(message, name, value) if stamps else None
    if special is not None:
        return special
    old = getattr(message, name)
    if is_message_value(old):
        return fill(old, value, stamps)
    if _is_message_array(kind):
        return _fill_messages(message, name, kind, value, stamps)
    try:
        message._check_fields = True  # numbers out of range are refused, not sent
        setattr(message, name, _convert(old, kind, value))
    except AssertionError as error:
        reason = " ".join(str(error).split())
        raise FieldError(f"{reason}: {value!r} does not fit", "AssertionError") from None
    except (TypeError, ValueError, OverflowError) as error:
        raise FieldError(str(error), type(error).__name__) from None
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


def _fill_messages(
    message: Untyped, name: str, kind: Untyped, value: Untyped, stamps: bool
) -> list[Stamper]:
    if not isinstance(value, list):
        raise FieldError(f"'{type(value).__name__}' object is not iterable", "TypeError")
    element = find_type("/".join(kind.value_type.namespaced_name()), "msg")
    assert element is not None, "the class of a field is loaded with the message"
    items, stampers = [], []
    for one in value:
        items.append(element())
        stampers += fill(items[-1], one, stamps)
    if hasattr(kind, "size") and len(items) != kind.size:
        text = f"'{name}' holds {kind.size} elements, not {len(items)}"
        raise FieldError(text, "AssertionError")
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
