"""Format messages as YAML and as CSV, as `topic echo` shows them."""

from __future__ import annotations

import array
from argparse import ArgumentParser, Namespace
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

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


def add_style_arguments(parser: ArgumentParser) -> None:
    """Add the options of verbs that show messages."""
    add = parser.add_argument
    add("--csv", action="store_true", help="Output all recursive fields separated by commas")
    add("-f", "--full-length", action="store_true",
        help="Output all elements for arrays, bytes, and strings")  # fmt: skip
    add("-l", "--truncate-length", type=int, default=128,
        help="The length to truncate arrays, bytes, and strings to (default: 128)")  # fmt: skip
    add("--no-arr", action="store_true", help="Don't print array fields of messages")
    add("--no-str", action="store_true", help="Don't print string fields of messages")
    add("--flow-style", action="store_true", help="Print collections in the flow style")


def style_of(args: Namespace) -> Style:
    """Return the style that the options ask for."""
    limit = None if args.full_length else args.truncate_length
    return Style(limit, args.no_arr, args.no_str, args.flow_style)


def is_message_value(value: Untyped) -> bool:
    """Return whether a value is a message."""
    return hasattr(value, "get_fields_and_field_types")


def is_array(value: Untyped) -> bool:
    """Return whether a value is a sequence of values, and not a text."""
    return isinstance(value, list | tuple | array.array) or hasattr(value, "dtype")


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
    if style.no_str:
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


def plain_to_yaml(value: Untyped, flow: bool = False) -> str:
    """Return dictionaries, lists and plain values as YAML that ends in a newline."""
    import yaml

    class Dumper(yaml.SafeDumper):
        def ignore_aliases(self, data: Untyped) -> bool:
            return True

    def inline(dumper: Untyped, data: _Inline) -> Untyped:
        return dumper.represent_sequence("tag:yaml.org,2002:seq", data, flow_style=flow or None)

    Dumper.add_representer(_Inline, inline)
    return str(
        yaml.dump(
            value, Dumper=Dumper, allow_unicode=True, sort_keys=False, width=float("inf"),
            default_flow_style=False,
        )
    )  # fmt: skip


def to_yaml(message: Untyped, style: Style) -> str:
    """Return a message as YAML that ends in a newline."""
    return plain_to_yaml(to_plain(message, style), style.flow)


def to_csv(message: Untyped, style: Style) -> str:
    """Return all values of a message on one line."""
    return ",".join(_leaves(message, None, style))


def _leaves(value: Untyped, kind: Untyped, style: Style) -> Iterable[str]:
    if is_message_value(value):
        for _, field_kind, field in fields_of(value):
            yield from _leaves(field, field_kind, style)
    elif is_array(value):
        yield from _array_leaves(value, kind, style)
    elif isinstance(value, str | bytes):
        yield _csv_text(value, style)
    else:
        yield str(value)


def _array_leaves(value: Untyped, kind: Untyped, style: Style) -> Iterable[str]:
    if style.no_arr and kind is not None:
        yield _array_summary(value, kind)
        return
    cut = style.limit is not None and len(value) > style.limit
    for item in value[: style.limit] if cut else value:
        yield from _leaves(item, None, style)
    if cut:
        yield "..."
    if len(value) == 0 and not hasattr(getattr(kind, "value_type", None), "namespaced_name"):
        yield ""


def _csv_text(value: str | bytes, style: Style) -> str:
    if style.no_str:
        return f"<string length: <{len(value)}>>"
    text = str(value)
    return text[: style.limit] + "..." if style.limit and len(value) > style.limit else text
