"""Walks made by hand, and what is said of them. Needs no ROS."""

import math
import random

import pytest

from rosbeat.exercises.walk_runs import DOWN, FREE, LONG, PHASE, READINGS, UP, is_open
from rosbeat.exercises.walks import Walk

ROOM = Walk(18.0, 28.0, 0.3)


def drawn(number):
    """A number between 0 and 1 with the tendency that it has in a scenario."""
    exponent = UP if number < PHASE else DOWN if number < 2 * PHASE else FREE
    return random.random() ** exponent


def walk(step=lambda u: 0.6 * u - 0.3, clamp=lambda x: max(18.0, min(28.0, x)), start=22.0):
    random.seed(4)
    found, here = [], start
    for number in range(READINGS):
        here = clamp(here + step(drawn(number)))
        found.append(here)
    return found


def named(values, room=ROOM):
    found = room.diagnose(values)
    return found.mistake if found else ""


def test_a_right_walk():
    values = walk()
    assert named(values) == ""
    assert (min(values), max(values)) == (18.0, 28.0)
    assert "from 18.00 to 28.00 degrees, in steps of at most 0.30" in ROOM.evidence(values)


def test_numbers_that_do_not_drift_are_right_too():
    random.seed(4)
    found, here = [], 22.0
    for _ in range(READINGS):
        here = max(18.0, min(28.0, here + random.choice((-0.3, 0.3))))
        found.append(here)
    assert named(found) == ""


def kept_elsewhere():
    inner = walk(clamp=lambda x: x)
    return [max(18.0, min(28.0, x)) for x in inner]


def too_early():
    random.seed(4)
    found, here = [], 22.0
    for number in range(READINGS):
        here = max(18.0, min(28.0, here)) + 0.6 * drawn(number) - 0.3
        found.append(here)
    return found


WRONG = {
    "never-changes": lambda: [22.0] * READINGS,
    "clamp-swapped": lambda: walk(clamp=lambda x: max(28.0, min(18.0, x))),
    "one-way": lambda: walk(step=lambda u: 0.3 * u),
    "forgets-itself": lambda: [18.0 + 10.0 * drawn(n) for n in range(READINGS)],
    "step-too-wide": lambda: walk(step=lambda u: u - 0.5),
    "step-too-small": lambda: walk(step=lambda u: 0.2 * u - 0.1),
    "no-clamp": lambda: walk(clamp=lambda x: min(28.0, x)),
    "clamped-too-early": too_early,
    "clamp-not-kept": kept_elsewhere,
    "other-limits": lambda: walk(clamp=lambda x: max(18.0, min(27.0, x))),
    "not-random": lambda: [23.0 + 5.0 * math.sin(n / 17) for n in range(READINGS)],
    "wrong-values": lambda: [*walk()[:-1], math.nan],
}


@pytest.mark.parametrize("name", WRONG)
def test_a_wrong_walk_has_a_name(name):
    found = ROOM.diagnose(WRONG[name]())
    assert (found and found.mistake) == name
    assert found.hint
    assert found.evidence


@pytest.mark.parametrize(("clamp", "limit"), [(lambda x: min(28.0, x), "18"), (lambda x: x, "28")])
def test_the_limit_that_nothing_keeps_is_named(clamp, limit):
    assert limit in ROOM.diagnose(walk(clamp=clamp)).hint


def test_a_falling_walk_goes_one_way_too():
    assert "falls" in ROOM.diagnose(walk(step=lambda u: -0.3 * u)).hint


def test_standing_at_the_lower_limit_has_two_reasons():
    found = ROOM.diagnose([18.0] * READINGS)
    assert found.mistake == "never-changes"
    assert "min and max" in found.hint


def test_readings_around_one_value_forget_themselves():
    assert named([22.0 + 0.6 * drawn(n) - 0.3 for n in range(READINGS)]) == "forgets-itself"


def test_readings_with_the_drift_decide_if_nothing_more_was_asked_for():
    values = walk()
    assert ROOM.decisive(values) is values


def test_they_decide_too_if_they_show_both_ends():
    values = walk()
    assert ROOM.decisive(values + [22.0] * LONG) == values


def test_those_after_them_decide_if_a_limit_was_not_met():
    rest = [20.0] * LONG
    assert is_open(wandering())
    assert ROOM.decisive(wandering() + rest) == rest


def test_a_walk_that_something_cuts_off_is_decided_with_the_drift():
    values = walk(clamp=lambda x: max(18.0, min(27.0, x)))
    assert ROOM.decisive(values + [22.0] * LONG) == values


def wandering():
    return walk(clamp=lambda x: max(18.0, min(28.0, x)))[:1] + FAR


#: It wanders about in the middle, and nothing holds it there.
FAR = [22.0 + 2.0 * math.asin(math.sin(n * math.sqrt(2) / 10)) for n in range(READINGS - 1)]


def test_rounding_to_32_bits_is_no_step_too_wide():
    assert named([value + 1e-5 * (-1) ** n for n, value in enumerate(walk())]) == ""
