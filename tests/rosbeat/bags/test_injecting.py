"""Faults on their way into messages."""

from dataclasses import replace

import pytest

from rosbeat.bags import Bag, delayed, drift, dropouts, inject, record, spikes, stuck, with_nan
from rosbeat.errors import BagError


@pytest.fixture
def walk(make):
    return tuple(make.sample(at, float(at)) for at in range(1, 101))


def numbers(samples):
    return [one.value for one in samples]


def test_what_is_given_stays_as_it_is(walk):
    before = tuple(replace(one, data=dict(one.data)) for one in walk)
    inject(walk, stuck(5), drift(1), with_nan(7), spikes(1, 1), delayed(1), dropouts(0.5))
    assert walk == before


def test_one_after_the_other(walk):
    found = inject(walk, drift(1, at=50), stuck(at=60), dropouts(spans=[(0, 59)]))
    assert [(one.time, one.value) for one in found[:3]] == [(59, 68), (60, 68), (61, 68)]
    other = inject(walk, stuck(at=60), drift(1, at=50))
    assert other[-1].value == 59 + 50


def test_only_the_topic_that_is_meant(make):
    samples = [make.sample(1, 1.0, "/a"), make.sample(1, "warm", "/b"), make.sample(2, 2.0, "/a")]
    assert numbers(drift(1, topic="a")(samples)) == [2.0, "warm", 4.0]
    assert numbers(stuck()(samples)) == [1.0, "warm", 1.0]


def test_the_order_of_one_instant_is_kept(make):
    samples = [make.sample(at, float(k), f"/{t}") for at in (1, 2) for k, t in enumerate("cabac")]
    assert list(drift(0)(samples)) == samples
    assert numbers(drift(0, at=1, topic="a")(samples)) == numbers(samples)


def test_whatever_has_messages_can_be_broken(tmp_path, make):
    run = make.run([1.0, 2.0])
    bag = record(run, tmp_path / "run")
    assert isinstance(bag, Bag)
    assert inject(bag, stuck()) == inject(run, stuck()) == inject(list(run.samples), stuck())
    assert inject(bag) == run.samples


def test_any_function_will_do(walk):
    assert inject(walk, lambda samples: samples[::50]) == (walk[0], walk[50])


@pytest.mark.parametrize(
    ("source", "fault", "words"),
    [((), 3, "is not a fault"), (3, stuck(), "is not a run"), (None, stuck(topic="a"), "no run")],
)
def test_bad_input_gets_three_parts(says, source, fault, words):
    with pytest.raises(BagError) as caught:
        inject(source, fault)
    says(caught.value, words.replace("no run", "is not a run"))


def test_a_topic_that_is_not_there_gets_three_parts(walk, says):
    with pytest.raises(BagError) as caught:
        inject(walk, stuck(topic="temprature"))
    says(caught.value, "Did you mean '/temperature'")
