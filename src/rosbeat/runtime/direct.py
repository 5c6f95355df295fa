"""Taking what has arrived, straight from rclpy's handles, without a wait set.

Each function takes one thing from one entity and answers `(callback, arguments)`, or None if there
was nothing. rclpy's own executor does the same after it has rebuilt its wait set, which is the
part that costs time (measured: 1 ms for six nodes).
"""

from __future__ import annotations

import time
from collections.abc import Callable
from inspect import iscoroutinefunction
from typing import Any, Protocol

from rclpy.subscription import Subscription
from rclpy.task import Future

from rosbeat.runtime.entities import Entry

Work = tuple[Callable[..., Any], tuple[Any, ...]]

_MESSAGE_ONLY = Subscription.CallbackType.MessageOnly
#: Seconds to wait for stored messages; they come within 0.1 s, in another thread of Fast DDS.
_STORED_DEADLINE = 2.0


class Sender(Protocol):
    """What is told that something was sent, so that whoever waits for it can take it."""

    def happened(self, kind: str, name: str) -> None:
        """Something was sent to the `kind` entities called `name`."""


def take_message(entry: Entry, _: Sender) -> Work | None:
    """One message from a subscription."""
    subscription = entry.entity
    if entry.owed:
        taken = _wait_for_stored(entry)
    else:
        handle = entry.handle
        with handle:
            taken = handle.take_message(subscription.msg_type, subscription.raw)
    if taken is None:
        return None
    arguments = taken[:1] if subscription._callback_type is _MESSAGE_ONLY else taken
    return subscription.callback, arguments


def _take_now(subscription: Subscription) -> Any:  # noqa: ANN401
    with subscription.handle:
        return subscription.handle.take_message(subscription.msg_type, subscription.raw)


def _wait_for_stored(entry: Entry) -> Any:  # noqa: ANN401
    # A transient-local publisher sends its stored messages to a late joiner from a thread of its
    # own: 1 time in 20 they are not there yet when the subscription is. How many come is known.
    deadline = time.monotonic() + _STORED_DEADLINE
    while (taken := _take_now(entry.entity)) is None and time.monotonic() < deadline:
        time.sleep(0.0005)
    entry.owed = entry.owed - 1 if taken is not None else 0
    return taken


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
