"""Messages as plain data, and a cheap way to remember them.

A node may change a message object after publishing it, so what is recorded must be a copy. For a
message whose fields are all numbers, bools and strings the copy is the tuple of its values, which
are immutable; that costs a tenth of a microsecond. For any other message it is the serialized
bytes, which is what crosses the wire.
"""

from __future__ import annotations

from array import array
from collections.abc import Callable, Sequence
from math import isfinite
from operator import attrgetter
from struct import Struct
from typing import Any

from rclpy.serialization import deserialize_message, serialize_message

_FLOAT = Struct("<f")


class _UnsureError(Exception):
    """What the wire makes of a value is not known here."""


def _of(kind: type) -> Callable[[Any], Any]:
    def same(value: Any) -> Any:  # noqa: ANN401
        if type(value) is kind:
            return value
        raise _UnsureError

    return same


def _float32(value: Any) -> float:  # noqa: ANN401
    if type(value) is not float:
        raise _UnsureError
    try:
        rounded: float = _FLOAT.unpack(_FLOAT.pack(value))[0]
    except OverflowError as error:
        raise _UnsureError from error
    return rounded


def _string(value: Any) -> str:  # noqa: ANN401
    # Of other characters, the wire ends at a zero and refuses half of a pair.
    if type(value) is str and value.isascii() and "\0" not in value:
        return value
    raise _UnsureError


def _integer(bits: int, signed: bool) -> Callable[[Any], int]:
    low = -(1 << bits - 1) if signed else 0
    high = low + (1 << bits)

    def within(value: Any) -> int:  # noqa: ANN401
        if type(value) is int and low <= value < high:
            return value
        raise _UnsureError

    return within


def _unsure(_: Any) -> Any:  # noqa: ANN401
    raise _UnsureError


#: What arrives of a value, by the type of its field, where that needs no wire to say it: a hundred
#: times as fast as serializing a message and reading it back.
_ARRIVING: dict[str, Callable[[Any], Any]] = {
    "boolean": _of(bool),
    "octet": _unsure,
    "float": _float32,
    "double": _of(float),
    "string": _string,
    **{f"int{bits}": _integer(bits, signed=True) for bits in (8, 16, 32, 64)},
    **{f"uint{bits}": _integer(bits, signed=False) for bits in (8, 16, 32, 64)},
}


def type_name(message_type: type) -> str:
    """The type's ROS name, such as `std_msgs/msg/Float32`, from its Python class."""
    package, kind = message_type.__module__.split(".")[:2]
    return f"{package}/{kind}/{message_type.__name__}"


def plain(value: Any) -> Any:  # noqa: ANN401 - a field may hold anything a message can
    """A message or field value as dicts, lists, numbers and strings.

    Arrays of any kind and byte strings become lists of numbers.
    """
    if hasattr(value, "get_fields_and_field_types"):
        return {name: plain(getattr(value, name)) for name in value.get_fields_and_field_types()}
    if isinstance(value, bool | int | float | str):
        return value
    if hasattr(value, "tolist"):  # NumPy arrays of fixed-size fields, array.array of the others
        return value.tolist()
    return [plain(item) for item in value]


class Memory:
    """Copies messages of one type and gives them back.

    Args:
        message_type: The message class.

    Attributes:
        take: Makes the copy of a message; the copy is opaque, small and immutable.
    """

    def __init__(self, message_type: type) -> None:
        self._type = message_type
        fields = message_type.get_fields_and_field_types()  # type: ignore[attr-defined]
        self._names = list(fields)
        self._flat = bool(fields) and _ARRIVING.keys() >= set(fields.values())
        self._arriving = [_ARRIVING[kind] for kind in fields.values()] if self._flat else []
        self._is_one_float = self._arriving == [_float32]
        # The slots behind the properties (`_data` for `data`) are read ten times as fast.
        slots = [f"_{name}" for name in fields]
        self.take: Callable[[Any], Any] = attrgetter(*slots) if self._flat else serialize_message

    def plain(self, copy: Any) -> dict[str, Any]:  # noqa: ANN401
        """The copied message as plain data, with the rounding that the wire does."""
        if self._flat and not isinstance(copy, Raw):
            try:
                return self._arrived(copy)
            except _UnsureError:
                pass  # the wire itself tells
        wire = copy if isinstance(copy, bytes) and not self._flat else self._serialized(copy)
        data: dict[str, Any] = plain(deserialize_message(wire, self._type))
        return data

    def all_plain(self, copies: Sequence[Any]) -> list[dict[str, Any]]:
        """Many copied messages as plain data."""
        if self._is_one_float and set(map(type, copies)) == {float}:
            name, values = self._names[0], array("f", copies).tolist()
            if all(map(isfinite, values)):  # too large a number becomes none, without a word
                return [{name: value} for value in values]
        return list(map(self.plain, copies))

    def _arrived(self, copy: Any) -> dict[str, Any]:  # noqa: ANN401
        if len(self._names) == 1:  # nearly every message of the course
            return {self._names[0]: self._arriving[0](copy)}
        columns = zip(self._names, self._arriving, copy, strict=True)
        return {name: arriving(value) for name, arriving, value in columns}

    def _serialized(self, copy: Any) -> bytes:  # noqa: ANN401
        if isinstance(copy, Raw):
            return copy.data
        values = copy if len(self._names) > 1 else (copy,)
        message = self._type(**dict(zip(self._names, values, strict=True)))
        wire: bytes = serialize_message(message)
        return wire


class Raw:
    """The copy of a message that was published as serialized bytes."""

    __slots__ = ("data",)

    def __init__(self, data: bytes) -> None:
        self.data = data
