"""Take what has arrived straight from rclpy's handles.

To rebuild a wait set for it, as rclpy's executor does, takes 1 ms for six nodes. Each function
takes one thing from one entity and returns `(callback, arguments)`, or None if there was nothing.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from rclpy.callback_groups import MutuallyExclusiveCallbackGroup, ReentrantCallbackGroup
from rclpy.subscription import Subscription
from rclpy.task import Future

from rosbeat.ros.exception_origin import asking

if TYPE_CHECKING:
    from rosbeat.ros.engine import VirtualTime
    from rosbeat.ros.processes import Entry

Work = tuple[Callable[..., Any], tuple[Any, ...]]

_MESSAGE_ONLY = Subscription.CallbackType.MessageOnly
#: The groups whose rules are known: with one thread, each callback may run when no other does.
_KNOWN_GROUPS = (MutuallyExclusiveCallbackGroup, ReentrantCallbackGroup)


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


def take_request(entry: Entry, _: object) -> Work | None:
    """Take one request from a service's server."""
    service = entry.entity
    with service.handle:
        request, header = service.handle.service_take_request(service.srv_type.Request)
    if header is None:
        return None
    return _serve, (entry, request, header)


def _serve(entry: Entry, request: Any, header: Any) -> None:  # noqa: ANN401 - generated, filled in C
    service = entry.entity
    response = service.callback(request, service.srv_type.Response())
    with asking("send_response", response):
        service.send_response(response, header)


def take_answer(entry: Entry, _: VirtualTime) -> Work | None:
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
    # So that its done callbacks become tasks, as rclpy does it.
    future._set_executor(entry.state.process.executor)
    return future.set_result, (response,)


TAKERS: dict[str, Callable[[Entry, Any], Work | None]] = {
    "subscription": take_message,
    "service": take_request,
    "client": take_answer,
}


def has_known_group(entity: Any) -> bool:  # noqa: ANN401 - rclpy's entities share no base class
    """Return whether an entity's callback group is one of rclpy's own, and not a program's."""
    return type(entity.callback_group) in _KNOWN_GROUPS
