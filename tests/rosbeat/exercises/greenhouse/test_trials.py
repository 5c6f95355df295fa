"""What somebody's greenhouse goes through, and what is written down of it."""

import pytest
from rclpy.node import Node
from std_msgs.msg import Float32

from rosbeat.exercises.evidence import from_json, to_json
from rosbeat.exercises.greenhouse import days
from rosbeat.exercises.greenhouse.trials import BROKEN, LOSSY, OTHER, PLAIN, aired, tried

pytestmark = pytest.mark.ros

COOL = {**days.USUAL, "open_above": 20.0, "close_below": 15.0}


class Listener(Node):
    """Hears temperatures, and publishes nothing."""

    def __init__(self):
        super().__init__("listener")
        self.create_subscription(Float32, "temperature", lambda _: None, 10)


@pytest.mark.parametrize("numbers", [days.USUAL, COOL], ids=["usual", "cool"])
def test_the_weather_is_made_of_the_numbers_that_are_handed_over(numbers):
    seen = aired(Listener, numbers)
    fed = [one.value for one in seen.plain.samples if one.topic == "/temperature"]
    assert fed == days.airing(numbers).temperature
    assert seen.numbers == numbers
    assert from_json(to_json(seen)) == seen


def test_without_others_the_course_s_own_numbers_count():
    assert aired(Listener).numbers == days.USUAL


def test_a_system_goes_through_every_trial():
    seen = tried(lambda: [Listener])
    assert list(seen.runs) == [PLAIN, BROKEN, LOSSY, OTHER]
    assert from_json(to_json(seen)).numbers == seen.numbers


def test_what_is_no_system_is_not_tried_again():
    seen = tried(lambda: 3)
    assert list(seen.runs) == [PLAIN]
    assert [one.kind for one in seen.plain.faults] == ["NoSystemError"]
