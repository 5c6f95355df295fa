"""Write the definition of a message, with those of all messages in it, as a recording holds it."""

from __future__ import annotations

from typing import Any

from ros2_command.names import find_type
from ros2_command.packages import all_interfaces, nested_type
from ros2_command.untyped import Untyped

#: What the primitive types of IDL, which a class knows, are called in a `.msg` file.
_PRIMITIVES = {"boolean": "bool", "octet": "byte", "float": "float32", "double": "float64"}


def definition_of(kind: Untyped, name: str) -> str:
    """Return a message's definition and those of all messages in it.

    The text is that of the `.msg` files. What actions and services have on their hidden topics
    comes from no such file, so there it follows from the class.

    Args:
        kind: The message class.
        name: Its type, `pkg/msg/Name`.
    """
    known = {one.name: one.path for one in all_interfaces() if one.kind == "msg"}
    classes: dict[str, Any] = {name: kind}
    texts = list[str]()
    for one in (names := [name]):  # grows while it is read
        if one in known:
            text = known[one].read_text(encoding="utf-8")
            inner = [nested_type(line, one.split("/")[0]) for line in text.splitlines()]
        else:
            found: Any = classes.get(one) or find_type(one, "msg")
            fields = zip(found.get_fields_and_field_types(), found.SLOT_TYPES, strict=True)
            text = "\n".join(f"{_written(slot)} {field}" for field, slot in fields)
            inner = [_message_in(slot) for slot in found.SLOT_TYPES]
        names += [part for part in dict.fromkeys(inner) if part and part not in names]
        title = f"{'=' * 80}\nMSG: {_short(one)}\n" if texts else ""
        texts.append(title + text.rstrip("\n") + "\n")
    return "".join(texts)


def _short(name: str) -> str:
    return name.replace("/msg/", "/")


def _message_in(slot: Untyped) -> str | None:
    """Return the message type of a field, or of its elements; None if these are primitive."""
    element: Any = getattr(slot, "value_type", slot)
    is_message = hasattr(element, "namespaced_name")
    return "/".join(element.namespaced_name()) if is_message else None


def _written(slot: Untyped) -> str:
    """Return a field's type as a `.msg` file has it."""
    if hasattr(slot, "value_type"):
        size = getattr(slot, "size", None) or ""
        most = f"<={slot.maximum_size}" if hasattr(slot, "maximum_size") else ""
        return f"{_written(slot.value_type)}[{size}{most}]"
    if message := _message_in(slot):
        return _short(message)
    if hasattr(slot, "typename"):
        return _PRIMITIVES.get(slot.typename, str(slot.typename))
    most = f"<={slot.maximum_size}" if getattr(slot, "maximum_size", None) else ""
    return f"{'wstring' if 'WString' in type(slot).__name__ else 'string'}{most}"
