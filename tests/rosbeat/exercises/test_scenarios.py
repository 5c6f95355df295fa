"""A function that reports what a learner found, and a workspace that is looked at."""

import math

import pytest

from rosbeat.errors import ExerciseError
from rosbeat.exercises.evidence import from_json, to_json
from rosbeat.exercises.model import before_reading
from rosbeat.exercises.scenarios import Report, look_at_workspace, report


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


# What is said of a report.


SAY = 'check("07a", findings)'


def said(answer):
    return before_reading(report(answer), SAY)


def test_a_good_result_needs_no_word():
    assert said(lambda: {"a": 1}) is None


def blank():
    return {"a": ____}  # noqa: F821


def test_a_blank_is_not_attempted():
    assert said(blank).status == "not attempted"


@pytest.mark.parametrize(
    ("answer", "problem", "mistake", "words"),
    [
        (endless, "Deadline", "does-not-return", "still running"),
        (leaves, "SystemExit", "raised", "SystemExit"),
        (lambda: 1 / 0, "ZeroDivisionError", "raised", "division by zero"),
        (lambda: hot, "NameError", "name-error", "hot"),  # noqa: F821
        (lambda: None, "", "returns-nothing", "returned nothing"),
        (lambda: object(), "NotPlain", "not-plain", "not JSON serializable"),
        (lambda: "x" * 30_000, "NotPlain", "not-plain", "characters long"),
        ({"a": 1}, "", "no-function", "no function"),
    ],
    ids=["endless", "leaves", "raises", "name", "nothing", "object", "long", "dict"],
)
def test_what_is_no_result_is_evidence_and_has_a_name(answer, problem, mistake, words):
    seen = report(answer)
    assert seen.problem.startswith(problem)
    assert seen.value is None
    assert from_json(to_json(seen)) == seen
    found = before_reading(seen, SAY)
    assert found.mistake == mistake
    assert words in found.evidence
    assert found.hint


# Workspaces.


def test_a_workspace_that_is_not_there_is_named_by_its_path(tmp_path):
    gone = tmp_path / "gone"
    for answer in (gone, str(gone)):
        with pytest.raises(ExerciseError) as caught:
            look_at_workspace(answer)
        assert caught.value.what == f"There is no workspace at {gone}."


@pytest.mark.parametrize("answer", [None, 3, "", " "])
def test_something_else_is_shown_as_it_is(answer, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    with pytest.raises(ExerciseError) as caught:
        look_at_workspace(answer)
    assert caught.value.what == f"There is no workspace at {answer!r}."
