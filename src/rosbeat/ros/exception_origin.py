"""Find the learner's own line in an exception, the call that failed, and a suggestion."""

from __future__ import annotations

import builtins
import linecache
import sysconfig
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from difflib import get_close_matches
from functools import partial
from itertools import pairwise
from pathlib import Path
from traceback import walk_tb
from types import BuiltinFunctionType, FrameType, FunctionType, MethodType, ModuleType
from typing import Any

from rclpy.node import Node
from rclpy.qos import QoSProfile

from rosbeat.records import Argument, FailedCall, Fault, called_callback, is_argument

# What to propose for an unknown name. A traceback in a terminal ends with `Did you mean:
# 'publisher_'?`, which Python adds while it prints, and differently in each version.

#: Least likeness: `logger` and `get_logger` are alike, `temperature` and `publish_temperature` not.
_LIKE = 0.75


def suggestion(error: BaseException) -> str:
    """Return the name nearest to that of an AttributeError or a NameError, or an empty text."""
    name = getattr(error, "name", None)
    if not isinstance(name, str) or not name.strip("_"):
        return ""  # nothing, or a blank that was not filled in
    if isinstance(error, AttributeError):
        return _nearest(name, _attributes(error.obj)) or _same_verb(name, error.obj)
    frames = [frame for frame, _ in walk_tb(error.__traceback__)]
    if not isinstance(error, NameError) or isinstance(error, UnboundLocalError) or not frames:
        return ""
    seen, known = frames[-1].f_locals, frames[-1].f_globals
    node = seen.get("self")
    if isinstance(node, Node) and name in _attributes(node):
        return f"self.{name}"
    return _nearest(name, [*seen, *known, *vars(builtins)])


def _nearest(name: str, known: Iterable[object]) -> str:
    names = {one for one in known if isinstance(one, str) and not one.startswith("_")} - {name}
    return next(iter(get_close_matches(name, sorted(names), 1, _LIKE)), "")


def _same_verb(name: str, owner: object) -> str:
    """Return the learner's only method that begins alike: `publish_humidity` for `publish_x`."""
    verb, _, rest = name.partition("_")
    kinds = type.mro(type(owner)) if isinstance(owner, Node) and verb and rest else []
    own = [vars(kind).items() for kind in kinds if not kind.__module__.startswith("rclpy.")]
    methods = {one for items in own for one, it in items if isinstance(it, FunctionType)}
    found = [one for one in methods if one.startswith(f"{verb}_")]
    return found[0] if len(found) == 1 else ""


def _attributes(owner: object) -> list[str]:
    """Return the names that an object, a class or a module has."""
    if isinstance(owner, ModuleType):
        return list(vars(owner))
    found = [] if isinstance(owner, type) else list(getattr(owner, "__dict__", ()))
    for kind in type.mro(owner if isinstance(owner, type) else type(owner)):
        # `publishers` and `timers` are every node's, and never what was meant by `publisher_`.
        foreign = kind.__module__.startswith("rclpy.")
        found += [name for name, it in vars(kind).items() if not foreign or callable(it)]
    return found


# Which call of rclpy failed, and with arguments of which types, for whoever explains it: rclpy's
# own text is the same for a missing callback and a missing queue depth. The learner's code is not
# called to describe an argument.

_NOTE = "_rosbeat_asked"


@contextmanager
def asking(method: str, *given: object, **named: object) -> Iterator[None]:
    """Note a call on the exception that it raises; the innermost call counts."""
    try:
        yield
    except Exception as error:
        if asked_by(error) is None:
            setattr(error, _NOTE, failed_call(method, given, named))
        raise


def asked_by(error: BaseException) -> FailedCall | None:
    """Return the call that was noted on an exception, or None."""
    return getattr(error, _NOTE, None)


def failed_call(method: str, given: tuple[Any, ...], named: dict[str, Any]) -> FailedCall:
    """Return a call with the types of what it was given."""
    words = {name: _described(one) for name, one in named.items()}
    return FailedCall(method, tuple(map(_described, given)), words)


