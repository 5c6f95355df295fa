"""Answers by people who had the pages only get their verdict, and their mistake its name."""

import pytest

from bank.reading import held_out, third_set
from bank.test_bank import assert_sound, assert_told

ANSWERS = held_out()


@pytest.mark.ros
@pytest.mark.parametrize("answer", ANSWERS, ids=lambda one: one.id)
def test_an_answer_is_told_what_is_right_or_wrong(answer, workspace):
    assert_told(answer, workspace)


@pytest.mark.thorough
@pytest.mark.ros
@pytest.mark.parametrize("answer", third_set(), ids=lambda one: one.id)
def test_an_answer_of_the_third_set_is_told_what_is_right_or_wrong(answer, workspace):
    assert_told(answer, workspace)


def test_names_are_unique_and_mistakes_are_known():
    assert_sound(ANSWERS)
    assert_sound(third_set())


def test_answers_are_many_and_more_than_a_third_of_them_are_right():
    assert len(ANSWERS) >= 430
    assert sum(one.status == "passed" for one in ANSWERS) >= 184
