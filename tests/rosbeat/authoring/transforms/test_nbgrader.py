"""What a page tells nbgrader, for which `tests/with_nbgrader` then runs nbgrader itself."""

from __future__ import annotations

import pytest

from rosbeat.authoring.pages import notebook_page, solution_draft

BODY = """
# %%
import time

# %% exercise="00a"
def f():
    # --- answer
    return 1
    # --- blank
    # return ____
    # --- end

# %% terminal="one" exercise="00a"
# # --- answer
# ls
# # --- blank
# # ____
# # --- end

# %% check="00a"
check("00a", f)

# %% save="src/a.py" exercise="00b"
# --- answer
b = 1
# --- blank
# b = ____
# --- end

# %% check="00b"
check("00b", b)
"""
NOTHING = {"grade": False, "locked": False, "solution": False, "task": False, "schema_version": 3}


def told(page):
    return [cell.metadata.nbgrader for cell in page.cells if "nbgrader" in cell.metadata]


@pytest.mark.parametrize("make", [notebook_page, solution_draft])
def test_answers_are_solutions_and_checks_give_the_points(checkout, make):
    page = make(checkout.lesson(BODY), {"00a": 4})
    check = {**NOTHING, "grade": True, "locked": True}
    assert told(page) == [
        {**NOTHING, "solution": True, "grade_id": "00a"},
        {**NOTHING, "solution": True, "grade_id": "00a-2"},
        {**check, "grade_id": "00a-check", "points": 4},
        {**NOTHING, "solution": True, "grade_id": "00b"},
        {**check, "grade_id": "00b-check", "points": 1},
    ]


def test_other_cells_are_nothing_to_nbgrader(checkout):
    page = notebook_page(checkout.lesson(BODY))
    assert [("nbgrader" in cell.metadata) for cell in page.cells][:2] == [False, False]


def test_a_name_does_not_depend_on_the_text_of_its_cell(checkout):
    before = told(notebook_page(checkout.lesson(BODY)))
    after = told(notebook_page(checkout.lesson(BODY.replace("def f", "def g"))))
    assert before == after
