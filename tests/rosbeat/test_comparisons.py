"""Two runs, message by message."""

import math
from itertools import pairwise

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rosbeat.comparisons import Difference, compare, distance
from rosbeat.errors import BagError
from rosbeat.records import NANOSECONDS, Endpoint, GraphSnapshot, Observation, QoS, Sample

FLOAT = "std_msgs/msg/Float32"


def sample(time, value, topic="/temperature"):
    return Sample(round(time * NANOSECONDS), topic, FLOAT, "/sensor", {"data": value})


def run(*pairs):
    return [sample(at, value) for at, value in pairs]


ONE = run((1, 20.0), (2, 21.0), (3, 22.0), (4, 23.0))


def test_the_same_is_the_same():
    found = compare(ONE, list(ONE), "temperature")
    assert found.is_same
    assert (found.first, found.largest, found.differences) == (None, None, ())
    assert repr(found) == "/temperature: the first run and the second run have the same 4 messages."


def test_what_is_missing_extra_and_different_is_found():
    other = run((1, 20.0), (2.5, 0.0), (3, 22.5), (4, 21.0))
    found = compare(ONE, other, "temperature", names=("recorded", "replayed"))
    assert found.counts == (4, 4)
    assert [one.time for one in found.missing] == [2]
    assert [one.time for one in found.extra] == [2.5]
    assert found.differences == (
        Difference(2 * NANOSECONDS, "missing"),
        Difference(5 * NANOSECONDS // 2, "extra"),
        Difference(3 * NANOSECONDS, "value", 0.5),
        Difference(4 * NANOSECONDS, "value", 2.0),
    )
    assert found.first.time == 2
    assert (found.largest.time, found.largest.amount) == (4, 2.0)
    assert repr(found) == (
        "/temperature: 4 messages in recorded, 4 in replayed. 1 is missing in replayed. "
        "1 is only in replayed, not in recorded. 2 of the 3 that both have differ, by 2 at most, "
        "at 4 s. The first difference is at 2 s."
    )


def test_other_words():
    assert repr(compare(ONE, ONE[:2], "temperature")) == (
        "/temperature: 4 messages in the first run, 2 in the second run. "
        "2 are missing in the second run. The 2 that both have are the same. "
        "The first difference is at 3 s."
    )
    assert repr(compare(ONE[:1], run((1, math.nan)), "temperature")) == (
        "/temperature: 1 message in the first run, 1 in the second run. 1 of the 1 that both have "
        "differs."
    )


def test_times_may_be_a_little_apart():
    later = run((1.1, 20.0), (2.2, 21.0), (3.05, 22.0), (4.0, 23.0))
    assert len(compare(ONE, later, "temperature").missing) == 3
    assert compare(ONE, later, "temperature", within=0.2).is_same


def test_at_one_instant_they_are_paired_in_order():
    one, other = run((1, 1.0), (1, 2.0), (1, 3.0)), run((1, 1.0), (1, 2.0))
    found = compare(one, other, "temperature")
    assert [a.value == b.value for a, b in found.pairs] == [True, True]
    assert [left.value for left in found.missing] == [3.0]


@pytest.mark.parametrize(
    ("one", "other", "apart"),
    [
        (1.0, 1.0, 0.0),
        (1, 3.5, 2.5),
        (math.nan, math.nan, 0.0),
        (math.nan, 1.0, math.nan),
        (math.inf, math.inf, 0.0),
        (math.inf, -math.inf, math.inf),
        ("a", "a", 0.0),
        ("a", "b", math.nan),
        (True, False, math.nan),
        ([1, 2], [1, 5], 3),
        ([1], [1, 2], math.nan),
        ([math.nan, 1.0], [0.0, 3.0], 2.0),
        ({"x": {"y": 1.0}, "n": "a"}, {"x": {"y": 2.0}, "n": "b"}, 1.0),
        ({"x": 1.0}, {"y": 1.0}, math.nan),
        ({}, {}, 0.0),
        ([], [], 0.0),
    ],
)
def test_distance(one, other, apart):
    for found in (distance(one, other), distance(other, one)):
        assert found == apart or (math.isnan(found) and math.isnan(apart))


TIMES = st.lists(st.integers(0, 30), max_size=12).map(sorted)


@settings(deadline=None, derandomize=True, database=None)
@given(TIMES, TIMES, st.integers(0, 3))
def test_every_message_is_counted_once(left, right, within):
    one, other = run(*((at, 1.0) for at in left)), run(*((at, 1.0) for at in right))
    if not one and not other:
        return
    found = compare(one, other, "temperature", within=within)
    assert sorted([a.time for a, _ in found.pairs] + [s.time for s in found.missing]) == left
    assert sorted([b.time for _, b in found.pairs] + [s.time for s in found.extra]) == right
    assert all(abs(a.time - b.time) <= within for a, b in found.pairs)
    assert all(a.time_ns <= b.time_ns for a, b in pairwise(found.differences))


def test_a_silent_publisher_is_a_topic_too():
    end = Endpoint("/sensor", "/temperature", FLOAT, "publisher", QoS())
    silent = Observation(0, 0, graph=GraphSnapshot((), (end,)))
    assert compare(silent, silent, "temperature").is_same
    assert len(compare(ONE, silent, "temperature").missing) == 4
    assert repr(compare(silent, silent, "temperature")).endswith("have no messages.")


@pytest.mark.parametrize(
    ("one", "topic", "given", "words"),
    [
        (ONE, "humidity", {}, "Neither run has a topic 'humidity'"),
        (ONE, 3, {}, "Neither run has a topic 3"),
        (3, "temperature", {}, "'int' is not a run"),
        ([3], "temperature", {}, "'list' is not a run"),
        (ONE, "temperature", {"within": -1}, "within=-1"),
        (ONE, "temperature", {"within": "a second"}, "within='a second'"),
    ],
)
def test_bad_input_gets_three_parts(says, one, topic, given, words):
    with pytest.raises(BagError) as caught:
        compare(one, ONE, topic, **given)
    says(caught.value, words)
