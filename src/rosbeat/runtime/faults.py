"""From an exception to the learner's own line."""

from __future__ import annotations

import linecache
import sysconfig
from pathlib import Path
from traceback import walk_tb
from types import FrameType

from rosbeat.records import Fault

# A frame in the standard library, in an installed package or in rosbeat is not the learner's.
_FOREIGN = tuple(
    {sysconfig.get_path(name) for name in ("stdlib", "purelib", "platlib")}
    | {str(Path(__file__).parents[1])}
)


def _is_learners(frame: FrameType) -> bool:
    name = frame.f_code.co_filename
    return not name.startswith(_FOREIGN) and not name.startswith("<frozen")


def learners_line(error: BaseException) -> tuple[int, str]:
    """Number and text of the innermost line that the learner wrote, or `(0, "")`."""
    own = [(frame, line) for frame, line in walk_tb(error.__traceback__) if _is_learners(frame)]
    if not own:
        return 0, ""
    frame, line = own[-1]
    return line, linecache.getline(frame.f_code.co_filename, line, frame.f_globals).strip()


def fault_of(error: BaseException, time_ns: int, node: str, callback: str) -> Fault:
    """The record of an exception that left a callback."""
    line, code = learners_line(error)
    return Fault(time_ns, node, callback, type(error).__name__, str(error), line, code)
