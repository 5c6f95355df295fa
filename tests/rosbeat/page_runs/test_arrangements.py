"""A right answer gets its points wherever it stands on a page.

The suite takes each way of arranging answers on two pages, and some ways on each other page. All of
them on all pages, and the pages that run live for a minute: `pytest --thorough`.
"""

import json
from dataclasses import replace

import pytest

from arrangements import ARRANGEMENTS, ONE_NAME, course
from rosbeat.exercises.registry import EXERCISES
from rosbeat.page_runs.judging import judge
from rosbeat.page_runs.notebook import read_notebook
from rosbeat.page_runs.pool import Pool
from rosbeat.page_runs.submitted_page import submitted_page

pytestmark = [pytest.mark.ros, pytest.mark.timeout(900), pytest.mark.xdist_group("arrangements")]
NUMBERS = [page.number for page in course().values() if page.wanted]
#: Of pages whose commands build packages, each arrangement takes seconds.
SLOW = {"02", "05", "06", "07", "09"}
#: Pages that run programs for half a minute and more, if all of their cells are run.
LIVE = {"06", "07"}


def every_case():
    """Each arrangement on each page; three answers of one name do not go into one cell."""
    cases = [(name, number) for name in ARRANGEMENTS for number in NUMBERS]
    return [case for case in cases if case[1] not in ONE_NAME or case[0] != "cells merged"]


def some_cases():
    """Each arrangement on pages 03 and 12, and each other page with some of them."""
    names = list(ARRANGEMENTS)
    ways = {
        number: {"as asked", *names[place % 3 :: 7 if number in SLOW else 3]}
        for place, number in enumerate(NUMBERS)
    }
    return [
        (name, number)
        for name, number in every_case()
        if number in ("03", "12") or name in ways[number]
    ]


def outcomes_of(pages, arranged):
    """The outcomes of exercises by case.

    Args:
        pages: The course's pages by number.
        arranged: Pairs of an arrangement and a number.
    """
    jobs = {}
    for name, number in arranged:
        body = json.dumps(ARRANGEMENTS[name](number)).encode()
        jobs[name, number] = submitted_page(pages[number], read_notebook(body).cells, 4711).job
    with Pool(2) as pool:
        evidence = dict(pool.observe([[(case, job)] for case, job in jobs.items()]))
    return {
        case: {
            exercise: judge(EXERCISES[exercise], seen, jobs[case].seeds[exercise])
            for exercise, seen in page.exercises.items()
        }
        for case, page in evidence.items()
    }


def not_passed(outcomes):
    return {
        exercise: (outcome.status, outcome.evidence)
        for exercise, outcome in outcomes.items()
        if outcome.status != "passed"
    }


CASES = some_cases()


@pytest.fixture(scope="module")
def outcomes():
    """The outcomes of the pages that are always run."""
    return outcomes_of(course(), CASES)


@pytest.mark.parametrize(("name", "number"), CASES, ids=lambda part: part)
def test_a_right_answer_passes_wherever_it_stands(outcomes, name, number):
    assert set(outcomes[name, number]) == {one.exercise for one in course()[number].wanted}
    assert not_passed(outcomes[name, number]) == {}


@pytest.mark.thorough
def test_every_arrangement_passes_on_every_page():
    rest = [case for case in every_case() if case not in CASES]
    wrong = {case: not_passed(some) for case, some in outcomes_of(course(), rest).items()}
    assert {case: some for case, some in wrong.items() if some} == {}


def whole(page):
    """A page of which no cell is left out."""
    return replace(page, cells=tuple(replace(cell, shows=False) for cell in page.cells))


def compare_with_whole_pages(outcomes, numbers):
    cases = [("as asked", number) for number in numbers]
    pages = {number: whole(course()[number]) for number in numbers}
    for number, page in pages.items():
        body = json.dumps(ARRANGEMENTS["as asked"](number)).encode()
        cells = read_notebook(body).cells
        left = submitted_page(course()[number], cells).job.cells
        assert len(submitted_page(page, cells).job.cells) > len(left)
    assert outcomes_of(pages, cases) == {case: outcomes[case] for case in cases}


def test_leaving_out_cells_that_only_show_something_changes_no_outcome(outcomes):
    compare_with_whole_pages(outcomes, [number for number in NUMBERS if number not in LIVE])


@pytest.mark.thorough
def test_leaving_out_what_runs_live_changes_no_outcome(outcomes):
    compare_with_whole_pages(outcomes, sorted(LIVE))


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
