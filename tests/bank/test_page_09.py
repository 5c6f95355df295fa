"""Every answer to an exercise of page 09 gets its outcome, and its mistake a name."""

import pytest

from bank.beyond import page_09
from bank.verdicts import assert_named, assert_sorted_out, assert_told, assert_wide

pytestmark = pytest.mark.ros


@pytest.mark.parametrize("answer", page_09.ANSWERS, ids=lambda answer: answer.id)
def test_an_answer_is_told_what_is_right_or_wrong(answer):
    assert_told(answer, page_09.SECRETS)


def test_no_right_answer_is_refused_and_no_wrong_one_accepted():
    assert_sorted_out(page_09.ANSWERS)


def test_nineteen_of_twenty_single_mistakes_are_named():
    assert_named(page_09.ANSWERS)


def test_each_exercise_has_enough_answers():
    assert_wide("09", page_09.ANSWERS, page_09.SECRETS)
