"""Convert messages from plain data, as in `records.Sample`, to bytes (CDR) and back.

The fields of a type are looked up in the library, which has the definitions of every type of ROS 2
Jazzy, in a bag, or in installed packages: `share/<package>/msg/<Name>.msg` below a folder of
`AMENT_PREFIX_PATH`.
"""

from __future__ import annotations

import os
import struct
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping
from operator import index
from pathlib import Path
from typing import Any, TypeAlias

import numpy as np
from rosbags.interfaces import Connection, MessageDefinitionFormat, Nodetype
from rosbags.typesys import (
    Stores,
    TypesysError,
    get_types_from_idl,
    get_types_from_msg,
    get_typestore,
)
from rosbags.typesys.store import Typestore

from rosbeat.errors import BagError
from rosbeat.records import Sample

#: A value of a field, or a message of one of the library's classes.
_Value: TypeAlias = Any
#: The library's description of a field: a kind, and the details of that kind.
_FieldType: TypeAlias = Any
#: What goes wrong when a value does not fit into its field, or bytes are no message.
MISFITS = (ValueError, TypeError, ArithmeticError, struct.error)
# What ROS puts into a message without fields, since C has no empty structures.
_FILLER = "structure_needs_at_least_one_member"
# A byte has no sign in ROS, and is bytes of length one in rclpy: a list in plain data. The library
# has it as a number with a sign.
_NUMPY = {"byte": "int8", "char": "uint8"}


# Types.


def installed_types(names: Iterable[str]) -> Typestore:
    """Return the definitions of message types that nodes on this computer use.

    Args:
        names: Required types, such as `std_msgs/msg/Float32`.

    Raises:
        BagError: If a type is neither part of ROS 2 nor installed.
    """
    store = get_typestore(Stores.ROS2_JAZZY)
    for name in names:
        _add_installed(store, name)
    return store


def recorded_types(connections: Iterable[Connection]) -> Typestore:
    """Return message types as a bag defines them, or as ROS 2 Jazzy does if the bag does not.

    Raises:
        BagError: If a type is defined neither in the bag nor in ROS 2 nor by an installed package.
        TypesysError: If a definition is invalid, or two definitions contradict each other.
    """
    store, undefined = get_typestore(Stores.EMPTY), []
    for one in connections:
        if one.msgdef.format == MessageDefinitionFormat.IDL:
            store.register(get_types_from_idl(one.msgdef.data))
        elif one.msgdef.format == MessageDefinitionFormat.MSG:
            store.register(get_types_from_msg(one.msgdef.data, one.msgtype))
        else:
            undefined.append(one.msgtype)
    known = installed_types(name for name in undefined if name not in store.fielddefs)
    for name in known.fielddefs.keys() - store.fielddefs.keys():
        store.fielddefs[name], store.types[name] = known.fielddefs[name], known.types[name]
    return store


def _add_installed(store: Typestore, name: str) -> None:
    """Add an installed type, and those it is made of, to a store that lacks it."""
    if name in store.fielddefs:
        return
    try:
        found = get_types_from_msg(_definition(name), name)
    except (OSError, ValueError, TypesysError) as error:
        raise BagError(
            f"The message type {name} is unknown.",
            "The type is not part of ROS 2, and no package that defines it is installed, so its "
            "fields are unknown.",
            "Build the package that defines the type and open the page again, or leave out its "
            "topic with `topics=[...]`.",
        ) from error
    fields: Iterable[tuple[str, _FieldType]] = found[name][1]
    for _, (kind, detail) in fields:
        if kind in (Nodetype.ARRAY, Nodetype.SEQUENCE):
            kind, detail = detail[0]
        if kind == Nodetype.NAME:
            _add_installed(store, detail)
    store.register(found)


def _definition(name: str) -> str:
    """The text of an installed `.msg` file."""
    package, kind, short = name.split("/")
    for prefix in filter(None, os.environ.get("AMENT_PREFIX_PATH", "").split(os.pathsep)):
        path = Path(prefix, "share", package, kind, f"{short}.msg")
        if path.is_file():
            return path.read_text(encoding="utf-8")
    raise FileNotFoundError(name)


def _fields(store: Typestore, type_name: str) -> Iterator[tuple[str, str, _FieldType]]:
    """Each field: its name, the name of its attribute, and what it holds."""
    entries = store.get_msgdef(type_name).fields
    for (name, holds), (attribute, _) in zip(store.fielddefs[type_name][1], entries, strict=True):
        yield name, attribute, holds


# To bytes.


def serialized(store: Typestore, samples: Iterable[Sample]) -> list[bytes]:
    """Return messages in serialized form.

    Raises:
        BagError: If a message does not fit its type; the error says which one.
    """
    counts: Counter[str] = Counter()
    found = []
    for one in samples:
        counts[one.topic] += 1
        try:
            found.append(to_bytes(store, one.type_name, one.data))
        except MISFITS as error:
            raise BagError(
                f"Message {counts[one.topic]} on {one.topic} is not a {one.type_name}: {error}.",
                "Every message on a topic has the fields of its type, and each field has a value "
                "of the right kind and size.",
                "Check that message: a fault may have given it a value that is too large.",
            ) from error
    return found


def to_bytes(store: Typestore, type_name: str, data: Mapping[str, Any]) -> bytes:
    """Serialize a message.

    Raises:
        ValueError, TypeError, ArithmeticError, struct.error: If the data do not fit the type.
    """
    return bytes(store.serialize_cdr(_message(store, type_name, data), type_name))


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


def _value(store: Typestore, holds: _FieldType, value: _Value) -> _Value:
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


def from_bytes(store: Typestore, type_name: str, data: bytes) -> dict[str, Any]:
    """Read a serialized message.

    The store's own `deserialize_cdr` is not used, since it refuses bytes after the message, and
    Fast DDS leaves some behind an empty sequence of 64-bit numbers (seen with rclpy 7.1.6).

    Raises:
        ValueError, ArithmeticError, struct.error: If the bytes are no message of this type.
    """
    if bytes(data[:2]) not in (b"\0\0", b"\0\1"):
        raise ValueError("a message is not encoded as plain CDR")
    definition = store.get_msgdef(type_name)
    read = definition.deserialize_cdr_le if data[1] else definition.deserialize_cdr_be
    message, _ = read(data[4:], 0, definition.cls, store)
    return _plain(store, type_name, message)


def _plain(store: Typestore, type_name: str, message: _Value) -> dict[str, Any]:
    return {
        name: _plain_value(store, holds, getattr(message, attribute))
        for name, attribute, holds in _fields(store, type_name)
        if name != _FILLER
    }


def _plain_value(store: Typestore, holds: _FieldType, value: _Value) -> _Value:
    kind, detail = holds
    if kind == Nodetype.BASE:
        return [value % 256] if detail[0] == "byte" else value
    if kind == Nodetype.NAME:
        return _plain(store, detail, value)
    items = value.tolist() if isinstance(value, np.ndarray) else value
    return [_plain_value(store, detail[0], one) for one in items]
