"""Classes and modules that nobody can change while a stranger's code runs.

What cannot be changed need not be watched: an answer could put back what it has changed before
anybody looks. So the classes of the course, of ROS and of Python get the flag that Python's own
built-in classes have (`Py_TPFLAGS_IMMUTABLETYPE`, documented since CPython 3.10), and the modules a
class that refuses. The course itself changes a few names of modules while it runs; these stay open,
and `intact` looks at them afterwards.
"""

from __future__ import annotations

import ctypes
import sys
from collections.abc import Iterator
from types import ModuleType

from rosbeat.grading.inside.intact import Census

_IMMUTABLE = 1 << 8
#: Where a class keeps its flags: behind 20 words of `PyTypeObject` and the head, the same in all of
#: CPython's 64-bit versions from 3.8 on. What stands there is compared before anything is written.
_OFFSET = 168
#: Packages whose classes never change. Those of messages are left open, see `intact.GUARDED`, and
#: some of Python's own count in themselves (`weakref.finalize`).
_PACKAGES = frozenset(("rosbeat", "rclpy", "json", "contextlib", "dataclasses", "collections"))
#: Classes of which an object may become one of another class, by the course's doing: those of a
#: module, and one of the course's own.
_CHANGING = frozenset(("rclpy.clock", "rosbeat.ros.clock.SessionClock"))
#: Modules in which the course puts back what it borrows; see `ros.isolation`.
_OPEN = frozenset(("builtins", "time", "random", "threading", "rclpy"))


class _Frozen(ModuleType):
    """A module whose names stay what they are."""

    def __setattr__(self, name: str, value: object) -> None:
        if callable(vars(self).get(name)):
            raise TypeError(f"cannot set {name!r} of the module {self.__name__!r}")
        super().__setattr__(name, value)

    def __delattr__(self, name: str) -> None:
        raise TypeError(f"cannot delete {name!r} of the module {self.__name__!r}")


def freeze(census: Census) -> int:
    """Freeze the classes and modules of a census, as far as this Python lets itself be asked.

    Args:
        census: What there is.

    Returns:
        How many classes are frozen now.
    """
    for module in {place.home for place in census.places} - _OPEN:
        found = sys.modules.get(module)
        if type(found) is ModuleType and module.split(".")[0] in _PACKAGES:
            found.__class__ = _Frozen
    return sum(_freeze_class(one) for one in set(_classes(census)))


def _classes(census: Census) -> Iterator[type]:
    for place in census.places:
        kind = place.value
        if isinstance(kind, type) and _is_ours(kind):
            yield kind


def _is_ours(kind: type) -> bool:
    module = kind.__module__
    changing = module in _CHANGING or f"{module}.{kind.__qualname__}" in _CHANGING
    return module.split(".")[0] in _PACKAGES and not changing


def _freeze_class(kind: type) -> bool:
    flags = ctypes.c_ulong.from_address(id(kind) + _OFFSET)
    if flags.value != kind.__flags__ or flags.value & _IMMUTABLE:
        return False
    flags.value |= _IMMUTABLE
    return bool(kind.__flags__ & _IMMUTABLE)
