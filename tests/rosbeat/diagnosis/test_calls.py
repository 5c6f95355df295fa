import pytest
from hypothesis import given
from hypothesis import strategies as st

from failed_calls import failed_call
from rosbeat.diagnosis.calls import in_words, role_of, written_call
from rosbeat.records import Argument


@pytest.mark.parametrize(
    ("kind", "role", "words"),
    [
        (Argument("message_type", "Float32"), "type", "the message type Float32"),
        (Argument("type", "float"), "type", "the type float"),
        (Argument("int"), "depth", "a whole number"),
        (Argument("QoSProfile"), "depth", "a QoS profile"),
        (Argument("function", "f", ()), "callback", "the function f"),
        (Argument("NoneType"), "none", "None"),
        (Argument("deque"), "other", "an object of type deque"),
    ],
)
def test_what_an_argument_could_be(kind, role, words):
    assert role_of(kind) == role
    assert in_words(kind) == words


@pytest.mark.parametrize(
    ("code", "call"),
    [
        (
            "self.publisher_ = self.create_publisher(Float32, 'temperature')",
            "create_publisher(message_type[Float32], str)",
        ),
        (
            "self.create_subscription(std_msgs.msg.String, topic, self.listen(), qos_profile=10)",
            "create_subscription(message_type[String], unknown, NoneType, qos_profile=int)",
        ),
        ("node.create_timer(1.0, lambda: None)", "create_timer(float, function)"),
        (
            "self.create_publisher(float, 'a', self.depth)",
            "create_publisher(type[float], str, method[depth])",
        ),
        ("self.create_publisher(*arguments)", ""),
        ("self.create_publisher(Float32, **options)", ""),
        ("self.publisher_ = self.create_publisher(", ""),
        ("rclpy.spin(node)", ""),
    ],
)
def test_a_call_that_is_written(code, call):
    assert written_call(code) == failed_call(call)


@given(st.text())
def test_any_line_can_be_looked_at(code):
    written_call(code)
