"""What a monitor is asked for on page 12, and when. Needs no ROS."""

import pytest

from rosbeat.exercises.page_12_scenarios import BY_PARAMETER, BY_SERVICE, readings_of, request_times

REQUESTS = (
    ({}, (25.0, 27.0)),
    ({"high": 24.0}, (25.0, 23.0)),
    ({"high": 90.0}, (25.0,)),
    ({"high": 9.0}, (25.0,)),
)


def test_readings_come_one_a_second_and_requests_between_them():
    assert readings_of(REQUESTS) == [25.0, 27.0, 25.0, 23.0, 25.0, 25.0]
    assert request_times(REQUESTS) == [0.5, 2.5, 4.5, 5.5]


@pytest.mark.parametrize("requests", [BY_SERVICE, BY_PARAMETER])
def test_nothing_is_asked_for_at_first_and_then_always_something(requests):
    assert [bool(values) for values, _ in requests] == [False] + [True] * (len(requests) - 1)
    assert all(readings for _, readings in requests)
