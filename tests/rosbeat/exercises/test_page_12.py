"""The models of page 12: right ones, and those of misunderstandings. Needs no ROS."""

from dataclasses import replace
from itertools import combinations, pairwise

import pytest

from rosbeat.exercises import page_12
from rosbeat.exercises.model import agree
from rosbeat.exercises.page_12 import (
    DECISIONS,
    HEATERS,
    MONITORS,
    NOT_FILLED,
    NOT_VALIDATED,
    THERMOSTATS,
    right_monitor,
    right_thermostat,
    same,
)
from rosbeat.exercises.registry import EXERCISES
from rosbeat.records import Observation

#: What the page feeds.
(BY_SERVICE,), (BY_PARAMETER,), (DECIDED,), (GOALS,), (HEATING,) = (
    EXERCISES[one].inputs() for one in ("12a", "12b", "12c", "12d", "12e")
)
#: What the models of an exercise are fed, the right one, and the suspects.
MODELS = {
    # One after the other is a misunderstanding of two limits in one request: page 12b alone.
    "12a": (
        BY_SERVICE,
        right_monitor,
        [NOT_FILLED, *(one for one in MONITORS if one.mistake != "validated-one-by-one")],
    ),
    # The readings of 12b meet no limit before the first request.
    "12b": (
        BY_PARAMETER,
        right_monitor,
        [NOT_FILLED, NOT_VALIDATED, *(one for one in MONITORS if one.mistake != "boundary")],
    ),
    "12c": (DECIDED.goals, right_thermostat, DECISIONS),
    "12d": (GOALS.goals, right_thermostat, HEATERS),
    "12e": (HEATING.goals, right_thermostat, THERMOSTATS),
}

#: A good value that is refused may be used or not. A monitor that uses all of them is a special
#: case, and is tried first.
INCLUDED = {("response-not-filled", "good-value-refused")}


def alike(one, other, fed):
    """Whether two models do the same about everything that is fed."""
    return all(agree(one(each), other(each), same) for each in fed)


@pytest.mark.parametrize("exercise", MODELS)
def test_the_input_tells_suspects_from_the_right_model_and_from_each_other(exercise):
    fed, right, suspects = MODELS[exercise]
    assert [one.mistake for one in suspects if alike(one.model, right, fed)] == []
    pairs = [pair for pair in combinations(suspects, 2) if pair[0].mistake != pair[1].mistake]
    found = [pair for pair in pairs if alike(pair[0].model, pair[1].model, fed)]
    assert {(one.mistake, other.mistake) for one, other in found} <= INCLUDED


@pytest.mark.parametrize("seed", range(5))
@pytest.mark.parametrize("exercise", ["12a", "12b"])
def test_nothing_is_asked_for_at_first_and_then_always_something(exercise, seed):
    (requests,) = EXERCISES[exercise].inputs(seed)
    assert [bool(one.values) for one in requests] == [False] + [True] * (len(requests) - 1)
    assert all(one.before == before.after for before, one in pairwise(requests))


def test_a_refused_request_leaves_the_limits_as_they_are():
    refused = next(one for one in BY_PARAMETER if one.values and not one.is_good)
    assert refused.after == refused.before != refused.asked
    assert replace(refused, is_good=True).after == refused.asked


@pytest.mark.parametrize("exercise", MODELS)
def test_a_node_that_does_nothing_fails(exercise):
    outcome = EXERCISES[exercise].judged(Observation(40 * 10**9, 0, subject="/node"))
    assert (outcome.status, outcome.points) == ("failed", 0)


def test_a_goal_is_over_before_the_next_one_and_a_canceled_one_does_not_reach_its_target():
    """The room loses a degree in five seconds, so a right thermostat may take a bit longer."""
    for seed in range(100):
        (fed,) = EXERCISES["12e"].inputs(seed)
        assert (fed.goals != HEATING.goals) == bool(seed)
        first, early, canceled, *others = fed.goals
        last, warm_until = others[-1], first.at + first.order - fed.start
        coldest = first.order - (last.at - warm_until) // 5
        assert 10 < coldest < first.order
        assert early.is_early
        assert not early.is_good
        assert first.at < early.at < warm_until
        assert canceled.at - first.at > first.order - (fed.start - first.at // 5) + 2
        assert canceled.cancel_after + 1 < canceled.order - first.order
        assert all(later.at - one.at >= 2 for one, later in pairwise(others))
        assert sum(one.is_reached for one in others) == 1
        assert fed.seconds - last.at > last.order - coldest + 1


def test_the_step_before_has_the_same_goals_without_the_one_that_is_canceled():
    for seed in range(100):
        (goals,), (all_of_them,) = (EXERCISES[one].inputs(seed) for one in ("12d", "12e"))
        sent = [(one.at, one.order) for one in all_of_them.goals if one.cancel_after is None]
        assert [(one.at, one.order) for one in goals.goals] == sent
        assert [one.number for one in goals.goals] == list(range(1, len(sent) + 1))
        assert len(all_of_them.goals) == len(sent) + 1


def test_a_suspect_leaves_open_what_follows_from_its_mistake():
    suspect = next(one for one in THERMOSTATS if one.mistake == "left-on")
    assert suspect.model(HEATING.goals[0])[page_12.Work.HEATER] == ("on",)
    (suspect,) = (one for one in THERMOSTATS if one.mistake == "cancel-refused")
    assert suspect.model(HEATING.goals[1])[page_12.Work.HEATER] == (...,)
