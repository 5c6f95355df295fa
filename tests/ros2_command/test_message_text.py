import pytest

pytest.importorskip("std_msgs.msg")

from geometry_msgs.msg import PoseWithCovariance
from ros2_command.message_text import Style, to_csv, to_yaml
from sensor_msgs.msg import JointState
from std_msgs.msg import (
    ByteMultiArray,
    Empty,
    Float32,
    Int32MultiArray,
    MultiArrayDimension,
    String,
)

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
        (String(data=""), "data: ''\n"),
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
