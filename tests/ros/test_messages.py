"""Messages as plain data, recorded as they were."""

import math
from functools import partial

import numpy
import pytest
from geometry_msgs.msg import Point, Polygon, PoseStamped, TwistWithCovariance
from hypothesis import given
from hypothesis import strategies as st
from rclpy.node import Node
from rclpy.serialization import deserialize_message, serialize_message
from sensor_msgs.msg import Imu, JointState
from std_msgs.msg import (
    Bool,
    Byte,
    ByteMultiArray,
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

from nodes import Talker, Words
from rosbeat.ros.recording import Memory, plain, type_name


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


def test_arrays_of_every_kind_become_lists():
    joints = JointState(name=["a", "b"], position=[1.0, 2.0])
    assert remembered(joints)["name"] == ["a", "b"]
    assert remembered(joints)["position"] == [1.0, 2.0]
    assert len(remembered(Imu())["orientation_covariance"]) == 9
    assert remembered(ByteMultiArray(data=[b"\x01", b"\x02"]))["data"] in ([1, 2], [[1], [2]])
    deep = remembered(TwistWithCovariance())
    assert deep["twist"]["linear"] == {"x": 0.0, "y": 0.0, "z": 0.0}
    assert isinstance(deep["covariance"], list)


@given(st.floats(-(2.0**127), 2.0**127, width=32) | st.sampled_from([math.inf, math.nan]))
def test_float32_is_what_a_subscriber_receives(value):
    got = remembered(Float32(data=value))["data"]
    assert got == value or (math.isnan(got) and math.isnan(value))


@given(st.floats(allow_nan=False, min_value=-3e38, max_value=3e38))
def test_float32_rounds(value):
    assert remembered(Float32(data=value))["data"] == float(numpy.float32(value))


def by_the_wire(message):
    return plain(deserialize_message(serialize_message(message), type(message)))


class Celsius(float):
    """A number of a kind of its own."""


TEXTS = st.text() | st.sampled_from(["", "a\0b", "grüß", "\ud800", "°C"])


@given(st.sampled_from([String, Header]), TEXTS)
def test_a_text_is_what_the_wire_makes_of_it(kind, text):
    message = kind(**{"data" if kind is String else "frame_id": text})
    try:
        expected = by_the_wire(message)
    except UnicodeEncodeError:
        return  # nobody can publish half of a surrogate pair
    assert remembered(message) == expected


@pytest.mark.parametrize(
    "message",
    [
        Float32(data=Celsius(0.1)),
        Float64(data=Celsius(0.1)),
        Float32(data=-0.0),
        Int8(data=-128),
        UInt8(data=255),
        Int8(data=True),
        ColorRGBA(r=0.1, a=Celsius(1 / 3)),
    ],
    ids=repr,
)
def test_other_values_are_what_the_wire_makes_of_them(message):
    expected = by_the_wire(message)
    found = remembered(message)
    assert repr(found) == repr(expected)
    assert list(map(type, found.values())) == list(map(type, expected.values()))


def test_names_of_types():
    assert type_name(Float32) == "std_msgs/msg/Float32"
    assert type_name(PoseStamped) == "geometry_msgs/msg/PoseStamped"


def test_plain_of_plain_values():
    assert [plain(value) for value in (1, 2.5, "x", True)] == [1, 2.5, "x", True]


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


def test_a_callback_with_message_info(ros):
    ros.add(Talker)
    node = ros.add(lambda: Node("informed"))
    seen = []

    def hear(message: Int32, info: dict) -> None:
        seen.append((message.data, sorted(info)))

    node.create_subscription(Int32, "count", hear, 10)
    ros.run(2)
    assert [number for number, _ in seen] == [1, 2]
    assert "source_timestamp" in seen[0][1]


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


def test_field_checks_are_on(ros, capsys):
    class Wrong(Words):
        def say(self):
            self.publisher.publish(String(data=25))

    ros.add(partial(Wrong))
    ros.run(1)
    assert "must be of type 'str'" in ros.observation().faults[0].text
    capsys.readouterr()
