"""The weather of the trials, for the usual numbers and for others."""

from math import isfinite

import pytest

from rosbeat.exercises.greenhouse import days
from rosbeat.exercises.greenhouse.days import USUAL

OTHERS = {
    **USUAL, "open_above": 23.3, "close_below": 21.1, "dry_below": 55.7, "react_seconds": 3.0,
    "pump_seconds": 8.0, "rest_seconds": 12.0, "silent_seconds": 9.0,
}  # fmt: skip
DAYS = (days.plain_day, days.broken_day, days.lossy_day, days.other_day)


@pytest.mark.parametrize("numbers", [USUAL, OTHERS], ids=["usual", "others"])
@pytest.mark.parametrize("make", DAYS)
def test_both_sensors_have_a_reading_or_a_silence_for_each_second(make, numbers):
    day = make(numbers)
    assert len(day.temperature) == len(day.humidity) == day.seconds - 1
    assert all(0 < at < day.seconds for at in day.marks.values())
    assert sorted(day.marks.values()) == list(day.marks.values())


def test_a_plain_day_holds_only_what_can_be():
    day = days.plain_day(USUAL)
    assert all(USUAL["temperature_min"] < one < USUAL["temperature_max"] for one in day.temperature)
    assert all(0 <= one <= 100 for one in day.humidity)


def test_the_vent_is_tried_on_every_side_of_both_limits():
    assert {28.0, 28.25, 27.0, 26.0, 25.75} <= set(days.vent_readings(USUAL))


def test_a_limit_that_no_float32_holds_is_not_met():
    sent = {days.as_sent(OTHERS[name]) for name in ("open_above", "close_below")}
    assert not sent & {days.as_sent(value) for value in days.vent_readings(OTHERS)}


def test_each_temperature_is_held_longer_than_a_system_may_take():
    day = days.airing(USUAL)
    assert [value for _, _, value in day.held] == days.vent_readings(USUAL)
    for begins, ends, value in day.held:
        assert set(day.temperature[begins - 1 : ends - 1]) == {value}
        assert ends - begins > USUAL["react_seconds"]


def test_a_broken_day_has_nonsense_and_two_silences():
    day = days.broken_day(USUAL)
    nonsense = [one for one in day.temperature if one is not None and not -20 <= one <= 60]
    assert len(nonsense) == 6
    assert sum(not isfinite(one) for one in nonsense) == 4
    silent = [at for at, one in enumerate(day.temperature, 1) if one is None]
    both = [at for at, one in enumerate(day.humidity, 1) if one is None]
    assert silent[0] == day.marks["temperature silent"]
    assert both[0] == day.marks["both silent"]
    assert len(silent) == 2 * len(both) == 2 * (2 * 10 + 1)  # a whole report


def test_only_other_limits_mean_anything_on_the_last_day():
    day = days.other_day(USUAL)
    assert max(day.temperature) <= USUAL["open_above"]
    assert min(day.humidity) > USUAL["dry_below"]
    other = days.other_limits(USUAL)
    assert max(day.temperature) > other["open_above"]
    assert min(day.humidity) < other["dry_below"]
