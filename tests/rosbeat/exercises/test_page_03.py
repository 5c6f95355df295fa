"""Page 03: how long a walk is watched, and a subscription in the place of a publisher."""

import random

import pytest

from rosbeat.exercises import page_03
from rosbeat.exercises.registry import EXERCISES


def sensor(draw):
    from rclpy.node import Node
    from std_msgs.msg import Float32

    class Sensor(Node):
        def __init__(self):
            super().__init__("room")
            self.temperature = 22.0
            self.publisher = self.create_publisher(Float32, "temperature", 10)
            self.create_timer(1.0, self.tick)

        def tick(self):
            self.temperature = max(18.0, min(28.0, self.temperature + 0.3 * draw()))
            self.publisher.publish(Float32(data=self.temperature))

    return Sensor


@pytest.mark.ros
def test_a_walk_is_watched_until_it_has_met_both_limits():
    own = random.Random(12)
    lengths = [
        len(EXERCISES["03b"].observed(sensor(draw)).samples)
        for draw in (
            lambda: random.uniform(-1.0, 1.0),
            lambda: own.uniform(-1.0, 1.0),
            lambda: 0.0,
            lambda: own.uniform(-1.0, 0.5),
        )
    ]
    first, second, _ = page_03._RUNS
    assert lengths == [first, second, first, first]
