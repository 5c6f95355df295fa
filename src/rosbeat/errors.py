"""Every error that rosbeat raises, in one tree.

::

    RosbeatError                    what happened, what it means, what to try
    ├── SessionError                a session was asked for something it cannot do
    │   ├── NodeClassError          what was added is not a node, or cannot be made into one
    │   │   └── NoSystemError       what should be a list of nodes is none
    │   ├── NodeConstructionError   the node's own constructor raised
    │   ├── DurationError           a time span that is negative, not finite or not a number
    │   ├── UnknownTopicError       nobody published on that topic
    │   ├── UnknownServerError      no node offers that service or action
    │   ├── TimeUpError             what a test waits for did not happen in time
    │   ├── NoFaultError            a callback that a test expects to raise did not
    │   ├── ExitCodeError           a program ended with an exit code other than 0
    │   ├── ParameterError          a node refused to set a parameter
    │   ├── EndlessChainError       callbacks cause each other for ever without time passing
    │   ├── DeadlockError           callbacks wait for ever
    │   ├── DomainsExhaustedError   no ROS domain id is left for a check or for terminals
    │   ├── NoSessionError          a node was made in a notebook with no session open
    │   └── ClosedSessionError      the session has ended
    ├── PictureError                a picture cannot be drawn from what it was given
    ├── ExerciseError               a check was asked for an exercise that does not exist
    ├── WorkspaceError              something in the learner's workspace is not as it is needed
    ├── TerminalError               a terminal of a page was asked for something it cannot do
    ├── LessonError                 a lesson source breaks a rule of the builder
    ├── BagError                    a recording cannot be written, read, replayed or compared
    ├── GradingError                submissions cannot be collected, graded or reported
    │   └── SubmissionError         what was handed in is nothing that can be graded
    ├── CallError                a function was called with arguments that it does not take
    ├── UnsupportedRclpyError       rclpy is of a distribution of ROS that the engine does not know
    ├── RecordError                 saved data that does not follow the schema
    ├── CommandError                the command line was used in a way it does not know
    └── StoppedError                a person has stopped a command (Ctrl-C); what is done stays

This module imports nothing of rosbeat, so that every room of the house may raise.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from difflib import get_close_matches
from functools import wraps
from inspect import Parameter, signature
from typing import Any, TypeVar, cast


class RosbeatError(Exception):
    """Report an error in three parts: what happened, what it means here, what to try.

    Args:
        what: What happened, in one sentence.
        means: What that means here.
        to_try: What to do about it.
    """

    def __init__(self, what: str, means: str = "", to_try: str = "") -> None:
        super().__init__(what)
        self.what = what
        self.means = means
        self.to_try = to_try

    def __reduce__(self) -> tuple[type[RosbeatError], tuple[str, str, str]]:
        """All three parts go from one process to another."""
        return type(self), (self.what, self.means, self.to_try)

    def __str__(self) -> str:
        rows = [self.what]
        if self.means:
            rows.append(f"  What it means: {self.means}")
        if self.to_try:
            rows.append(f"  What to try:   {self.to_try}")
        return "\n".join(rows)

    def _render_traceback_(self) -> Sequence[str]:
        """Show the three parts instead of a stack of our own frames (IPython calls this)."""
        return f"{type(self).__name__}: {self}".splitlines()


def explain_interrupt(
    interrupt: KeyboardInterrupt, what: str, means: str = "", to_try: str = ""
) -> None:
    """Let IPython show the three parts of an error for an interrupt, and no stack.

    Args:
        interrupt: The interrupt.
        what: What it stopped, in one sentence.
        means: What that means here.
        to_try: What to do about it.
    """
    lines = f"KeyboardInterrupt: {RosbeatError(what, means, to_try)}".splitlines()
    interrupt._render_traceback_ = lambda: lines  # type: ignore[attr-defined] # IPython's protocol


class SessionError(RosbeatError):
    """Signal that a session cannot do what it was asked to do."""


class DeadlockError(SessionError):
    """Signal that callbacks wait for something that can never happen."""


class NodeClassError(SessionError):
    """Signal that an object added to a session is neither a node nor a factory for nodes."""


class NoSystemError(NodeClassError):
    """Signal that an object is not a list of nodes."""


class NodeConstructionError(SessionError):
    """Signal that a node's constructor raised; the original exception is the cause."""


class DurationError(SessionError):
    """Signal that a duration is negative, infinite or not a number."""


class UnknownTopicError(SessionError):
    """Signal that nothing was published on the requested topic."""


class UnknownServerError(SessionError):
    """Signal that no node of the session offers the requested service or action."""


class TimeUpError(SessionError):
    """Signal that what a test waits for did not happen in time."""


class NoFaultError(SessionError):
    """Signal that no callback raised the exception that a test expects."""


class ExitCodeError(SessionError):
    """Signal that a program ended with an exit code other than 0."""


class ParameterError(SessionError):
    """Signal that a node refused to set a parameter."""


class EndlessChainError(SessionError):
    """Signal that callbacks trigger each other endlessly while no time passes."""


class DomainsExhaustedError(SessionError):
    """Signal that every ROS domain id for checks, or for terminals, is in use on this machine."""


class NoSessionError(SessionError):
    """Signal that a notebook created a node with no open session and no initialized context."""


