"""Convert plain data, as in `records.Sample`, to serialized messages (CDR), and back."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from operator import index
from typing import Any, TypeAlias

import numpy as np
from rosbags.interfaces import Nodetype
from rosbags.typesys.store import Typestore

#: A value of a field, or a message of one of the library's classes.
_Value: TypeAlias = Any
#: The library's description of a field: a kind, and the details of that kind.
_Holds: TypeAlias = Any
# What ROS puts into a message without fields, since C has no empty structures.
_FILLER = "structure_needs_at_least_one_member"
# A byte has no sign in ROS, and is bytes of length one in rclpy: a list in plain data. The library
# has it as a number with a sign.
_NUMPY = {"byte": "int8", "char": "uint8"}


def to_wire(store: Typestore, type_name: str, data: Mapping[str, Any]) -> bytes:
    """Serialize a message.

    Raises:
        ValueError, TypeError, ArithmeticError, struct.error: If the data do not fit the type.
    """
    return bytes(store.serialize_cdr(_message(store, type_name, data), type_name))


def from_wire(store: Typestore, type_name: str, wire: bytes) -> dict[str, Any]:
    """Read a serialized message.

    The store's own `deserialize_cdr` is not used, since it refuses bytes after the message, and
    Fast DDS leaves some behind an empty sequence of 64-bit numbers (seen with rclpy 7.1.6).

    Raises:
        ValueError, ArithmeticError, struct.error: If the bytes are no message of this type.
    """
    if bytes(wire[:2]) not in (b"\0\0", b"\0\1"):
        raise ValueError("a message is not encoded as plain CDR")
    definition = store.get_msgdef(type_name)
    read = definition.deserialize_cdr_le if wire[1] else definition.deserialize_cdr_be
    message, _ = read(wire[4:], 0, definition.cls, store)
    return _plain(store, type_name, message)


def _fields(store: Typestore, type_name: str) -> Iterator[tuple[str, str, _Holds]]:
    """Each field: its name, the name of its attribute, and what it holds."""
    entries = store.get_msgdef(type_name).fields
    for (name, holds), (attribute, _) in zip(store.fielddefs[type_name][1], entries, strict=True):
        yield name, attribute, holds


# To messages.


def _message(store: Typestore, type_name: str, data: _Value) -> _Value:
    if not isinstance(data, Mapping):
        raise TypeError(f"a {type_name} has fields, and {data!r} has none")
    values: dict[str, Any] = {}
    rest = dict(data)
    for name, attribute, holds in _fields(store, type_name):
        if name == _FILLER:
            values[attribute] = 0
        elif name not in rest:
            raise ValueError(f"the field {name!r} is missing")
        else:
            values[attribute] = _value(store, holds, rest.pop(name))
    if rest:
        raise ValueError(f"a {type_name} has no field {next(iter(rest))!r}")
    return store.types[type_name](**values)


def _value(store: Typestore, holds: _Holds, value: _Value) -> _Value:
    kind, detail = holds
    if kind == Nodetype.BASE:
        return _scalar(detail[0], value)
    if kind == Nodetype.NAME:
        return _message(store, detail, value)
    inner, limit = detail
    items = [_value(store, inner, one) for one in value]
    if limit and (len(items) > limit or (kind == Nodetype.ARRAY and len(items) != limit)):
        raise ValueError(f"{len(items)} items were given where {limit} fit")
    if inner[0] == Nodetype.NAME or inner[1][0] == "string":
        return items
    with np.errstate(over="raise"):
        return np.array(items, dtype=_NUMPY.get(inner[1][0], inner[1][0]))


def _scalar(base: str, value: _Value) -> _Value:
    if base == "byte":
        (value,) = value
        if index(value) not in range(256):
            raise ValueError(f"{value} is not a byte")
        return value - 256 if value > 127 else value
    wanted: tuple[Any, ...] = {"bool": (bool,), "string": (str,)}.get(base, (int, float))
    if not isinstance(value, wanted) or isinstance(value, bool) != (base == "bool"):
        raise TypeError(f"{value!r} is not a {base}")
    if base in ("bool", "string"):
        return value
    return float(value) if base.startswith("float") else index(value)


# To plain data.


def _plain(store: Typestore, type_name: str, message: _Value) -> dict[str, Any]:
    return {
        name: _data(store, holds, getattr(message, attribute))
        for name, attribute, holds in _fields(store, type_name)
        if name != _FILLER
    }


def _data(store: Typestore, holds: _Holds, value: _Value) -> _Value:
    kind, detail = holds
    if kind == Nodetype.BASE:
        return [value % 256] if detail[0] == "byte" else value
    if kind == Nodetype.NAME:
        return _plain(store, detail, value)
    items = value.tolist() if isinstance(value, np.ndarray) else value
    return [_data(store, detail[0], one) for one in items]
