"""The golden course: one small lesson and both of its pages, byte for byte.

After a wanted change: `rosbeat build --root tests/golden`, and look at the difference.
"""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from rosbeat.authoring import pages
from rosbeat.authoring.lint import check_lessons
from rosbeat.authoring.source import Course, read_lesson

GOLDEN = Course(Path(__file__).parents[2] / "golden")
NAME = "00_hear_a_pulse.ipynb"


@pytest.fixture(scope="module")
def lesson():
    return GOLDEN.lessons()[0]


def test_the_learners_page_is_golden(lesson):
    made = pages.to_bytes(pages.notebook_page(lesson))
    assert made == (GOLDEN.notebooks / NAME).read_bytes()


def test_the_solution_page_is_golden_outputs_included(lesson, tmp_path):
    made = pages.to_bytes(pages.solution_page(lesson, tmp_path))
    assert made == (GOLDEN.solutions / NAME).read_bytes()


def test_the_golden_lesson_keeps_every_rule(lesson):
    assert check_lessons(GOLDEN, [lesson], [lesson]) == []


def test_one_changed_sentence_is_one_changed_line_in_each_page(lesson, tmp_path):
    old, new = "It is short, it needs no ROS", "It is brief, it needs no ROS"
    source = tmp_path / lesson.path.name
    source.write_text(lesson.path.read_text().replace(old, new))
    other = read_lesson(source)
    for make in (pages.notebook_page, pages.solution_draft):
        before, after = (pages.to_bytes(make(x)).splitlines() for x in (lesson, other))
        changed = [pair for pair in zip(before, after, strict=True) if pair[0] != pair[1]]
        assert len(changed) == 1


def test_pages_hold_no_version_no_time_and_no_place():
    for tree in (GOLDEN.notebooks, GOLDEN.solutions):
        text = (tree / NAME).read_text()
        assert "version" not in text.replace('"schema_version": 3', "")  # nbgrader's, not ours
        assert "ipykernel_" not in text
        assert "/" + "tmp" not in text


def test_the_learners_page_is_blank():
    page = json.loads((GOLDEN.notebooks / NAME).read_text())
    code = [cell for cell in page["cells"] if cell["cell_type"] == "code"]
    assert all(cell["outputs"] == [] and cell["execution_count"] is None for cell in code)


def test_the_solution_page_counts_its_cells():
    page = json.loads((GOLDEN.solutions / NAME).read_text())
    counts = [cell["execution_count"] for cell in page["cells"] if cell["cell_type"] == "code"]
    assert counts == list(range(1, len(counts) + 1))
