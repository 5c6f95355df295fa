"""What `grade` says of an answer is what `check` says of it on the page.

The suite takes some answers of each exercise. To compare all of them, which takes a quarter of an
hour: `ROSBEAT_ALL_ANSWERS=1 pytest -n 0 tests/bank/test_same_marks.py`.
"""

import os

import pytest

from bank.graded import ANSWERS, graded, handed_in, sample
from bank.running import outcome_of

#: Whether all answers are compared.
ALL = bool(os.environ.get("ROSBEAT_ALL_ANSWERS"))
#: Of each exercise and each status, how many are compared otherwise.
MOST = 1
#: Answers that use what only grading could lack: the clinic's instruments.
ALWAYS = {"10a with an instrument in it"}

CHOSEN = [
    *(ANSWERS if ALL else sample(MOST)),
    *(() if ALL else (one for one in ANSWERS if one.id in ALWAYS)),
]


@pytest.fixture(scope="module")
def marks():
    """What grading says of the answers, by their ids."""
    return dict(graded(CHOSEN))


@pytest.mark.ros
@pytest.mark.timeout(3_600 if ALL else 120)  # the first one waits for all
@pytest.mark.parametrize("answer", CHOSEN, ids=lambda answer: answer.id)
def test_an_answer_gets_the_same_outcome_everywhere(answer, marks):
    assert marks[answer.id] == outcome_of(answer.exercise, answer.text, answer.subject)


@pytest.mark.skipif(not ALL, reason="it reads 1,900 pages")
def test_no_answer_is_held_or_mended():
    found = {one.id: handed_in(one) for one in ANSWERS}
    assert {name for name, one in found.items() if one.job is None or one.repairs} == set()


def test_the_sample_is_fair():
    found = sample(MOST)
    assert {one.exercise for one in found} == {one.exercise for one in ANSWERS}
    assert {(one.exercise, one.status) for one in found} == {
        (one.exercise, one.status) for one in ANSWERS
    }
    assert len({one.id for one in ANSWERS}) == len(ANSWERS) > 1_800
    assert sample(MOST) == found
