"""A right answer gets its points wherever it stands on a page.

The suite takes each way of arranging answers on one page, and another way on each other page. All
of them on all pages, some 170 pages: `pytest --thorough`.
"""

import json
from dataclasses import replace

import pytest

from arrangements import ARRANGEMENTS, ONE_NAME, course
from rosbeat.exercises.registry import EXERCISES
from rosbeat.grading.judging import judge
from rosbeat.grading.notebook import read_notebook
from rosbeat.grading.pool import Pool
from rosbeat.grading.submitted_page import submitted_page

pytestmark = [pytest.mark.ros, pytest.mark.timeout(900), pytest.mark.xdist_group("arrangements")]
NUMBERS = [page.number for page in course().values() if page.wanted]
#: Of pages whose commands build packages, each arrangement takes seconds.
SLOW = {"02", "05", "06", "07", "09"}


def chosen(thorough):
    """Each arrangement on pages 03 and 12, and each other page with some of them."""
    names = list(ARRANGEMENTS)
    found = [(name, number) for name in names for number in (NUMBERS if thorough else ("03", "12"))]
    for place, number in enumerate(NUMBERS):
        ways = ["as asked", *names[place % 3 :: 7 if number in SLOW else 3]]
        found += [(name, number) for name in ways]
    return [
        (name, number)
        for name, number in dict.fromkeys(found)
        if not (number in ONE_NAME and name == "cells merged")
    ]


CASES = chosen(False)


@pytest.fixture(scope="module")
def outcomes(request):
    """The outcome of each exercise by arrangement and page."""
    jobs = {}
    for name, number in chosen(True):
        if (name, number) in CASES or request.config.getoption("--thorough", False):
            body = json.dumps(ARRANGEMENTS[name](number)).encode()
            jobs[name, number] = submitted_page(
                course()[number], read_notebook(body).cells, 4711
            ).job
    with Pool(2) as pool:
        seen = dict(pool.observe([[(key, job)] for key, job in jobs.items()]))
    return {
        key: {
            exercise: judge(EXERCISES[exercise], evidence, jobs[key].seeds[exercise])
            for exercise, evidence in page.exercises.items()
        }
        for key, page in seen.items()
    }


@pytest.mark.parametrize(("name", "number"), CASES, ids=lambda case: case)
def test_a_right_answer_passes_wherever_it_stands(outcomes, name, number):
    wrong = {
        exercise: (one.status, one.evidence)
        for exercise, one in outcomes[name, number].items()
        if one.status != "passed"
    }
    assert wrong == {}


@pytest.fixture(scope="module")
def whole_outcomes(request):
    """The outcomes of right answers on pages of which no cell is left out."""
    slow = () if request.config.getoption("--thorough", False) else ("06", "07")
    jobs = {}
    for number in (number for number in NUMBERS if number not in slow):
        page = course()[number]
        whole = replace(page, cells=tuple(replace(cell, shows=False) for cell in page.cells))
        body = json.dumps(ARRANGEMENTS["as asked"](number)).encode()
        jobs[number] = submitted_page(whole, read_notebook(body).cells, 4711).job
        assert len(jobs[number].cells) > len(
            submitted_page(page, read_notebook(body).cells).job.cells
        )
    with Pool(2) as pool:
        seen = dict(pool.observe([[(number, job)] for number, job in jobs.items()]))
    return {
        number: {
            exercise: judge(EXERCISES[exercise], evidence, jobs[number].seeds[exercise])
            for exercise, evidence in page.exercises.items()
        }
        for number, page in seen.items()
    }


def test_leaving_out_cells_that_only_show_something_changes_no_outcome(outcomes, whole_outcomes):
    compared = {number: outcomes["as asked", number] for number in whole_outcomes}
    assert compared == whole_outcomes


def test_a_cell_that_a_learner_builds_on_is_not_left_out():
    page = course()["03"]
    body = ARRANGEMENTS["as asked"]("03")
    run = submitted_page(page, read_notebook(json.dumps(body).encode()).cells).job
    assert not any("ros.run(seconds=5)" in cell.source for cell in run.cells)
    body["cells"].append({"cell_type": "code", "metadata": {}, "source": "print(ros.time)"})
    run = submitted_page(page, read_notebook(json.dumps(body).encode()).cells).job
    assert any("ros.run(seconds=5)" in cell.source for cell in run.cells)


def test_there_are_a_dozen_ways():
    assert len(ARRANGEMENTS) >= 12
    assert {name for name, _ in CASES} == set(ARRANGEMENTS)
    assert {number for _, number in CASES} == set(NUMBERS)
