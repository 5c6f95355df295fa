"""What a page promises is practised on it: objectives have exercises, predictions an input."""

import re
from pathlib import Path

import pytest

from rosbeat.authoring.source import read_lesson
from rosbeat.exercises.quiz import QUESTIONS
from rosbeat.exercises.registry import EXERCISES, PAGES

LESSONS = Path(__file__).resolve().parents[1] / "src" / "lessons"
HEAD = "# **After this page, you can:**\n#\n"
#: The pages that state their objectives.
STATED = sorted(path for path in LESSONS.glob("[0-9]*.py") if HEAD in path.read_text("utf-8"))


def objectives(path):
    listed = path.read_text("utf-8").split(HEAD, 1)[1].split("#\n", 1)[0]
    return re.findall(r"(?m)^# - ((?:.*\n)(?:#   .*\n)*)", listed)


def test_every_page_states_what_one_can_do_after_it():
    assert sorted(LESSONS.glob("[0-9]*.py")) == STATED


@pytest.mark.parametrize("path", STATED, ids=lambda path: path.stem)
def test_each_objective_is_practised_on_the_page(path):
    number = path.name[:2]
    (page,) = [one for one in PAGES if one.number == number]
    exercises = {one.id for one in page.exercises}
    questions = {one.id for one in QUESTIONS[number]}
    items = objectives(path)
    assert 3 <= len(items) <= 5
    named = []
    for item in items:
        ids = {one for said in re.findall(r"\(([^()]*)\)", item) for one in said.split(", ")}
        assert ids
        assert ids <= exercises | questions
        named += ids
    assert exercises <= set(named)


@pytest.mark.parametrize("path", STATED, ids=lambda path: path.stem)
def test_each_prediction_has_an_input(path):
    """Whoever is asked to predict finds a blank to fill in before the text goes on."""
    asked = None
    for cell in read_lesson(path).cells:
        if cell.kind == "markdown":
            assert asked is None, f"line {asked} asks for a prediction, and no cell takes it"
            asked = cell.line if "**Predict" in cell.source else None
        elif cell.predict:
            assert asked, f"line {cell.line} takes a prediction that nobody asked for"
            asked = None
    assert asked is None


def headings(path):
    """The heading above each exercise, and how many exercises share it."""
    above, found = "", {}
    for cell in read_lesson(path).cells:
        if cell.kind == "markdown":
            above = ([above, *re.findall(r"(?m)^## (?:Try it: )?(.+)$", cell.source)])[-1]
        elif cell.exercise:
            found.setdefault(above, []).append(cell.exercise)
    return {one: (above, len(set(ids))) for above, ids in found.items() for one in ids}


@pytest.mark.parametrize("path", STATED, ids=lambda path: path.stem)
def test_an_exercise_is_called_what_its_heading_says(path):
    """So that a learner finds the exercise that progress and a grade name."""
    for exercise, (heading, sharing) in headings(path).items():
        title = EXERCISES[exercise].title
        assert sharing > 1 or title.removesuffix(" each").endswith(heading), exercise
