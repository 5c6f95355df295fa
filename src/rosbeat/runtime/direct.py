"""Taking what has arrived, straight from rclpy's handles, without a wait set.

Each function takes one thing from one entity and answers `(callback, arguments)`, or None if there
was nothing. rclpy's own executor does the same after it has rebuilt its wait set, which is the
part that costs time (measured: 1 ms for six nodes).
"""

from __future__ import annotations

from collections.abc import Callable
from inspect import iscoroutinefunction
from typing import Any, Protocol

from rclpy.subscription import Subscription
from rclpy.task import Future

from rosbeat.runtime.asking import asking
from rosbeat.runtime.entities import Entry

Work = tuple[Callable[..., Any], tuple[Any, ...]]

_MESSAGE_ONLY = Subscription.CallbackType.MessageOnly


class Sender(Protocol):
    """What is told that something was sent, so that whoever waits for it can take it."""

    def happened(self, kind: str, name: str) -> None:
        """Something was sent to the `kind` entities called `name`."""


def take_message(entry: Entry, _: Sender) -> Work | None:
    """One message from a subscription."""
    subscription, handle = entry.entity, entry.handle
    with handle:
        taken = handle.take_message(subscription.msg_type, subscription.raw)
    if taken is None:
        return None
    arguments = taken[:1] if subscription._callback_type is _MESSAGE_ONLY else taken
    return subscription.callback, arguments


def next_message(entry: Entry) -> Any:  # noqa: ANN401 - a message with its info, or None
    """The same without the callback: the message, and what is known of it."""
    subscription, handle = entry.entity, entry.handle
    with handle:
        return handle.take_message(subscription.msg_type, subscription.raw)


def work_for(entry: Entry, taken: tuple[Any, ...]) -> Work:
    """The callback of a subscription, and what it is given of a message and its info."""
    subscription = entry.entity
    only = subscription._callback_type is _MESSAGE_ONLY
    return subscription.callback, taken[:1] if only else taken


def take_request(entry: Entry, sender: Sender) -> Work | None:
    """One request from a service's server."""
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
    sender.happened("client", entry.name)


def take_answer(entry: Entry, executor: Sender) -> Work | None:
    """One answer to a client's request."""
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
