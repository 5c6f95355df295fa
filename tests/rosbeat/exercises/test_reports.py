"""What is said of a function that reports what a learner found."""

import pytest

from rosbeat.exercises.evidence import from_json, to_json
from rosbeat.exercises.model import before_reading
from rosbeat.exercises.scenarios import report

SAY = 'check("07a", findings)'


def said(answer, *arguments):
    seen = report(answer, *arguments)
    assert from_json(to_json(seen)) == seen
    return before_reading(seen, SAY)


def test_a_good_result_needs_no_word():
    assert said(lambda: {"a": 1}) is None


def blank():
    return {"a": ____}  # noqa: F821


def test_a_blank_is_not_attempted():
    assert said(blank).status == "not attempted"


def endless():
    while True:
        pass


def leaves():
    raise SystemExit(0)


@pytest.mark.parametrize(
    ("answer", "mistake", "words"),
    [
        (endless, "does-not-return", "still running"),
        (leaves, "raised", "SystemExit"),
        (lambda: 1 / 0, "raised", "division by zero"),
        (lambda: hot, "name-error", "hot"),  # noqa: F821
        (lambda: None, "returns-nothing", "nothing back"),
        (lambda: object(), "not-plain", "not JSON serializable"),
        (lambda: "x" * 30_000, "not-plain", "characters long"),
        ({"a": 1}, "no-function", "no function"),
    ],
    ids=["endless", "leaves", "raises", "name", "nothing", "object", "long", "dict"],
)
def test_what_is_wrong_with_it_has_a_name(answer, mistake, words):
    found = said(answer)
    assert found.mistake == mistake
    assert words in found.evidence
    assert found.hint
