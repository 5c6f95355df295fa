"""What the middleware tells a node of: events of its publishers and subscriptions."""

from __future__ import annotations

from rclpy.event_handler import EventHandler
from rclpy.node import Node

#: The end of rcl's name of an event, and the event's name as the learner writes it, as in
#: `SubscriptionEventCallbacks(deadline=...)`.
_NAMES = {
    "DEADLINE_MISSED": "deadline",
    "LIVELINESS_LOST": "liveliness",
    "LIVELINESS_CHANGED": "liveliness",
    "INCOMPATIBLE_QOS": "incompatible_qos",
    "INCOMPATIBLE_TYPE": "incompatible_type",
    "MESSAGE_LOST": "message_lost",
    "MATCHED": "matched",
}


def event_name(handler: EventHandler) -> str:
    """Which event a handler answers, such as `deadline`."""
    said: str = handler.event_type.name
    return next((name for end, name in _NAMES.items() if said.endswith(end)), said.lower())


def event_source(handler: EventHandler, topic: str) -> str:
    """What a run of the handler's callback is recorded to have answered."""
    return f"{event_name(handler)} of {topic}"


def topic_of(handler: EventHandler, node: Node) -> str:
    """The full name of the topic that an event of a node is about."""
    for end in (*node.publishers, *node.subscriptions):
        if handler in end.event_handlers:
            return str(end.topic_name)
    return "?"  # its endpoint has just been destroyed
