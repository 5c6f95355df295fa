"""Every answer about files and terminals gets its outcome, and its mistake is named."""

from collections import Counter

import pytest

from bank.workspaces.table import ANSWERS, SOLUTIONS, outcome_of
from rosbeat.diagnosis.mistakes import MISTAKES, UNKNOWN
from rosbeat.exercises.check import EXERCISES

pytestmark = pytest.mark.ros  # `check` loads every exercise, those about nodes included


@pytest.fixture
def root(tmp_path, monkeypatch):
    """A workspace that is not there yet, where a page would find it."""
    monkeypatch.setenv("ROSBEAT_STEADY_HOME", str(tmp_path))
    return tmp_path / "ROS2_and_RL_Tutorials"


@pytest.mark.parametrize("answer", ANSWERS, ids=lambda one: one.id)
def test_an_answer_gets_its_outcome(answer, root):
    outcome = outcome_of(answer, root)
    assert outcome.status == answer.status, outcome
    if answer.status != "failed":
        assert not outcome.mistake
        assert not outcome.hint
        return
    assert outcome.mistake in answer.mistakes, outcome
    assert outcome.evidence
    assert outcome.hint
    assert not [text for text in SOLUTIONS[answer.exercise] if text in outcome.hint]


def test_the_bank_is_what_it_says():
    by_name = Counter(one.id for one in ANSWERS)
    assert max(by_name.values()) == 1
    for exercise in SOLUTIONS:
        counted = Counter(one.status for one in ANSWERS if one.exercise == exercise)
        assert counted["passed"] >= 6, exercise
        assert counted["failed"] >= 8, exercise
        assert counted["not attempted"] >= 1, exercise
    assert {name for one in ANSWERS for name in one.mistakes} - {UNKNOWN} <= set(MISTAKES)


def test_single_mistakes_have_names():
    single = [one for one in ANSWERS if len(one.mistakes) == 1]
    named = [one for one in single if one.mistakes != (UNKNOWN,)]
    share = len(named) / len(single)
    print(f"{len(ANSWERS)} answers, {len(single)} single mistakes, {share:.1%} with a name")
    assert share >= 0.95


@pytest.mark.parametrize("exercise", SOLUTIONS)
def test_hints_go_from_general_to_exact_and_hold_no_answer(exercise):
    found = EXERCISES[exercise]
    assert found.title
    assert found.points in (1, 2)
    assert 2 <= len(found.hints) <= 4
    assert len(set(found.hints)) == len(found.hints)
    assert not [one for one in found.hints for text in SOLUTIONS[exercise] if text in one]
