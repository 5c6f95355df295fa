"""The report of a class: counted, drawn, and said in words as well."""

from dataclasses import replace

import pytest

from graded_classes import HOSTILE, a_class, hostile_learner, one_of_each
from parsed_html import ELEMENTS, Parsed
from rosbeat.grading.class_report import class_report
from rosbeat.grading.marks import Gradebook
from rosbeat.grading.tally import tally_exercises, tally_mistakes

ONE = Gradebook("0.1.0", (one_of_each(),))


def text_of(page):
    return " ".join(Parsed(page).text.split())


@pytest.mark.parametrize(
    "said",
    [
        "1 learner, 10 exercises. 1 answer waits for you to look at.",
        "Judged by version 0.1.0",
        "40 to 49 %: 1 learner",
        "A topic's name that nobody else uses",
        "Hint for the class: Compare the two names letter by letter.",
        "03 Write a publisher",
        "Ana Muster (4711), 04b raise the alarm in 04.ipynb It used more memory than there is.",
        "The answer, 2 lines import os class A: pass",
        "Ana Muster (4711) 03c KeyError: 'x'.",
        "Ana Muster homework (1).ipynb This is the page 03; it has another name.",
        "Ana Muster 04c Its cell has lost its name.",
    ],
)
def test_everything_is_said(said):
    assert said in text_of(class_report(ONE))


def test_the_numbers_are_those_of_the_class():
    book = a_class(60)
    text = text_of(class_report(book))
    for one in tally_mistakes(book):
        assert f"{one.count} answers of {one.learners} learners" in text
    for one in tally_exercises(book)[:5]:
        assert f"{one.exercise} {one.title} " in text
        assert f"✓ passed {one.counts['passed']}" in text


def test_each_drawing_is_said_in_words():
    elements = Parsed(class_report(a_class(30))).elements
    drawn = [attrs for tag, attrs in elements if tag == "svg"]
    assert len(drawn) > 40
    assert all(attrs["role"] == "img" and ": " in attrs["aria-label"] for attrs in drawn)
    assert [tag for tag, _ in elements].count("table") > 5


def test_nobody_is_named_who_need_not_be():
    book = a_class(20)
    named = "Learner 4"  # nothing of this learner was late, held or nameless
    clean = next(one for one in book.learners if one.name == named)
    quiet = Gradebook("1", (*ONE.learners, _without_trouble(clean)))
    page = class_report(quiet)
    assert text_of(page).count(named) == 1
    assert "<details>\n<summary>2 learners" in page


def _without_trouble(learner):
    marks = tuple(replace(one, status="passed", repairs=()) for one in learner.marks)
    return replace(learner, marks=marks, remarks=())


@pytest.mark.parametrize("size", [0, 1, 1000])
def test_classes_of_every_size(size):
    page = class_report(a_class(size))
    assert page == class_report(a_class(size))
    assert len(page) < 1_000_000
    assert {tag for tag, _ in Parsed(page).elements} <= ELEMENTS


def test_strange_texts_stay_text():
    page = class_report(Gradebook("<b>", tuple(hostile_learner(one) for one in HOSTILE)))
    page.encode("utf-8")
    elements = Parsed(page).elements
    assert {tag for tag, _ in elements} <= ELEMENTS
    assert not any(name.startswith("on") for _, attrs in elements for name in attrs)
    assert not set("\0\x1b\u202e") & set(page)