class ClosedSessionError(SessionError):
    """Signal that the session is closed, so its ROS context no longer exists."""


class UnsupportedRclpyError(RosbeatError, ImportError):
    """Signal that rclpy belongs to a distribution of ROS that the engine does not know."""


class PictureError(RosbeatError):
    """Signal that a picture cannot be drawn from the given data."""


class ExerciseError(RosbeatError):
    """Signal that an exercise, scenario or patient does not exist, or has invalid arguments."""


class WorkspaceError(RosbeatError):
    """Signal that the learner's workspace is not in the required state."""


class TerminalError(RosbeatError):
    """Signal that a terminal of a page cannot do what it was asked to do."""


class LessonError(RosbeatError):
    """Signal that a lesson source breaks a rule of the builder."""


class BagError(RosbeatError):
    """Signal that a recording cannot be written, read, replayed or compared."""


class GradingError(RosbeatError):
    """Signal that submissions cannot be collected, graded or reported."""


class SubmissionError(GradingError):
    """Signal that what was handed in is nothing that can be graded."""


class CallError(RosbeatError):
    """Signal that a function was called with arguments that it does not take, or without one."""


class RecordError(RosbeatError):
    """Signal that saved data does not follow the schema of the records."""


class CommandError(RosbeatError):
    """Signal that the command line was used incorrectly."""


class StoppedError(RosbeatError):
    """Signal that somebody stopped a command; what it had finished by then is kept."""


# Calls that do not fit the signature of the function.

_Function = TypeVar("_Function", bound=Callable[..., Any])


def called_as(example: str) -> Callable[[_Function], _Function]:
    """Answer a call that does not fit a function's signature with a `CallError`.

    Python's own `TypeError` names the inner function and comes with a stack of our frames. A
    `TypeError` that the function itself raises passes unchanged.

    Args:
        example: A correct call, as a learner would write it: `ros.run(seconds=60)`.

    Returns:
        The decorator, which leaves the signature as it is.
    """

    def decorate(function: _Function) -> _Function:
        @wraps(function)
        def called(*values: Any, **named: Any) -> Any:  # noqa: ANN401 - the function's own
            __tracebackhide__ = True  # pytest leaves this frame out of a traceback
            try:
                return function(*values, **named)
            except TypeError as error:
                trace = error.__traceback__
                # Python binds the arguments before there is a frame of the function.
                if trace is None or trace.tb_next is not None:
                    raise
            raise _call_error(function, example, values, named)

        return cast(_Function, called)

    return decorate


def _call_error(
    function: Callable[..., Any], example: str, values: tuple[Any, ...], named: dict[str, Any]
) -> CallError:
    """Return the error for arguments that cannot be bound to the function's parameters."""
    name = example.partition("(")[0]
    takes = list(signature(function).parameters.values())
    if takes and takes[0].name == "self":
        takes, values = takes[1:], values[1:]
    by_place = [one for one in takes if one.kind is Parameter.POSITIONAL_OR_KEYWORD]
    known = [one.name for one in takes if one.kind is not Parameter.VAR_POSITIONAL]
    missing = [
        one.name
        for one in by_place[len(values) :]
        if one.default is Parameter.empty and one.name not in named
    ]
    unknown = [one for one in named if one not in known]
    tips = [f"For example, write `{example}`."]
    if len(values) > len(by_place) and len(known) == len(takes):
        given = f"{len(values)} positional argument{'s' if len(values) > 1 else ''}"
        what = f"`{name}` was given {given}, but takes {len(by_place) or 'none'}."
        tips = _decimal_point(by_place, values) + tips
    elif unknown:
        what = f"`{name}` has no argument `{unknown[0]}`."
        tips = [f"Did you mean `{one}`?" for one in get_close_matches(unknown[0], known, 1)] + tips
    elif missing:
        what = f"`{name}` was called without {_listed(missing)}."
    else:
        twice = [one.name for one in by_place[: len(values)] if one.name in named]
        what = f"`{name}` was given {_listed(twice)} twice."
    return CallError(what, _arguments(takes), " ".join(tips))


def _arguments(takes: Sequence[Parameter]) -> str:
    """Say which arguments a function needs, and which others it takes."""
    needed = [one for one in takes if one.default is Parameter.empty]
    required = [one.name for one in needed if one.kind is Parameter.POSITIONAL_OR_KEYWORD]
    others = [one.name for one in takes if one.name not in required]
    told = [f"It needs {_listed(required)}."] if required else []
    told += [f"It also takes {_listed(others)}."] if others else []
    return " ".join(told) or "It takes no arguments."


def _decimal_point(takes: Sequence[Parameter], values: Sequence[object]) -> list[str]:
    """Return advice for `0,5` in the place of `0.5`, which is two whole numbers to Python."""
    for one, whole, part in zip(takes, values, values[1:], strict=False):
        numbers = type(whole) is int and type(part) is int and part >= 0
        if numbers and ("float" in str(one.annotation) or one.annotation == "object"):
            return [f"If you mean one number, write it with a decimal point: `{whole}.{part}`."]
    return []


def _listed(names: Sequence[str]) -> str:
    *first, last = [f"`{name}`" for name in names]
    return f"{', '.join(first)} and {last}" if first else last
