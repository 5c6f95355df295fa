"""Describe nodes and entities, and take messages, requests and responses from their handles."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from inspect import iscoroutinefunction
from typing import TYPE_CHECKING, Any

from rclpy.node import Node
from rclpy.subscription import Subscription
from rclpy.task import Future

from rosbeat.ros.faults import asking

if TYPE_CHECKING:
    from rosbeat.ros.processes import Process
    from rosbeat.ros.recording import CallbackLabel, Message, PublisherTap
    from rosbeat.ros.virtual_time import VirtualTimeExecutor


def full_name(name: str, namespace: str) -> str:
    """Return a node's full name, such as `/room/sensor`."""
    return f"/{namespace.strip('/')}/{name}".replace("//", "/")


def callback_name(callback: Any) -> str:  # noqa: ANN401 - a callback may be any callable
    """Return the name a learner gave to a function, also when it is a lambda or an object."""
    if callback is None:
        return "nothing"  # a timer whose callback was left out, or that of a rate
    return getattr(callback, "__name__", type(callback).__name__)


@dataclass(eq=False)
class NodeState:
    """Hold the state of one node of a session.

    Attributes:
        number: Order of creation.
        name: Full name.
        spinning: Whether its callbacks run: it was added, has no fault and is not paused.
        born_ns: When it was created, in nanoseconds since the session began.
        open: Whether its callbacks can run at once: it spins, and nothing in its process waits.
        paused: Whether the session was told to pause it.
        ended: Whether it raised in a callback or requested a shutdown; this is permanent.
        logger: The logger for its code, created at the first call of `get_logger`.
        entries: Its timers, subscriptions, servers and clients, in order of creation.
        taps: The taps on its publishers, in order of creation.
        actions: Its action servers and clients, in order of creation; see `actions`.
    """

    number: int
    name: str
    node: Node
    process: Process
    spinning: bool = False
    born_ns: int = 0
    open: bool = False
    paused: bool = False
    ended: bool = False
    logger: Any = None
    entries: list[Entry] = field(default_factory=list)
    taps: list[PublisherTap] = field(default_factory=list)
    actions: list[Any] = field(default_factory=list)


@dataclass(eq=False, slots=True)
class Entry:
    """Hold one timer, subscription, server or client, with the data that the executor needs.

    Attributes:
        number: Order of creation over the whole session.
        kind: `timer`, `wall timer` (on a clock other than the session's: it fires in live mode
            only), `subscription`, `service`, `client` or `event`.
        entity: The rclpy object; rclpy's entities share no base class.
        name: Full topic or service name; empty for a timer.
        label: The label under which its runs are recorded.
        take: Takes one item that has arrived; a timer has none. See `TAKERS`.
        handle: The entity's handle, cached because the property is slow; None for an event.
        calls: How often its callback has run.
        born: Of a subscription: how many messages had been recorded when it was created.
        deadline: Position of a timer in the agenda, in nanoseconds; None if the agenda has set it
            aside.
    """

    number: int
    state: NodeState
    kind: str
    entity: Any
    name: str
    label: CallbackLabel
    take: Callable[..., Any] | None = None
    label_number: int = field(init=False)
    handle: Any = field(init=False)
    calls: int = 0
    born: int = 0
    deadline: int | None = None

    def __post_init__(self) -> None:
        self.label_number = self.label.number
        self.handle = getattr(self.entity, "handle", None)


# Taking what has arrived, straight from rclpy's handles: to rebuild a wait set for it, as rclpy's
# executor does, takes 1 ms for six nodes. Each function takes one thing from one entity and returns
# `(callback, arguments)`, or None if there was nothing.


Work = tuple[Callable[..., Any], tuple[Any, ...]]

_MESSAGE_ONLY = Subscription.CallbackType.MessageOnly


def take_message(entry: Entry, _: object) -> Work | None:
    """Take one message from a subscription."""
    subscription, handle = entry.entity, entry.handle
    with handle:
        taken = handle.take_message(subscription.msg_type, subscription.raw)
    if taken is None:
        return None
    # Not by `message_work`: one more call would slow every message down.
    arguments = taken[:1] if subscription._callback_type is _MESSAGE_ONLY else taken
    return subscription.callback, arguments


def message_work(entry: Entry, taken: tuple[Any, ...]) -> Work:
    """Return the callback of a subscription, and its arguments for a message and its info."""
    subscription = entry.entity
    # rclpy looks once at what a callback takes, and keeps the answer in this attribute.
    only = subscription._callback_type is _MESSAGE_ONLY
    return subscription.callback, taken[:1] if only else taken


def take_request(entry: Entry, executor: VirtualTimeExecutor) -> Work | None:
    """Take one request from a service's server."""
    service = entry.entity
    with service.handle:
        request, header = service.handle.service_take_request(service.srv_type.Request)
    if header is None:
        return None
    serve = _serve_later if iscoroutinefunction(service.callback) else _serve
    return serve, (entry, request, header, executor)


async def _serve_later(entry: Entry, *asked: Any) -> None:  # noqa: ANN401 - see `_answer`
    response = await entry.entity.callback(asked[0], entry.entity.srv_type.Response())
    _answer(entry, response, *asked[1:])


def _serve(entry: Entry, *asked: Any) -> None:  # noqa: ANN401 - see `_answer`
    response = entry.entity.callback(asked[0], entry.entity.srv_type.Response())
    _answer(entry, response, *asked[1:])


def _answer(entry: Entry, response: Message, header: Any, executor: VirtualTimeExecutor) -> None:  # noqa: ANN401 - filled in C
    with asking("send_response", response):
        entry.entity.send_response(response, header)
    executor.happened("client", entry.name, entry.state)


def take_answer(entry: Entry, executor: VirtualTimeExecutor) -> Work | None:
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
