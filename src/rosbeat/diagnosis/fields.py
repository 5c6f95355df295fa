"""Messages and their fields: rows 1 to 5 of the table, and a message taken for its value."""

from __future__ import annotations

import ast
import re

from rosbeat.diagnosis.calls import asked_of
from rosbeat.diagnosis.meaning import MESSAGES, Meaning, article, called_by_ros, matched
from rosbeat.records import Fault

_SHOW = "`ros2 interface show std_msgs/msg/{0}` in a terminal lists what a {0} has."


def of_another_type(fault: Fault) -> Meaning | None:
    """`msg.data = 25`: a value of another type than the field's (row 1)."""
    found = matched(fault, r"The '(\w+)' field must be of type '(\w+)'", "AssertionError")
    if not found:
        return None
    name, wanted = found.groups()
    value = _value_for(fault.code, name)
    got = f"{value} is {_described(value)}" if value else _given(fault)
    if "a message of type" in got:
        return Meaning(
            "message-for-value",
            f"The field {name} of the message takes {article(wanted)}, and {got}.",
            "The message is an envelope: what it carries is in one of its fields.",
        )
    return Meaning(
        "not-a-float",
        f"The field {name} of the message takes {article(wanted)}, and {got}.",
        _TO_MAKE.get(wanted, f"Give it {article(wanted)}."),
    )


_TO_MAKE = {
    "float": "A number such as 18 is an int, and one in quotes is a text. A decimal point makes a "
    "float, and so does float(...).",
    "str": "A text stands in quotes; str(...) or an f-string makes one of a number.",
}


def _value_for(code: str, name: str) -> str:
    """The constant that a line puts into a field, as it is written; empty if it is no constant."""
    try:
        tree = ast.parse(code)
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return ""
    for node in ast.walk(tree):
        value = _put_in(node, name)
        if isinstance(value, ast.Constant):
            return ast.unparse(value)
    return ""


def _put_in(node: ast.AST, name: str) -> ast.expr | None:
    if isinstance(node, ast.keyword) and node.arg == name:
        return node.value
    if isinstance(node, ast.Assign) and isinstance(node.targets[0], ast.Attribute):
        return node.value if node.targets[0].attr == name else None
    return None


def _described(constant: str) -> str:
    kind = type(ast.literal_eval(constant)).__name__
    return "nothing at all" if kind == "NoneType" else article(kind)


def _given(fault: Fault) -> str:
    """What is known of a value that the line does not show: its type, where the node ran here."""
    asked = asked_of(fault)
    if asked is None or asked.method != "field" or not asked.given:
        return "what it was given is something else"
    given = asked.given[0]
    if given.kind in ("int", "bool", "str", "float", "bytes", "list", "tuple", "dict"):
        return f"what it was given is {article(given.kind)}"
    return f"what it was given is {given}"


def out_of_range(fault: Fault) -> Meaning | None:
    """A number too large for its field."""
    found = matched(fault, r"The '(\w+)' field must be an? [\w ]+ in \[", "AssertionError")
    if not found:
        return None
    return Meaning(
        "wrong-values",
        f"The number is too large for the field {found[1]}.",
        "Print it before that line, for each call: does it grow from one to the next?",
    )


def of_another_name(fault: Fault) -> Meaning | None:
    """`Float32(dat=25.0)` (row 4)."""
    found = matched(fault, r"Invalid arguments passed to constructor: (.+)", "AssertionError")
    if not found:
        return None
    kind = re.search(rf"\b({'|'.join(sorted(MESSAGES))})\(", fault.code)
    return Meaning(
        "wrong-keyword",
        f"The message has no field called {found[1]}, so it cannot be given one.",
        "Compare the name letter by letter. " + _SHOW.format(kind[1] if kind else "Float32"),
    )


def without_a_name(fault: Fault) -> Meaning | None:
    """`Float32(25.0)`: a value without the name of its field."""
    found = matched(fault, r"^(\w+)\.__init__\(\) takes 1 positional argument but \d", "TypeError")
    if not found or found[1] not in MESSAGES:
        return None
    return Meaning(
        "field-without-name",
        f"{found[1]}(...) was given a value without the name of the field it belongs in.",
        "A message can have many fields, so each value is given by its field's name. "
        + _SHOW.format(found[1]),
    )


