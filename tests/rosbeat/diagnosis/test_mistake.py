import pytest

from rosbeat.diagnosis.mistakes import Mistake


@pytest.mark.parametrize(
    ("title", "heading"),
    [
        ("the queue depth is missing", "The queue depth is missing"),
        ("super().__init__ is missing", "super().__init__ is missing"),
        ("rclpy.init a second time", "rclpy.init a second time"),
    ],
)
def test_a_heading_leaves_code_as_it_is(title, heading):
    assert Mistake("x", title).heading == heading
