"""Whether an answer has changed the course, ROS or Python, instead of solving the exercise.

Functions and classes are counted before the answer runs and after its scenario. What is another one
then, or has another body, was changed by the answer. Values that are no functions may change: they
are what programs work with.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from itertools import groupby
from operator import is_
from types import FunctionType, ModuleType
from typing import Any

from rosbeat.grading.inside.words import PARTS, Words, words_of_bodies, words_of_changes

#: Packages in which nothing may be changed: they run, observe and write down. `typing` is none of
#: them: it changes a few of its own functions the first time that they are used. Nor are message
#: classes: `msg = Float32` without brackets changes one, and has a name of its own.
GUARDED = (
    *("rosbeat", "rclpy", "builtins", "json", "ast", "dataclasses", "random", "time", "math"),
    *("os", "io", "threading", "contextlib", "functools", "collections", "queue", "types", "abc"),
    *("weakref", "copy", "itertools", "operator", "traceback", "linecache", "warnings", "signal"),
)
#: Enough for a report.
_MOST = 5


@dataclass(frozen=True)
class Place:
    """Where a function or class stands, and which one.

    Attributes:
        home: Dotted name of the module or class.
        space: Its names.
        name: The name.
        value: What stands there.
        body: If it is a function of Python: its code and its default values.
    """

    home: str
    space: Mapping[str, Any]
    name: str
    value: object
    body: tuple[object, ...]

    def is_same(self) -> bool:
        """Whether the same thing stands there still, with the same body."""
        now = self.space.get(self.name)
        return now is self.value and all(
            one is other for one, other in zip(_body(now), self.body, strict=True)
        )


#: How names are looked up in one module or class, the names, and what stood there.
Space = tuple[Callable[[str], object], tuple[str, ...], tuple[object, ...]]


@dataclass(frozen=True)
class Census:
    """All places, and the same in columns: 8,000 places are looked at once for each answer.

    Attributes:
        places: Each function and class.
        spaces: What stood in each module and class.
        functions: The functions of Python among it.
        bodies: Of these the code, the default values, and those that are named.
        changes: A word for each space that is another one after every change, if there is such.
        pointers: The words of the functions that say what their bodies are, if they can be told.
    """

    places: tuple[Place, ...]
    spaces: tuple[Space, ...]
    functions: tuple[object, ...]
    bodies: tuple[tuple[object, ...], ...]
    changes: Words | None
    pointers: Words | None

    def is_same(self) -> bool:
        """Whether everything stands there still, with the same bodies."""
        return self._stands_there() and self._has_same_bodies()

    def _stands_there(self) -> bool:
        # Spaces that have changed may have got other values, which are nobody's business.
        among = self.spaces if self.changes is None else map(self._space, self.changes.changed())
        # Nowhere with `==`, which what an answer has put there could answer itself.
        return all(all(map(is_, map(get, names), was)) for get, names, was in among)

    def _space(self, number: int) -> Space:
        return self.spaces[number]

    def _has_same_bodies(self) -> bool:
        if self.pointers is not None:
            return not self.pointers.changed()
        return all(
            all(map(is_, map(part, self.functions), was))
            for part, was in zip(PARTS, self.bodies, strict=True)
        )


def census() -> Census:
    """List what is there: each function and class of the packages that are guarded."""
    places = tuple(
        place
        for module in _modules()
        for place in _places(module.__name__, vars(module), module.__name__)
    )
    inner = (_inner(place.value) for place in places)
    functions = tuple(one for one in inner if isinstance(one, FunctionType))
    bodies = tuple(tuple(map(part, functions)) for part in PARTS)
    by_space = [tuple(some) for _, some in groupby(places, lambda place: id(place.space))]
    changes = words_of_changes([some[0].space for some in by_space])
    spaces = tuple(map(_space_of, by_space))
    return Census(places, spaces, functions, bodies, changes, words_of_bodies(functions))


def _space_of(places: tuple[Place, ...]) -> Space:
    names = tuple(place.name for place in places)
    return places[0].space.get, names, tuple(place.value for place in places)


def differences(before: Census) -> tuple[str, ...]:
    """The dotted names of what is another function or class now, or has another body.

    Args:
        before: The census of an earlier moment, of the same process or of the one it was forked
            from.
    """
    if before.is_same():
        return ()
    changed = (f"{place.home}.{place.name}" for place in before.places if not place.is_same())
    return tuple(sorted(changed))[:_MOST]


def _modules() -> Iterator[ModuleType]:
    for name, module in list(sys.modules.items()):
        if name.split(".")[0] in GUARDED and isinstance(module, ModuleType):
            yield module


def _places(home: str, space: Mapping[str, Any], module: str) -> Iterator[Place]:
    for name, value in list(space.items()):
        if isinstance(value, type):
            yield Place(home, space, name, value, ())
            if value.__module__ == module and module != "builtins":
                yield from _places(f"{home}.{name}", vars(value), module)
        elif _is_function(value):
            yield Place(home, space, name, value, _body(value))


def _is_function(value: object) -> bool:
    return callable(value) or isinstance(value, (property, staticmethod, classmethod))


def _inner(value: object) -> object:
    return getattr(value, "__func__", value)


def _body(value: object) -> tuple[object, ...]:
    inner = _inner(value)
    return tuple(part(inner) for part in PARTS) if isinstance(inner, FunctionType) else ()
