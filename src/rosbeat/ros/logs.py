"""Bring each log line of a session's code to its session, whichever logger it comes from.

A line may come from a node's logger, from `rclpy.logging.get_logger("name")` in a module, or from
rclpy itself, which warns of incompatible QoS. A session that listened on `/rosout` would hear its
neighbors: rcl keeps one publisher there for each logger name *in the whole process*
(logging_rosout.c), and lines of other loggers never get there. So lines are taken one step earlier,
where all of them pass: in `RcutilsLogger.log`. They go on to `/rosout` as ever.

Levels belong to an operating-system process, and so to a simulated one here. rcl keeps one table of
levels for all of the kernel, so each simulated process has a table of its own beside it.
"""

from __future__ import annotations

import os
import sys
import threading
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from functools import wraps
from itertools import pairwise
from typing import Any, Protocol
from weakref import WeakKeyDictionary, ref

import rclpy.utilities
from rclpy.clock import Clock
from rclpy.impl import rcutils_logger
from rclpy.impl.implementation_singleton import rclpy_implementation
from rclpy.impl.rcutils_logger import RcutilsLogger
from rclpy.logging import LoggingSeverity
from rclpy.time import Time

# Who is told of a line.


class LogHost(Protocol):
    """Say what this module asks of a session."""

    def now(self) -> int:
        """Return nanoseconds since the session began."""

    def has_this_thread(self) -> bool:
        """Return whether its nodes run, or would run, in the calling thread."""

    def runs_here(self) -> bool:
        """Return whether code of its nodes is running in the calling thread."""

    def process_here(self) -> object | None:
        """Return the simulated process whose code is running, or None if a cell is."""

    def logged(self, level: str, name: str, text: str, function: str, line: int) -> None:
        """Record a line, and print it if it is time to."""


class Owner(Protocol):
    """Say what this module asks of a node: in which simulated process it is."""

    process: Any


#: The sessions that are open. A tuple that is replaced as a whole: other threads read it.
_hosts: tuple[ref[LogHost], ...] = ()
_hosts_lock = threading.Lock()


def open_host(host: LogHost) -> None:
    """Tell a session of its lines from now on."""
    global _hosts
    with _hosts_lock:
        _hosts = (*(one for one in _hosts if one() is not None), ref(host))


def close_host(host: LogHost) -> None:
    """Tell a session of no more lines, except those of its nodes' own loggers."""
    global _hosts
    with _hosts_lock:
        _hosts = tuple(one for one in _hosts if one() not in (None, host))


def _host_here() -> LogHost | None:
    """Return the session whose code is running: that of the default context, where it runs here.

    In the thread of a plain executor, or of another session, another session may be the default.
    """
    context = rclpy.utilities.g_default_context
    default: LogHost | None = getattr(context, "session_core", None)
    if default is not None and default.has_this_thread():
        return default
    for reference in _hosts:
        host = reference()
        if host is not None and host.runs_here():
            return host
    return None


# Levels.

#: What is logged of a process that has set no level.
_DEFAULT = int(LoggingSeverity.INFO)


class Levels:
    """Hold the levels of one simulated process, or of the cells of a session.

    As in rcutils, a logger without a level has that of the part of its name before the last dot;
    an empty name stands for all others.
    """

    def __init__(self) -> None:
        self._of: dict[str, int] = {}

    def __len__(self) -> int:
        return len(self._of)

    def set(self, name: str, level: int) -> None:
        """Set the level of a logger; 0 takes it back."""
        if level or not name:
            self._of[name] = int(level)
        else:
            self._of.pop(name, None)

    def get(self, name: str) -> int | None:
        """Return the level that was set for exactly this name, if one was."""
        return self._of.get(name)


_levels: WeakKeyDictionary[object, Levels] = WeakKeyDictionary()


def levels_of(owner: object) -> Levels:
    """Return the levels of a simulated process or a session."""
    levels = _levels.get(owner)
    if levels is None:
        levels = _levels[owner] = Levels()
    return levels


def set_levels(process: object, arguments: Sequence[str]) -> bool:
    """Apply what a command line says of logging to a process, as `rclpy.init` does.

    Args:
        process: The simulated process.
        arguments: ROS arguments that rcl has accepted.

    Returns:
        Whether the process publishes its lines on `/rosout`.
    """
    levels, rosout = levels_of(process), True
    for word, value in pairwise([*arguments, ""]):
        if word == "--log-level":
            name, _, level = value.rpartition(":=")
            levels.set(name, LoggingSeverity[level.upper()])
        elif word in ("--disable-rosout-logs", "--enable-rosout-logs"):
            rosout = word.startswith("--enable")
    return rosout


