"""Definitions: the library's, those that packages install, those in a bag."""

import json
import os
from pathlib import Path

import pytest
from rosbags.interfaces import Connection, MessageDefinition, MessageDefinitionFormat
from rosbags.typesys import TypesysError

from rosbeat.bags.plain import from_wire, to_wire
from rosbeat.bags.types import installed_types, recorded_types
from rosbeat.errors import BagError

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
    wire = to_wire(store, "greenhouse_msgs/msg/Bed", data)
    assert from_wire(store, "greenhouse_msgs/msg/Bed", wire) == data
    assert "greenhouse_msgs/msg/Bed" not in installed_types([]).fielddefs


@pytest.mark.parametrize("name", ["greenhouse_msgs/msg/Odd", "a/msg/B", "nonsense", ""])
def test_an_unknown_type_gets_three_parts(package, says, name):
    with pytest.raises(BagError) as caught:
        installed_types([name])
    says(caught.value, "is not known here", "topics=")


def test_a_bag_s_own_definition_counts():
    store = recorded_types([connection("std_msgs/msg/Float32", "float64 other\n")])
    assert to_wire(store, "std_msgs/msg/Float32", {"other": 0.1})[4:] == (
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
    assert from_wire(store, "a/msg/B", to_wire(store, "a/msg/B", {"x": 1.5})) == {"x": 1.5}


def test_definitions_that_contradict_each_other_are_refused():
    with pytest.raises(TypesysError):
        recorded_types([connection("a/msg/B", "int8 x\n"), connection("a/msg/B", "int16 x\n")])
