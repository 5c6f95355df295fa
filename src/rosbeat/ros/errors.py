"""Errors that a session raises, and checks of what a caller typed."""

from __future__ import annotations

from collections.abc import Sequence
from difflib import get_close_matches
from math import inf, isfinite
from numbers import Real
from typing import TYPE_CHECKING, Any

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

# What a session says when it is asked for something it cannot do.


#: The last instant of ROS time, in nanoseconds: it is a signed 64-bit number.
END_OF_TIME = 2**63 - 1


def check_whole(
    name: str,
    value: Any,  # noqa: ANN401 - unchecked
    low: int,
    high: int,
    example: str = "",
) -> None:
    """Refuse anything but a whole number from `low` to `high`.

    Raises:
        SessionError: If it is something else.
    """
    if isinstance(value, int) and not isinstance(value, bool) and low <= value <= high:
        return
    raise SessionError(
        f"{name}={value!r} cannot be used.",
        f"It must be a whole number from {low} to {high if high < 2**63 else 'about 9e18'}.",
        f"Write for example {example or f'Session({name}=7)'}.",
    )


def check_name(call: str, value: Any) -> str:  # noqa: ANN401 - unchecked
    """Refuse anything but a text.

    Raises:
        SessionError: If it is something else.
    """
    if isinstance(value, str):
        return value
    raise SessionError(
        f"{call}(...) was given {value!r}, which is of type {type(value).__name__}.",
        "It is asked by name, and a name is a text.",
        f'Put it in quotation marks: `ros.{call}("temperature")`.',
    )


def check_end(time_ns: int) -> int:
    """Refuse a time, in nanoseconds, that ROS cannot express.

    Raises:
        DurationError: If it lies beyond the end of ROS time.
    """
    if time_ns <= END_OF_TIME:
        return time_ns
    raise DurationError(
        "The session would run beyond the end of time.",
        "ROS counts nanoseconds in 64 bits, which end after 292 years.",
        "Open a new session; it begins at zero again.",
    )


def session_is_live(call: str = "run") -> SessionError:
    """Return the error for what needs virtual time, while live."""
    return SessionError(
        "This session is live, so its time passes by itself.",
        f"`{call}` moves virtual time, which stands still while the wall clock counts.",
        "Use `ros.wait(seconds)`, or `ros.stop()` first.",
    )


def session_is_not_live() -> SessionError:
    """`wait` in virtual time."""
    return SessionError(
        "This session is not live, so there is nothing to wait for.",
        "In virtual time nothing happens by itself.",
        "Use `ros.run(seconds)`, or `ros.start()` first.",
    )


def session_has_ended() -> ClosedSessionError:
    """Anything but reading, after `close`."""
    return ClosedSessionError(
        "This session has ended.",
        "Its nodes and its ROS context are gone; what it recorded can still be read.",
        "Open a new one: `ros = Session()`.",
    )


def called_in_callback(call: str) -> SessionError:
    """Return the error for what runs the simulation, called by a node."""
    return SessionError(
        f"`{call}` was called from inside a callback.",
        "It waits for other callbacks, and they can only run when this one has returned: "
        "a deadlock, on a real robot too.",
        _INSTEAD_OF_WAITING,
    )


_INSTEAD_OF_WAITING = (
    "For a service use `call_async` and add a done callback, or make the callback `async def` and "
    "await the future, with the client in a callback group of its own. To do something again and "
    "again, create a timer."
)


def deadlock(waits: Sequence[Wait]) -> DeadlockError:
    """Return the error for callbacks that can never go on.

    Args:
        waits: What they wait for; the first is that of the callback that is told.
    """
    told = [f"{w.call.node} waits in `{w.call.name}` for {w.reason}" for w in waits if w.call]
    own = waits[0].needs is not None and len(waits) == 1
    why = (
        "Its own executor would have to take that, and it is busy with this very callback"
        if own
        else "Nothing else is left to do, so nobody will end that"
    )
    return DeadlockError(
        f"{'; '.join(told)}: for ever.",
        f"{why}: a deadlock, on a real robot too.",
        _INSTEAD_OF_WAITING,
    )


def never_made(seconds: float) -> SessionError:
    """Return the error for a constructor that waits on and on while a cell calls it."""
    return SessionError(
        f"The constructor still waits after {seconds:g} s of virtual time.",
        "`ros.add` returns the node, so it cannot return before there is one.",
        "Add first what it waits for, such as the node that offers the service. A program that "
        "waits for another one can be started with `ros.spawn`.",
    )


def asks_before_it_runs(node: str, service: str) -> SessionError:
    """Return the error for `client.call` of a node that is not spun."""
    return SessionError(
        f"{node} asks {service} before it runs itself.",
        "Nobody takes the answer of a node that is still being made, was not added, or is "
        "paused. Outside a page the call would wait for ever.",
        "Add the node first, with `ros.add(...)`, and ask then, or in a timer's callback "
        "with `call_async`.",
    )


def unanswered_call(service: str) -> SessionError:
    """Return the error for a service call of a cell that nobody answers."""
    return SessionError(
        f"Nobody has answered the call to {service}.",
        "Either no node of this session offers that service, or its callback does not end. "
        "Outside a page the call would wait for ever.",
        "Add the node that offers the service first, and compare the two names.",
    )


def asleep_while_going_live(node: str, callback: str) -> SessionError:
    """Return the error for `start` while a callback waits in virtual time."""
    return SessionError(
        f"The session cannot go live: `{callback}` of {node} still waits.",
        "It began in virtual time, and what it waits for comes in virtual time.",
        "Let it return first, with `ros.run(seconds)`, or remove the node.",
    )


