"""Run a learner's code with a deadline, leave the process as it was, and seed random numbers."""

from __future__ import annotations

import _thread
import builtins
import gc
import linecache
import os
import random
import signal
import sys
import threading
import time
import warnings
from collections import deque
from collections.abc import Callable, Iterable, Iterator
from contextlib import ExitStack, contextmanager, suppress
from dataclasses import dataclass
from functools import partial
from io import TextIOBase
from pathlib import Path
from types import FrameType, ModuleType, TracebackType
from typing import Any, NoReturn
from weakref import WeakSet

import rclpy
from rclpy.node import Node
from rclpy.publisher import Publisher

from rosbeat.ros.exception_origin import is_learners

# Kept here: a learner's code may put something else in its place.
_now = time.monotonic
_signal, _setitimer, _mask = signal.signal, signal.setitimer, signal.pthread_sigmask

#: Seconds between two exceptions, if the timer that is set after each of them gets lost.
_EVERY = 0.001
#: The same for the first two: most code ends with the first.
_FIRST = 0.1
#: Seconds after the second exception and each later one, in turn.
_SWEEP = [k * 1e-6 for k in (1, 2, 4, 6, 8, 12, 16, 24, 32, 64, 128, 256)]
#: Seconds that code which gets on has in all.
_AT_MOST = 15.0
#: Seconds that rosbeat's own code and rclpy's have to tidy up, between two exceptions.
_PATIENCE = 0.6
#: Seconds that code may go on after Interrupt, if it catches even that.
_AFTER_INTERRUPT = 0.2

_ROSBEAT = str(Path(__file__).parents[1])
_OURS = (_ROSBEAT, str(Path(rclpy.__file__).parent))


class DeadlinePassed(BaseException):
    """Signal, in code that still runs, that its time is up."""

    def __str__(self) -> str:
        return "the time is up"


