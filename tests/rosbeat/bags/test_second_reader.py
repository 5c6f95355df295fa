"""Readers that share no code with ours find every message: `mcap`, `sqlite3`, rclpy."""

import math
import sqlite3

import pytest
from mcap.reader import make_reader
from mcap_ros2.decoder import DecoderFactory
from rclpy.node import Node
from rclpy.serialization import deserialize_message
from sensor_msgs.msg import Imu, JointState
from std_msgs.msg import Float32, String

from nodes import Talker
from rosbeat import Session
from rosbeat.bags import record
from rosbeat.ros.recording import message_class, plain

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
    """Fifty seconds of a robot and of somebody who counts: 450 messages."""
    with Session(seed=2) as ros:
        ros.add(Robot)
        ros.add(Talker)
        ros.run(50)
        return ros.observation()


def in_order(found):
    """Rows of (topic, type, stamp, plain data), in the order in which they were published."""
    return [(one.topic, one.type_name, one.time_ns, one.data) for one in found.samples]


def as_in(data, message):
    """A decoded message of the second library as plain data, with the fields of `data`."""
    if isinstance(data, dict):
        return {name: as_in(value, getattr(message, name)) for name, value in data.items()}
    return list(message) if isinstance(data, list) else message


def test_mcap_has_every_message_for_the_reader_of_its_makers_and_for_rclpy(tmp_path, run):
    record(run, tmp_path / "run")
    with (tmp_path / "run" / "messages.mcap").open("rb") as file:
        reader = make_reader(file, validate_crcs=True, decoder_factories=[DecoderFactory()])
        assert reader.get_header().profile == "ros2"
        assert reader.get_summary().statistics.message_count == len(run.samples) == 450
        rows = []
        for schema, channel, message, decoded in reader.iter_decoded_messages():
            rows.append((channel.topic, schema.name, message.log_time, message.data))
            assert message.publish_time == message.log_time
            data = run.samples[len(rows) - 1].data
            assert repr(as_in(data, decoded)) == repr(data)
    check(rows, run)


def test_sqlite_has_the_bytes_that_rclpy_reads(tmp_path, run):
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
    check(rows, run)


def check(rows, run):
    expected = in_order(run)
    assert [row[:3] for row in rows] == [row[:3] for row in expected]
    for (_, kind, _, wire), (*_, data) in zip(rows, expected, strict=True):
        assert repr(plain(deserialize_message(wire, message_class(kind)))) == repr(data)
