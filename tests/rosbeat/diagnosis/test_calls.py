import pytest
from hypothesis import given
from hypothesis import strategies as st

from rosbeat.diagnosis.calls import Asked, Given, asked_of, written_call
from rosbeat.records import Fault


def asked(text):
    return asked_of(Fault(0, "/s", "__init__", "TypeError", "", 0, "", text))


def test_a_call_is_read():
    text = "create_subscription(message_type[Float32], str, method[cb(self, msg)], qos_profile=int)"
    assert asked(text) == Asked(
        "create_subscription",
        (
            Given("message_type", "Float32"),
            Given("str"),
            Given("method", "cb", ("self", "msg")),
        ),
        {"qos_profile": Given("int")},
    )


@pytest.mark.parametrize("text", ["", "nonsense here", "create_timer", "f(", "\0"])
def test_what_is_no_call(text):
    assert asked(text) is None


@pytest.mark.parametrize(
    ("kind", "role", "words"),
    [
        (Given("message_type", "Float32"), "type", "the message type Float32"),
        (Given("type", "float"), "type", "the type float"),
        (Given("int"), "depth", "a whole number"),
        (Given("QoSProfile"), "depth", "a QoS profile"),
        (Given("function", "f", ()), "callback", "the function f"),
        (Given("NoneType"), "none", "None"),
        (Given("deque"), "other", "an object of type deque"),
    ],
)
def test_what_an_argument_could_be(kind, role, words):
    assert kind.role == role
    assert str(kind) == words


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
    assert written_call(code) == call


@given(st.text())
def test_any_line_can_be_looked_at(code):
    assert isinstance(written_call(code), str)
    asked(code)
