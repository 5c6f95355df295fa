import random

import pytest
from rclpy.node import Node

from rosbeat.ros.faults import fault_of, suggestion

pytestmark = pytest.mark.ros


class Deceiver:
    def __dir__(self):
        raise RuntimeError("boom")

    def __getattr__(self, name):
        raise AttributeError(f"no {name}", name=name, obj=self)


class Sensor(Node):
    def __init__(self):
        super().__init__("sensor")
        self.temperature, self.publisher_ = 22.0, None

    def publish_temperature(self):
        pass

    def use(self):
        publish_temperature()  # noqa: F821


def error_of(call):
    with pytest.raises((AttributeError, NameError)) as caught:
        call()
    return caught.value


@pytest.mark.parametrize(
    ("call", "meant"),
    [
        (lambda node: node.temprature, "temperature"),
        (lambda node: node.publisher, "publisher_"),
        (lambda node: node.publish_pressure, "publish_temperature"),
        (lambda node: node.read_pressure, ""),
        (lambda node: node.publsh_temperature, "publish_temperature"),
        (lambda node: node.create_publisherr, "create_publisher"),
        (lambda node: node.timerss, ""),
        (lambda node: node.temp, ""),
        (lambda node: node.use(), "self.publish_temperature"),
        (lambda node: random.unifrom(0, 1), "uniform"),
        (lambda node: nodee, "node"),  # noqa: F821
        (lambda node: ____, ""),  # noqa: F821
        (lambda node: Deceiver().anything, ""),
    ],
)
def test_what_was_meant(ros, call, meant):
    node = ros.add(Sensor)
    assert suggestion(error_of(lambda: call(node))) == meant


def test_it_ends_the_text_of_a_fault_as_in_a_traceback(ros):
    node = ros.add(Sensor)
    fault = fault_of(error_of(lambda: node.temprature), 0, "/sensor", "tick")
    assert fault.text == (
        "'Sensor' object has no attribute 'temprature'. Did you mean: 'temperature'?"
    )


def test_other_errors_have_none():
    assert suggestion(KeyError("temprature")) == ""
    assert suggestion(NameError("never raised", name="x")) == ""


def test_a_text_that_raises():
    class OddError(Exception):
        def __str__(self):
            raise RuntimeError

    assert fault_of(OddError(), 0, "/a", "tick").text == ""
