"""How the vent should stand, and what is said if it does not. Needs no ROS."""

import pytest

from rosbeat.exercises.greenhouse.days import USUAL, airing
from rosbeat.exercises.greenhouse.reading import Switch
from rosbeat.exercises.greenhouse.vent import stands, wrong_vent

DAY = airing(USUAL)


@pytest.mark.parametrize(
    ("value", "before", "opened"),
    [
        (28.0, False, False),
        (28.25, False, True),
        (27.0, False, False),
        (27.0, True, True),
        (26.0, True, True),
        (25.75, True, False),
        (32.0, True, True),
        (22.0, False, False),
    ],
)
def test_it_opens_above_one_limit_and_closes_below_the_other(value, before, opened):
    assert stands(value, before, USUAL) is opened


def commands(rule, delay=0.0):
    """What a vent is told that follows a rule, so long after each temperature."""
    said, is_open = [], False
    for begins, _, value in DAY.held:
        is_open = rule(value, is_open)
        said.append((begins + delay, is_open))
    return Switch(tuple(said))


def test_a_vent_may_take_some_time_and_no_more():
    def right(value, before):
        return stands(value, before, USUAL)

    assert wrong_vent(commands(right), DAY, USUAL) is None
    assert wrong_vent(commands(right, USUAL["react_seconds"]), DAY, USUAL) is None
    assert wrong_vent(commands(right, USUAL["react_seconds"] + 0.5), DAY, USUAL) is not None


@pytest.mark.parametrize(
    ("rule", "mistake"),
    [
        (lambda value, _: value >= 28.0, "boundary"),
        (lambda value, before: value > 28.0 or (before and value > 26.0), "boundary"),
        (lambda value, _: value > 28.0, "no-hysteresis"),
        (lambda value, _: value > 26.0, "no-hysteresis"),
        (lambda value, before: False, "wrong-state"),
    ],
)
def test_each_mistake_has_its_name(rule, mistake):
    found = wrong_vent(commands(rule), DAY, USUAL)
    assert found is not None
    assert found.mistake == mistake
