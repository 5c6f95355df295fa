"""The call of rclpy that failed, as `Fault.asked` writes it down.

`create_subscription(message_type[Float32], str, method[listen(self)], depth=int)`: what was given,
by its type. It reads as an expression of Python, so Python's own parser takes it apart.
"""

from __future__ import annotations

import ast
from dataclasses import dataclass, field
from typing import TypeGuard

from rosbeat.diagnosis.meaning import MESSAGES
from rosbeat.records import Fault

#: What is given for each kind of thing, by the first word of its description.
_ROLES = {
    "message_type": "type",
    "type": "type",
    "module": "type",
    "str": "topic",
    "int": "depth",
    "QoSProfile": "depth",
    "method": "callback",
    "function": "callback",
    "partial": "callback",
    "builtin_function_or_method": "callback",
    "NoneType": "none",
    "message": "message",
    "float": "number",
    "unknown": "unknown",
}


@dataclass(frozen=True)
class Given:
    """One argument of a call.

    Attributes:
        kind: What it is: a type's name, or `message_type`, `message`, `method`, `function`, `type`.
        name: For these: which one.
        parameters: Of a method or function: the names of its parameters; None if unknown.
    """

    kind: str
    name: str = ""
    parameters: tuple[str, ...] | None = None

    @property
    def role(self) -> str:
        """What it could be used as: `type`, `topic`, `callback`, `depth`; or else what it is."""
        return _ROLES.get(self.kind, "other")

    def __str__(self) -> str:
        return _WORDS.get(self.kind, f"an object of type {self.kind}").format(self.name)


#: How an argument is called in a sentence.
_WORDS = {
    "message_type": "the message type {}",
    "type": "the type {}",
    "module": "a module",
    "str": "a text",
    "int": "a whole number",
    "float": "a number with a decimal point",
    "QoSProfile": "a QoS profile",
    "method": "the method {}",
    "function": "the function {}",
    "NoneType": "None",
    "message": "a message of type {}",
}


@dataclass(frozen=True)
class Asked:
    """A call.

    Attributes:
        method: What was called, such as `create_publisher`.
        given: What it was given without a name, in order.
        named: What it was given by name.
    """

    method: str
    given: tuple[Given, ...] = ()
    named: dict[str, Given] = field(default_factory=dict)


def asked_of(fault: Fault) -> Asked | None:
    """The call of rclpy that failed; None if it was none, or cannot be read."""
    try:
        call = ast.parse(fault.asked, mode="eval").body if fault.asked else None
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return None
    if not isinstance(call, ast.Call):
        return None
    return Asked(
        ast.unparse(call.func),
        tuple(_given(one) for one in call.args),
        {one.arg: _given(one.value) for one in call.keywords if one.arg},
    )


def _given(node: ast.expr) -> Given:
    if not isinstance(node, ast.Subscript):
        return Given(ast.unparse(node))
    kind, what = ast.unparse(node.value), node.slice
    if isinstance(what, ast.Call):
        return Given(kind, ast.unparse(what.func), tuple(ast.unparse(one) for one in what.args))
    return Given(kind, ast.unparse(what))


def written_call(code: str) -> str:
    """A call that makes an entity, in the words of `Fault.asked`, as a line of source shows it.

    Where a program's output is all that is known, the line is the only trace of the call. What the
    line does not tell is `unknown`.

    Args:
        code: The line; if it is only a part of the call, the answer is an empty text.
    """
    try:
        tree = ast.parse(code)
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return ""
    calls = [node for node in ast.walk(tree) if _makes_an_entity(node)]
    return _in_words(calls[0]) if calls else ""


def _makes_an_entity(node: ast.AST) -> TypeGuard[ast.Call]:
    if not isinstance(node, ast.Call) or not isinstance(node.func, ast.Attribute):
        return False
    return node.func.attr.startswith("create_") and not _unpacks(node)


def _in_words(call: ast.Call) -> str:
    given = [_written(one) for one in call.args]
    given += [f"{one.arg}={_written(one.value)}" for one in call.keywords]
    return f"{ast.unparse(call.func).split('.')[-1]}({', '.join(given)})"


def _unpacks(call: ast.Call) -> bool:
    starred = any(isinstance(one, ast.Starred) for one in call.args)
    return starred or any(one.arg is None for one in call.keywords)


def _written(node: ast.expr) -> str:
    if isinstance(node, ast.Constant):
        return type(node.value).__name__
    if isinstance(node, ast.Lambda):
        return "function"
    if isinstance(node, ast.Attribute):
        return _dotted(node)
    if isinstance(node, ast.Name):
        return _named(node.id)
    if isinstance(node, ast.Call) and ast.unparse(node.func).startswith("self."):
        return "NoneType"  # what a callback returns that is called on the spot
    return "unknown"


def _dotted(node: ast.Attribute) -> str:
    if isinstance(node.value, ast.Name) and node.value.id == "self":
        return f"method[{node.attr}]"
    return _named(node.attr)


def _named(name: str) -> str:
    if name in MESSAGES:
        return f"message_type[{name}]"
    return f"type[{name}]" if name in ("float", "int", "str", "bool") else "unknown"
