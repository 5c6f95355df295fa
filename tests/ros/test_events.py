"""Events of the middleware, by the names that a learner writes."""

import pytest
from rclpy.event_handler import PublisherEventCallbacks, SubscriptionEventCallbacks
from rclpy.node import Node
from rclpy.qos import QoSProfile, ReliabilityPolicy
from std_msgs.msg import Int32

from rosbeat.ros.qos_events import event_name, event_source, topic_of

pytestmark = pytest.mark.ros
OF_PUBLISHERS = ["deadline", "liveliness", "incompatible_qos", "incompatible_type", "matched"]
OF_SUBSCRIPTIONS = [*OF_PUBLISHERS, "message_lost"]


def test_each_event_has_the_name_of_its_argument(ros):
    node = ros.add(lambda: Node("node"))
    publisher = node.create_publisher(
        Int32, "count", 10,
        event_callbacks=PublisherEventCallbacks(**dict.fromkeys(OF_PUBLISHERS, print)),
    )  # fmt: skip
    subscription = node.create_subscription(
        Int32, "count", print, 10,
        event_callbacks=SubscriptionEventCallbacks(**dict.fromkeys(OF_SUBSCRIPTIONS, print)),
    )  # fmt: skip
    assert sorted(map(event_name, publisher.event_handlers)) == sorted(OF_PUBLISHERS)
    assert sorted(map(event_name, subscription.event_handlers)) == sorted(OF_SUBSCRIPTIONS)
    handler = subscription.event_handlers[0]
    assert topic_of(handler, node) == "/count"
    assert event_source(handler, "/count") == "deadline of /count"
    node.destroy_subscription(subscription)
    assert topic_of(handler, node) == "?"


def test_what_the_middleware_tells_at_once_is_recorded_as_an_event(ros):
    node = ros.add(lambda: Node("node"))
    told = []

    def on_misfit(info):
        told.append(info.total_count)

    node.create_subscription(
        Int32, "count", print, 10,
        event_callbacks=SubscriptionEventCallbacks(incompatible_qos=on_misfit),
    )  # fmt: skip
    weak = QoSProfile(depth=10, reliability=ReliabilityPolicy.BEST_EFFORT)
    silent = PublisherEventCallbacks(use_default_callbacks=False)
    node.create_publisher(Int32, "count", weak, event_callbacks=silent)
    ros.run(1)
    assert told == [1]
    (record,) = [one for one in ros.observation().callbacks if one.kind == "event"]
    assert (record.name, record.source) == ("on_misfit", "incompatible_qos of /count")
