"""The call of rclpy that failed is noted on the exception, without calling what it was given."""

import math
from functools import partial

import pytest
from rclpy.node import Node
from rclpy.qos import QoSProfile
from std_msgs.msg import Float32

from rosbeat.ros.faults import asked_by, asked_text, asking

pytestmark = pytest.mark.ros


class Deceiver:
    """Anything that describes it by asking it is deceived."""

    @property
    def __code__(self):
        raise RuntimeError("boom")

    def __repr__(self):
        raise RuntimeError("boom")

    def listen(self, msg):
        pass


@pytest.mark.parametrize(
    ("given", "words"),
    [
        (Float32, "message_type[Float32]"),
        (Float32(), "message[Float32]"),
        (float, "type[float]"),
        ("temperature", "str"),
        (10, "int"),
        (True, "bool"),
        (1.0, "float"),
        (None, "NoneType"),
        (math, "module"),
        (print, "builtin_function_or_method"),
        (partial(print, 1), "partial"),
        (QoSProfile(depth=1), "QoSProfile"),
        (lambda msg: msg, "function[function(msg)]"),
        (Deceiver().listen, "method[listen(self, msg)]"),
        (Deceiver(), "Deceiver"),
    ],
)
def test_how_a_thing_is_described(given, words):
    assert asked_text("f", (given,), {"by": given}) == f"f({words}, by={words})"


def test_the_innermost_call_counts():
    with pytest.raises(KeyError) as caught, asking("outer"), asking("inner", 1):
        raise KeyError
    assert asked_by(caught.value) == "inner(int)"
    assert asked_by(KeyError()) == ""


def test_a_node_s_failing_calls_are_noted(ros):
    class Wrong(Node):
        def __init__(self):
            super().__init__("wrong")
            self.create_timer(1.0, self.tick)

        def tick(self):
            self.create_publisher(Float32, "temperature")

    ros.add(Wrong)
    ros.run(1)
    (fault,) = ros.observation().faults
    assert fault.asked == "create_publisher(message_type[Float32], str)"


def test_an_error_of_the_learner_s_own_is_no_call(ros):
    class Wrong(Node):
        def __init__(self):
            super().__init__("wrong")
            self.create_timer(1.0, self.tick)

        def tick(self):
            raise ValueError("boom")

    ros.add(Wrong)
    ros.run(1)
    assert ros.observation().faults[0].asked == ""
