"""What `grade` says of an answer about files or a terminal is what `check` says of it.

The suite takes a few answers of each exercise; `ROSBEAT_ALL_ANSWERS=1` takes all of them.
"""

import os

import pytest

from bank.graded_workspaces import HEADS, graded, usable
from bank.workspaces.table import outcome_of

pytestmark = [pytest.mark.ros, pytest.mark.timeout(1_800)]

#: Of each exercise, how many are compared.
MOST = 1_000 if os.environ.get("ROSBEAT_ALL_ANSWERS") else 2
CHOSEN = [one for exercise in HEADS for one in usable(exercise)[:MOST]]


@pytest.fixture(scope="module")
def marks():
    """What grading says of the answers, by their ids."""
    return dict(graded(CHOSEN))


@pytest.mark.parametrize("answer", CHOSEN, ids=lambda answer: answer.id)
def test_an_answer_gets_the_same_outcome_everywhere(answer, marks, tmp_path, monkeypatch):
    monkeypatch.setenv("ROSBEAT_STEADY_HOME", str(tmp_path))
    assert marks[answer.id] == outcome_of(answer, tmp_path / "ROS2_and_RL_Tutorials")


def test_both_right_and_wrong_ones_are_compared():
    assert {answer.status for answer in CHOSEN} >= {"passed", "failed"}
