"""The bank is as large and as wide as it has to be, and its own tools can fail."""

import pytest

from bank.answer import Answer, edited, right, wrong
from bank.nodes.table import ANSWERS
from bank.pages import NODE_EXERCISES
from bank.verdicts import SECRETS, leaks
from bank.workspaces.table import ANSWERS as OTHER_ANSWERS
from rosbeat.diagnosis.mistakes import MISTAKES, UNKNOWN

#: Rows of the table of mistakes that a cell with a node class can show. The others belong to
#: terminals and files (20 to 29), or need a program of their own or a second one.
ROWS = {*range(1, 17), 17, 19, 30}


def test_there_are_two_hundred_answers():
    assert len(ANSWERS) >= 150
    assert len(ANSWERS) + len(OTHER_ANSWERS) >= 200


def test_names_are_unique():
    names = [answer.id for answer in ANSWERS]
    assert sorted(set(names)) == sorted(names)


def test_every_mistake_that_is_expected_exists():
    assert {name for one in ANSWERS for name in one.mistakes} - {UNKNOWN} <= set(MISTAKES)


@pytest.mark.parametrize("exercise", NODE_EXERCISES)
def test_an_exercise_has_enough_answers(exercise):
    mine = [answer for answer in ANSWERS if answer.exercise == exercise]
    assert sum(answer.status == "passed" for answer in mine) >= 6
    assert sum(len(answer.mistakes) == 1 for answer in mine) >= 30
    assert sum(len(answer.mistakes) > 1 for answer in mine) >= 5


def test_every_row_of_the_table_is_made_that_can_be_made():
    names = {name for answer in ANSWERS for name in answer.mistakes} & set(MISTAKES)
    assert {MISTAKES[name].row for name in names} >= ROWS


def test_the_last_definition_is_handed_over_unless_another_is_named():
    text = "class A: pass\ndef make(): pass\nx = 1\n"
    assert right("03a", "a", text).subject == "make"
    assert right("03a", "a", text, handed="A").subject == "A"
    assert wrong("03a", "a", "no-node", text) == Answer("03a", "a", text, "failed", ("no-node",))


def test_an_edit_has_to_find_its_place():
    assert edited("\n    a b\n", ("b", "c")) == "a c\n"
    with pytest.raises(ValueError, match="is not in"):
        edited("a b", ("d", "c"))


def test_a_hint_that_gives_the_answer_is_noticed():
    assert set(SECRETS) == set(NODE_EXERCISES)
    assert leaks("03b", "Write max( 18.0, ...).") == ["max(18"]
    assert leaks("03b", "Which function cuts off what is below?") == []
