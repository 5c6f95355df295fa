"""Describe nodes and entities, and take from an entity what has arrived."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from inspect import iscoroutinefunction
from typing import TYPE_CHECKING, Any, Protocol

from rclpy.node import Node
from rclpy.subscription import Subscription
from rclpy.task import Future

from rosbeat.records import NANOSECONDS
from rosbeat.ros.faults import asking

if TYPE_CHECKING:
    from rosbeat.ros.processes import Process
    from rosbeat.ros.recording import CallbackLabel


def full_name(name: str, namespace: str) -> str:
    """Return a node's full name, such as `/room/sensor`."""
    return f"/{namespace.strip('/')}/{name}".replace("//", "/")


def callback_name(callback: Any) -> str:  # noqa: ANN401 - a callback may be any callable
    """Return the name a learner gave to a function, also when it is a lambda or an object."""
    if callback is None:
        return "nothing"  # a timer whose callback was left out, or that of a rate
    return getattr(callback, "__name__", type(callback).__name__)


def period_text(period_ns: int) -> str:
    """Return a timer's period as a person writes it, such as `0.5 s`."""
    return f"{period_ns / NANOSECONDS:g} s"


@dataclass(eq=False)
class NodeState:
    """One node of a session.

    Attributes:
        number: Order of creation.
        name: Full name.
        node: The node, once its constructor has got far enough.
        process: The simulated process in which it runs.
        spinning: Whether its callbacks are run: it was added, has no fault and is not paused.
        born_ns: When it was made, in nanoseconds since the session began.
        open: Whether its callbacks can run at once: it spins, and nothing in its process waits.
        paused: It rests because the session was told to pause it.
        ended: It raised in a callback or asked for shutdown, and does not come back.
        logger: The logger handed to its code, made at the first call of `get_logger`.
        entries: Its timers, subscriptions, servers and clients, in order of creation.
        taps: What listens to its publishers, in order of creation.
        actions: Its action servers and clients, in order of creation; see `actions`.
    """

    number: int
    name: str
    node: Node | None
    process: Process
    spinning: bool = False
    born_ns: int = 0
    open: bool = False
    paused: bool = False
    ended: bool = False
    logger: Any = None
    entries: list[Entry] = field(default_factory=list)
    taps: list[Any] = field(default_factory=list)
    actions: list[Any] = field(default_factory=list)


class Entry:
    """One timer, subscription, server or client, and what the executor needs of it.

    Attributes:
        number: Order of creation over the whole session.
        state: The node it belongs to.
        kind: `timer`, `wall timer` (on another clock than the session's: it fires in live mode
            only), `subscription`, `service`, `client` or `event`.
        entity: rclpy's object.
        handle: Its handle, which is a property of it and so takes a call to get; None for an event.
        name: Full topic or service name; empty for a timer.
        label: What its runs are recorded as.
        label_number: The label's number.
        take: Takes one thing that has arrived; a timer has none. See `TAKERS`.
        calls: How often its callback has run.
        born: Of a subscription: how many messages had been recorded when it was made.
        deadline: Where the agenda keeps a timer, in nanoseconds; None if it waits elsewhere.
    """

    __slots__ = (
        "born", "calls", "deadline", "entity", "handle", "kind", "label",
        "label_number", "name", "number", "state", "take",
    )  # fmt: skip

    def __init__(
        self,
        number: int,
        state: NodeState,
        kind: str,
        entity: Any,  # noqa: ANN401 - rclpy's entities share no base class
        name: str,
        label: CallbackLabel,
        take: Callable[..., Any] | None = None,
    ) -> None:
        self.number, self.state, self.kind = number, state, kind
        self.entity, self.name, self.label = entity, name, label
        self.label_number = label.number
        self.handle: Any = getattr(entity, "handle", None)
        self.take = take
        self.calls = 0
        self.born = 0
        self.deadline: int | None = None


# Taking what has arrived, straight from rclpy's handles, without a wait set.
#
# Each function takes one thing from one entity and answers `(callback, arguments)`, or None if
# there was nothing. rclpy's own executor does the same after it has rebuilt its wait set, which is
# the part that costs time (measured: 1 ms for six nodes).


Work = tuple[Callable[..., Any], tuple[Any, ...]]

_MESSAGE_ONLY = Subscription.CallbackType.MessageOnly


class Sender(Protocol):
    """Learns that something was sent, so that whoever waits for it can take it."""

    def happened(self, kind: str, name: str, origin: NodeState) -> None:
        """Note that a node sent something to the `kind` entities called `name`."""


def take_message(entry: Entry, _: Sender) -> Work | None:
    """Take one message from a subscription."""
    # Not by `next_message` and `work_for`: two more calls would slow every message down.
    subscription, handle = entry.entity, entry.handle
    with handle:
        taken = handle.take_message(subscription.msg_type, subscription.raw)
    if taken is None:
        return None
    arguments = taken[:1] if subscription._callback_type is _MESSAGE_ONLY else taken
    return subscription.callback, arguments


def next_message(entry: Entry) -> Any:  # noqa: ANN401 - a message with its info, or None
    """Take one message, and return it with its info, or None."""
    subscription, handle = entry.entity, entry.handle
    with handle:
        return handle.take_message(subscription.msg_type, subscription.raw)


def work_for(entry: Entry, taken: tuple[Any, ...]) -> Work:
    """Return the callback of a subscription, and its arguments for a message and its info."""
    subscription = entry.entity
    only = subscription._callback_type is _MESSAGE_ONLY
    return subscription.callback, taken[:1] if only else taken


def take_request(entry: Entry, sender: Sender) -> Work | None:
    """Take one request from a service's server."""
    service = entry.entity
    with service.handle:
        request, header = service.handle.service_take_request(service.srv_type.Request)
    if header is None:
        return None
    serve = _serve_later if iscoroutinefunction(service.callback) else _serve
    return serve, (entry, request, header, sender)


def _serve(entry: Entry, request: Any, header: Any, sender: Sender) -> None:  # noqa: ANN401
    response = entry.entity.callback(request, entry.entity.srv_type.Response())
    _answer(entry, response, header, sender)


async def _serve_later(entry: Entry, request: Any, header: Any, sender: Sender) -> None:  # noqa: ANN401
    response = await entry.entity.callback(request, entry.entity.srv_type.Response())
    _answer(entry, response, header, sender)


def _answer(entry: Entry, response: Any, header: Any, sender: Sender) -> None:  # noqa: ANN401
    with asking("send_response", response):
        entry.entity.send_response(response, header)
    sender.happened("client", entry.name, entry.state)


def take_answer(entry: Entry, executor: Sender) -> Work | None:
    """Take one response to a client's request."""
    client = entry.entity
    with client.handle:
        header, response = client.handle.take_response(client.srv_type.Response)
    if header is None:
        return None
    try:
        future: Future = client.get_pending_request(header.request_id.sequence_number)
    except KeyError:
        return None  # the request was withdrawn
    future._set_executor(executor)  # so that its done callbacks become tasks, as rclpy does it
    return future.set_result, (response,)


TAKERS: dict[str, Callable[[Entry, Any], Work | None]] = {
    "subscription": take_message,
    "service": take_request,
    "client": take_answer,
}
