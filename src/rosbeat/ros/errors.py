"""Define errors that several session calls raise, and checks of a caller's arguments."""

from __future__ import annotations

from collections.abc import Sequence
from difflib import get_close_matches
from math import inf, isfinite
from numbers import Real
from typing import TYPE_CHECKING

from rclpy.exceptions import InvalidHandle
from rclpy.node import Node

from rosbeat.errors import (
    ClosedSessionError,
    DeadlockError,
    DurationError,
    NodeClassError,
    SessionError,
    UnknownTopicError,
)
from rosbeat.records import INFRASTRUCTURE_TOPICS, NANOSECONDS, GraphSnapshot

if TYPE_CHECKING:
    from rosbeat.ros.processes import Wait

#: What to write in the place of a call that waits in a callback.
INSTEAD_OF_WAITING = (
    "For a service use `call_async` and add a done callback, or make the callback `async def` and "
    "await the future, with the client in a callback group of its own. To do something again and "
    "again, create a timer."
)
#: About 31 years; a longer span is a slip, and ROS time ends at 2**63 nanoseconds.
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
        f"Write for example {example or f'Session({name}=7)'}.",
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
        "It is asked by name, and a name is a text.",
        f'Put it in quotation marks: `ros.{call}("temperature")`.',
    )


def check_end(time_ns: int) -> int:
    """Return a time in nanoseconds that fits into a signed 64-bit number, as ROS requires.

    Raises:
        DurationError: If it does not fit.
    """
    if time_ns < 2**63:
        return time_ns
    raise DurationError(
        "The session would run beyond the end of time.",
        "ROS counts nanoseconds in 64 bits, which end after 292 years.",
        "Open a new session; it begins at zero again.",
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
            problem = f"{span:g}: a negative time."
        else:
            problem = f"{span:g}: more than {_LONGEST:g} seconds."
    raise DurationError(
        f"{what} was given {problem}",
        "Time in a session only moves forward, by a number of seconds.",
        "Give a number from 0 up, such as 60 for one minute.",
    )


# Errors.


def session_is_live(call: str = "run") -> SessionError:
    """Return the error for what needs virtual time, while live."""
    return SessionError(
        "This session is live, so its time passes by itself.",
        f"`{call}` moves virtual time, which stands still while the wall clock counts.",
        "Use `ros.wait(seconds)`, or `ros.stop()` first.",
    )


def session_is_not_live() -> SessionError:
    """Return the error for `wait` in virtual time."""
    return SessionError(
        "This session is not live, so there is nothing to wait for.",
        "In virtual time nothing happens by itself.",
        "Use `ros.run(seconds)`, or `ros.start()` first.",
    )


def session_has_ended() -> ClosedSessionError:
    """Return the error for anything but reading, after `close`."""
    return ClosedSessionError(
        "This session has ended.",
        "Its nodes and its ROS context are gone; what it recorded can still be read.",
        "Open a new one: `ros = Session()`.",
    )


def node_has_ended(name: str) -> SessionError:
    """Return the error for `resume` of a node that raised."""
    return SessionError(
        f"{name} has ended and cannot go on.",
        "An exception left one of its callbacks, or it called rclpy.shutdown().",
        "Add it again: `ros.add(...)` makes a new node in its place.",
    )


def deadlock(waits: Sequence[Wait]) -> DeadlockError:
    """Return the error for callbacks that can never go on, by what they wait for."""
    told = [f"{w.call.node} waits in `{w.call.name}` for {w.reason}" for w in waits if w.call]
    why = "Nothing else is left to do, so nobody will end that"
    if waits[0].needs is not None and len(waits) == 1:
        why = "Its own executor would have to take that, and it is busy with this very callback"
    return DeadlockError(
        f"{'; '.join(told)}: for ever.",
        f"{why}: a deadlock, on a real robot too.",
        INSTEAD_OF_WAITING,
    )


def never_made(seconds: float) -> SessionError:
    """Return the error for a constructor that waits on and on while a cell calls it."""
    return SessionError(
        f"The constructor still waits after {seconds:g} s of virtual time.",
        "`ros.add` returns the node, so it cannot return before there is one.",
        "Add first what it waits for, such as the node that offers the service. A program that "
        "waits for another one can be started with `ros.spawn`.",
    )


def foreign_node(node: Node, name: str | None = None) -> NodeClassError:
    """Return the error for a node of another context, or a destroyed one with a known name."""
    return NodeClassError(
        f"The node {name or node_name(node)} does not belong to this session.",
        "It was made before the session was opened, in another session, or it has been "
        "destroyed; a node cannot move from one ROS context to another.",
        "Hand over its class instead: `ros.add(TemperatureSensor)`.",
    )


def no_such_node(name: str, names: list[str]) -> SessionError:
    """Return the error for a name that no node of the session has."""
    return SessionError(
        f"This session has no node {name}.",
        f"Its nodes are: {', '.join(names) or 'none yet'}.",
        nearest(name, names, "Add it first with `ros.add(...)`."),
    )


def unknown_topic(name: str, known: set[str], graph: GraphSnapshot) -> UnknownTopicError:
    """Return the error for a topic without messages because it has no publisher."""
    outside = [end.node for end in graph.on(name, "publisher")]
    if outside and name not in INFRASTRUCTURE_TOPICS:  # there, own nodes publish as well
        return UnknownTopicError(
            f"No node of this session listens on {name}.",
            f"{', '.join(outside)} publishes there, in another process; what comes from others is "
            "recorded when a node of the session gets it.",
            "Add a node that subscribes there, with `ros.add(...)`.",
        )
    listening = graph.on(name, "subscription")
    if any(end.matched > 0 for end in listening):
        return UnknownTopicError(
            f"No node of this session has published on {name}.",
            "Another process publishes there. What it sends is not recorded, only delivered.",
            "Log or keep the messages in the callback of a node that subscribes.",
        )
    listeners = ", ".join(end.node for end in listening)
    add = "Add the publishing node first, with `ros.add(...)`."
    # A near name that has listeners of its own is another topic, and no misspelling of this one.
    near = [one for one in sorted(known) if not (listening and graph.on(one, "subscription"))]
    to_try = nearest(name, near, add)
    if listening and to_try != add:
        to_try += f" If not, add the node that publishes on {name}."
    return UnknownTopicError(
        f"Nobody has published on {name}.",
        f"{f'{listeners} listens there, but no' if listeners else 'No'} node of this session has "
        f"a publisher of that name. Published topics: {', '.join(sorted(known)) or 'none yet'}.",
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
