"""A function that reports what a learner found, called."""

import math

import pytest

from rosbeat.exercises.evidence import from_json, to_json
from rosbeat.exercises.scenarios import Report, report


def test_a_result_is_plain_data():
    assert report(lambda: {"a": (1, 2.5, "x")}) == Report('{"a": [1, 2.5, "x"]}', "", "dict")
    assert report(lambda a, b: a + b, 1, 2).value == 3
    assert report(lambda: [True, None]).value == [True, None]


@pytest.mark.parametrize("value", [math.inf, {"8": None}, [None, [None]], {"$float": 1}, ""])
def test_a_result_may_hold_what_no_message_does(value):
    seen = report(lambda: value)
    assert from_json(to_json(seen)) == seen
    assert seen.value == value


def endless():
    while True:
        pass


def leaves():
    raise SystemExit(0)


@pytest.mark.parametrize(
    ("answer", "problem"),
    [
        (endless, "Deadline"),
        (leaves, "SystemExit"),
        (lambda: 1 / 0, "ZeroDivisionError"),
        (lambda: object(), "NotPlain"),
        (lambda: "x" * 30_000, "NotPlain"),
    ],
    ids=["endless", "leaves", "raises", "object", "long"],
)
def test_what_is_no_result_is_evidence(answer, problem):
    seen = report(answer)
    assert seen.problem.startswith(problem)
    assert seen.value is None
    assert from_json(to_json(seen)) == seen