class Deadline:
    """End a block of code after a time limit: `with Deadline(1.0) as deadline: ...`.

    When the time is up, the handler of `SIGALRM` raises `DeadlinePassed` in the middle of an
    endless loop, a wait or a sleep. Code that catches everything (`while True: try: ... except:
    pass`) gets the next exception while it handles the last one, or between two rounds of its loop:
    from the second exception on, the timer is set to a few microseconds, a different number each
    time. Code that catches an Interrupt ends soon after it.

    Python handles signals in the main thread only, so a deadline has no effect in another thread.
    Neither a deadline nor Interrupt ends a long call of C code, such as `sum(range(10**12))`.

    Args:
        seconds: Time limit for the block, in seconds of wall time; `passed` tells whether the block
            took longer.
        noting: Called once, at the moment when the time is up.
        gets_on: Tells, when the time is up, whether the code has got on lately, such as to another
            callback. Then the time begins anew, up to three times as much in all: on a busy machine
            slow code is not taken for endless code.
    """

    def __init__(
        self,
        seconds: float,
        noting: Callable[[], object] = bool,
        gets_on: Callable[[], bool] | None = None,
    ) -> None:
        self.seconds = seconds
        self._gets_on = gets_on
        self.passed = self.interrupted = False
        self._where: tuple[str, int, dict[str, Any]] | None = None
        self._noting = noting
        self._open = self._raising = False
        self._raised, self._spared_until = 0, 0.0
        self._in_main = threading.current_thread() is threading.main_thread()

    def __enter__(self) -> Deadline:
        self._base = sys._getframe(1)
        self._began = _now()
        self._until = self._began + self.seconds
        self._latest = self._began + max(self.seconds, min(3 * self.seconds, _AT_MOST))
        if self._in_main:
            self._take_signals()
        self._open = True
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, _: TracebackType | None
    ) -> bool:
        """End the block; swallow a passed deadline, but no interrupt.

        Raises:
            KeyboardInterrupt: If Interrupt was pressed, whatever the code made of it.
        """
        self._open = False
        if self._in_main:
            self._give_signals_back()
        if self.interrupted and not isinstance(error, KeyboardInterrupt):
            raise KeyboardInterrupt from None
        return self.passed and isinstance(error, DeadlinePassed)  # else it is an outer one's

    @property
    def place(self) -> tuple[int, str]:
        """Return number and text of the learner's line where the time was up, or `(0, "")`.

        Ask after the block: in it a learner's code may have changed what Python needs.
        """
        if self._where is None:
            return 0, ""
        file, line, names = self._where
        return line, linecache.getline(file, line, names).strip()

    # Signals.

    def _take_signals(self) -> None:
        self._functions = {name: getattr(signal, name) for name in _RESERVED}
        vars(signal).update(_RESERVED)
        self._alarm_before = _signal(signal.SIGALRM, self._ring)
        first = max(1e-6, self._until - _now())
        self._timer_before = _setitimer(signal.ITIMER_REAL, first, _FIRST)
        self._interrupt_before = signal.getsignal(signal.SIGINT)
        if callable(self._interrupt_before):
            _signal(signal.SIGINT, self._interrupt)

    def _give_signals_back(self) -> None:
        _setitimer(signal.ITIMER_REAL, 0)
        _signal(signal.SIGALRM, self._alarm_before or signal.SIG_DFL)
        if callable(self._interrupt_before):
            _signal(signal.SIGINT, self._interrupt_before)
        vars(signal).update(self._functions)
        left, again = self._timer_before
        if left:  # an outer deadline's, or a test's time limit
            _setitimer(signal.ITIMER_REAL, max(0.001, left - (_now() - self._began)), again)

    def _ring(self, number: int, frame: FrameType | None) -> None:
        """Raise in the code that is running, if its time is up: the handler of `SIGALRM`."""
        if not self._open or self._raising or _now() < self._until:
            return
        if self._gets_on is not None and not (self.passed or self.interrupted):
            self._give_time(self._gets_on)
            if _now() < self._until:
                return
        self._raising = True  # the next alarm may come while this one is being answered
        try:
            inside = list(self._inside(frame))
            # Not before and after the block: one that never begins never ends.
            if not inside or inside[0].f_code in _NEVER:
                return
            self._note(inside)
            if self._may_be_hit(inside):
                self._raised += 1
                if self._raised > 1:
                    _setitimer(signal.ITIMER_REAL, _SWEEP[self._raised % len(_SWEEP)], _EVERY)
                raise DeadlinePassed
        finally:
            self._raising = False

    def _give_time(self, gets_on: Callable[[], bool]) -> None:
        self._raising = True  # a look may take longer than the timer
        try:
            with suppress(Exception):  # a node may have properties of its own
                if gets_on():
                    self._until = max(self._until, min(_now() + self.seconds, self._latest))
        finally:
            self._raising = False

    def _interrupt(self, number: int, frame: FrameType | None) -> None:
        self.interrupted = True  # `__exit__` remembers
        if self._open:
            self._until = min(self._until, _now() + _AFTER_INTERRUPT)
            _setitimer(signal.ITIMER_REAL, _AFTER_INTERRUPT + 0.01, _FIRST)
            if frame is not None and frame.f_code not in _NEVER:
                self._interrupt_before(number, frame)  # type: ignore[operator,misc] # callable

    # What is running.

    def _note(self, inside: list[FrameType]) -> None:
        if self.passed:
            return
        self.passed = True
        frame = next(filter(is_learners, inside), None)
        if frame is not None:
            self._where = (frame.f_code.co_filename, frame.f_lineno or 0, frame.f_globals)
        with suppress(Exception):  # names that Python has by itself may be others by now
            self._noting()

    def _may_be_hit(self, inside: Iterable[FrameType]) -> bool:
        """Return whether to raise here: in a learner's code always, in ours now and then."""
        for frame in inside:
            if is_learners(frame):
                return True
            if frame.f_code.co_filename.startswith(_OURS):
                break
        now = _now()
        if now < self._spared_until:
            return False
        self._spared_until = now + _PATIENCE
        return True

    def _inside(self, frame: FrameType | None) -> Iterator[FrameType]:
        """Return the frames of the block, innermost first."""
        while frame is not None:
            yield frame
            frame = frame.f_back if frame is not self._base else None


_NEVER = {Deadline.__enter__.__code__, Deadline.__exit__.__code__}


def run_in_generator(do: Callable[[], object]) -> None:
    """Run code that a deadline may hit, and leave no exception of it behind.

    An exception that hits the very beginning of an `except` or the end of a `with` leaves Python
    believing that the one before is still being handled (CPython 3.11). Later tracebacks of the
    thread would begin with it, and it would keep nodes from being collected. A generator handles
    exceptions of its own, and they end with it.
    """

    def generator() -> Iterator[None]:
        do()
        yield

    next(generator())


