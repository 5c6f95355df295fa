"""Define the errors of session calls, and print log lines and exceptions of nodes as they come.

Log lines have the format of `ros2 run`, with virtual time instead of wall time, so that every run
prints the same text.
"""

from __future__ import annotations

import sys
from collections.abc import Sequence
from difflib import get_close_matches
from math import inf, isfinite
from numbers import Real
from typing import TYPE_CHECKING, NamedTuple

import rclpy
from rclpy.exceptions import InvalidHandle
from rclpy.node import Node

from rosbeat.errors import (
    ClosedSessionError,
    DeadlockError,
    DurationError,
    NodeClassError,
    NodeConstructionError,
    RosbeatError,
    SessionError,
    UnknownTopicError,
)
from rosbeat.records import INFRASTRUCTURE_TOPICS, NANOSECONDS, Fault, GraphSnapshot, LogRecord

if TYPE_CHECKING:
    from rosbeat.ros.simulated_program import SimulatedProgram
    from rosbeat.ros.waits import Wait


#: What to write in the place of a call that waits in a callback.
INSTEAD_OF_WAITING = (
    "For a service, use `call_async` and add a done callback, or make the callback `async def` "
    "and await the future, with the client in its own callback group. To do something "
    "repeatedly, create a timer."
)
#: The only middleware that delivers a message within `publish`.
MIDDLEWARE = "rmw_fastrtps_cpp"
#: About 31 years; a longer span is a slip.
_LONGEST = 1e9


# Checks.


def check_whole(name: str, value: object, low: int, high: int, example: str = "") -> None:
    """Check that a value is a whole number from `low` to `high`.

    Raises:
        SessionError: If it is anything else.
    """
    if isinstance(value, int) and not isinstance(value, bool) and low <= value <= high:
        return
    raise SessionError(
        f"{name}={value!r} cannot be used.",
        f"It must be a whole number from {low} to {high if high < 2**63 else 'about 9e18'}.",
        f"For example, write {example or f'Session({name}=7)'}.",
    )


def check_middleware() -> None:
    """Check that the middleware is Fast DDS.

    Raises:
        SessionError: If it is another one.
    """
    name = rclpy.get_rmw_implementation_identifier()
    if name != MIDDLEWARE:
        raise SessionError(
            f"A session needs the middleware {MIDDLEWARE}, and this process uses {name}.",
            "Virtual time counts on a message being there when `publish` returns, as it is with "
            "Fast DDS.",
            f"Set RMW_IMPLEMENTATION={MIDDLEWARE} before Python starts. It is in the package "
            f"ros-jazzy-{MIDDLEWARE.replace('_', '-')}.",
        )


def check_name(call: str, value: object) -> str:
    """Return a value that is a string.

    Raises:
        SessionError: If it is anything else.
    """
    if isinstance(value, str):
        return value
    raise SessionError(
        f"{call}(...) was given {value!r}, which is of type {type(value).__name__}.",
        "The argument is a name, and a name is a string.",
        f'Put it in quotation marks: `ros.{call}("temperature")`.',
    )


def duration_ns(seconds: object, what: str = "run(seconds=...)") -> int:
    """Convert seconds to whole nanoseconds.

    Args:
        seconds: A number from 0 to 1e9.
        what: The call that was given the number, for the error.

    Raises:
        DurationError: If it is not such a number.
    """
    if not isinstance(seconds, Real) or isinstance(seconds, bool):
        problem = f"{seconds!r}, which is of type {type(seconds).__name__}."
    else:
        try:
            span = float(seconds)
        except OverflowError:
            span = inf
        if 0 <= span <= _LONGEST:
            return round(span * NANOSECONDS)
        if not isfinite(span):
            problem = f"{span}."
        elif span < 0:
            problem = f"{span:g}, which is a negative time."
        else:
            problem = f"{span:g}, which is more than {_LONGEST:g} seconds."
    raise DurationError(
        f"{what} was given {problem}",
        "Time in a session only moves forward, by a number of seconds.",
        "Give a number of 0 or more, such as 60 for one minute.",
    )


# Errors.


def session_is_live(call: str = "run") -> SessionError:
    """Return the error for what needs virtual time, while live."""
    return SessionError(
        "This session is live, so its time passes by itself.",
        f"`{call}` advances virtual time, but a live session runs on the wall clock.",
        "Use `ros.wait(seconds)`, or `ros.stop()` first.",
    )


def session_is_not_live() -> SessionError:
    """Return the error for `wait` in virtual time."""
    return SessionError(
        "This session is not live, so there is nothing to wait for.",
        "In virtual time, nothing happens until `ros.run` advances the clock.",
        "Use `ros.run(seconds)`, or `ros.start()` first.",
    )