def not_there(fault: Fault) -> Meaning | None:
    """`msg.value = 25.0` (row 5)."""
    found = matched(fault, r"'(\w+)' object has no attribute '(\w+)'", "AttributeError")
    if not found or found[1] not in MESSAGES or found[2].startswith("__"):
        return None
    return Meaning(
        "wrong-field",
        f"A {found[1]} has no field called {found[2]}.",
        _SHOW.format(found[1]),
    )


def class_changed(fault: Fault) -> Meaning | None:
    """`msg = Float32` and then `msg.data = 25.0`: the class itself was written into."""
    found = matched(fault, r"'(\w+)' object attribute '(\w+)' is read-only", "AttributeError")
    if not found:
        return None
    return Meaning(
        "class-changed",
        f"Some line before this one has put a value into {found[2]} of the class {found[1]} "
        "itself. That has spoilt the class for all messages; it is whole again now.",
        f"Look for a {found[1]} without brackets behind it, then run your cells again.",
    )


_IN_PLACE_OF_ITS_VALUE = (
    r"unsupported format string passed to (\w+)\.__format__",
    r"not supported between instances of '(\w+)' and '\w+'",
    r"not supported between instances of '\w+' and '(\w+)'",
    r"unsupported operand type\(s\) for [^:]+: '(\w+)' and '\w+'",
    r"unsupported operand type\(s\) for [^:]+: '\w+' and '(\w+)'",
    r"can only concatenate \w+ \(not \"(\w+)\"\) to \w+",
    r"argument must be a (?:string|real number|string or a (?:real )?number).*, not '?(\w+)'?",
    r"(?:a|must be) (?:real )?number(?: is required)?,? not (\w+)",
    r"type (\w+) doesn't define __\w+__ method",
    r"bad operand type for .*: '(\w+)'",
    r"can't convert type '(\w+)' to numerator/denominator",
    r"'(\w+)' object (?:is not (?:subscriptable|iterable)|cannot be interpreted as an integer)",
)


def message_for_value(fault: Fault) -> Meaning | None:
    """`if msg > 26.0`, `f"{msg:.2f}"`: the message where the number in it is meant."""
    for pattern in _IN_PLACE_OF_ITS_VALUE:
        found = matched(fault, pattern, "TypeError")
        if found and found[1] in MESSAGES:
            return Meaning(
                "message-for-value",
                f"A whole message of type {found[1]} stands where the value in it is meant.",
                "The message is an envelope: what it carries is in one of its fields. "
                + _SHOW.format(found[1]),
            )
    return None


_MISUSED = r"Publisher\.publish\(\) (takes|missing|got)"


def published(fault: Fault) -> Meaning | None:
    """`publish(25.0)`, `publish(Float32)` (rows 2 and 3), or a message of another type."""
    if fault.asked == "publish(bytes)":
        return _value_published("message", "bytes")
    found = matched(fault, r"^Expected <class '([\w.]+)'>, got <class '([\w.]+)'>", "TypeError")
    if not found:
        return _publish_misused(fault)
    wanted, got = found[1].split(".")[-1], found[2].split(".")[-1]
    if got.startswith("Metaclass_"):
        return _class_published(got.removeprefix("Metaclass_"))
    if ".msg." in found[2]:
        return Meaning(
            "type-mismatch",
            f"The publisher was made for messages of type {wanted}, and was given a {got}.",
            "One topic carries one type. Compare the line that makes the publisher with the line "
            "that makes the message.",
        )
    return _value_published(wanted, got)


def _class_published(name: str) -> Meaning:
    return Meaning(
        "class-published",
        f"publish was given the class {name} itself, and no message of it.",
        f"{name} is the form; a filled-in form is made by calling it. How do you call a class?",
    )


def _value_published(wanted: str, got: str) -> Meaning:
    what = "None" if got == "NoneType" else f"a bare value, {article(got)}"
    what = "bytes" if got == "bytes" else what
    return Meaning(
        "number-published",
        f"publish was given {what}, and not a message.",
        f"Make a {wanted} first and put the value into its field; publish sends that.",
    )


def _publish_misused(fault: Fault) -> Meaning | None:
    if called_by_ros(fault) or not matched(fault, _MISUSED, "TypeError"):
        return None
    return Meaning(
        "number-published",
        "publish takes exactly one thing, a message, and was called with something else.",
        "Make the message first, put the value into its field, and hand over the message alone.",
    )
