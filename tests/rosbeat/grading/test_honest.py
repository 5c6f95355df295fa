"""Two hundred honest submissions: none of them is held, refused or remarked upon.

Each is a page with right answers of the bank, arranged in one of the ways of `arrangements`.
"""

import json

import pytest

import arrangements
from bank.class_of_learners import answers_to
from rosbeat.grading.ledger import Ledger
from rosbeat.grading.run import Plan, grade
from rosbeat.grading.submissions import collect
from rosbeat.page_runs.pool import Pool

pytestmark = [pytest.mark.ros, pytest.mark.timeout(1800)]
NUMBERS = ("03", "04", "08", "11", "12")


def of_the_bank(number, turn):
    """Right answers of the bank by the id of their cell, others for each turn."""
    answers = {}
    for cell in arrangements.course()[number].wanted:
        known = answers_to(cell.exercise, "passed")
        answers[cell.id] = known[turn % len(known)].text
    return answers


def hand_in(folder, learners, monkeypatch):
    """What each learner hands in, by name: the exercises of one page."""
    ways = list(arrangements.ARRANGEMENTS)
    exercises = {}
    for learner in range(learners):
        number, way = NUMBERS[learner % len(NUMBERS)], ways[learner // len(NUMBERS) % len(ways)]
        answers = of_the_bank(number, learner)
        monkeypatch.setattr(arrangements, "right_answers", lambda _, answers=answers: answers)
        page = arrangements.course()[number]
        place = folder / f"learner_{learner:03} {way}"
        place.mkdir(parents=True)
        body = json.dumps(arrangements.ARRANGEMENTS[way](number))
        (place / f"{page.lesson}.ipynb").write_text(body, encoding="utf-8")
        exercises[place.name] = {cell.exercise for cell in page.wanted}
    return exercises


def marked(folder, exercises):
    """What is not as it should be, by learner."""
    pages = tuple(arrangements.course()[number] for number in NUMBERS)
    with Ledger(None) as ledger, Pool(2) as pool:
        collection = collect(folder, pages)
        book = grade(collection, Plan(pages, "v", seed=4711), ledger, pool.observe, lambda *_: None)
    wrong = {}
    assert {graded.learner for graded in book.learners} == set(exercises)
    for graded in book.learners:
        marks = [mark for mark in graded.marks if mark.exercise in exercises[graded.learner]]
        odd = [(mark.exercise, mark.status, mark.evidence) for mark in marks
               if mark.status != "passed" or mark.differs]  # fmt: skip
        if odd or graded.remarks or len(marks) != len(exercises[graded.learner]):
            wrong[graded.learner] = odd, graded.remarks
    return wrong


@pytest.mark.parametrize(
    "learners", [20, pytest.param(200, marks=pytest.mark.thorough)], ids=["some", "many"]
)
def test_honest_submissions_pass_without_a_remark(tmp_path, monkeypatch, learners):
    exercises = hand_in(tmp_path / "class", learners, monkeypatch)
    assert marked(tmp_path / "class", exercises) == {}
