from __future__ import annotations

import pytest

from rosbeat.authoring.layout import choose, find_course
from rosbeat.errors import LessonError


def test_a_course_is_found_from_anywhere_inside(checkout):
    assert find_course(checkout.course.sources) == checkout.course


def test_outside_of_a_course_the_cure_is_said(tmp_path):
    with pytest.raises(LessonError, match="no lessons are found") as caught:
        find_course(tmp_path)
    assert "--root" in caught.value.to_try


@pytest.mark.parametrize(
    "name", ["01", "01_say_it", "notebooks/01_say_it.ipynb", "src/lessons/01_say_it.py"]
)
def test_lessons_are_chosen_by_number_name_or_file(checkout, name):
    checkout.write("")
    checkout.write("", name="01_say_it")
    lessons = checkout.course.lessons()
    assert [lesson.name for lesson in choose(lessons, [name])] == ["01_say_it"]
    assert choose(lessons, []) == lessons


def test_an_unknown_lesson_names_the_known_ones(checkout):
    lesson = checkout.lesson("")
    with pytest.raises(LessonError) as caught:
        choose([lesson], ["09"])
    assert "00_hear_it" in caught.value.to_try
