"""Faults: pure, seeded, one after the other."""

import math

import pytest

from rosbeat.bags import delayed, drift, dropouts, spikes, stuck, with_nan
from rosbeat.errors import BagError


@pytest.fixture
def walk(make):
    return tuple(make.sample(at, float(at)) for at in range(1, 101))


def numbers(samples):
    return [one.value for one in samples]


def test_stuck_says_again_what_it_said_last(walk):
    found = numbers(stuck(at=10, seconds=5)(walk))
    assert found[8:16] == [9, 9, 9, 9, 9, 9, 15, 16]
    assert numbers(stuck(at=98)(walk))[-4:] == [97, 97, 97, 97]
    assert numbers(stuck()(walk)) == [1] * 100


def test_drift_grows_with_time(walk):
    assert numbers(drift(0.5)(walk))[:3] == [1.5, 3.0, 4.5]
    assert numbers(drift(-2, at=98)(walk))[-4:] == [97, 98, 97, 96]


def test_dropouts_lose_a_share_or_whole_spans(walk):
    kept = dropouts(share=0.3, seed=1)(walk)
    assert 55 <= len(kept) <= 85
    assert all(one in walk for one in kept)
    assert numbers(dropouts(spans=[(1, 4), (5, 100)])(walk)) == [4, 100]
    assert dropouts(share=1)(walk) == ()
    assert dropouts()(walk) == walk


def test_nan_comes_once_for_a_while_or_for_ever(walk):
    def where(fault):
        return [one.time for one in fault(walk) if math.isnan(one.value)]

    assert where(with_nan(at=9.5)) == [10]
    assert where(with_nan(at=10, seconds=3)) == [10, 11, 12]
    assert where(with_nan(at=98, seconds=None)) == [98, 99, 100]
    assert where(with_nan(at=101)) == []


def test_spikes_go_both_ways(walk):
    off = {b - a for a, b in zip(numbers(walk), numbers(spikes(0.3, 50)(walk)), strict=True)}
    assert off == {0, 50, -50}


def test_delayed_comes_later_and_may_overtake(walk):
    assert [one.time for one in delayed(0.25)(walk)][:2] == [1.25, 2.25]
    moved = delayed(0, jitter=3)(walk)
    assert numbers(moved) != numbers(walk)
    assert sorted(numbers(moved)) == numbers(walk)
    times = [one.time_ns for one in moved]
    assert times == sorted(times)
    by_value = {one.value: one.time for one in moved}
    assert all(0 <= by_value[value] - value <= 3 for value in by_value)


SEEDED = {
    "dropouts": lambda seed: dropouts(0.5, seed=seed),
    "spikes": lambda seed: spikes(0.5, 3, seed=seed),
    "delayed": lambda seed: delayed(1, jitter=2, seed=seed),
}


@pytest.mark.parametrize("name", SEEDED)
def test_the_same_seed_gives_the_same_and_another_one_does_not(walk, name):
    fault = SEEDED[name](4)
    assert fault(walk) == fault(walk) == SEEDED[name](4)(walk)
    assert SEEDED[name](5)(walk) != fault(walk)


@pytest.mark.parametrize("name", SEEDED)
def test_another_topic_changes_nothing_for_the_first(walk, make, name):
    others = tuple(make.sample(at, 0.0, "/other") for at in range(200))
    both = sorted(walk + others, key=lambda one: one.time_ns)
    found = [one for one in SEEDED[name](4)(both) if one.topic == "/temperature"]
    assert tuple(found) == SEEDED[name](4)(walk)


def test_random_faults_are_the_same_on_every_python(walk):
    assert numbers(dropouts(0.9, seed=1)(walk)) == [
        6,
        17,
        23,
        34,
        36,
        37,
        46,
        51,
        52,
        64,
        67,
        89,
        97,
    ]


def test_nothing_comes_of_nothing():
    for fault in (stuck(), drift(1), dropouts(0.5), with_nan(), spikes(1, 1), delayed(1)):
        assert fault([]) == ()
    assert stuck(topic="temperature")([]) == ()


def test_they_say_what_they_do():
    assert list(map(repr, [
        stuck(at=20, seconds=5), stuck(at=20), drift(0.1, topic="temperature"), dropouts(0.25),
        dropouts(spans=[(3, 4.5)]), dropouts(), with_nan(3), with_nan(3, 2), spikes(0.1, 40),
        delayed(0.5), delayed(0.5, jitter=1),
    ])) == [
        "stuck at 20 s for 5 s", "stuck from 20 s on",
        "/temperature: drift of 0.1 a second from 0 s on", "25% of the messages lost",
        "no messages from 3 s to 4.5 s", "0% of the messages lost", "NaN once at 3 s",
        "NaN at 3 s for 2 s", "spikes of 40 in 10% of the messages", "delayed by 0.5 s",
        "delayed by 0.5 s and up to 1 s more",
    ]  # fmt: skip


@pytest.mark.parametrize(
    ("make_fault", "words"),
    [
        (lambda: stuck(at=-1), "at=-1"),
        (lambda: stuck(at="soon"), "at='soon'"),
        (lambda: stuck(seconds=math.inf), "seconds=inf"),
        (lambda: stuck(topic=3), "not the name of a topic"),
        (lambda: drift(math.nan), "rate=nan"),
        (lambda: drift(True), "rate=True"),
        (lambda: dropouts(share=1.1), "a number from 0 to 1"),
        (lambda: dropouts(share=None), "share=None"),
        (lambda: dropouts(spans=[(4, 3)]), "pairs of ascending times"),
        (lambda: dropouts(spans=[3]), "pairs of ascending times"),
        (lambda: dropouts(spans=[(-1, 3)]), "spans=-1"),
        (lambda: with_nan(seconds=-1), "seconds=-1"),
        (lambda: spikes(-0.1, 1), "share=-0.1"),
        (lambda: spikes(0.1, "big"), "size='big'"),
        (lambda: delayed(-1), "seconds=-1"),
        (lambda: delayed(1, jitter=-1), "jitter=-1"),
        (lambda: dropouts(spans=3), "pairs of ascending times"),
    ],
)
def test_bad_input_gets_three_parts(says, make_fault, words):
    with pytest.raises(BagError) as caught:
        make_fault()
    says(caught.value, words)
