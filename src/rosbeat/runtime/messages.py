"""Messages as plain data, and a cheap way to remember them.

A node may change a message object after publishing it, so what is recorded must be a copy. For a
message whose fields are all numbers, bools and strings the copy is the tuple of its values, which
are immutable; that costs a tenth of a microsecond. For any other message it is the serialized
bytes, which is what crosses the wire.
"""

from __future__ import annotations

from collections.abc import Callable
from operator import attrgetter
from typing import Any

from rclpy.serialization import deserialize_message, serialize_message

_PLAIN_TYPES = frozenset(
    ["boolean", "octet", "float", "double", "string"]
    + [f"{sign}int{bits}" for sign in ("", "u") for bits in (8, 16, 32, 64)]
)


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
        self._flat = bool(fields) and _PLAIN_TYPES.issuperset(fields.values())
        # The slots behind the properties (`_data` for `data`) are read ten times as fast.
        slots = [f"_{name}" for name in fields]
        self.take: Callable[[Any], Any] = attrgetter(*slots) if self._flat else serialize_message

    def plain(self, copy: Any) -> dict[str, Any]:  # noqa: ANN401
        """The copied message as plain data, with the rounding that the wire does."""
        wire = copy if isinstance(copy, bytes) and not self._flat else self._serialized(copy)
        data: dict[str, Any] = plain(deserialize_message(wire, self._type))
        return data

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
