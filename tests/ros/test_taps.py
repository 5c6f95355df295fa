"""What a tap knows of stored messages, compared with what Fast DDS hands to a late joiner."""

from itertools import product
from types import SimpleNamespace

import pytest
from rclpy.exceptions import InvalidHandle
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from std_msgs.msg import Int32

from limited import Heart, by_the_wall
from rosbeat.ros.recording import PublisherTap

pytestmark = pytest.mark.ros
DURABILITIES = [one for one in DurabilityPolicy if one.name != "UNKNOWN"]
RELIABILITIES = [one for one in ReliabilityPolicy if one.name != "UNKNOWN"]


def profiles():
    return [
        QoSProfile(depth=5, durability=one, reliability=other)
        for one, other in product(DURABILITIES, RELIABILITIES)
    ]


def tapped(publisher):
    return PublisherTap(publisher, SimpleNamespace(take=lambda message: message), lambda _: None)


def arrived(subscription):
    """All that can be taken at once."""
    got = []
    while (taken := subscription.handle.take_message(Int32, False)) is not None:
        got.append(taken[0].data)
    return got


@pytest.mark.parametrize(
    "offered", profiles(), ids=lambda one: f"{one.durability.name}-{one.reliability.name}"
)
def test_who_gets_stored_messages_has_them_when_all_is_delivered(offered, eventually):
    with by_the_wall() as world:
        node = Heart(QoSProfile(depth=1), context=world.context)
        world.nodes.append(node)
        for number, asked in enumerate(profiles()):
            publisher = node.create_publisher(Int32, f"t{number}", offered)
            tap = tapped(publisher)
            assert not tap.stores_for(asked)
            for data in (1, 2):
                publisher.publish(Int32(data=data))
            late = node.create_subscription(Int32, f"t{number}", print, asked)
            eventually(tap.has_delivered)
            assert arrived(late) == ([1, 2] if tap.stores_for(asked) else [])
            publisher.publish(Int32(data=3))
            assert arrived(late) == ([3] if tap.fits(late) else [])


def test_a_destroyed_publisher_delivers_nothing_more():
    with by_the_wall() as world:
        heart = world.make(Heart, QoSProfile(depth=1))
        tap = tapped(heart.publisher)
        heart.beat(1)
        heart.destroy_publisher(heart.publisher)
        with pytest.raises(InvalidHandle), heart.publisher.handle:
            pass
        assert tap.has_delivered()
