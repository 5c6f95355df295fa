"""Answers by somebody who has read the pages only: each gets its outcome, and a true name."""

import pytest

from bank.beyond import blind, page_07, page_08, page_09, page_11, page_12, page_13
from bank.verdicts import assert_named, assert_sorted_out, assert_told
from rosbeat.diagnosis.mistakes import MISTAKES

pytestmark = pytest.mark.ros

PAGES = (page_07, page_08, page_09, page_11, page_12, page_13)
SECRETS = {name: secrets for page in PAGES for name, secrets in page.SECRETS.items()}


@pytest.mark.parametrize("answer", blind.ANSWERS, ids=lambda answer: answer.id)
def test_an_answer_is_told_what_is_right_or_wrong(answer):
    assert_told(answer, SECRETS)


def test_no_right_answer_is_refused_and_no_wrong_one_accepted():
    assert_sorted_out(blind.ANSWERS)


def test_nineteen_of_twenty_single_mistakes_are_named():
    assert_named(blind.ANSWERS)


def test_the_answers_are_many_and_half_of_them_are_right():
    answers = (*blind.ANSWERS, *blind.DISAGREE)
    right = [answer for answer in answers if answer.status == "passed"]
    assert len({answer.id for answer in answers}) == len(answers) >= 2 * 110
    assert 2 * len(right) >= len(answers)
    assert {name for answer in answers for name in answer.mistakes} <= set(MISTAKES)
    assert len(blind.DISAGREE) == len(blind.REASONS)
