"""The calm monitor's judge, asked about made-up runs. Needs no ROS."""

import pytest

from rosbeat.exercises.calm import judge_calm
from rosbeat.records import Observation, Sample

READINGS = (22.0, 26.0, 26.5, 25.5, 26.25, 25.0, 24.75, 25.5, 20.0, 19.5, 20.5, 21.0, 21.25, 27.0,
            18.0, 30.0, 23.0)  # fmt: skip
CHANGES = {3: "High", 7: "Normal", 10: "Low", 13: "Normal", 14: "High", 15: "Low", 16: "High",
           17: "Normal"}  # fmt: skip


def mean(second, width=5):
    last = READINGS[max(0, second - width) : second]
    return sum(last) / len(last)


def run(means=mean, changes=CHANGES, type_name="std_msgs/msg/String"):
    """What a monitor publishes: a mean for each reading, and its changes."""
    seconds = range(1, len(READINGS) + 1)
    found = [
        Sample(second * 10**9, "/mean", "std_msgs/msg/Float32", "/calm", {"data": means(second)})
        for second in seconds
        if means(second) is not None
    ]
    found += [
        Sample(round(at * 10**9), "/status", type_name, "/calm", {"data": word})
        for at, word in changes.items()
    ]
    return judge_calm("04c", Observation(18 * 10**9, 0, tuple(found)), READINGS)


def held(rule):
    """The changes that a rule gives: from the status before and a reading to a status."""
    status, found = "Normal", {}
    for second, value in enumerate(READINGS, 1):
        new = rule(status, value)
        if new != status:
            found[second] = status = new
    return found


def calm(status, value, high=26.0, low=20.0, down=25.0, up=21.0):
    if value > high:
        return "High"
    if value < low:
        return "Low"
    stays = (status == "High" and value >= down) or (status == "Low" and value <= up)
    return status if stays else "Normal"


def test_the_right_one():
    assert held(calm) == CHANGES
    assert run().status == "passed"
    assert run(changes={at: word.upper() for at, word in CHANGES.items()}).status == "passed"


MEANS = {
    "all so far": (lambda n: mean(n, 99), "wrong-window", "mean of all readings"),
    "four": (lambda n: mean(n, 4), "wrong-window", "last 4 readings"),
    "the last": (lambda n: mean(n, 1), "wrong-window", "last reading alone"),
    "always by five": (
        lambda n: sum(READINGS[max(0, n - 5) : n]) / 5,
        "wrong-window",
        "divide by how many there are",
    ),
    "without the newest": (
        lambda n: sum(READINGS[max(0, n - 6) : n - 1] or [0.0]) / min(5, max(1, n - 1)),
        "wrong-window",
        "newest reading is not in it",
    ),
    "something else": (lambda n: 3.0, "wrong-window", "divided by how many they are"),
    "from the fifth on": (lambda n: mean(n) if n > 4 else None, "wrong-rate", "fewer than five"),
}


@pytest.mark.parametrize("name", MEANS)
def test_a_wrong_mean(name):
    means, mistake, words = MEANS[name]
    outcome = run(means)
    assert (outcome.mistake, words in outcome.hint) == (mistake, True), outcome


STATUSES = {
    "without hysteresis": (held(lambda s, v: calm("Normal", v)), "no-hysteresis"),
    "back too early": (held(lambda s, v: calm(s, v, down=25.8)), "no-hysteresis"),
    "exactly 25": (
        held(lambda s, v: "Normal" if (s, v) == ("High", 25.0) else calm(s, v)),
        "boundary",
    ),
    "exactly 26": (held(lambda s, v: "High" if v == 26.0 else calm(s, v)), "boundary"),
    "back too late": (held(lambda s, v: calm(s, v, down=24.0)), "hysteresis-lost"),
    "no jump": (
        held(lambda s, v: "Normal" if (s, v) == ("High", 18.0) else calm(s, v)),
        "wrong-state",
    ),
    "other words": ({**CHANGES, 3: "Hot"}, "wrong-state"),
    "the beginning": ({0.5: "Normal", **CHANGES}, "status-repeated"),
    "a stop on the way": ({**CHANGES, 14.9: "Normal"}, "wrong-state"),
    "each time": ({**CHANGES, 4: "High"}, "status-repeated"),
}


@pytest.mark.parametrize("name", STATUSES)
def test_a_wrong_status(name):
    changes, mistake = STATUSES[name]
    outcome = run(changes=dict(sorted(changes.items())))
    assert outcome.mistake == mistake, outcome
    assert outcome.hint


def test_another_type():
    assert run(type_name="std_msgs/msg/Float32").mistake == "type-mismatch"


def test_nothing_published():
    assert run(means=lambda n: None).status == "failed"
    assert run(changes={}).status == "failed"
