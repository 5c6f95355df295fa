"""The bytes of messages, judged by rclpy, and the definitions of their types."""

import json
import os
from pathlib import Path

import pytest
from hypothesis import HealthCheck, Phase, example, given, settings
from rclpy.serialization import deserialize_message, serialize_message
from rosbags.interfaces import Connection, MessageDefinition, MessageDefinitionFormat
from rosbags.typesys import TypesysError

from any_message import ANY, STORE
from rosbeat.bags.serialization import (
    MISFITS,
    from_bytes,
    installed_types,
    recorded_types,
    to_bytes,
)
from rosbeat.errors import BagError
from rosbeat.ros.recording import message_class, plain

FLOAT, BYTES = "std_msgs/msg/Float32", "std_msgs/msg/ByteMultiArray"


def text(data):
    """A text that is equal for equal data, where NaN is NaN, and 1 is not 1.0."""
    return json.dumps(data, sort_keys=True)


@pytest.mark.ros
@settings(
    max_examples=150,
    deadline=None,
    derandomize=True,
    database=None,
    phases=[Phase.explicit, Phase.generate],  # shrinking such data takes minutes
    suppress_health_check=list(HealthCheck),
)
@given(ANY)
@example(("std_msgs/msg/Byte", {"data": [200]}))
@example(("std_msgs/msg/Char", {"data": 200}))
def test_rclpy_reads_what_is_written_and_the_other_way_around(case):
    name, data = case
    message = deserialize_message(to_bytes(STORE, name, data), message_class(name))
    assert text(plain(message)) == text(data)
    back = from_bytes(STORE, name, serialize_message(message))
    assert text(back) == text(data)
    assert list(back) == list(plain(message))


def test_bytes_that_fast_dds_leaves_behind_a_message_do_not_matter():
    # Seen with rclpy 7.1.6: a message of 16 bytes comes as 20, and the library refuses it.
    left = bytes.fromhex("00010000000000000000000000000000a0000000")
    data = {"layout": {"dim": [], "data_offset": 0}, "data": []}
    assert from_bytes(STORE, "std_msgs/msg/Int64MultiArray", left) == data


@pytest.mark.parametrize("wire", [b"", b"\0\1", b"\0\1\0\0", b"\0\1\0\0\1", b"\0\3\0\0\1\2\3\4"])
def test_what_is_no_message_is_refused(wire):
    with pytest.raises(MISFITS):
        from_bytes(STORE, FLOAT, wire)


def test_messages_of_computers_that_count_the_other_way_are_read():
    assert from_bytes(STORE, FLOAT, b"\0\0\0\0\x3f\x80\0\0") == {"data": 1.0}


def test_a_long_text_survives():
    text = "grüße 🌡 " * 20_000
    name = "std_msgs/msg/String"
    assert from_bytes(STORE, name, to_bytes(STORE, name, {"data": text})) == {"data": text}


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
        to_bytes(STORE, name, data)


# Definitions.

#: Types with a `char`, of which the library reckons another hash than ROS does; their bytes are the
#: same.
KNOWN = {
    "std_msgs/msg/Char",
    "service_msgs/msg/ServiceEventInfo",
    "rmw_dds_common/msg/Gid",
    "rmw_dds_common/msg/NodeEntitiesInfo",
    "rmw_dds_common/msg/ParticipantEntitiesInfo",
}
TEXT = MessageDefinitionFormat.MSG


def connection(name, text, form=TEXT):
    return Connection(1, "/t", name, MessageDefinition(form, text), "", 0, None, None)


def installed():
    """Every installed message type with its hash, as the packages say."""
    for prefix in os.environ["AMENT_PREFIX_PATH"].split(os.pathsep):
        for path in sorted(Path(prefix, "share").glob("*/msg/*.json")):
            if path.parts[-3] == "test_msgs":
                continue  # made to test ROS with; the library has no wide strings
            name = f"{path.parts[-3]}/msg/{path.stem}"
            hashes = json.loads(path.read_text())["type_hashes"]
            yield name, next(one["hash_string"] for one in hashes if one["type_name"] == name)


@pytest.mark.ros
def test_the_library_knows_the_types_of_the_course_exactly_as_they_are_installed():
    expected = dict(installed())
    assert len(expected) > 150
    store = installed_types(expected)
    found = {name: store.hash_rihs01(name) for name in expected}
    assert {name for name in expected if found[name] != expected[name]} <= KNOWN


@pytest.fixture
def package(tmp_path, monkeypatch):
    """An installed package with types of its own."""
    folder = tmp_path / "share" / "greenhouse_msgs" / "msg"
    folder.mkdir(parents=True)
    (folder / "Plant.msg").write_text("string name\nfloat32[2] span\nstd_msgs/Header header\n")
    (folder / "Bed.msg").write_text("# a bed\nPlant[] plants\nuint8 WET=1\nuint8 state\n")
    (folder / "Odd.msg").write_text("this is ( no definition")
    monkeypatch.setenv("AMENT_PREFIX_PATH", f"{os.pathsep}{tmp_path}")
    return folder


def test_a_type_of_ones_own_is_read_from_where_it_is_installed(package):
    store = installed_types(["greenhouse_msgs/msg/Bed"])
    header = {"stamp": {"sec": 1, "nanosec": 2}, "frame_id": "bed"}
    data = {"plants": [{"name": "fern", "span": [1.0, 2.0], "header": header}], "state": 1}
    wire = to_bytes(store, "greenhouse_msgs/msg/Bed", data)
    assert from_bytes(store, "greenhouse_msgs/msg/Bed", wire) == data
    assert "greenhouse_msgs/msg/Bed" not in installed_types([]).fielddefs


@pytest.mark.parametrize("name", ["greenhouse_msgs/msg/Odd", "a/msg/B", "nonsense", ""])
def test_an_unknown_type_gets_three_parts(package, says, name):
    with pytest.raises(BagError) as caught:
        installed_types([name])
    says(caught.value, "is unknown", "topics=")


def test_a_bag_s_own_definition_counts():
    store = recorded_types([connection("std_msgs/msg/Float32", "float64 other\n")])
    assert to_bytes(store, "std_msgs/msg/Float32", {"other": 0.1})[4:] == (
        b"\x9a\x99\x99\x99\x99\x99\xb9\x3f"
    )


def test_what_a_bag_does_not_define_is_known():
    store = recorded_types([
        connection("a_msgs/msg/A", "int32 x\n"),
        connection("std_msgs/msg/Bool", "", MessageDefinitionFormat.NONE),
    ])  # fmt: skip
    assert {"a_msgs/msg/A", "std_msgs/msg/Bool"} <= set(store.fielddefs)


def test_a_definition_in_idl_is_understood():
    text = "module a { module msg { struct B { double x; }; }; };"
    store = recorded_types([connection("a/msg/B", text, MessageDefinitionFormat.IDL)])
    assert from_bytes(store, "a/msg/B", to_bytes(store, "a/msg/B", {"x": 1.5})) == {"x": 1.5}


def test_definitions_that_contradict_each_other_are_refused():
    with pytest.raises(TypesysError):
        recorded_types([connection("a/msg/B", "int8 x\n"), connection("a/msg/B", "int16 x\n")])
