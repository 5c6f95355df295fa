"""The steps before a page runs."""

from __future__ import annotations

from rosbeat.authoring.pages import notebook_page, solution_draft

BODY = """
# %% exercise="00a" tags=["hide-input"]
def f():
    # --- answer
    return 1
    # --- blank
    # return ____
    # --- end

# %% [markdown] only="solution"
# Why.

# %% [markdown] only="notebook"
# Your turn.
"""


def test_each_tree_gets_its_cells_and_its_part(checkout):
    lesson = checkout.lesson(BODY)
    learner, solution = notebook_page(lesson), solution_draft(lesson)
    assert [c.source for c in learner.cells] == [
        "# Hear it", "def f():\n    return ____", "Your turn."
    ]  # fmt: skip
    assert [c.source for c in solution.cells] == ["# Hear it", "def f():\n    return 1", "Why."]


def test_shared_cells_have_the_same_id_and_metadata(checkout):
    lesson = checkout.lesson(BODY)
    pairs = list(zip(notebook_page(lesson).cells, solution_draft(lesson).cells, strict=True))[:2]
    assert all(left.id == right.id and left.metadata == right.metadata for left, right in pairs)
    assert set(pairs[1][0].metadata) == {"nbgrader", "rosbeat", "tags"}
    assert pairs[1][0].metadata.rosbeat == {"exercise": "00a"}
    assert pairs[1][0].metadata.tags == ["hide-input"]


def test_the_page_says_what_it_is_and_no_more(checkout):
    metadata = notebook_page(checkout.lesson(BODY)).metadata
    assert set(metadata) == {"kernelspec", "language_info", "title", "rosbeat"}
    assert metadata.kernelspec.display_name == "Python 3 (ipykernel)"
    assert metadata.rosbeat == {"lesson": "00_hear_it"}
