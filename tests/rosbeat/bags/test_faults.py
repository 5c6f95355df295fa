"""Faults on their way into messages: pure, seeded, one after the other, in any field."""

import math
from dataclasses import replace

import pytest

from record_builders import run_of, sample
from rosbeat.bags import drift, dropouts, inject, record, stuck, with_nan
from rosbeat.errors import BagError

WALK = tuple(sample(time, float(time)) for time in range(1, 101))
IMU = {"angular": {"x": 1.0, "y": 2.0}, "valid": True, "label": "a", "list": [1.0]}


def numbers(samples):
    return [one.value for one in samples]


@pytest.mark.parametrize(
    ("fault", "at", "values"),
    [
        (stuck(at=10, seconds=5), 9, [9, 9, 9, 9, 9, 9, 15, 16]),
        (stuck(at=98), 97, [97, 97, 97, 97]),
        (stuck(), 1, [1] * 100),
        (drift(0.5), 1, [1.5, 3.0, 4.5]),
        (drift(-2, at=98), 97, [97, 98, 97, 96]),
    ],
    ids=repr,
)
def test_stuck_says_again_what_it_said_last_and_drift_grows_with_time(fault, at, values):
    assert numbers(fault(WALK))[at - 1 : at - 1 + len(values)] == values


def test_dropouts_lose_a_share_or_whole_spans():
    kept = dropouts(share=0.3, seed=1)(WALK)
    assert 55 <= len(kept) <= 85
    assert all(one in WALK for one in kept)
    assert numbers(dropouts(spans=[(1, 4), (5, 100)])(WALK)) == [4, 100]
    assert dropouts(share=1)(WALK) == ()
    assert dropouts()(WALK) == WALK


def test_nan_comes_once_for_a_while_or_for_ever():
    def where(fault):
        return [one.time for one in fault(WALK) if math.isnan(one.value)]

    assert where(with_nan(at=9.5)) == [10]
    assert where(with_nan(at=10, seconds=3)) == [10, 11, 12]
    assert where(with_nan(at=98, seconds=None)) == [98, 99, 100]
    assert where(with_nan(at=101)) == []


def test_the_same_seed_gives_the_same_whatever_other_topics_do():
    fault = dropouts(0.5, seed=4)
    assert fault(WALK) == fault(WALK) == dropouts(0.5, seed=4)(WALK)
    assert dropouts(0.5, seed=5)(WALK) != fault(WALK)
    others = tuple(sample(at, 0.0, "/other") for at in range(200))
    both = sorted(WALK + others, key=lambda one: one.time_ns)
    assert tuple(one for one in fault(both) if one.topic == "/temperature") == fault(WALK)


def test_random_faults_are_the_same_on_every_python():
    kept = [6, 17, 23, 34, 36, 37, 46, 51, 52, 64, 67, 89, 97]
    assert numbers(dropouts(0.9, seed=1)(WALK)) == kept


def test_nothing_comes_of_nothing():
    for fault in (stuck(), drift(1), dropouts(0.5), with_nan()):
        assert fault([]) == ()
    assert stuck(topic="temperature")([]) == ()


def test_they_say_what_they_do():
    assert list(map(repr, [
        stuck(at=20, seconds=5), stuck(at=20), drift(0.1, topic="temperature"), dropouts(0.25),
        dropouts(spans=[(3, 4.5)]), dropouts(), with_nan(3), with_nan(3, 2),
    ])) == [
        "stuck at 20 s for 5 s", "stuck from 20 s on",
        "/temperature: drift of 0.1 a second from 0 s on", "25% of the messages lost",
        "no messages from 3 s to 4.5 s", "0% of the messages lost", "NaN once at 3 s",
        "NaN at 3 s for 2 s",
    ]  # fmt: skip


def test_faults_come_one_after_the_other_and_change_nothing_that_was_given():
    before = tuple(replace(one, data=dict(one.data)) for one in WALK)
    inject(WALK, stuck(5), drift(1), with_nan(7), dropouts(0.5))
    assert before == WALK
    found = inject(WALK, drift(1, at=50), stuck(at=60), dropouts(spans=[(0, 59)]))
    assert [(one.time, one.value) for one in found[:3]] == [(59, 68), (60, 68), (61, 68)]
    assert inject(WALK, stuck(at=60), drift(1, at=50))[-1].value == 59 + 50
    assert inject(WALK, lambda samples: samples[::50]) == (WALK[0], WALK[50])  # any function


def test_only_the_topic_that_is_meant():
    samples = [sample(1, 1.0, "/a"), sample(1, "warm", "/b"), sample(2, 2.0, "/a")]
    assert numbers(drift(1, topic="a")(samples)) == [2.0, "warm", 4.0]
    assert numbers(stuck()(samples)) == [1.0, "warm", 1.0]


def test_the_order_of_one_instant_is_kept():
    samples = [sample(at, float(k), f"/{t}") for at in (1, 2) for k, t in enumerate("cabac")]
    assert list(drift(0)(samples)) == samples
    assert numbers(drift(0, at=1, topic="a")(samples)) == numbers(samples)


def test_whatever_has_messages_can_be_broken(tmp_path):
    run = run_of([1.0, 2.0])
    bag = record(run, tmp_path / "run")
    assert inject(bag, stuck()) == inject(run, stuck()) == inject(list(run.samples), stuck())
    assert inject(bag) == run.samples


def test_a_field_of_a_larger_message_and_whole_numbers():
    one = sample(10, IMU)
    (found,) = drift(1, field="angular.y")([one])
    assert found.data == {**IMU, "angular": {"x": 1.0, "y": 12.0}}
    assert one.data["angular"]["y"] == 2.0
    (found,) = drift(0.26)([sample(10, 5)])
    assert (found.value, type(found.value)) == (8, int)


def on(value, fault):
    return lambda: fault([sample(1, value)])


@pytest.mark.parametrize(
    ("ask", "words"),
    [
        (lambda: stuck(at=-1), "at=-1"),
        (lambda: stuck(at="soon"), "at='soon'"),
        (lambda: stuck(seconds=math.inf), "seconds=inf"),
        (lambda: stuck(topic=3), "not the name of a topic"),
        (lambda: drift(math.nan), "rate=nan"),
        (lambda: drift(True), "rate=True"),
        (lambda: dropouts(share=1.1), "a number from 0 to 1"),
        (lambda: dropouts(share=None), "share=None"),
        *((lambda spans=spans: dropouts(spans=spans), "pairs of ascending times")
          for spans in ([(4, 3)], [3], 3)),
        (lambda: dropouts(spans=[(-1, 3)]), "spans=-1"),
        (lambda: with_nan(seconds=-1), "seconds=-1"),
        # A message that cannot have the fault.
        (on("warm", drift(1)), "no field that holds a number"),
        (on(True, drift(1)), "no field that holds a number"),
        (on(IMU, drift(1)), "'angular.x', 'angular.y'"),
        (on(IMU, drift(1, field="angular.z")), "the field 'angular.z'"),
        (on(IMU, with_nan(field="angular")), "the field 'angular'"),
        (on(3, with_nan()), "whole numbers, and NaN is not a whole number"),
        # What is no fault, no run, no topic.
        (lambda: inject((), 3), "is not a fault"),
        (lambda: inject(3, stuck()), "is not a run"),
        (lambda: inject(None, stuck(topic="a")), "is not a run"),
        (lambda: inject(WALK, stuck(topic="temprature")), "Did you mean '/temperature'"),
    ],
)  # fmt: skip
def test_bad_input_gets_three_parts(says, ask, words):
    with pytest.raises(BagError) as caught:
        ask()
    says(caught.value, words)
