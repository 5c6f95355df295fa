"""Answers by somebody who had the pages only get their outcome, and their mistake its name."""

import pytest

from bank import pages
from bank.held_out import STATUS, answers
from bank.running import outcome_of
from bank.workspaces import table
from bank.workspaces.answer import Answer
from rosbeat.diagnosis.mistakes import MISTAKES

pytestmark = pytest.mark.ros

ANSWERS = answers()
#: Exercises of which an answer is typed in a terminal, or saved in a file.
TYPED = ("01a", "01b", "02a", "02b", "05a")


@pytest.mark.parametrize("answer", ANSWERS, ids=lambda one: one.id)
def test_an_answer_gets_its_outcome(answer, tmp_path, monkeypatch):
    if answer.exercise in TYPED:
        monkeypatch.setenv("ROSBEAT_STEADY_HOME", str(tmp_path))
        lines = answer.text.removeprefix("%%")
        given = Answer(answer.exercise, answer.name, lines)
        outcome = table.outcome_of(given, tmp_path / "ROS2_and_RL_Tutorials")
    else:
        handed = answer.handed or pages.subject(answer.exercise)
        outcome = outcome_of(answer.exercise, answer.text, handed)
    assert (outcome.status, outcome.mistake) == (answer.status, answer.mistake), outcome
    assert bool(outcome.hint) == (answer.status == STATUS["wrong"])


def test_the_answers_are_many_and_nearly_half_of_them_are_right():
    assert len({one.id for one in ANSWERS}) == len(ANSWERS) >= 250
    assert sum(one.status == STATUS["right"] for one in ANSWERS) >= 115
    assert {one.mistake for one in ANSWERS} - {""} <= {"new-to-me", *MISTAKES}
