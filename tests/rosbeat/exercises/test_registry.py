"""Exercises, their pages, their scenarios and their answers."""

from pathlib import Path

import pytest

from rosbeat.authoring.build import answer_files
from rosbeat.authoring.source import Course
from rosbeat.errors import ExerciseError
from rosbeat.exercises.registry import EXERCISES, PAGES, find, scenario

COURSE = Course(Path(__file__).parents[3])
LESSONS = {lesson.number: lesson for lesson in COURSE.lessons() if lesson.number}
CELLS = {
    cell.exercise: cell for lesson in LESSONS.values() for cell in lesson.cells if cell.exercise
}


def test_the_pages_are_those_of_the_course_with_what_their_headers_say():
    pages = [(p.number, p.title, p.lesson, p.minutes, p.needs) for p in PAGES if p.number]
    heads = [(lesson, lesson.header) for lesson in LESSONS.values()]
    assert pages == [(one.number, h.title, one.name, h.minutes, h.needs) for one, h in heads]
    assert {page.lesson for page in PAGES} == {lesson.name for lesson in LESSONS.values()}


def test_every_exercise_on_a_page_can_be_checked():
    on_pages = {one.id: page.number for page in PAGES if page.number for one in page.exercises}
    assert on_pages == {name: name[:2] for name in CELLS}


def test_exercises_of_no_page_come_last():
    numbered = [bool(page.number) for page in PAGES]
    assert numbered == sorted(numbered, reverse=True)
    assert len(EXERCISES) == sum(len(page.exercises) for page in PAGES)


def test_the_answers_are_made_from_the_lessons():
    wanted = {path.name: text for path, text in answer_files(COURSE, LESSONS.values()).items()}
    folder = COURSE.root / "src/rosbeat/exercises/solved"
    found = {path.name: path.read_bytes() for path in folder.iterdir()}
    assert found == wanted, "an answer is not what its lesson says: run `rosbeat build`"


@pytest.mark.parametrize("name", ["03a", " 03A ", "03a\n"])
def test_an_exercise_is_found_by_its_id(name):
    assert find(name, "check({})").id == "03a"


@pytest.mark.parametrize(("name", "near"), [("3a", "03a"), ("03_a", "03a"), (3, "0"), (None, "0")])
def test_an_unknown_one_is_refused_with_the_nearest(name, near, says):
    with pytest.raises(ExerciseError, match="There is no exercise") as caught:
        find(name, "hint({})")
    says(caught.value, f'hint("{near}', ", ".join(sorted(EXERCISES)))


# Scenarios.


@pytest.mark.parametrize("name", ["", "03", "03z", "99a", "page_03", "registry", "../03a"])
def test_what_is_no_exercise_has_none(name, says):
    with pytest.raises(ExerciseError) as caught:
        scenario(name)
    says(caught.value, repr(name), "03a", "system")
