import pytest

pytest.importorskip("std_msgs.msg")

from geometry_msgs.msg import PoseArray, PoseStamped, PoseWithCovariance
from ros2_command.errors import CommandError
from ros2_command.message_values import fill, read_yaml
from std_msgs.msg import Bool, Byte, Float32, Header, Int32, Int32MultiArray, String, UInt8


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
        (String, "{}", ""),
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
