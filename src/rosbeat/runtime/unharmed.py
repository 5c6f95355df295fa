"""A kernel that is afterwards as it was before, whatever a learner's code does to it meanwhile."""

from __future__ import annotations

import builtins
import gc
import os
import random
import signal
import sys
import threading
import time
import warnings
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager, redirect_stderr, redirect_stdout, suppress
from importlib import import_module
from typing import Any, NoReturn

import rclpy
from rclpy.node import Node
from rclpy.publisher import Publisher

from rosbeat.runtime.sink import Count, Sink


@contextmanager
def unharmed() -> Iterator[Count]:
    """Keep what belongs to the process and not to a node, and put it back afterwards.

    That is: standard output and error, the current folder, the environment, Python's built-in
    names and those of `time`, `random` and rclpy's nodes, handlers of signals, hooks for exceptions
    and traces, filters of warnings, limits. Meanwhile nothing
    is printed, nobody types (`input()` raises), and `quit()` does not end the kernel.

    Yields:
        How much was printed.
    """
    count = Count()
    with ExitStack() as stack:
        for put_back in _kept():
            stack.callback(_quietly, put_back)
        stack.enter_context(warnings.catch_warnings())
        out, err = Sink(sys.stdout, count), Sink(sys.stderr, count)
        for sink in (out, err):
            stack.callback(sink.outlive_threads)
        stack.enter_context(redirect_stdout(out))
        stack.enter_context(redirect_stderr(err))
        sys.unraisablehook = _say_nothing
        stack.enter_context(_nobody_types())
        stack.enter_context(_quit_ends_nothing())
        yield count


def _say_nothing(_: object) -> None:
    """Take an exception that nobody can catch, as in `__del__`."""


def _quietly(put_back: Callable[[], object]) -> None:
    with suppress(Exception):  # a folder that was removed, say: the rest is put back all the same
        put_back()


def _kept() -> list[Callable[[], object]]:
    """Functions that put things back, to be called from the last to the first."""
    return [_folder(), _environ(), _limits(), _signals(), _timers(), _hooks(sys, _SYS_HOOKS),
            _hooks(threading, ("excepthook",)), _methods(Node), _methods(Publisher),
            *(_names(one) for one in (rclpy, random, time, builtins))]  # fmt: skip


_SYS_HOOKS = ("excepthook", "unraisablehook", "displayhook", "stdin", "stdout", "stderr")


def _folder() -> Callable[[], object]:
    try:
        folder = os.getcwd()
    except FileNotFoundError:
        return bool  # it has been removed
    return lambda: os.chdir(folder)


def _environ() -> Callable[[], object]:
    before = dict(os.environ)

    def put_back() -> None:
        if os.environ != before:
            os.environ.clear()
            os.environ.update(before)

    return put_back


def _names(module: Any) -> Callable[[], object]:  # noqa: ANN401 - a module
    before = dict(vars(module))

    def put_back() -> None:
        # `_` is the last result of a cell, for IPython's own use.
        for name, value in before.items():
            if vars(module).get(name) is not value and name != "_":
                setattr(module, name, value)

    return put_back


def _methods(kind: type) -> Callable[[], object]:
    before = dict(vars(kind))

    def put_back() -> None:
        for name, value in before.items():
            if vars(kind).get(name) is not value and name not in ("__dict__", "__weakref__"):
                setattr(kind, name, value)

    return put_back


def _timers() -> Callable[[], object]:
    # The third one, ITIMER_REAL, belongs to the deadline, which puts it back.
    return lambda: [signal.setitimer(one, 0) for one in (signal.ITIMER_VIRTUAL, signal.ITIMER_PROF)]


def _limits() -> Callable[[], object]:
    depth, interval, collecting = sys.getrecursionlimit(), sys.getswitchinterval(), gc.isenabled()
    threshold, tracing, profiling = gc.get_threshold(), sys.gettrace(), sys.getprofile()

    def put_back() -> None:
        sys.setrecursionlimit(depth)
        sys.setswitchinterval(interval)
        (gc.enable if collecting else gc.disable)()
        gc.set_threshold(*threshold)
        sys.settrace(tracing)
        sys.setprofile(profiling)

    return put_back


def _hooks(module: Any, names: tuple[str, ...]) -> Callable[[], object]:  # noqa: ANN401
    before = {name: getattr(module, name) for name in names}
    return lambda: vars(module).update(before)


_SIGNALS = tuple(map(int, signal.valid_signals()))
# The C function: `signal.getsignal` makes an enum of each answer, which is half of all this.
_handler: Callable[[int], Any] = import_module("_signal").getsignal


def _signals() -> Callable[[], object]:
    if threading.current_thread() is not threading.main_thread():
        return bool  # only the main thread can change them
    before = [(number, _handler(number)) for number in _SIGNALS]

    def put_back() -> None:
        for number, handler in before:
            if handler is not None and _handler(number) is not handler:
                signal.signal(number, handler)

    return put_back


@contextmanager
def _nobody_types() -> Iterator[None]:
    def refuse(*_: object) -> NoReturn:
        raise EOFError("input() was called, and nobody types while a node runs")

    original = builtins.input
    builtins.input = refuse
    try:
        yield
    finally:
        builtins.input = original


@contextmanager
def _quit_ends_nothing() -> Iterator[None]:
    """IPython's `quit()` lets the kernel end after the cell; here it raises, as elsewhere."""

    def refuse() -> NoReturn:
        raise SystemExit("quit() was called")

    ipython = sys.modules.get("IPython")
    shell = ipython.get_ipython() if ipython else None
    if shell is None:
        yield
        return
    shell.ask_exit = refuse
    try:
        yield
    finally:
        with suppress(AttributeError):
            del shell.ask_exit
