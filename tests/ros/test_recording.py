"""What is recorded of nodes: messages, log lines; and message classes that stay whole."""

import math
from itertools import product
from types import SimpleNamespace

import numpy
import pytest
from geometry_msgs.msg import Point, Polygon
from hypothesis import given
from hypothesis import strategies as st
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from rclpy.serialization import serialize_message
from std_msgs.msg import (
    Bool,
    Byte,
    ColorRGBA,
    Empty,
    Float32,
    Float64,
    Header,
    Int8,
    Int32,
    Int64,
    String,
    UInt8,
    UInt64,
)

from limited import Heart, by_the_wall
from nodes import Words
from rosbeat.ros.recording import (
    Memory,
    PublisherTap,
    repair_message_classes,
)

pytestmark = pytest.mark.ros

# Messages as plain data, recorded as they were.


def remembered(message):
    memory = Memory(type(message))
    return memory.plain(memory.take(message))


@pytest.mark.parametrize(
    ("message", "wanted"),
    [
        (Bool(data=True), {"data": True}),
        (Byte(data=b"\x07"), {"data": [7]}),
        (Int8(data=-5), {"data": -5}),
        (UInt8(data=255), {"data": 255}),
        (Int64(data=-(2**63)), {"data": -(2**63)}),
        (UInt64(data=2**64 - 1), {"data": 2**64 - 1}),
        (Float64(data=0.1), {"data": 0.1}),
        (Float32(data=0.1), {"data": float(numpy.float32(0.1))}),
        (String(data="grüß Gott ✓"), {"data": "grüß Gott ✓"}),
        (Empty(), {}),
        (ColorRGBA(r=1.0, a=0.5), {"r": 1.0, "g": 0.0, "b": 0.0, "a": 0.5}),
        (Point(x=1.0), {"x": 1.0, "y": 0.0, "z": 0.0}),
        (Header(frame_id="map"), {"stamp": {"sec": 0, "nanosec": 0}, "frame_id": "map"}),
    ],
    ids=lambda value: type(value).__name__,
)
def test_what_is_remembered(message, wanted):
    assert remembered(message) == wanted


@given(st.floats(-(2.0**127), 2.0**127, width=32) | st.sampled_from([math.inf, math.nan]))
def test_float32_is_what_a_subscriber_receives(value):
    got = remembered(Float32(data=value))["data"]
    assert got == value or (math.isnan(got) and math.isnan(value))


def test_a_node_may_change_a_message_after_publishing(ros):
    class Reuser(Node):
        def __init__(self):
            super().__init__("reuser")
            self.number, self.polygon = Int32(), Polygon()
            self.numbers = self.create_publisher(Int32, "numbers", 10)
            self.polygons = self.create_publisher(Polygon, "polygons", 10)
            self.create_timer(1.0, self.again)

        def again(self):
            from geometry_msgs.msg import Point32

            self.number.data += 1
            self.polygon.points.append(Point32(x=float(self.number.data)))
            self.numbers.publish(self.number)
            self.polygons.publish(self.polygon)

    ros.add(Reuser)
    ros.run(3)
    assert [sample.value for sample in ros.messages("numbers")] == [1, 2, 3]
    assert [len(sample.value) for sample in ros.messages("polygons")] == [1, 2, 3]
    assert [point["x"] for point in ros.messages("polygons")[2].value] == [1.0, 2.0, 3.0]


def test_serialized_bytes_can_be_published_and_heard_raw(ros):
    node = ros.add(lambda: Node("raw"))
    heard, read = [], []
    publisher = node.create_publisher(Int32, "bytes", 10)
    node.create_subscription(Int32, "bytes", heard.append, 10, raw=True)
    node.create_subscription(Int32, "bytes", read.append, 10)
    publisher.publish(serialize_message(Int32(data=77)))
    ros.run(0)
    assert heard == [serialize_message(Int32(data=77))]
    assert [message.data for message in read] == [77]
    assert [sample.value for sample in ros.messages("bytes")] == [77]


def test_a_refused_message_is_not_recorded(ros, capsys):
    class Wrong(Words):
        def say(self):
            self.publisher.publish(25.0)

    ros.add(Wrong)
    ros.run(3)
    (fault,) = ros.observation().faults
    assert fault.kind == "TypeError"
    assert ros.messages("text") == ()
    capsys.readouterr()


# `msg = Float32` and `msg.data = 25.0` spoil the class for the whole kernel: not for long.


@pytest.fixture(autouse=True)
def _whole_again():
    yield
    repair_message_classes()


def test_a_class_that_was_written_into_is_whole_again():
    Float32.data, String.data = 25.0, "text"
    with pytest.raises(AttributeError, match="read-only"):
        Float32()
    assert sorted(repair_message_classes()) == ["Float32", "String"]
    assert Float32(data=1.0).data == 1.0
    with pytest.raises(AssertionError, match="must be of type 'float'"):
        Float32(data=1)
    assert repair_message_classes() == []


class Spoiler(Node):
    def __init__(self):
        super().__init__("spoiler")
        self.publisher_ = self.create_publisher(Float32, "temperature", 10)
        self.create_timer(1.0, self.tick)

    def tick(self):
        msg = Float32
        msg.data = 25.0
        self.publisher_.publish(msg)


def test_the_next_run_of_a_node_that_was_put_right_works(ros, capsys):
    ros.add(Spoiler)
    ros.run(1)
    assert Float32(data=2.0).data == 2.0
    capsys.readouterr()


# What a tap knows of stored messages, compared with what Fast DDS hands to a late joiner.


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


# The C part of message types, loaded ahead.
