"""The logger that a node of a session gets.

rclpy hands each log line to rcl, which prints it and publishes it on `/rosout`. rcl keeps one
`/rosout` publisher for each logger name *in the whole process*: a second node of the same name,
in whatever session, logs through the first one's publisher, and falls silent when that is
destroyed (rcl, logging_rosout.c). A session that listened on `/rosout` would hear its neighbours,
so lines are taken one step earlier, from the node's own logger, and go on to `/rosout` as ever.
"""

from __future__ import annotations

import inspect
import os
import sys
from collections.abc import Callable
from types import CodeType, FrameType
from typing import Any

from rclpy.clock import Clock
from rclpy.impl import rcutils_logger
from rclpy.impl.implementation_singleton import rclpy_implementation
from rclpy.impl.rcutils_logger import RcutilsLogger
from rclpy.logging import LoggingSeverity

#: level, logger name, text, function, line
Listener = Callable[[str, str, str, str, int], None]

_THIS_FILE = os.path.realpath(__file__)
_OWN_FILES = (_THIS_FILE, os.path.realpath(rcutils_logger.__file__))

# rclpy names the caller of a log line by skipping the files in this list; ours is one of them.
rcutils_logger._internal_callers.append(_THIS_FILE)


def _caller() -> FrameType:
    frame = sys._getframe(2)
    while frame.f_back and frame.f_code.co_filename in _OWN_FILES:
        frame = frame.f_back
    return frame


class SessionLogger(RcutilsLogger):
    """A logger that also tells its session.

    The first call from each place goes through rclpy, which checks it and remembers the place.
    Later calls from there with the same level and no filter are handed to rcl directly, with the
    same arguments: rclpy would look its caller up in the source files each time, which takes
    twenty times as long as all the rest (measured: 230 of 240 microseconds).

    Args:
        name: The logger's name.
        listener: Called with every line that was really logged.
        clock: The session's clock; `throttle_duration_sec` counts its seconds.
    """

    def __init__(self, name: str, listener: Listener, clock: Clock) -> None:
        super().__init__(name)
        self._listener = listener
        self._clock = clock
        self._places: dict[tuple[CodeType, int], LoggingSeverity] = {}

    def get_child(self, name: str) -> SessionLogger:
        """A logger below this one, heard by the same session."""
        child = super().get_child(name)
        made = SessionLogger(child.name, self._listener, self._clock)
        # rclpy removes the child's /rosout publisher by this pair of names.
        made.logger_sublogger_namepair = child.logger_sublogger_namepair
        child.logger_sublogger_namepair = None
        return made

    def log(self, message: str, severity: LoggingSeverity, **options: Any) -> bool:  # noqa: ANN401
        """Log a line; see `rclpy`. Returns whether it was logged."""
        frame = _caller()
        place = (frame.f_code, frame.f_lasti)
        known = not options and self._places.get(place) == severity
        if not (self._repeat(message, severity, frame) if known else self._first(
            message, severity, frame, options
        )):  # fmt: skip
            return False
        self._places[place] = severity
        level, name = LoggingSeverity(severity).name, str(options.get("name", self.name))
        self._listener(level, name, str(message), frame.f_code.co_name, frame.f_lineno)
        return True

    def _first(
        self, message: str, severity: LoggingSeverity, frame: FrameType, options: dict[str, Any]
    ) -> bool:
        if "throttle_duration_sec" in options:
            options.setdefault("throttle_time_source_type", self._clock)
        # rclpy looks for its caller's module, and would ask each of a thousand: a cell has none.
        module = str(frame.f_globals.get("__name__", ""))
        inspect.modulesbyfile.setdefault(frame.f_code.co_filename, module)
        return bool(super().log(message, severity, **options))

    def _repeat(self, message: str, severity: LoggingSeverity, frame: FrameType) -> bool:
        if not self.is_enabled_for(severity):
            return False
        code = frame.f_code
        rclpy_implementation.rclpy_logging_rcutils_log(
            severity, self.name, message, code.co_name, code.co_filename, frame.f_lineno
        )
        return True
