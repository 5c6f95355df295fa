"""Every answer to an exercise of page 12 gets its outcome, and its mistake a name."""

import pytest

from bank.beyond import page_12
from bank.verdicts import assert_named, assert_sorted_out, assert_told, assert_wide

pytestmark = pytest.mark.ros


@pytest.mark.parametrize("answer", page_12.ANSWERS, ids=lambda answer: answer.id)
def test_an_answer_is_told_what_is_right_or_wrong(answer):
    assert_told(answer, page_12.SECRETS)


def test_no_right_answer_is_refused_and_no_wrong_one_accepted():
    assert_sorted_out(page_12.ANSWERS)


def test_nineteen_of_twenty_single_mistakes_are_named():
    assert_named(page_12.ANSWERS)


def test_each_exercise_has_enough_answers():
    assert_wide("12", page_12.ANSWERS, page_12.SECRETS)
