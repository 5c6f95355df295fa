"""Which call of rclpy failed, and with arguments of which types, noted on the exception.

rclpy's own texts often do not tell: `missing 1 required positional argument: 'qos_profile'` is the
same for a callback that was left out and for a queue depth. `diagnosis.calls` reads what is written
here. Nothing of a learner's is called in order to describe it.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from functools import partial
from types import BuiltinFunctionType, FunctionType, MethodType, ModuleType
from typing import Any

from rclpy.qos import QoSProfile

_NOTE = "_rosbeat_asked"


@contextmanager
def asking(method: str, *given: Any, **named: Any) -> Iterator[None]:  # noqa: ANN401
    """Note a call on the exception that it raises; the innermost call counts."""
    try:
        yield
    except Exception as error:
        if not asked_by(error):
            setattr(error, _NOTE, asked_text(method, given, named))
        raise


def asked_by(error: BaseException) -> str:
    """The call that was noted on an exception, or an empty text."""
    return str(getattr(error, _NOTE, ""))


def value_text(value: object) -> str:
    """The type of a value that a message's field refused, as `Fault.asked` has it."""
    return f"field({_kind(value)})"


def asked_text(method: str, given: tuple[Any, ...], named: dict[str, Any]) -> str:
    """A call with the types of what it was given, as `Fault.asked` has it."""
    words = [_kind(one) for one in given]
    words += [f"{name}={_kind(one)}" for name, one in named.items()]
    return f"{method}({', '.join(words)})"


def _kind(one: Any) -> str:  # noqa: ANN401
    if isinstance(one, type):
        kind = "message_type" if is_message_class(one) else "type"
        return f"{kind}[{_safe(one.__name__)}]"
    if isinstance(one, MethodType):
        return f"method[{_signature(one.__func__)}]"
    if isinstance(one, FunctionType):
        return f"function[{_signature(one)}]"
    if is_message_class(type(one)):
        return f"message[{_safe(type(one).__name__)}]"
    return _plain(one)


def _plain(one: Any) -> str:  # noqa: ANN401
    for base in (QoSProfile, partial, BuiltinFunctionType, ModuleType, bool, int, float, str):
        if isinstance(one, base):
            return _safe(base.__name__)
    return _safe(type(one).__name__)


def is_message_class(kind: type) -> bool:
    """Whether a class is that of a ROS message."""
    return "_fields_and_field_types" in vars(kind)


def _signature(function: Any) -> str:  # noqa: ANN401 - what a method is bound to may be anything
    code = getattr(function, "__code__", None)
    if code is None:
        return _safe(type(function).__name__)
    # The names of the parameters come first among the local ones.
    names = code.co_varnames[: code.co_argcount]
    return f"{_safe(code.co_name)}({', '.join(map(_safe, names))})"


def _safe(name: object) -> str:
    """A name that Python's parser can read; `<lambda>` is none."""
    text = str(name)
    return text if text.isidentifier() else "function"
