"""From an exception to the learner's own line."""

from __future__ import annotations

import linecache
import sysconfig
from itertools import pairwise
from pathlib import Path
from traceback import walk_tb
from types import FrameType

from rosbeat.diagnosis.callbacks import CALLED, is_argument
from rosbeat.records import Fault
from rosbeat.runtime.asking import asked_by, value_text
from rosbeat.runtime.suggestions import suggestion

# A frame in the standard library, in an installed package or in rosbeat is not the learner's.
_FOREIGN = tuple(
    {sysconfig.get_path(name) for name in ("stdlib", "purelib", "platlib")}
    | {str(Path(__file__).parents[1])}
)


def is_learners(frame: FrameType) -> bool:
    """Whether a frame runs code that the learner wrote, and not a library or rosbeat."""
    name = frame.f_code.co_filename
    if name == "<string>":  # code that a library has written, as for a dataclass, is of its module
        name = str(frame.f_globals.get("__file__", name))
    return not name.startswith(_FOREIGN) and not name.startswith("<frozen")


def learners_line(error: BaseException) -> tuple[int, str]:
    """Number and text of the innermost line that the learner wrote, or `(0, "")`."""
    own = _own_lines(error)
    return own[-1][1:] if own else (0, "")


def _own_lines(error: BaseException) -> list[tuple[str, int, str]]:
    """Function, number and text of each line of the learner's at work, outermost first."""
    return [
        (
            frame.f_code.co_name,
            line,
            linecache.getline(frame.f_code.co_filename, line, frame.f_globals).strip(),
        )
        for frame, line in walk_tb(error.__traceback__)
        if is_learners(frame)
    ]


def _refused_by_field(error: BaseException) -> str:
    """What a field of a message was given: the generated setter of the field raised."""
    frames = [frame for frame, _ in walk_tb(error.__traceback__)]
    if not isinstance(error, AssertionError) or not frames:
        return ""
    setter = frames[-1]
    of_message = ".msg._" in str(setter.f_globals.get("__name__"))
    known = of_message and "value" in setter.f_locals
    return value_text(setter.f_locals["value"]) if known else ""


def error_text(error: BaseException) -> str:
    """The exception's message, with the proposal that Python makes in a traceback."""
    try:
        text = str(error)
    except Exception:  # a class of the learner's own
        return ""
    meant = suggestion(error)
    asks = "Did you mean" in text or not meant
    return text if asks else f"{text.rstrip('.')}. Did you mean: '{meant}'?"


def fault_of(error: BaseException, time_ns: int, node: str, callback: str) -> Fault:
    """The record of an exception that left a callback."""
    line, code = learners_line(error)
    kind, asked = type(error).__name__, asked_by(error) or _refused_by_field(error)
    for (_, at, text), (called, *_) in pairwise(_own_lines(error)):
        # `create_timer(1.0, self.tick())`: what failed in `tick` is not where the mistake is.
        if is_argument(text, called):
            line, code, asked = at, text, f"create({CALLED}[{called}])"
    return Fault(time_ns, node, callback, kind, error_text(error), line, code, asked)