#: What stands in the place of functions of `signal` in a block: they leave the deadline's alone.
_RESERVED: dict[str, Callable[..., Any]] = {
    "signal": lambda which, do: None if which == signal.SIGALRM else _signal(which, do),
    "setitimer": lambda which, *rest: (
        None if which == signal.ITIMER_REAL else _setitimer(which, *rest)
    ),
    "alarm": lambda _: 0,
    "pthread_sigmask": lambda how, mask: _mask(how, set(mask) - {signal.SIGALRM}),
}


# Where a learner's prints go while a check runs.


@dataclass
class Count:
    """Count the characters that code other than rosbeat's own printed, on both streams.

    Attributes:
        characters: How many there were.
    """

    characters: int = 0

    def add(self, text: str) -> None:
        """Count a text, and let a check overhear its beginning."""
        self.characters += len(text)
        for heard in _overhearing:
            heard.append(text[: _MOST_HEARD - sum(map(len, heard))])


#: Characters of what is printed that a check can show.
_MOST_HEARD = 4000
_overhearing: list[list[str]] = []


@contextmanager
def overheard() -> Iterator[list[str]]:
    """Collect the beginning of what answers print in the block, which is not shown meanwhile."""
    heard: list[str] = []
    _overhearing.append(heard)
    try:
        yield heard
    finally:
        _overhearing.remove(heard)


class Sink(TextIOBase):
    """Count what is written to the stream, and discard it.

    Output of threads that already existed goes to the `real` stream, because they do not belong to
    the learner's node.
    """

    encoding = "utf-8"

    def __init__(self, real: Any, count: Count) -> None:  # noqa: ANN401 - whatever stdout is
        super().__init__()
        self._real, self._count = real, count
        here = _thread.get_ident()
        self._others = {one.ident for one in threading.enumerate() if one.ident != here}

    def writable(self) -> bool:
        """Return that it can be written to."""
        return True

    def write(self, text: str) -> int:
        """Count a text."""
        if _thread.get_ident() in self._others:
            return int(self._real.write(text))
        if not sys._getframe(1).f_code.co_filename.startswith(_ROSBEAT):
            self._count.add(text)
        return len(text)

    def outlive_threads(self) -> None:
        """Stay alive while a thread may still be printing here.

        `print` holds no reference to the stream that it writes to (CPython before 3.13): if the
        stream goes away meanwhile, the whole process does.
        """
        for thread in threading.enumerate():
            vars(thread).setdefault("_rosbeat_sinks", deque(maxlen=8)).append(self)


# A process that is afterwards as it was before.


@contextmanager
def unharmed() -> Iterator[Count]:
    """Restore what belongs to the process, and not to a node, after the block.

    That is: standard output and error, the current folder, the environment, Python's built-in
    names and those of `time`, `random` and rclpy's nodes, handlers of signals, hooks for exceptions
    and traces, filters of warnings, limits. Meanwhile what is printed is only counted, nobody types
    (`input()` raises), and `quit()` does not end the kernel.
    """
    count = Count()
    with ExitStack() as stack:
        stack.callback(_silence_threads_but, set(threading.enumerate()))
        for put_back in [*_settings(), *_signals(), *(_names(*one) for one in _NAMES)]:
            stack.callback(_quietly, put_back)
        stack.enter_context(warnings.catch_warnings())
        sinks = [Sink(sys.stdout, count), Sink(sys.stderr, count)]
        for sink in sinks:
            stack.callback(sink.outlive_threads)
        sys.stdout, sys.stderr = sinks
        # What nobody can catch, as in `__del__`, is not printed either.
        sys.unraisablehook = lambda _: None
        builtins.input = _refuse_input
        shell = _ipython()
        if shell is not None:
            stack.callback(_quietly, lambda: delattr(shell, "ask_exit"))
            shell.ask_exit = _refuse_to_quit
        yield count


class _Silence:
    """Print the exceptions of all threads but those that a block has left behind."""

    def __init__(self) -> None:
        self.left_behind: WeakSet[threading.Thread] = WeakSet()
        self._print = threading.excepthook

    def __call__(self, raised: threading.ExceptHookArgs) -> None:
        if raised.thread not in self.left_behind:
            self._print(raised)


