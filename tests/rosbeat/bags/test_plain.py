"""Bytes of ours are read by rclpy, and bytes of rclpy's by us."""

import math
import struct

import pytest
from hypothesis import HealthCheck, Phase, given, settings
from rclpy.serialization import deserialize_message, serialize_message

from any_message import ANY, STORE, TYPES
from rosbeat.bags.plain import from_wire, to_wire
from rosbeat.bags.writing import MISFITS
from rosbeat.ros.recording import plain
from rosbeat.ros.scenario import message_class

pytestmark = pytest.mark.ros
FLOAT, BYTES = "std_msgs/msg/Float32", "std_msgs/msg/ByteMultiArray"
EVERY = settings(
    max_examples=150,
    deadline=None,
    derandomize=True,
    database=None,
    phases=[Phase.explicit, Phase.generate],  # shrinking such data takes minutes
    suppress_health_check=list(HealthCheck),
)


@EVERY
@given(ANY)
def test_rclpy_reads_what_is_written_and_the_other_way_around(same, case):
    name, data = case
    message = deserialize_message(to_wire(STORE, name, data), message_class(name))
    assert same(plain(message), data)
    back = from_wire(STORE, name, serialize_message(message))
    assert same(back, data)
    assert list(back) == list(plain(message))


def test_bytes_that_fast_dds_leaves_behind_a_message_do_not_matter():
    # Seen with rclpy 7.1.6: a message of 16 bytes comes as 20, and the library refuses it.
    left = bytes.fromhex("00010000000000000000000000000000a0000000")
    data = {"layout": {"dim": [], "data_offset": 0}, "data": []}
    assert from_wire(STORE, "std_msgs/msg/Int64MultiArray", left) == data


@pytest.mark.parametrize("wire", [b"", b"\0\1", b"\0\1\0\0", b"\0\1\0\0\1", b"\0\3\0\0\1\2\3\4"])
def test_what_is_no_message_is_refused(wire):
    with pytest.raises(MISFITS):
        from_wire(STORE, FLOAT, wire)


def test_messages_of_computers_that_count_the_other_way_are_read():
    assert from_wire(STORE, FLOAT, b"\0\0\0\0\x3f\x80\0\0") == {"data": 1.0}


def test_there_are_many_types():
    assert len(TYPES) > 50


@pytest.mark.parametrize("value", [math.nan, math.inf, -math.inf, 0.0, -0.0, 1e-45, 3.4e38])
def test_odd_numbers_survive(same, value):
    (number,) = struct.unpack("<f", struct.pack("<f", value))
    back = from_wire(STORE, FLOAT, to_wire(STORE, FLOAT, {"data": number}))
    assert same(back, {"data": number})
    assert math.copysign(1, back["data"]) == math.copysign(1, number)


def test_a_long_text_survives():
    text = "grüße 🌡 " * 20_000
    name = "std_msgs/msg/String"
    assert from_wire(STORE, name, to_wire(STORE, name, {"data": text})) == {"data": text}


@pytest.mark.parametrize(
    ("name", "data"),
    [
        (FLOAT, {}),
        (FLOAT, {"data": 1.0, "more": 2}),
        (FLOAT, {"data": "1"}),
        (FLOAT, {"data": None}),
        (FLOAT, {"data": True}),
        (FLOAT, {"data": 1e39}),
        (FLOAT, 1.0),
        ("std_msgs/msg/Int8", {"data": 128}),
        ("std_msgs/msg/Int8", {"data": 1.5}),
        ("std_msgs/msg/Bool", {"data": 1}),
        ("std_msgs/msg/String", {"data": b"a"}),
        ("std_msgs/msg/String", {"data": "\ud800"}),
        ("std_msgs/msg/Byte", {"data": [1, 2]}),
        ("std_msgs/msg/Byte", {"data": [256]}),
        ("std_msgs/msg/Byte", {"data": [-1]}),
        ("std_msgs/msg/Byte", {"data": 1}),
        ("geometry_msgs/msg/Vector3", {"x": 1.0, "y": 2.0, "z": []}),
        ("std_msgs/msg/UInt8MultiArray", {"layout": {"dim": [], "data_offset": 0}, "data": [256]}),
        ("std_msgs/msg/Float32MultiArray",
         {"layout": {"dim": [], "data_offset": 0}, "data": [1e39]}),
        ("geometry_msgs/msg/PoseWithCovariance",
         {"pose": {"position": {"x": 0.0, "y": 0.0, "z": 0.0},
                   "orientation": {"x": 0.0, "y": 0.0, "z": 0.0, "w": 1.0}},
          "covariance": [0.0] * 35}),
    ],
)  # fmt: skip
def test_what_does_not_fit_is_refused(name, data):
    with pytest.raises(MISFITS):
        to_wire(STORE, name, data)
