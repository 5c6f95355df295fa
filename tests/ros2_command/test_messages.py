"""Messages to YAML and CSV, and from YAML."""

from importlib import import_module

import pytest
import yaml

pytest.importorskip("std_msgs.msg")

from geometry_msgs.msg import PoseArray, PoseStamped, PoseWithCovariance
from ros2_command.errors import CommandError
from ros2_command.messages import Style, fill, read_yaml, to_csv, to_yaml
from sensor_msgs.msg import JointState
from std_msgs.msg import (
    Bool,
    Byte,
    ByteMultiArray,
    Empty,
    Float32,
    Header,
    Int32,
    Int32MultiArray,
    MultiArrayDimension,
    String,
    UInt8,
)
from unique_identifier_msgs.msg import UUID

JOINTS = """\
header:
  stamp:
    sec: 0
    nanosec: 0
  frame_id: ''
name:
- a
- b
position: []
velocity: []
effort: []
"""


@pytest.mark.parametrize(
    ("message", "text"),
    [
        (Float32(data=25.2294921875), "data: 25.2294921875\n"),
        (Float32(data=float("nan")), "data: .nan\n"),
        (String(data="12"), "data: '12'\n"),
        (String(data="it's"), "data: it's\n"),
        (String(data="grün " * 40), "data: '" + ("grün " * 40)[:128] + "...'\n"),
        (Empty(), "{}\n"),
        (JointState(name=["a", "b"]), JOINTS),
    ],
)
def test_yaml(message, text):
    if "grün" in text:
        text = text.replace("'", "")
    assert to_yaml(message, Style()) == text


def test_long_arrays_are_cut():
    message = Int32MultiArray(data=range(5))
    assert to_yaml(message, Style(limit=2)).endswith("data:\n- 0\n- 1\n- '...'\n")
    assert to_yaml(message, Style(limit=None)).endswith("- 3\n- 4\n")
    assert to_yaml(message, Style(flow=True)).endswith("data: [0, 1, 2, 3, 4]\n")
    assert to_csv(message, Style(limit=2)) == "0,0,1,..."


def test_arrays_of_a_fixed_size():
    message = PoseWithCovariance(covariance=[0.5] * 36)
    assert to_yaml(message, Style()).endswith("covariance:\n" + "- 0.5\n" * 36)
    cut = Style(limit=2, flow=True)
    assert to_yaml(message, cut).endswith("covariance: [0.5, 0.5, '...']\n")
    assert to_csv(message, Style()) == ",".join(["0.0"] * 6 + ["1.0"] + ["0.5"] * 36)
    assert to_csv(message, Style(limit=2)).endswith("1.0,0.5,0.5,...")
    assert to_yaml(UUID(uuid=range(16)), Style(limit=1)) == "uuid:\n- 0\n- '...'\n"


@pytest.mark.parametrize("package", ["geometry_msgs", "sensor_msgs", "nav_msgs", "test_msgs"])
def test_every_message_can_be_shown(package):
    found = vars(import_module(f"{package}.msg")).values()
    messages = [kind() for kind in found if hasattr(kind, "SLOT_TYPES")]
    assert len(messages) > 4
    for message in messages:
        for style in (Style(), Style(limit=None), Style(no_arr=True), Style(flow=True, limit=1)):
            assert set(yaml.safe_load(to_yaml(message, style))) == set(
                message.get_fields_and_field_types()
            )
            to_csv(message, style)


def test_arrays_and_texts_as_summaries():
    message = Int32MultiArray(data=range(200))
    assert "data: '<sequence type: int32, length: 200>'" in to_yaml(message, Style(no_arr=True))
    message.layout.dim = [MultiArrayDimension()]
    kind = "<sequence type: std_msgs/msg/MultiArrayDimension, length: 1>"
    assert kind in to_yaml(message, Style(no_arr=True))
    fixed = to_yaml(PoseWithCovariance(), Style(no_arr=True))
    assert "covariance: '<array type: double[36]>'" in fixed
    assert to_yaml(String(data="abc"), Style(no_str=True)) == "data: '<string length: <3>>'\n"


def test_bytes_and_csv():
    assert to_yaml(ByteMultiArray(data=[b"\0"]), Style()).endswith('data:\n- "\\0"\n')
    assert to_csv(JointState(name=["a", "b"]), Style()) == "0,0,,a,b,,,"
    assert to_csv(Empty(), Style()) == ""


def filled(message, text):
    fill(message, read_yaml(text))
    return message


@pytest.mark.parametrize(
    ("kind", "text", "value"),
    [
        (Float32, "{data: 25}", 25.0),
        (Int32, "{data: 2.5}", 2),
        (String, "data: 12", "12"),
        (Bool, "{data: yes}", True),
        (Byte, "{data: 7}", b"\x07"),
    ],
)
def test_values_are_converted(kind, text, value):
    assert filled(kind(), text).data == value


def test_nested_messages_and_arrays():
    message = filled(PoseArray(), "{poses: [{position: {x: 1}}, {}]}")
    assert [one.position.x for one in message.poses] == [1.0, 0.0]
    assert list(filled(Int32MultiArray(), "{data: [1, 2]}").data) == [1, 2]
    covariance = filled(PoseWithCovariance(), f"{{covariance: {[1.0] * 36}}}").covariance
    assert list(covariance) == [1.0] * 36


@pytest.mark.parametrize(
    ("kind", "text"),
    [(PoseStamped, "{header: auto}"), (PoseStamped, "{header: {stamp: now, frame_id: map}}"),
     (Header, "{stamp: now}")],
)  # fmt: skip
def test_stamps_are_renewed(kind, text):
    message = kind()
    now = type(Header().stamp)(sec=5)
    for stamp in fill(message, read_yaml(text)):
        stamp(now)
    assert (message if kind is Header else message.header).stamp.sec == 5


@pytest.mark.parametrize(
    ("kind", "text", "said"),
    [
        (String, "{nope: 1}", "'String' object has no attribute 'nope'\nIt has: data"),
        (String, "{dat: 1}", "Did you mean 'data'?"),
        (Int32, "{data: now}", "invalid literal for int() with base 10: 'now'"),
        (Int32MultiArray, "{data: 5}", "'int' object is not iterable"),
        (PoseStamped, "{pose: now}", "Value 'now' is expected to be a dictionary but is a str"),
        (UInt8, "{data: 300}", "300 does not fit"),
        (Int32MultiArray, "{data: [99999999999]}", "Failed to populate field: "),
        (PoseWithCovariance, "{covariance: [1]}", "Failed to populate field: "),
        (String, "{data: [", "not valid YAML"),
        (String, "a: 1\n---\nb: 2", "not valid YAML"),
    ],
)
def test_what_does_not_fit_is_refused(kind, text, said):
    with pytest.raises(CommandError) as error:
        filled(kind(), text)
    assert said in str(error.value)