def _silence_threads_but(before: set[threading.Thread]) -> None:
    """Keep exceptions of the threads that are left behind from the page: its nodes are gone."""
    left_behind = set(threading.enumerate()) - before
    if left_behind:
        if not isinstance(threading.excepthook, _Silence):
            threading.excepthook = _Silence()
        threading.excepthook.left_behind.update(left_behind)


#: Where names are put back; which ones, or all.
_NAMES: tuple[tuple[Any, tuple[str, ...]], ...] = (
    (sys, ("excepthook", "unraisablehook", "displayhook", "stdin", "stdout", "stderr")),
    (threading, ("excepthook",)),
    *((one, ()) for one in (Node, Publisher, rclpy, random, time, builtins)),
)
#: How a setting is read and set.
_SETTINGS: tuple[tuple[Callable[[], Any], Callable[[Any], object]], ...] = (
    (os.getcwd, os.chdir),
    (lambda: dict(os.environ), lambda before: _set_environment(before)),
    (sys.getrecursionlimit, sys.setrecursionlimit),
    (sys.getswitchinterval, sys.setswitchinterval),
    (gc.isenabled, lambda on: gc.enable() if on else gc.disable()),
    (gc.get_threshold, lambda numbers: gc.set_threshold(*numbers)),
    (sys.gettrace, sys.settrace),
    (sys.getprofile, sys.setprofile),
)


def _settings() -> Iterator[Callable[[], object]]:
    for read, put in _SETTINGS:
        with suppress(FileNotFoundError):  # the current folder has been removed
            yield partial(put, read())


def _set_environment(before: dict[str, str]) -> None:
    if os.environ != before:
        os.environ.clear()
        os.environ.update(before)


def _names(owner: ModuleType | type, names: tuple[str, ...]) -> Callable[[], object]:
    """Return a function that restores the names of a module or class."""
    # `_` is the last result of a cell, for IPython's own use.
    before = {name: vars(owner)[name] for name in names or vars(owner) if name != "_"}

    def put_back() -> None:
        for name, value in before.items():
            if vars(owner).get(name) is not value:
                setattr(owner, name, value)

    return put_back


def _signals() -> Iterator[Callable[[], object]]:
    if threading.current_thread() is not threading.main_thread():
        return  # only the main thread can change them
    before = [(number, signal.getsignal(number)) for number in signal.valid_signals()]
    yield lambda: [
        signal.signal(number, handler)
        for number, handler in before
        if handler is not None and signal.getsignal(number) != handler
    ]
    # The third one, ITIMER_REAL, belongs to the deadline, which puts it back.
    yield lambda: [signal.setitimer(one, 0) for one in (signal.ITIMER_VIRTUAL, signal.ITIMER_PROF)]


def _quietly(put_back: Callable[[], object]) -> None:
    with suppress(Exception):  # a folder that was removed, say: the rest is put back all the same
        put_back()


def _refuse_input(*_: object) -> NoReturn:
    raise EOFError("input() was called, but a node has no keyboard input")


def _refuse_to_quit() -> NoReturn:
    raise SystemExit("quit() was called")


@contextmanager
def quitting_raises(in_code_of_node: Callable[[], bool]) -> Iterator[None]:
    """Let `exit()` and `quit()` of a node's code in a kernel end its process, and not the kernel.

    Those of IPython only ask the shell to end; Python's own raise SystemExit.
    """
    shell = _ipython()
    ask_exit = getattr(shell, "ask_exit", None)
    if ask_exit is None:  # no kernel, or a shell that nobody can ask
        yield
        return

    def ask_or_raise() -> None:
        if in_code_of_node():
            raise SystemExit
        ask_exit()

    shell.ask_exit = ask_or_raise
    try:
        yield
    finally:
        if shell.ask_exit is ask_or_raise:
            shell.ask_exit = ask_exit


def _ipython() -> Any:  # noqa: ANN401 - its shell, whose `quit()` ends the kernel after the cell
    ipython = sys.modules.get("IPython")
    return ipython.get_ipython() if ipython else None


# Random numbers.
#
# A node draws from Python's global generator (`random.uniform`) or NumPy's. Each session keeps its
# own generator states and installs them only while its nodes run, so that the same seed gives the
# same numbers whatever other code draws in between.


#: The generator behind the functions of `random`: `random.uniform` is a method of it.
_SHARED: random.Random = random.uniform.__self__  # type: ignore[attr-defined]  # a method
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
