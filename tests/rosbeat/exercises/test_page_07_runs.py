"""The scenarios of page 07 do to a node what the judges believe that they do."""

import pytest
from rcl_interfaces.msg import Log
from rclpy.node import Node
from std_msgs.msg import Float32

from rosbeat.exercises.page_07_scenarios import CHANGES, LINES, READINGS, SCENARIOS

pytestmark = pytest.mark.ros


def test_a_monitor_hears_each_reading_and_gets_each_change():
    class Monitor(Node):
        def __init__(self):
            super().__init__("monitor")
            self.declare_parameter("low", 0.0)
            self.declare_parameter("high", 0.0)
            self.create_subscription(Float32, "temperature", self.hear, 10)

        def hear(self, msg):
            low, high = (self.get_parameter(name).value for name in ("low", "high"))
            self.get_logger().info(f"{msg.data} {low} {high}")

    seen = SCENARIOS["07b"](Monitor)
    limits, expected, planned = {"low": 0.0, "high": 0.0}, [], dict(CHANGES)
    for second, value in enumerate(READINGS, 1):
        limits |= planned.get(second, {})
        expected.append(f"{value} {limits['low']} {limits['high']}")
    assert [log.text for log in seen.logs] == expected


def test_a_watcher_hears_each_line_and_nothing_else():
    heard = []

    class Watcher(Node):
        def __init__(self):
            super().__init__("watcher")
            self.create_subscription(Log, "/rosout", self.hear, 10)

        def hear(self, msg):
            heard.append((msg.level, msg.name, msg.msg))

    seen = SCENARIOS["07c"](Watcher)
    assert not seen.faults
    assert heard == [(line.level, line.name, line.msg) for line in LINES]
