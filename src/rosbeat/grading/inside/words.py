"""What CPython keeps of functions and dictionaries, read from memory without touching it.

To look at an object in Python is to write into it: somebody more knows it for a moment, and that is
counted in the object. In a forked process each page that is written to is copied first, and to look
at all functions of the course and of ROS copies a thousand pages, for each answer. To read the
words where functions keep their bodies, and dictionaries a number that every change renews, copies
none.

Where those words are is not written here. It is found out by trial, with this very Python, and
where there is no such word, as in Python 3.14 for dictionaries, `None` says so.
"""

from __future__ import annotations

import ctypes
import gc
from collections.abc import Callable, Mapping, Sequence
from operator import attrgetter
from types import FunctionType
from typing import Any

import numpy as np

_WORD = 8
#: Words of an object in which something is looked for; none that is asked for has more.
_MOST = 24
_HEAD = 2

#: What a function's body is made of.
PARTS = tuple(map(attrgetter, ("__code__", "__defaults__", "__kwdefaults__")))


class Words:
    """Words of memory, read all at once, and what they were at first.

    Whoever makes this keeps the objects alive to which the words belong.

    Args:
        addresses: Where they are; at least one.
    """

    def __init__(self, addresses: Sequence[int]) -> None:
        base, end = min(addresses), max(addresses)
        # A view of all that lies between the two, of which nothing is read but what is asked for.
        span = (ctypes.c_uint64 * ((end - base) // _WORD + 1)).from_address(base)
        self._view = np.frombuffer(span, dtype=np.uint64)
        self._places = (np.array(addresses, dtype=np.int64) - base) // _WORD
        self.before = self._view.take(self._places)
        self.before.flags.writeable = False

    def changed(self) -> list[int]:
        """Which of them are others than at first, by their places in the order of the addresses."""
        # With nothing but what arrays can do by themselves: functions of NumPy could be exchanged.
        found: list[int] = (self._view.take(self._places) != self.before).nonzero()[0].tolist()
        return found


def words_of_bodies(functions: Sequence[object]) -> Words | None:
    """The words that say of what functions are made.

    Args:
        functions: Functions of Python.

    Returns:
        For each function as many as it has `PARTS`; None if they cannot be told.
    """
    offsets = [_word_with(part) for part in PARTS]
    if None in offsets:
        return None
    words = Words([id(one) + offset for one in functions for offset in offsets if offset])
    known = [_pointer(part(one)) for one in functions for part in PARTS]
    return words if words.before.tolist() == known else None


def words_of_changes(spaces: Sequence[Mapping[str, Any]]) -> Words | None:
    """The words of dictionaries that are others after every change.

    Args:
        spaces: Dictionaries, or the views of them that classes give.

    Returns:
        One for each; None if there is no such word.
    """
    offset = _counting_word()
    return Words([id(_dictionary(one)) + offset for one in spaces]) if offset else None


def _pointer(part: object) -> int:
    """What stands where a function keeps a part; nothing at all, if it has none."""
    return 0 if part is None else id(part)


def _word_with(part: Callable[[object], object]) -> int | None:
    """Where in a function the pointer to one of its parts is."""

    def sample(first: object = object(), *, second: object = object()) -> None:
        """Have all of the parts."""

    found = [at for at in _words_of(FunctionType) if _word(sample, at) == id(part(sample))]
    return found[0] if len(found) == 1 else None


def _counting_word() -> int | None:
    """Where in a dictionary the number is that every change renews."""
    probe: dict[str, object] = {"a": 1, "b": 2}
    found = [{at: _word(probe, at) for at in _words_of(dict)}]
    for change in _CHANGES:
        change(probe)
        found.append({at: _word(probe, at) for at in _words_of(dict)})
    kept = [at for at in found[0] if len({words[at] for words in found}) == len(found)]
    return kept[0] if len(kept) == 1 else None


#: Other values, no values, new ones, with and without another size.
_CHANGES: tuple[Callable[[dict[str, object]], object], ...] = (
    lambda probe: probe.update(a=3),
    lambda probe: probe.update(a=1),
    lambda probe: probe.pop("a"),
    lambda probe: probe.update(a=1),
    lambda probe: probe.setdefault("c", 1),
    lambda probe: probe.popitem(),
    lambda probe: probe.__setitem__("b", 5),
    lambda probe: probe.__delitem__("b"),
    lambda probe: probe.clear(),
    lambda probe: probe.update(a=1, b=2),
)


def _words_of(kind: type) -> range:
    """Offsets of an object's words, behind what every object begins with."""
    return range(_HEAD * _WORD, min(kind.__basicsize__, _MOST * _WORD), _WORD)


def _word(found: object, offset: int) -> int:
    return ctypes.c_uint64.from_address(id(found) + offset).value


def _dictionary(space: Mapping[str, Any]) -> object:
    """The dictionary itself, of which a class gives only a view."""
    return space if type(space) is dict else gc.get_referents(space)[0]