def session_has_ended() -> ClosedSessionError:
    """Return the error for anything but reading, after `close`."""
    return ClosedSessionError(
        "This session is closed.",
        "Its nodes and its ROS context no longer exist, but its recordings can still be read.",
        "Open a new session: `ros = Session()`.",
    )


def node_has_ended(name: str) -> SessionError:
    """Return the error for `resume` of a node that raised."""
    return SessionError(
        f"{name} has ended and cannot be resumed.",
        "A callback of its process raised an exception, called rclpy.shutdown(), or was "
        "interrupted before it had returned.",
        "Add the node again: `ros.add(...)` creates a new node in its place.",
    )


def deadlock(waits: Sequence[Wait]) -> DeadlockError:
    """Return the error for callbacks that can never go on, by what they wait for."""
    told = [f"{w.call.node} waits in `{w.call.name}` for {w.reason}" for w in waits if w.call]
    means = (
        "No other callback is left to run in this session, so the wait never ends here. On a real "
        "robot, only another program could end it."
    )
    if waits[0].needs is not None:
        means = (
            "The executor that would have to process it is busy with this same callback: this is "
            "a deadlock, on a real robot too."
        )
        if len(waits) > 1:
            means = (
                "The executors that would have to process it are busy with these same callbacks: "
                "this is a deadlock, on a real robot too."
            )
    return DeadlockError(f"{'; '.join(told)}, forever.", means, INSTEAD_OF_WAITING)


def never_made(seconds: float) -> SessionError:
    """Return the error for a constructor that waits on and on while `ros.add` calls it."""
    return SessionError(
        f"The constructor is still waiting after {seconds:g} s of virtual time.",
        "`ros.add` returns the node, so it cannot return until the constructor does.",
        "First add the node that the constructor waits for, such as the one that offers the "
        "service. Use `ros.spawn` to start a program that waits for another one.",
    )


def foreign_node(node: Node, name: str | None = None) -> NodeClassError:
    """Return the error for a node of another context, or a destroyed one with a known name."""
    return NodeClassError(
        f"The node {name or node_name(node)} does not belong to this session.",
        "The node was created before the session was opened or in another session, or it has "
        "been destroyed. A node cannot move from one ROS context to another.",
        "Pass the node's class instead: `ros.add(TemperatureSensor)`.",
    )


def no_such_node(name: str, names: list[str]) -> SessionError:
    """Return the error for a name that no node of the session has."""
    return SessionError(
        f"This session has no node {name}.",
        f"Its nodes are: {', '.join(names) or 'none yet'}.",
        nearest(name, names, "Add the node first, with `ros.add(...)`."),
    )


def unknown_topic(name: str, known: set[str], graph: GraphSnapshot) -> UnknownTopicError:
    """Return the error for a topic without messages because it has no publisher."""
    outside = [end.node for end in graph.on(name, "publisher")]
    if outside and name not in INFRASTRUCTURE_TOPICS:  # there, own nodes publish as well
        return UnknownTopicError(
            f"No node of this session subscribes to {name}.",
            f"{', '.join(outside)} publishes on it, in another process. A session records "
            "messages from other processes only when one of its own nodes receives them.",
            "Add a node that subscribes to the topic, with `ros.add(...)`.",
        )
    listening = graph.on(name, "subscription")
    if any(end.matched > 0 for end in listening):
        return UnknownTopicError(
            f"Messages on {name} are not recorded.",
            "ROS itself publishes on it for each node. The messages are delivered, but a session "
            "records only what the nodes' own publishers send.",
            "Log or store the messages in the callback of a node that subscribes.",
        )
    listeners = ", ".join(end.node for end in listening)
    add = "Add the publishing node first, with `ros.add(...)`."
    # A near name that has listeners of its own is another topic, and no misspelling of this one.
    near = [one for one in sorted(known) if not (listening and graph.on(one, "subscription"))]
    to_try = nearest(name, near, add)
    if listening and to_try != add:
        to_try += f" If not, add the node that publishes on {name}."
    return UnknownTopicError(
        f"No messages were published on {name}.",
        f"{f'{listeners} subscribes to it, but no' if listeners else 'No'} node of this session "
        "has a publisher with that name. Published topics: "
        f"{', '.join(sorted(known)) or 'none yet'}.",
        to_try,
    )


def node_name(node: Node) -> str:
    """Return a node's full name; of a destroyed one, its class."""
    try:
        return str(node.get_fully_qualified_name())
    except InvalidHandle:
        return f"of class {type(node).__name__}"


def nearest(name: str, names: list[str], otherwise: str) -> str:
    """Suggest the most similar name, or something else if none is similar."""
    similar = get_close_matches(name, names, 1, 0.6)
    return f"Did you mean {similar[0]}?" if similar else otherwise


# What a session prints.


#: Log lines printed for one call of `run`; the rest is counted and stays in `logs()`.
MOST_LINES = 100

