"""`time.sleep` in virtual time.

A node that sleeps in a callback is a process that does nothing else meanwhile: its messages wait in
their queues, its timers are late, and the other nodes go on. So while nodes run in virtual time, a
sleep of their thread lets virtual time pass for the others, and no real time. Threads of their own,
and code of rosbeat, sleep as ever. Who goes on meanwhile: `dozing`.
"""

from __future__ import annotations

import sys
import threading
import time
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from math import isfinite
from pathlib import Path
from typing import Any

from rosbeat.runtime.clock import SessionClock

_OWN = str(Path(__file__).parents[1])


@contextmanager
def virtual_sleep(
    nap: Callable[[float], object], clock: SessionClock, code: Iterable[object]
) -> Iterator[None]:
    """Let `time.sleep` of this thread, and `sleep_for` of the clock, call `nap` with the seconds.

    Args:
        nap: Lets virtual time pass.
        clock: The session's clock.
        code: Classes and functions; `from time import sleep` may stand in their modules.
    """
    real, home = time.sleep, threading.get_ident()

    def sleep(seconds: Any) -> None:  # noqa: ANN401 - unchecked
        own = sys._getframe(1).f_code.co_filename.startswith(_OWN)
        if own or threading.get_ident() != home or not _is_span(seconds):
            real(seconds)
        else:
            nap(float(seconds))

    def sleep_until(until: Any, context: object = None) -> bool:  # noqa: ANN401 - rclpy's
        nap(max(0, until.nanoseconds - clock.now().nanoseconds) / 1e9)
        return True

    with _in_place_of(real, sleep, [vars(time), *_namespaces(code)]):
        clock.sleep_until = sleep_until
        try:
            yield
        finally:
            del clock.sleep_until


@contextmanager
def _in_place_of(old: object, new: object, namespaces: list[dict[str, Any]]) -> Iterator[None]:
    found = [(names, key) for names in namespaces for key, one in names.items() if one is old]
    for names, key in found:
        names[key] = new
    try:
        yield
    finally:
        for names, key in found:
            if names.get(key) is new:
                names[key] = old


def _is_span(seconds: object) -> bool:
    return isinstance(seconds, int | float) and isfinite(seconds) and seconds >= 0


def _namespaces(code: Iterable[object]) -> list[dict[str, Any]]:
    """The global names that functions see, and those of classes and what they inherit from."""
    parts: list[object] = []
    for one in code:
        bases = one.__mro__ if isinstance(one, type) else ()
        parts += [one, *(part for base in bases for part in vars(base).values())]
    found = {id(names): names for part in parts if (names := getattr(part, "__globals__", None))}
    return list(found.values())
