"""Look up the fields of a message type: in the library, in installed packages, or in a bag.

The library includes the definitions of every type of ROS 2 Jazzy. Definitions of other types are
read from their install location, `share/<package>/msg/<Name>.msg` below a folder of
`AMENT_PREFIX_PATH`.
"""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Any

from rosbags.interfaces import Connection, MessageDefinitionFormat, Nodetype
from rosbags.typesys import (
    Stores,
    TypesysError,
    get_types_from_idl,
    get_types_from_msg,
    get_typestore,
)
from rosbags.typesys.store import Typestore

from rosbeat.bags import refusals


def installed_types(names: Iterable[str]) -> Typestore:
    """Return the definitions of message types that nodes on this computer use.

    Args:
        names: Required types, such as `std_msgs/msg/Float32`.

    Raises:
        BagError: If a type is neither part of ROS 2 nor installed.
    """
    store = get_typestore(Stores.ROS2_JAZZY)
    for name in names:
        _learn(store, name)
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


def _learn(store: Typestore, name: str) -> None:
    """Add an installed type, and those it is made of, to a store that lacks it."""
    if name in store.fielddefs:
        return
    try:
        found = get_types_from_msg(_definition(name), name)
    except (OSError, ValueError, TypesysError) as error:
        raise refusals.unknown_type(name) from error
    for part in _parts(found[name][1]):
        _learn(store, part)
    store.register(found)


def _definition(name: str) -> str:
    """The text of an installed `.msg` file."""
    package, kind, short = name.split("/")
    prefixes = os.environ.get("AMENT_PREFIX_PATH", "").split(os.pathsep)
    places = (Path(one, "share", package, kind, f"{short}.msg") for one in prefixes if one)
    found = next((place for place in places if place.is_file()), None)
    if found is None:
        raise FileNotFoundError(name)
    return found.read_text(encoding="utf-8")


def _parts(fields: Iterable[tuple[str, Any]]) -> Iterator[str]:
    """Types of the fields that are messages themselves, or arrays of messages."""
    for _, (kind, detail) in fields:
        if kind in (Nodetype.ARRAY, Nodetype.SEQUENCE):
            kind, detail = detail[0]
        if kind == Nodetype.NAME:
            yield detail
