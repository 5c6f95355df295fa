"""How long a walk is looked at. What is said of walks is tested with their judge."""

import random
from itertools import pairwise

import pytest

from rosbeat.exercises.walk_runs import (
    DOWN,
    FREE,
    LONG,
    PHASE,
    READINGS,
    UP,
    is_open,
    stays,
    watch_walk,
    widest,
)  # fmt: skip


def drawn(number):
    """A number between 0 and 1 with the tendency that it has in a scenario."""
    exponent = UP if number < PHASE else DOWN if number < 2 * PHASE else FREE
    return random.random() ** exponent


def walk(low=18.0, high=28.0, draw=drawn):
    random.seed(4)
    found, here = [], 22.0
    for number in range(READINGS):
        here = max(low, min(high, here + 0.6 * draw(number) - 0.3))
        found.append(here)
    return found


def undriven(_):
    return random.random()


OPEN = {
    "chance has not met the upper end": lambda: walk(high=60.0, draw=undriven),
    "chance has met no end": lambda: walk(-60.0, 60.0, draw=undriven),
}
CLEAR = {
    "both ends": walk,
    "other ends than any that are asked for": lambda: walk(20.0, 23.0),
    "no upper end: it got far with the drift": lambda: walk(high=1e6),
    "standing": lambda: [22.0] * READINGS,
    "back and forth": lambda: [18.0, 28.0] * (READINGS // 2),
    "jumping from one reading to the next": lambda: [random.random() for _ in range(READINGS)],
    "too few": lambda: walk(draw=undriven)[1:],
    "no number among them": lambda: [*walk(high=60.0, draw=undriven)[1:], float("nan")],
    "texts": lambda: ["warm"] * READINGS,
    "nothing": list,
}


@pytest.mark.parametrize("name", OPEN)
def test_a_walk_that_may_go_further_is_open(name):
    assert is_open(OPEN[name]())


@pytest.mark.parametrize("name", CLEAR)
def test_another_one_is_not(name):
    assert not is_open(CLEAR[name]())


def test_an_end_is_where_the_same_number_comes_again_and_again():
    assert stays([28.0, 27.0] * 5, 28.0)
    assert not stays([28.0, 27.0] * 4, 28.0)


def test_the_widest_step():
    assert widest([1.0]) == 0
    assert widest([1.0, 3.0, 2.5]) == 2.0
    assert widest(walk()) == max(abs(b - a) for a, b in pairwise(walk()))


def room(draw):
    """The class of a sensor in a room, written when ROS is there."""
    from rclpy.node import Node
    from std_msgs.msg import Float32

    class Room(Node):
        def __init__(self):
            super().__init__("room")
            self.temperature = 22.0
            self.publisher = self.create_publisher(Float32, "temperature", 10)
            self.create_timer(1.0, self.tick)

        def tick(self):
            self.temperature = max(18.0, min(28.0, self.temperature + 0.3 * draw()))
            self.publisher.publish(Float32(data=self.temperature))

    return Room


def readings(seen):
    return [sample.value for sample in seen.samples]


@pytest.mark.ros
def test_a_walk_with_the_drift_is_looked_at_once():
    seen = watch_walk(room(lambda: random.uniform(-1.0, 1.0)), "/temperature", 1)
    values = readings(seen)
    assert len(values) == READINGS
    assert stays(values, 18.0)
    assert stays(values, 28.0)


@pytest.mark.ros
def test_a_walk_of_numbers_that_do_not_drift_is_looked_at_for_longer():
    own = random.Random(4)
    seen = watch_walk(room(lambda: own.choice((-0.25, 0.25))), "/temperature", 1)
    assert len(readings(seen)) == READINGS + LONG


@pytest.mark.ros
def test_a_node_that_is_silent_is_looked_at_once():
    seen = watch_walk(room(lambda: 0.0), "/elsewhere", 1)
    assert len(readings(seen)) == READINGS
