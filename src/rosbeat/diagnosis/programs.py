"""Name the mistake that a program in a terminal ended with, by what it printed.

The last traceback is taken apart into the same record that a session makes of an exception, so the
same functions recognise it. What is said of Ctrl+C (row 29), of files that Python cannot read (28)
and of a name that is taken (18) only shows in a program.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise

from rosbeat.diagnosis.calls import matched, written_call
from rosbeat.diagnosis.exceptions import diagnosed, meaning_of
from rosbeat.diagnosis.mistakes import Diagnosis
from rosbeat.diagnosis.syntax import diagnose_syntax
from rosbeat.records import Fault, called_callback, is_argument

_COLOUR = re.compile(r"\x1b\[[0-9;]*[A-Za-z]")
_START = "Traceback (most recent call last)"
_FRAME = re.compile(r'^ +File "(?P<file>[^"]*)", line (?P<line>\d+)(?:, in (?P<name>.+))?$')
_ERROR = re.compile(
    r"^(?:[\w.]+\.)?(?P<kind>\w*(?:Error|Exception|Interrupt|Exit|Iteration))(?:: (?P<text>.*))?$"
)
_UNREADABLE = ("SyntaxError", "IndentationError", "TabError")
#: Files of Python, of ROS and of the environment; whatever colcon installed is the learner's.
_FOREIGN = re.compile(
    r"^<|/lib/python[\d.]+/(?!site-packages/)|/(?:rclpy|std_msgs|rosidl\w*|setuptools)/|/\.venv/|/opt/ros/"
)
_MARKS = re.compile(r"^ *[~^]+ *$")


@dataclass(frozen=True)
class _Frame:
    file: str
    line: int
    name: str
    code: str

    @property
    def is_learners(self) -> bool:
        """Return whether the file is the learner's own."""
        installed = "/install/" in self.file or "/build/" in self.file
        foreign = _FOREIGN.search(self.file) and not installed
        return not foreign and self.file.endswith(".py")


def diagnose_output(text: str) -> Diagnosis | None:
    """Return the mistake that a program's output shows.

    Args:
        text: The program's output, stdout and stderr combined.

    Returns:
        The mistake, with the learner's line as evidence; None if no mistake is certain.
    """
    meaning = meaning_of_output(text)
    if meaning is None:
        return None
    fault = fault_in(text)
    return meaning if fault is None else diagnosed(fault, meaning)


def meaning_of_output(text: str) -> Diagnosis | None:
    """Return what a program's output means, if it shows a known mistake; else None."""
    fault = fault_in(text)
    if fault is None:
        return _registered_twice(text)
    return _unreadable(fault) or _ended(fault) or meaning_of(fault)


def fault_in(text: str) -> Fault | None:
    """Return the record of the last exception that a program's output shows, or None.

    The line is the learner's own; the callback is the function that it is in.
    """
    lines = _COLOUR.sub("", text).replace("\r", "").split("\n")
    starts = [at for at, line in enumerate(lines) if line.startswith(_START)]
    ends = [at for at, line in enumerate(lines) if _ERROR.match(line)]
    if not ends:
        return None
    found = _ERROR.match(lines[ends[-1]])
    begin = max((at for at in starts if at < ends[-1]), default=-1)
    if not found or (begin < 0 and found["kind"] not in _UNREADABLE):
        return None  # a log line that quotes an error is no error
    frames = list(_frames(lines[begin + 1 : ends[-1]]))
    message = "\n".join([found["text"] or "", *_rest(lines[ends[-1] + 1 :])])
    return _fault(found["kind"], message, frames)


def _frames(lines: list[str]) -> Iterator[_Frame]:
    for at, line in enumerate(lines):
        found = _FRAME.match(line)
        if found:
            below = [one for one in lines[at + 1 : at + 2] if not _FRAME.match(one)]
            code = "" if not below or _MARKS.match(below[0]) else below[0].strip()
            yield _Frame(found["file"], int(found["line"]), found["name"] or "", code)


def _rest(lines: list[str]) -> Iterator[str]:
    """Return the lines of a message that go on under the first: they are indented."""
    for line in lines:
        if not line.startswith(" "):
            return
        yield line


def _fault(kind: str, text: str, frames: list[_Frame]) -> Fault:
    own = [frame for frame in frames if frame.is_learners]
    if not own:
        return Fault(0, "", "", kind, text, 0, "")
    at = own[-1]
    asked = written_call(at.code)
    for outer, inner in pairwise(own):
        if is_argument(outer.code, inner.name):
            at, asked = outer, called_callback(inner.name)
    return Fault(0, "", at.name, kind, text, at.line, at.code, asked)


# What only programs show.


def _registered_twice(text: str) -> Diagnosis | None:
    if not re.search(r"Publisher already registered for (?:provided )?node name", text):
        return None
    return Diagnosis(
        "run-twice",
        "Two nodes in this program have the same name, so they share one logger.",
        "Is the node created twice? Each node needs its own name.",
    )


def _unreadable(fault: Fault) -> Diagnosis | None:
    if fault.kind not in _UNREADABLE:
        return None
    said = fault.text.split("\n")[0].split(" (")[0]
    if known := diagnose_syntax(said, fault.code):
        return known
    return Diagnosis(
        "syntax-error",
        f"Python cannot read the file: {said or 'something is missing'}.",
        "Check the brackets, quotes and colons on that line and the line above it, and their "
        "indentation.",
    )


def _ended(fault: Fault) -> Diagnosis | None:
    if fault.kind in ("KeyboardInterrupt", "ExternalShutdownException"):
        means = "Ctrl+C ended the program, but main does not handle that exception."
    elif matched(fault, r"rcl_shutdown already called"):
        means = "Ctrl+C has already shut ROS down, and main shuts it down a second time."
    else:
        return None
    return Diagnosis(
        "ctrl-c-traceback",
        means,
        "The node itself worked; only its exit isn't clean. What does main do when spin is "
        "interrupted, and after that?",
    )