class _Memory:
    """Hold what is known of one logger's calls in one process.

    Attributes:
        contexts: By place in the code: rclpy's record of its filters.
        places: By place in the code: the level with which rclpy has accepted it.
    """

    __slots__ = ("__weakref__", "contexts", "places")

    def __init__(self) -> None:
        self.contexts: dict[Any, Any] = {}
        self.places: dict[Any, int] = {}


class _Source:
    """Hold whose code logs with one logger: of which session and process.

    Attributes:
        host: The session.
        memory: What is known of the logger's calls there.
    """

    __slots__ = ("_owner", "_process", "host", "memory")

    def __init__(
        self,
        host: LogHost,
        memory: _Memory,
        process: object | None = None,
        owner: Owner | None = None,
    ) -> None:
        self.host, self.memory = host, memory
        # A node may be moved to another process.
        self._process, self._owner = process, owner

    def for_child(self) -> _Source:
        """Return a source for a logger below this one."""
        return _Source(self.host, _Memory(), self._process, self._owner)

    @property
    def process(self) -> object | None:
        """Return the simulated process; None for a cell."""
        return self._process if self._owner is None else self._owner.process

    def level(self, name: str) -> int:
        """Return the level of a logger: that of its process, otherwise that of the session."""
        if not _levels:
            return _DEFAULT
        owners = [owner for owner in (self.process, self.host) if owner is not None]
        tables = [levels for owner in owners if (levels := _levels.get(owner))]
        while tables:
            for levels in tables:
                level = levels.get(name)
                if level is not None:
                    return level
            if not name:
                break
            name = name.rpartition(".")[0]
        return _DEFAULT


# Loggers. What this module knows of one is kept in its own attributes, since most are short-lived.


def bind(logger: RcutilsLogger, host: LogHost, owner: Owner) -> None:
    """Let the lines of a node's logger go to its session, from whichever thread they come."""
    if "_rosbeat_source" not in logger.__dict__:
        logger._rosbeat_source = _Source(host, _Memory(), owner=owner)


def _source_of(logger: RcutilsLogger) -> _Source | None:
    """Return whose code logs with a logger; None for code of no session."""
    bound: _Source | None = logger.__dict__.get("_rosbeat_source")
    if bound is not None:
        return bound
    host = _host_here()
    if host is None or logger.name.startswith(_HIDDEN):
        return None
    process = host.process_here()
    # A logger of a module outlives a session, and programs share it: each of them is a process on
    # a robot, so `once=True` logs once in each. It must not keep them alive.
    memories: WeakKeyDictionary[object, _Memory] = logger.__dict__.setdefault(
        "_rosbeat_memories", WeakKeyDictionary()
    )
    scope = host if process is None else process
    memory = memories.get(scope)
    if memory is None:
        memory = memories[scope] = _Memory()
    return _Source(host, memory, process)


#: The names of rosbeat's own hidden nodes begin so.
_HIDDEN = "_rosbeat_"
#: rcl's filter takes 0 for "long ago", which is true of a robot's clock: about 55 years.
_LONG_AGO = 55 * 365 * 24 * 3600 * 1_000_000_000


class _ThrottleClock(Clock):
    """Show a session's time to rclpy's throttles."""

    host: ref[LogHost]

    def now(self) -> Time:
        """Return the session's time, counted from long ago."""
        host = self.host()
        now = 0 if host is None else host.now()
        return Time(nanoseconds=_LONG_AGO + now, clock_type=self.clock_type)


_clocks: WeakKeyDictionary[object, _ThrottleClock] = WeakKeyDictionary()


def _clock_of(host: LogHost) -> _ThrottleClock:
    """Return the clock of a session's throttles, always the same: rclpy insists on that."""
    clock = _clocks.get(host)
    if clock is None:
        clock = _clocks[host] = _ThrottleClock()
        clock.host = ref(host)
    return clock


# The hooks.


class _Here(threading.local):
    """Hold, for each thread, whose code is logging."""

    source: _Source | None = None


_here = _Here()

#: A file that is never the caller of a log line, as `hooks` tells rclpy.
THIS_FILE = os.path.realpath(__file__)
_OWN_FILES = (THIS_FILE, os.path.realpath(rcutils_logger.__file__))

