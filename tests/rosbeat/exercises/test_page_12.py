"""Page 12: what is drawn for monitors and thermostats. Needs no ROS."""

from itertools import pairwise

import pytest

from rosbeat.exercises.registry import EXERCISES
from rosbeat.records import Observation


@pytest.mark.parametrize("seed", range(5))
@pytest.mark.parametrize("exercise", ["12a", "12b"])
def test_nothing_is_asked_for_at_first_and_then_always_something(exercise, seed):
    (requests,) = EXERCISES[exercise].inputs(seed)
    assert [bool(one.values) for one in requests] == [False] + [True] * (len(requests) - 1)
    assert all(one.before == before.after for before, one in pairwise(requests))


@pytest.mark.parametrize("exercise", ["12a", "12b", "12c", "12d", "12e"])
def test_a_node_that_does_nothing_fails(exercise):
    outcome = EXERCISES[exercise].judged(Observation(40 * 10**9, 0, subject="/node"))
    assert (outcome.status, outcome.points) == ("failed", 0)


def test_a_goal_is_over_before_the_next_one_and_a_canceled_one_does_not_reach_its_target():
    """The room loses a degree in five seconds, so a right thermostat may take a bit longer."""
    for seed in range(100):
        (fed,), (step_before,) = (EXERCISES[one].inputs(seed) for one in ("12e", "12d"))
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
        # The step before has the same goals without the one that is canceled.
        sent = [(one.at, one.order) for one in (first, early, *others)]
        assert [(one.at, one.order) for one in step_before.goals] == sent
        assert [one.number for one in step_before.goals] == list(range(1, len(sent) + 1))
