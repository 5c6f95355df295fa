"""Readers that share no code with ours find every message: `mcap`, `sqlite3`, rclpy."""

import math
import sqlite3
from dataclasses import replace

import pytest
from mcap.reader import make_reader
from mcap_ros2.decoder import DecoderFactory
from rclpy.node import Node
from rclpy.serialization import deserialize_message
from sensor_msgs.msg import Imu, JointState
from std_msgs.msg import Float32, String

from made_records import run_of
from nodes import Talker
from rosbeat import Session
from rosbeat.bags import record
from rosbeat.records import NANOSECONDS, Observation
from rosbeat.ros.recording import plain
from rosbeat.ros.scenario import message_class

pytestmark = pytest.mark.ros


class Robot(Node):
    """Publishes all kinds of things, odd ones among them."""

    def __init__(self):
        super().__init__("robot")
        kinds = {"odd": Float32, "words": String, "imu": Imu, "joints": JointState}
        self.outlets = {name: self.create_publisher(kind, name, 10) for name, kind in kinds.items()}
        self.create_timer(0.5, self.tick)
        self.ticks = 0

    def tick(self):
        self.ticks += 1
        k = self.ticks
        odd = [math.nan, math.inf, -math.inf, -0.0, 1e-45, 3.4e38][k % 6]
        self.outlets["odd"].publish(Float32(data=odd))
        self.outlets["words"].publish(String(data="grüße 🌡" * (k % 5) * 500))
        imu = Imu(orientation_covariance=[float(k)] * 9)
        imu.header.stamp, imu.header.frame_id = self.get_clock().now().to_msg(), f"frame{k}"
        self.outlets["imu"].publish(imu)
        names = [f"joint{n}" for n in range(k % 4)]
        joints = JointState(name=names, position=[n / 3 for n in range(k % 4)])
        self.outlets["joints"].publish(joints)


@pytest.fixture(scope="module")
def run():
    """Two hundred seconds of a robot and of somebody who counts: 1800 messages."""
    with Session(seed=2) as ros:
        ros.add(Robot)
        ros.add(Talker)
        ros.run(200)
        return ros.observation()


def read(path):
    """Every message as (topic, type, log time, publish time, decoded)."""
    with path.open("rb") as file:
        reader = make_reader(file, validate_crcs=True, decoder_factories=[DecoderFactory()])
        return [
            (channel.topic, schema.name, message.log_time, message.publish_time, decoded)
            for schema, channel, message, decoded in reader.iter_decoded_messages()
        ]


def in_order(found):
    """Rows of (topic, type, stamp, plain data), in the order in which they were published."""
    return [(one.topic, one.type_name, one.time_ns, one.data) for one in found.samples]


def as_in(data, message):
    """A decoded message of the second library as plain data, with the fields of `data`."""
    if isinstance(data, dict):
        return {name: as_in(value, getattr(message, name)) for name, value in data.items()}
    return list(message) if isinstance(data, list) else message


def test_mcap_loses_nothing_for_the_reader_of_its_makers(tmp_path, run, same):
    record(run, tmp_path / "run")
    rows = read(tmp_path / "run" / "messages.mcap")
    expected = in_order(run)
    assert len(rows) == len(expected) == 1800
    for (*row, decoded), (topic, kind, stamp, data) in zip(rows, expected, strict=True):
        assert row == [topic, kind, stamp, stamp]
        assert same(as_in(data, decoded), data)


def test_mcap_has_the_bytes_that_rclpy_reads(tmp_path, run, same):
    record(run, tmp_path / "run")
    with (tmp_path / "run" / "messages.mcap").open("rb") as file:
        reader = make_reader(file, validate_crcs=True)
        assert reader.get_header().profile == "ros2"
        assert reader.get_summary().statistics.message_count == len(run.samples)
        rows = [
            (channel.topic, schema.name, message.log_time, message.data)
            for schema, channel, message in reader.iter_messages()
        ]
    check(rows, run, same)


def test_sqlite_has_the_bytes_that_rclpy_reads(tmp_path, run, same):
    record(run, tmp_path / "run", storage="sqlite3")
    database = sqlite3.connect(tmp_path / "run" / "messages.db3")
    try:
        assert database.execute("PRAGMA integrity_check").fetchone() == ("ok",)
        rows = database.execute(
            "SELECT name, type, timestamp, data FROM messages JOIN topics ON topic_id = topics.id "
            "ORDER BY messages.id"
        ).fetchall()
        definitions = dict(
            database.execute(
                "SELECT topic_type, encoded_message_definition FROM message_definitions"
            )
        )
    finally:
        database.close()
    assert set(definitions) == {one.type_name for one in run.samples}
    check(rows, run, same)


def check(rows, run, same):
    expected = in_order(run)
    assert [row[:3] for row in rows] == [row[:3] for row in expected]
    for (_, kind, _, wire), (*_, data) in zip(rows, expected, strict=True):
        assert same(plain(deserialize_message(wire, message_class(kind))), data)


def test_thousands_of_messages(tmp_path, same):
    many = run_of([at / 7 for at in range(20_000)])
    bag = record(many, tmp_path / "run")
    assert len(read(tmp_path / "run" / "messages.mcap")) == len(bag) == 20_000


def test_an_empty_bag_is_one_for_others_too(tmp_path):
    record(Observation(NANOSECONDS, 0), tmp_path / "empty")
    assert read(tmp_path / "empty" / "messages.mcap") == []
    record(replace(run_of([]), time_ns=1), tmp_path / "silent")
    assert read(tmp_path / "silent" / "messages.mcap") == []
