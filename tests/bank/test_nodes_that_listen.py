"""Every answer about a node that listens gets its outcome, and its mistake a name."""

import pytest

from bank.nodes.table import ANSWERS
from bank.verdicts import assert_named, assert_sorted_out, assert_told

pytestmark = pytest.mark.ros

EXERCISES = ("00a", "04a", "04b", "04c")
MINE = [answer for answer in ANSWERS if answer.exercise in EXERCISES]


@pytest.mark.parametrize("answer", MINE, ids=lambda answer: answer.id)
def test_an_answer_is_told_what_is_right_or_wrong(answer):
    assert_told(answer)


def test_no_right_answer_is_refused_and_no_wrong_one_accepted():
    assert_sorted_out(MINE)


def test_nineteen_of_twenty_single_mistakes_are_named():
    assert_named(MINE)
