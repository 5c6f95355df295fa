"""Seed random numbers per session.

A node draws from Python's global generator (`random.uniform`) or NumPy's. Each session keeps its
own generator states and installs them only while its nodes run, so that the same seed gives the
same numbers whatever other code draws in between.
"""

from __future__ import annotations

import random
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

#: The generator behind the functions of `random`: `random.uniform` is a method of it.
_SHARED: random.Random = random.uniform.__self__  # type: ignore[attr-defined]
#: The same function again, and not an equal one: nothing is different after a session.
_PLAIN = random.random


def _numpy_random() -> Any:  # noqa: ANN401 - a module
    # Only a node that imported NumPy can draw from it; importing it here would cost 0.1 s.
    return getattr(sys.modules.get("numpy"), "random", None)


def tilt(exponent: float) -> None:
    """Tilt the numbers that the functions of `random` draw, until the session's run ends.

    They are what would have been drawn, between 0 and 1, raised to a power; so they keep their
    range, and only their mean moves, to 1 / (1 + exponent).

    Args:
        exponent: 1 for no tilt, less for higher numbers, more for lower ones; above 0.
    """
    _straighten()
    if exponent == 1.0:
        return
    plain = _SHARED.random

    def tilted() -> float:
        return float(plain() ** exponent)

    # `uniform` and `gauss` ask the first, `choice` and `randint` the second.
    vars(_SHARED).update(random=tilted, _randbelow=lambda n: int(n * tilted()))
    random.random = tilted


def _straighten() -> None:
    for name in ("random", "_randbelow"):
        vars(_SHARED).pop(name, None)
    random.random = _PLAIN


class SeededRandom:
    """Hold the random state of one session; NumPy takes its seed modulo 2**32."""

    def __init__(self, seed: int) -> None:
        self._seed = seed
        self._state = random.Random(seed).getstate()
        self._numpy_state: Any = None
        self._is_lent = False

    @contextmanager
    def lent(self) -> Iterator[None]:
        """Put this session's states in place of the process's, and back at the end.

        Within another `lent` of the same session it does nothing: a constructor may call a service.
        """
        if self._is_lent:
            yield
            return
        self._is_lent = True
        try:
            with self._exchanged():
                yield
        finally:
            self._is_lent = False

    @contextmanager
    def _exchanged(self) -> Iterator[None]:
        outer, numpy = _SHARED.getstate(), _numpy_random()
        outer_numpy = numpy.get_state() if numpy else None
        _SHARED.setstate(self._state)
        if numpy and self._numpy_state is None:
            numpy.seed(self._seed % 2**32)
        elif numpy:
            numpy.set_state(self._numpy_state)
        try:
            yield
        finally:
            _straighten()
            self._state = _SHARED.getstate()
            _SHARED.setstate(outer)
            # NumPy may have been imported meanwhile; then there is no outer state to put back.
            numpy = _numpy_random()
            self._numpy_state = numpy.get_state() if numpy else None
            if outer_numpy is not None:
                numpy.set_state(outer_numpy)