_log = RcutilsLogger.log
_get_child = RcutilsLogger.get_child
_send = rclpy_implementation.rclpy_logging_rcutils_log
_is_enabled = rclpy_implementation.rclpy_logging_logger_is_enabled_for
_set_level = rclpy_implementation.rclpy_logging_set_logger_level
_get_level = rclpy_implementation.rclpy_logging_get_logger_level
_effective_level = rclpy_implementation.rclpy_logging_get_logger_effective_level


@wraps(_log)
def hooked_log(
    logger: RcutilsLogger,
    message: str,
    severity: LoggingSeverity,
    *name: str,
    **options: Any,  # noqa: ANN401 - passed on
) -> bool:
    """Log a line, as rclpy does, and tell the session of it; return whether it was logged.

    The first call from each place goes through rclpy, which checks it and remembers the place.
    Later calls from there with the same level and no filter are handed to rcl directly: rclpy would
    look its caller up in the source files each time, which takes twenty times as long as all the
    rest (230 of 240 microseconds). `throttle_duration_sec` counts the session's seconds.
    """
    source = _source_of(logger)
    if source is None:
        return bool(_log(logger, message, severity, *name, **options))
    options |= {"name": name[0]} if name else {}  # Kilted takes it in this place as well
    frame = sys._getframe(1)
    while frame.f_back and frame.f_code.co_filename in _OWN_FILES:
        frame = frame.f_back
    place = (frame.f_code, frame.f_lasti)
    function, line = frame.f_code.co_name, frame.f_lineno
    if options or source.memory.places.get(place) != severity:
        if options.get("throttle_duration_sec"):
            options.setdefault("throttle_time_source_type", _clock_of(source.host))
        with _in_place_of(logger, source):
            if not _log(logger, message, severity, **options):
                return False
        source.memory.places[place] = severity
    elif source.level(logger.name) <= severity:
        _send_anyway(severity, logger.name, message, function, frame.f_code.co_filename, line)
    else:
        return False
    called = str(options.get("name") or logger.name)
    source.host.logged(LoggingSeverity(severity).name, called, str(message), function, line)
    return True


@contextmanager
def _in_place_of(logger: RcutilsLogger, source: _Source) -> Iterator[None]:
    """Let rclpy know of this source's earlier calls and levels only, in this block."""
    before, others = _here.source, logger.contexts
    _here.source, logger.contexts = source, source.memory.contexts
    try:
        yield
    finally:
        _here.source, logger.contexts = before, others


@wraps(_get_child)
def hooked_child(logger: RcutilsLogger, name: str) -> RcutilsLogger:
    """Return a logger below this one, heard by the same session."""
    child = _get_child(logger, name)
    bound: _Source | None = logger.__dict__.get("_rosbeat_source")
    if bound is not None:
        child._rosbeat_source = bound.for_child()
    return child


def _send_anyway(severity: int, name: str, *rest: Any) -> None:  # noqa: ANN401 - passed on
    """Hand a line to rcl, which has levels of its own, and would drop what a process wants."""
    if _is_enabled(name, severity):
        _send(severity, name, *rest)
        return
    before = _get_level(name)
    _set_level(name, severity, False)
    try:
        _send(severity, name, *rest)
    finally:
        _set_level(name, before, False)


def _source_here() -> _Source | None:
    """Return whose code sets a level or asks for one; None for code of no session."""
    if _here.source is not None:
        return _here.source
    host = _host_here()
    return None if host is None else _Source(host, _Memory(), host.process_here())


def hooked_send(severity: int, name: str, *rest: Any) -> None:  # noqa: ANN401 - passed on
    """Send a line to rcl, as a process wants it whose code is running."""
    (_send if _here.source is None else _send_anyway)(severity, name, *rest)


def hooked_is_enabled(name: str, severity: int) -> bool:
    """Return whether a logger logs lines of a severity, in the process that asks."""
    source = _source_here()
    return bool(_is_enabled(name, severity)) if source is None else source.level(name) <= severity


def hooked_effective_level(name: str) -> int:
    """Return from which level on a logger logs, in the process that asks."""
    source = _source_here()
    return int(_effective_level(name)) if source is None else source.level(name)


def hooked_get_level(name: str) -> int:
    """Return the level that was set for a logger, in the process that asks."""
    source = _source_here()
    if source is None:
        return int(_get_level(name))
    own = levels_of(source.process or source.host).get(name)
    return own if own is not None else 0 if name else _DEFAULT


def hooked_set_level(name: str, level: int, detailed_error: bool = False) -> None:
    """Set the level of a logger, in the process that asks."""
    source = _source_here()
    if source is None:
        _set_level(name, level, detailed_error)
    else:
        levels_of(source.process or source.host).set(name, int(level))
