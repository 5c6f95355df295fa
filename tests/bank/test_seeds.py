"""With inputs that are drawn from a seed, as in grading, answers get the outcome of the page."""

from collections import Counter
from zlib import crc32

import pytest

from bank import pages
from bank.reading import answers, held_out
from bank.running import namespace_of, told
from rosbeat.diagnosis.mistakes import UNKNOWN
from rosbeat.exercises.registry import EXERCISES

pytestmark = pytest.mark.ros

DRAWN = [name for name, one in EXERCISES.items() if one.draw is not None]
HELD_OUT = [one for one in held_out() if one.exercise in DRAWN]
#: Answers to an exercise that every run tries, half of them right ones; all of them are tried
#: with the inputs of the page, in `test_held_out`.
SOME = 4
BANK = [one for one in answers() if one.exercise in DRAWN]


def seed_of(answer):
    """Return a seed for an answer: any, and always the same."""
    return 1 + crc32(answer.id.encode()) % 10_000


def some_first(found):
    """Mark all but some answers to each exercise as thorough."""
    ranks = Counter()
    for one in found:
        right = one.status == "passed"
        ranks[one.exercise, right] += 1
        many = ranks[one.exercise, right] > SOME // 2
        yield pytest.param(one, marks=[pytest.mark.thorough] if many else [], id=one.id)


@pytest.mark.parametrize("answer", list(some_first(HELD_OUT)))
def test_a_held_out_answer_gets_its_outcome_with_any_seed(answer, workspace):
    outcome = told(answer, workspace, seed_of(answer))
    assert outcome.status == answer.status, outcome
    assert outcome.mistake in (answer.mistakes or ("",)) + (UNKNOWN,), outcome


@pytest.mark.parametrize("exercise", DRAWN)
def test_evidence_of_a_right_answer_does_not_pass_with_another_seed(exercise):
    space = namespace_of(exercise, pages.solution(exercise), "<reference>")
    judged, seen = (getattr(EXERCISES[exercise], name) for name in ("judged", "observed"))
    evidence = seen(eval(pages.subject(exercise), space))
    assert judged(evidence).status == "passed"
    assert {judged(evidence, seed).status for seed in range(1, 11)} == {"failed"}


@pytest.mark.thorough
@pytest.mark.parametrize("answer", BANK, ids=lambda one: one.id)
def test_an_answer_of_the_bank_gets_its_outcome_with_any_seed(answer, workspace):
    outcome = told(answer, workspace, seed_of(answer))
    assert outcome.status == answer.status, outcome
    # The name may be another one: of two mistakes, the first to show depends on what is fed.
    assert bool(outcome.mistake) == bool(answer.mistakes)