_NODE_ENDS = (
    "n uncaught exception in a callback ends its node, as it would end the node's process. The "
    "other nodes keep running."
)
_GOAL_ENDS = (
    "n uncaught exception in an execute callback aborts its goal, and the client gets an empty "
    "result. The node keeps running."
)
_MEANS = "\n  What it means: "


def seconds_text(time_ns: int) -> str:
    """Format nanoseconds as seconds, cut to three decimals."""
    whole, rest = divmod(time_ns, 1_000_000_000)
    return f"{whole}.{rest // 1_000_000:03d}"


def log_text(record: LogRecord) -> str:
    """Format a log line: level, time in seconds, logger, message."""
    return f"[{record.level}] [{seconds_text(record.time_ns)}] [{record.name}]: {record.text}"


class Advice(NamedTuple):
    """Say what an exception means, as far as it is known.

    Attributes:
        text: The exception's message, shortened.
        means: What the exception means here.
        to_try: What to do about it.
    """

    text: str
    means: str
    to_try: str


class Console:
    """Print what happens in a session: log lines as they come, and exceptions in three parts.

    A subclass speaks to other people (`rosbeat.page_session`) or in another way
    (`rosbeat.testing`).
    """

    #: What to do after a correction, at the end of a sentence: when a node has ended, and when it
    #: could not be created.
    add_again = "add the node again, with `ros.add(...)`."
    create_again = "run the program again."

    def __init__(self) -> None:
        self.begin()

    def begin(self, quiet: bool = False) -> None:
        """Count anew, for the next call of `run`; print no log lines if it is `quiet`."""
        self._quiet, self._printed, self._held_back = quiet, 0, 0

    def log(self, record: LogRecord) -> None:
        """Print one log line, unless the limit is reached."""
        if self._quiet:
            return
        if self._printed >= MOST_LINES:
            self._held_back += 1
            return
        self._printed += 1
        print(log_text(record))

    def end(self) -> None:
        """Say how many lines were not printed."""
        if self._held_back:
            print(f"... and {self._held_back} more lines; logs() has them all.")
            self._held_back = 0

    def explain(self, fault: Fault) -> Advice | None:
        """Return what an exception means; None if nothing is known beyond its own words."""
        return None

    def raised(self, fault: Fault, error: BaseException) -> None:
        """Take note of an exception that left a callback, or the work on a goal, as it happens."""

    def program_ended(self, program: SimulatedProgram) -> None:
        """Take note that a program has ended, as it happens."""

    def fault(self, fault: Fault) -> None:
        """Print an exception that ended a node."""
        print(self._fault_text(fault, "stopped", _NODE_ENDS), file=sys.stderr)

    def work_fault(self, fault: Fault) -> None:
        """Print an exception in the work on a goal."""
        print(self._fault_text(fault, "aborted a goal", _GOAL_ENDS), file=sys.stderr)

    def deadlock(self, fault: Fault, error: RosbeatError) -> None:
        """Print that a callback waits forever."""
        text = _three_parts(error.what, fault, error.means, error.to_try)
        print(text, file=sys.stderr)

    def _fault_text(self, fault: Fault, event: str, outcome: str) -> str:
        # An error of our own says what it means itself.
        known = None if _MEANS in fault.text else self.explain(fault)
        time = seconds_text(fault.time_ns)
        text = known.text if known else fault.text
        return _three_parts(
            f"{fault.node} {event} at {time} s, in {fault.callback}: {fault.kind}: {text}",
            fault,
            f"{known.means} A{outcome}" if known else f"a{outcome}",
            f"{known.to_try if known else 'correct that line,'} {'Then' if known else 'then'} "
            f"{self.add_again}",
        )

    def construction_error(
        self, name: str, fault: Fault, error: BaseException
    ) -> NodeConstructionError:
        """Return the error for a constructor that raised, in three parts."""
        known = self.explain(fault)
        if isinstance(error, RosbeatError):
            text, means, to_try = error.what, error.means, error.to_try
        elif known is not None:
            text, means = known.text, known.means
            to_try = f"{known.to_try} Then {self.create_again}"
        else:
            text = fault.text
            means = (
                "The constructor, `__init__`, raised before the node was ready, so there is no "
                "node."
            )
            again = f"line {fault.line}, then {self.create_again}" if fault.line else "`__init__`."
            to_try = f"Mend {again}"
        where = f"\n    line {fault.line}: {fault.code}" if fault.line else ""
        what = f"{name} could not be created: {fault.kind}: {text}{where}"
        return NodeConstructionError(what, means, to_try)


def _three_parts(what: str, fault: Fault, means: str, to_try: str) -> str:
    where = f"\n    line {fault.line}: {fault.code}" if fault.line else ""
    return f"{what}{where}{_MEANS}{means}\n  What to try:   {to_try}"


def note(text: str) -> None:
    """Say something that is not an error."""
    print(f"rosbeat: {text}")