def _described(one: object) -> Argument:
    if isinstance(one, type):
        kind = "message_type" if is_message_class(one) else "type"
        return Argument(kind, one.__name__)
    if isinstance(one, MethodType | FunctionType):
        function = one.__func__ if isinstance(one, MethodType) else one
        kind = "method" if isinstance(one, MethodType) else "function"
        code = getattr(function, "__code__", None)
        if code is None:
            return Argument(kind, type(function).__name__)
        # The names of the parameters come first among the local ones.
        name = code.co_name if code.co_name.isidentifier() else "function"  # <lambda> is none
        return Argument(kind, name, code.co_varnames[: code.co_argcount])
    if is_message_class(type(one)):
        return Argument("message", type(one).__name__)
    known = (QoSProfile, partial, BuiltinFunctionType, ModuleType, bool, int, float, str)
    base: Any = next((base for base in known if isinstance(one, base)), type(one))
    return Argument(base.__name__)


def is_message_class(kind: type) -> bool:
    """Return whether a class is that of a ROS message."""
    return "_fields_and_field_types" in vars(kind)


# A frame in the standard library, in an installed package or in rosbeat is not the learner's.
_FOREIGN = tuple(
    {sysconfig.get_path(name) for name in ("stdlib", "purelib", "platlib")}
    | {str(Path(__file__).parents[1])}
)


def is_learners(frame: FrameType) -> bool:
    """Return whether a frame runs code that the learner wrote, not a library or rosbeat."""
    name = frame.f_code.co_filename
    if name == "<string>":  # code that a library has written, as for a dataclass, is of its module
        name = str(frame.f_globals.get("__file__", name))
    return not is_foreign(name) and not name.startswith("<frozen")


def is_foreign(file: str) -> bool:
    """Return whether a file is of the standard library, an installed package or rosbeat."""
    return file.startswith(_FOREIGN)


def line_of(frame: FrameType | None) -> tuple[int, str]:
    """Return number and text of the learner's line at which a frame is, or `(0, "")`."""
    while frame is not None and not is_learners(frame):
        frame = frame.f_back
    return (0, "") if frame is None else _line(frame, frame.f_lineno or 0)


def _line(frame: FrameType, number: int) -> tuple[int, str]:
    return number, linecache.getline(frame.f_code.co_filename, number, frame.f_globals).strip()


def _refused_by_field(error: BaseException) -> FailedCall | None:
    """Return what a field of a message was given, if the field's setter raised."""
    frames = [frame for frame, _ in walk_tb(error.__traceback__)]
    if not isinstance(error, AssertionError) or not frames:
        return None
    setter = frames[-1]
    of_message = ".msg._" in str(setter.f_globals.get("__name__"))
    known = of_message and "value" in setter.f_locals
    return FailedCall("field", (_described(setter.f_locals["value"]),)) if known else None


def error_text(error: BaseException) -> str:
    """Return the exception's message, with the proposal that Python makes in a traceback."""
    try:
        text = str(error)
    except Exception:  # a class of the learner's own
        return ""
    meant = suggestion(error)
    asks = "Did you mean" in text or not meant
    return text if asks else f"{text.rstrip('.')}. Did you mean: '{meant}'?"


def fault_of(error: BaseException, time_ns: int, node: str, callback: str) -> Fault:
    """Return the record of an exception that left a callback."""
    frames = walk_tb(error.__traceback__)
    # Function, number and text of each line of the learner's, outermost first.
    own = [(one.f_code.co_name, *_line(one, at)) for one, at in frames if is_learners(one)]
    line, code = own[-1][1:] if own else (0, "")
    kind, asked = type(error).__name__, asked_by(error) or _refused_by_field(error)
    for (_, at, text), (called, *_) in pairwise(own):
        # `create_timer(1.0, self.tick())`: what failed in `tick` is not where the mistake is.
        if is_argument(text, called):
            line, code, asked = at, text, called_callback(called)
    return Fault(time_ns, node, callback, kind, error_text(error), line, code, asked)
