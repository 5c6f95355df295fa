"""The judge of limits that change, asked about made-up runs. Needs no ROS."""

import pytest

from rosbeat.exercises.page_07_scenarios import CHANGES, READINGS
from rosbeat.exercises.tuning import DEFAULTS, judge_tuning
from rosbeat.records import CallbackRecord, Observation, Sample

STRING = "std_msgs/msg/String"


def word(value, low, high):
    return "High" if value > high else "Low" if value < low else "Normal"


def run(rule=word, start=DEFAULTS, lag=0, changes=CHANGES, refused=""):
    """What a monitor publishes that decides by a rule, and takes changes some readings late."""
    limits, planned = dict(start), dict(changes)
    samples, calls = [], []
    for second, value in enumerate(READINGS, 1):
        limits |= planned.get(second - lag, {})
        said = rule(value, **limits)
        at = second * 10**9
        calls.append(CallbackRecord(at, "/m", "subscription", "listen", "/temperature"))
        samples += [Sample(at, "/status", STRING, "/m", {"data": one}) for one in said.split()]
    for second, values in CHANGES:
        for name in values:
            said = refused if name == "high" and refused else "accepted"
            at = round((second - 0.5) * 10**9)
            calls.append(CallbackRecord(at, "/m", "step", "SetParameter", f"{name}: {said}"))
    observation = Observation(len(READINGS) * 10**9, 0, tuple(samples), callbacks=tuple(calls))
    return judge_tuning("07b", observation)


def test_the_right_one():
    assert run().status == "passed"


def test_each_change_matters():
    for number in range(len(CHANGES)):
        for name in CHANGES[number][1]:
            kept = [(at, {**one} if n != number else {k: v for k, v in one.items() if k != name})
                    for n, (at, one) in enumerate(CHANGES)]  # fmt: skip
            assert run(changes=kept).status == "failed", (number, name)


WRONG = {
    "frozen": ({"changes": ()}, "parameter-frozen"),
    "late": ({"lag": 1}, "parameter-late"),
    "swapped": ({"rule": lambda value, low, high: word(value, high, low)}, "parameters-swapped"),
    "another default": ({"start": {"low": 19.0, "high": 26.0}}, "other-default"),
    "another default, little": ({"start": {"low": 20.0, "high": 25.0}}, "other-default"),
    "at the upper limit": (
        {"rule": lambda value, low, high: "High" if value >= high else word(value, low, high)},
        "boundary",
    ),
    "always Normal": ({"rule": lambda value, low, high: "Normal"}, "wrong-state"),
    "another word": ({"rule": lambda value, low, high: "Fine"}, "wrong-word"),
    "twice": ({"rule": lambda *a, **k: f"{word(*a, **k)} Low"}, "wrong-rate"),
    "not declared": ({"refused": "refused, not declared"}, "parameter-undeclared"),
    "another type": ({"refused": "refused, Wrong parameter type, x"}, "parameter-type"),
    "refused": ({"refused": "refused, no reason"}, "parameter-refused"),
}


@pytest.mark.parametrize("case", WRONG)
def test_a_mistake_has_a_name(case):
    how, mistake = WRONG[case]
    outcome = run(**how)
    assert (outcome.status, outcome.mistake) == ("failed", mistake), outcome


def test_the_plan_has_a_reading_at_each_border_and_beside_it():
    limits, planned = dict(DEFAULTS), dict(CHANGES)
    seen = set()
    for second, value in enumerate(READINGS, 1):
        limits |= planned.get(second, {})
        seen |= {(name, limit, value > limit, value == limit) for name, limit in limits.items()}
    for name, limit in (("low", 20.0), ("high", 26.0), ("high", 24.0), ("low", 22.0),
                        ("low", 10.0), ("high", 30.0)):  # fmt: skip
        assert {(name, limit, True, False), (name, limit, False, True),
                (name, limit, False, False)} <= seen  # fmt: skip