def node_has_ended(name: str) -> SessionError:
    """`resume` of a node that raised."""
    return SessionError(
        f"{name} has ended and cannot go on.",
        "An exception left one of its callbacks, or it called rclpy.shutdown().",
        "Add it again: `ros.add(...)` makes a new node in its place.",
    )


def is_made_already(node: Node) -> SessionError:
    """`add` of a node with a new name or remappings."""
    return SessionError(
        f"The node {_name(node)} is made already and cannot be started in another way.",
        "Its name, topics and parameters are settled while it is made.",
        "Hand over its class, without brackets: the session then makes the node.",
    )


def nothing_to_add() -> SessionError:
    """Return the error for `add` without a node."""
    return SessionError(
        "`ros.add()` was given no node.",
        "It starts a process, and a process without a node does nothing.",
        "Hand over a class, without brackets: `ros.add(TemperatureSensor)`.",
    )


def one_name_for_several(name: str) -> SessionError:
    """Return the error for `add` of several nodes with one name."""
    return SessionError(
        f"Several nodes cannot all be called {name!r}.",
        "`name` renames every node that is started, as `__node` does on a command line.",
        "Add them without `name`, or each by itself.",
    )


def foreign_node(node: Node, name: str | None = None) -> NodeClassError:
    """A node of another context, or a destroyed one whose name is remembered."""
    return NodeClassError(
        f"The node {name or _name(node)} does not belong to this session.",
        "It was made before the session was opened, in another session, or it has been "
        "destroyed; a node cannot move from one ROS context to another.",
        "Hand over its class instead: `ros.add(TemperatureSensor)`.",
    )


def no_such_node(name: str, names: list[str]) -> SessionError:
    """A name that no node of the session has."""
    return SessionError(
        f"This session has no node {name}.",
        f"Its nodes are: {', '.join(names) or 'none yet'}.",
        _nearest(name, names, "Add it first with `ros.add(...)`."),
    )


def nodes_did_not_come(
    missing: list[str], seen: tuple[str, ...], seconds: float, domain_id: int
) -> SessionError:
    """`wait_for_nodes`, in vain."""
    verb = "is" if len(missing) == 1 else "are"
    return SessionError(
        f"{', '.join(missing)} {verb} not there after {seconds:g} s.",
        f"In domain {domain_id} the session sees: {', '.join(seen) or 'no node at all'}.",
        _nearest(
            missing[0],
            [name for name in seen if name not in missing],
            "Start it in a terminal, and look whether it goes on running. Both sides need the same "
            "ROS_DOMAIN_ID.",
        ),
    )


def nobody_else_here() -> SessionError:
    """`wait_for_nodes` in a private domain."""
    return SessionError(
        "This session does not see nodes of other processes.",
        "It has a domain to itself, and the nodes of a terminal are in another one.",
        'Join theirs: `Session(domain_id=int(os.environ["ROS_DOMAIN_ID"]))`.',
    )


def unknown_topic(name: str, known: set[str], graph: GraphSnapshot) -> UnknownTopicError:
    """A topic without messages because it has no publisher."""
    outside = [end.node for end in graph.on(name, "publisher")]
    if outside and name not in INFRASTRUCTURE_TOPICS:  # there, own nodes publish as well
        return UnknownTopicError(
            f"No node of this session listens on {name}.",
            f"{', '.join(outside)} publishes there, in another process; what comes from others is "
            "recorded when a node of the session gets it.",
            "Add a node that subscribes there, with `ros.add(...)`.",
        )
    listening = [end.node for end in graph.on(name, "subscription")]
    means = f"{', '.join(listening)} listens there, but no node" if listening else "No node"
    topics = sorted(known) or ["none yet"]
    if any(end.matched > 0 for end in graph.on(name, "subscription")):
        return UnknownTopicError(
            f"No node of this session has published on {name}.",
            "Another process publishes there. What it sends is not recorded, only delivered.",
            "Log or keep the messages in the callback of a node that subscribes.",
        )
    return UnknownTopicError(
        f"Nobody has published on {name}.",
        f"{means} of this session has a publisher of that name. Published topics: "
        f"{', '.join(topics)}.",
        _nearest(name, sorted(known), "Add the publishing node first, with `ros.add(...)`."),
    )


def _name(node: Node) -> str:
    try:
        return str(node.get_fully_qualified_name())
    except InvalidHandle:
        return f"of class {type(node).__name__}"


def _nearest(name: str, names: list[str], otherwise: str) -> str:
    near = get_close_matches(name, names, 1, 0.6)
    return f"Did you mean {near[0]}?" if near else otherwise


# Time spans that a person typed.


#: About 31 years; a longer span is a slip, and ROS time ends at 2**63 nanoseconds.
LONGEST = 1e9


def duration_ns(seconds: Any, what: str = "run(seconds=...)") -> int:  # noqa: ANN401 - unchecked
    """Seconds as whole nanoseconds.

    Args:
        seconds: A number from 0 to 1e9, in seconds.
        what: The call it was given to, for the error.

    Raises:
        DurationError: If it is not a number, negative, not finite or above 1e9.
    """
    if not isinstance(seconds, Real) or isinstance(seconds, bool):
        kind = type(seconds).__name__
        raise _refusal(f"{what} was given {seconds!r}, which is of type {kind}.")
    try:
        span = float(seconds)
    except OverflowError:
        span = inf
    if not isfinite(span):
        raise _refusal(f"{what} was given {span}.")
    if span < 0:
        raise _refusal(f"{what} was given {span:g}: a negative time.")
    if span > LONGEST:
        raise _refusal(f"{what} was given {span:g}: more than {LONGEST:g} seconds.")
    return round(span * NANOSECONDS)


def _refusal(what: str) -> DurationError:
    return DurationError(
        what,
        "Time in a session only moves forward, by a number of seconds.",
        "Give a number from 0 up, such as 60 for one minute.",
    )
