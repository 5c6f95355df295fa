"""What Python itself would propose for a name that it does not know.

A traceback in a terminal ends with `Did you mean: 'publisher_'?`. The exception's text has no such
end: Python adds it while it prints, and differently in each version.
"""

from __future__ import annotations

import builtins
from collections.abc import Iterable, Iterator
from difflib import SequenceMatcher, get_close_matches
from traceback import walk_tb
from types import FrameType, FunctionType, ModuleType

from rclpy.node import Node

#: `logger` and `get_logger` are alike, `temperature` and `publish_temperature` are not.
_LIKE = 0.75


def suggestion(error: BaseException) -> str:
    """The nearest name to one that does not exist, or an empty text.

    Args:
        error: An exception; only an AttributeError or a NameError has a suggestion.
    """
    name = getattr(error, "name", None)
    if not isinstance(name, str) or not name.strip("_"):
        return ""  # nothing, or a blank that was not filled in
    if isinstance(error, AttributeError):
        return _nearest(name, _attributes(error.obj)) or _same_verb(name, error.obj)
    if isinstance(error, NameError) and not isinstance(error, UnboundLocalError):
        return _nearest(name, _names(error, name))
    return ""


def _nearest(name: str, groups: Iterable[Iterable[str]]) -> str:
    """The name that is most alike; of two that are equally so, that of the earlier group."""
    best, likeness = "", _LIKE
    for group in groups:
        names = [one for one in group if isinstance(one, str) and not one.startswith("_")]
        if name in names:
            return f"self.{name}"
        for near in get_close_matches(name, names, 1, likeness):
            rated = SequenceMatcher(None, near, name).ratio()
            best, likeness = (near, rated) if not best or rated > likeness else (best, likeness)
    return best


def _same_verb(name: str, owner: object) -> str:
    """The only method of the learner's that begins alike: `publish_humidity` for `publish_x`."""
    if not isinstance(owner, Node):
        return ""
    verb, _, rest = name.partition("_")
    found = {
        one
        for kind in type.mro(type(owner))
        if not kind.__module__.startswith("rclpy.")
        for one, it in vars(kind).items()
        if isinstance(it, FunctionType) and verb and rest and one.startswith(f"{verb}_")
    }
    return found.pop() if len(found) == 1 else ""


def _attributes(owner: object) -> Iterator[Iterable[str]]:
    """Names that an object has, its own before those of its classes."""
    if not isinstance(owner, type):
        yield list(getattr(owner, "__dict__", ()))
    if isinstance(owner, ModuleType):
        return
    for kind in type.mro(owner if isinstance(owner, type) else type(owner)):
        # `publishers` and `timers` are every node's, and never what was meant by `publisher_`.
        foreign = kind.__module__.startswith("rclpy.")
        yield [name for name, it in vars(kind).items() if not foreign or callable(it)]


def _names(error: NameError, name: str) -> Iterator[Iterable[str]]:
    frame = _frame(error)
    if frame is None:
        return
    # `tick` where `self.tick` is meant is the same name, and so nearer than any other.
    node = frame.f_locals.get("self")
    own = [list(group) for group in _attributes(node)] if isinstance(node, Node) else []
    yield from ([name] for group in own if name in group)
    for known in (frame.f_locals, frame.f_globals, vars(builtins)):
        yield [one for one in known if one != name]


def _frame(error: NameError) -> FrameType | None:
    frames = [frame for frame, _ in walk_tb(error.__traceback__)]
    return frames[-1] if frames else None
