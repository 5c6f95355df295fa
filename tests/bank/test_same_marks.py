"""What `grade` says of an answer is what `check` says of it on the page.

The suite takes some answers of each exercise. To compare all of them, which takes a quarter of an
hour: `ROSBEAT_ALL_ANSWERS=1 pytest -n 0 tests/bank/test_same_marks.py`.
"""

import os

import pytest

from bank.graded import REPLAYED, graded, sample, usable
from bank.running import told

#: Whether all answers are compared.
ALL = bool(os.environ.get("ROSBEAT_ALL_ANSWERS"))
#: Answers that use what only grading could lack: the clinic's instruments.
ALWAYS = {"10a with an instrument in it"}

CHOSEN = usable() if ALL else (*sample(1), *(one for one in usable() if one.id in ALWAYS))


@pytest.fixture(scope="module")
def marks():
    """What grading says of the answers, by their ids."""
    return dict(graded(CHOSEN))


@pytest.mark.ros
@pytest.mark.timeout(3_600 if ALL else 600)  # the first one waits for all
@pytest.mark.parametrize("answer", CHOSEN, ids=lambda answer: answer.id)
def test_an_answer_gets_the_same_outcome_everywhere(answer, marks, workspace):
    assert marks[answer.id] == told(answer, workspace, patient=True)


def test_the_sample_is_fair():
    found = {(one.exercise, one.status) for one in sample(1)}
    wanted = {(one.exercise, one.status) for one in usable()}
    assert {one for one in wanted if one[0] not in REPLAYED} <= found <= wanted
    assert {"passed", "failed"} <= {one.status for one in sample(1) if one.exercise in REPLAYED}
    assert {one.id for one in usable()} >= ALWAYS
