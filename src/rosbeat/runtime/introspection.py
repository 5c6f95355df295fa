"""The graph of a session's nodes."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Any

from rclpy.exceptions import InvalidHandle
from rclpy.qos import QoSProfile

from rosbeat.records import Endpoint, GraphSnapshot, QoS, TimerRecord
from rosbeat.runtime.entities import Entry, NodeState
from rosbeat.runtime.messages import type_name
from rosbeat.runtime.stretching import limit_ns


def qos_of(profile: QoSProfile) -> QoS:
    """A QoS profile as plain data."""
    return QoS(
        profile.reliability.name,
        profile.durability.name,
        profile.history.name,
        profile.depth,
        limit_ns(profile.deadline),
        limit_ns(profile.lifespan),
    )


def snapshot(states: Iterable[NodeState]) -> GraphSnapshot:
    """The graph of these nodes as it is now, destroyed entities left out."""
    alive = [state for state in states if state.node is not None]
    endpoints = (end for state in alive for end in _endpoints(state))
    timers = (timer for state in alive for timer in _timers(state))
    return GraphSnapshot(tuple(state.name for state in alive), tuple(endpoints), tuple(timers))


def _endpoints(state: NodeState) -> Iterator[Endpoint]:
    node = state.node
    assert node is not None
    for publisher in filter(_is_alive, node.publishers):
        yield _publisher(state, publisher)
    for subscription in filter(_is_alive, node.subscriptions):
        yield _subscription(state, subscription)
    for service in node.services:
        yield _service(state, service, "server")
    for client in node.clients:
        yield _service(state, client, "client")
    for action in state.actions:
        if action.exists:
            yield from action.endpoints()


def _is_alive(entity: Any) -> bool:  # noqa: ANN401
    try:
        with entity.handle:
            return True
    except InvalidHandle:
        return False  # destroyed by itself, not by its node


def _publisher(state: NodeState, publisher: Any) -> Endpoint:  # noqa: ANN401
    return Endpoint(
        state.name,
        publisher.topic_name,
        type_name(publisher.msg_type),
        "publisher",
        qos_of(publisher.qos_profile),
        publisher.get_subscription_count(),
    )


def _subscription(state: NodeState, subscription: Any) -> Endpoint:  # noqa: ANN401
    return Endpoint(
        state.name,
        subscription.topic_name,
        type_name(subscription.msg_type),
        "subscription",
        qos_of(subscription.qos_profile),
        subscription.get_publisher_count(),
    )


def _service(state: NodeState, entity: Any, kind: str) -> Endpoint:  # noqa: ANN401
    name = type_name(entity.srv_type)
    return Endpoint(state.name, entity.service_name, name, kind, qos_of(entity.qos_profile))


def _timers(state: NodeState) -> Iterator[TimerRecord]:
    for entry in state.entries:
        if entry.kind.endswith("timer") and (period := _period(entry)) is not None:
            yield TimerRecord(state.name, entry.label.name, period, entry.calls)


def _period(entry: Entry) -> int | None:
    try:
        period: int = entry.entity.timer_period_ns
    except InvalidHandle:
        return None  # destroyed
    return period
