"""Both trees say what the sources say. Outputs are nbval's business, so nothing is run here."""

from __future__ import annotations

from pathlib import Path

import nbformat
import pytest

from rosbeat.authoring import pages
from rosbeat.authoring.build import compare, stale_pages
from rosbeat.authoring.lint import check_lessons
from rosbeat.authoring.source import Course, read_lesson
from rosbeat.exercises.registry import EXERCISES

COURSE = Course(Path(__file__).parents[2])
POINTS = {one.id: one.points for one in EXERCISES.values()}
LESSONS = COURSE.lessons()
SOURCES = sorted(COURSE.sources.glob("*.py"))
each_source = pytest.mark.parametrize("source", SOURCES, ids=lambda path: path.stem)


def without_outputs(page):
    for cell in page.cells:
        if cell.cell_type == "code":
            cell.outputs, cell.execution_count = [], None
    return pages.to_bytes(page)


@each_source
def test_the_source_keeps_the_rules(source):
    findings = check_lessons(COURSE, LESSONS, [read_lesson(source)])
    assert not findings, "\n".join(map(str, findings))


@each_source
def test_the_learners_page_is_built_from_the_source(source):
    page = COURSE.notebooks / f"{source.stem}.ipynb"
    made = pages.notebook_page(read_lesson(source), POINTS, LESSONS)
    change = compare(page, pages.to_bytes(made))
    assert change is None or not change.matters, BUILD


@each_source
def test_the_solution_page_is_built_from_the_source(source):
    stored = nbformat.read(COURSE.solutions / f"{source.stem}.ipynb", as_version=4)
    draft = pages.solution_page(
        read_lesson(source), COURSE.solutions, fresh=True, points=POINTS, lessons=LESSONS,
        run=lambda page, folder: page,
    )  # fmt: skip
    assert without_outputs(stored) == without_outputs(draft), BUILD


@pytest.mark.parametrize("folder", [COURSE.notebooks, COURSE.solutions], ids=lambda path: path.name)
def test_every_page_has_its_source(folder):
    assert stale_pages(folder, {source.stem for source in SOURCES}) == []


BUILD = "the page is not what its source says: run `rosbeat build`"
