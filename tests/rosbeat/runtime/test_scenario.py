import sys

import pytest
from rclpy.node import Node
from std_msgs.msg import Float32

from rosbeat.runtime.scenario import feeder, observe

pytestmark = pytest.mark.ros


class Echo(Node):
    def __init__(self):
        super().__init__("echo")
        self.heard = self.create_publisher(Float32, "echo", 10)
        self.create_subscription(Float32, "in", self.heard.publish, 10)


def test_a_feeder_publishes_one_value_a_second_and_then_falls_silent():
    observation = observe(
        Echo, 9, others=[feeder("f", "in", "std_msgs/msg/Float32", [1.0, 2.5, -3.0])]
    )
    heard = [(s.time, s.value) for s in observation.samples if s.topic == "/echo"]
    assert heard == [(1, 1.0), (2, 2.5), (3, -3.0)]


def test_the_same_scenario_gives_the_same_observation():
    feed = feeder("f", "in", "std_msgs/msg/Float32", [1.0])
    assert observe(Echo, 3, others=[feed]) == observe(Echo, 3, others=[feed])


def test_whatever_goes_wrong_becomes_a_fault_and_nothing_is_printed(capsys):
    class Exits(Node):
        def __init__(self):
            print("noise")
            sys.exit(3)

    class Circle(Node):
        def __init__(self):
            super().__init__("circle")
            pub = self.create_publisher(Float32, "round", 10)
            self.create_subscription(Float32, "round", pub.publish, 10)
            self.create_timer(1.0, lambda: pub.publish(Float32()))

    kinds = [observe(answer, 2).faults[0].kind for answer in (None, Exits, Circle)]
    assert kinds == ["NodeClassError", "SystemExit", "EndlessChainError"]
    printed = capsys.readouterr()
    assert printed.out == printed.err == ""
