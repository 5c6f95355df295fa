"""What a prediction becomes on the two pages."""

from __future__ import annotations

from rosbeat.authoring import pages
from rosbeat.authoring.lint import check_lessons

BODY = """
    # %% predict=true
    def steps():
        return [1, 2, 3]

    # --- answer
    predict(3, len(steps()), because="It counts.")
    # --- blank
    # predict("____", len(steps()), because="It counts.")
    # --- end
"""


def cell(page):
    return next(one.source for one in page.cells if "def steps" in one.source)


def test_the_learner_is_asked_and_the_solution_knows(checkout):
    lesson = checkout.lesson(BODY, filler=True)
    assert check_lessons(checkout.course, [lesson], [lesson]) == []
    asked, answered = cell(pages.notebook_page(lesson)), cell(pages.solution_draft(lesson))
    assert asked.endswith('\n\npredict("____", len(steps()), because="It counts.")')
    assert answered.endswith('\n\npredict(3, len(steps()), because="It counts.")')
    assert asked.splitlines()[:-1] == answered.splitlines()[:-1]


def test_nothing_of_it_is_written_into_the_page(checkout):
    page = pages.notebook_page(checkout.lesson(BODY))
    assert all("predict" not in str(one.metadata) for one in page.cells)


def test_a_finding_says_what_to_do(checkout):
    lesson = checkout.lesson("# %%\npredict(3, len([]))", filler=True)
    (finding,) = check_lessons(checkout.course, [lesson], [lesson])
    assert (finding.lint, finding.to_try) == (
        "predictions",
        "Begin the cell with '# %% predict=true'.",
    )
