"""Who is named in the report of a class, and what there is to look at."""

from dataclasses import replace

import pytest

from graded_classes import a_class, mark, one_of_each
from parsed_html import ELEMENTS, Parsed
from rosbeat.grading.cells import number
from rosbeat.grading.class_report import class_report
from rosbeat.grading.feedback import feedback_files
from rosbeat.grading.marks import Gradebook


def text_of(page):
    return " ".join(Parsed(page).text.split())


def sections(page):
    """The sections of a page, by their headings."""
    return {part.split("</h2>")[0]: part for part in page.split("<h2>")[1:]}


def test_every_learner_has_points_and_a_link_to_the_feedback():
    learners = [replace(one, name=f"Ünal & {n}") for n, one in enumerate(a_class(700).learners)]
    book = Gradebook("1", tuple(reversed(learners)))
    page = sections(class_report(book))["Learners"]
    links = [attrs["href"] for tag, attrs in Parsed(page).elements if tag == "a"]
    files = feedback_files(book)
    assert set(links) == {f"feedback/{files[one.learner]}" for one in learners}
    assert len(links) == 700
    text = text_of(page)
    one = learners[0]
    assert f"Ünal & 0 0000 {number(one.points)} ? {number(one.out_of)} 1 Ünal & 1 0001" in text


def test_a_held_answer_is_shown_as_it_is_and_stays_text():
    answer = "import os\n\n    <script>alert(1)</script>\u202e\n" + "x = 1\n" * 5_000
    held = mark("03a", "held", answer=answer, file="ana/<b>.ipynb")
    page = class_report(Gradebook("1", (replace(one_of_each(), marks=(held,)),)))
    assert "import os\n\n    &lt;script&gt;alert(1)&lt;/script&gt;\\u202e\nx = 1" in page
    assert "more characters; the file has all of them" in page
    assert {tag for tag, _ in Parsed(page).elements} <= ELEMENTS


def test_more_held_answers_than_anybody_reads_are_counted():
    held = mark("03a", "held", answer="import os", file="a")
    page = class_report(Gradebook("1", (replace(one_of_each(), marks=(held,) * 250),)))
    assert page.count("import os") == 200
    assert "And 50 more; results.json has all of them." in page
    assert "<details open>" not in page


def test_exercises_behind_the_end_of_a_file_are_named_with_it():
    marks = [mark(name, "held", file="x/04.ipynb") for name in ("04a", "04b")]
    book = Gradebook("1", (replace(one_of_each(), marks=tuple(marks)),))
    text = text_of(class_report(book))
    assert "No answer waits for you. 1 file is not whole." in text
    assert "stop before these exercises" in text
    assert "Ana Muster (4711) 04a, 04b 04.ipynb" in text


def test_what_was_looked_at_waits_for_nobody_and_is_no_mistake():
    seen = mark("03a", "looked at", points=0.5, manual=True, answer="import os")
    text = text_of(class_report(Gradebook("1", (replace(one_of_each(), marks=(seen,)),))))
    assert "No answer waits for you." in text
    assert "No answer failed." in text
    assert "✎ looked at by you 1" in text
    assert "import os" not in text


@pytest.mark.parametrize(
    "said", ["Its cell is not on the page.", "A cell of it is not on the page."]
)
def test_what_was_not_found_is_not_among_what_was(said):
    one = replace(one_of_each(), marks=(mark("04a", "not attempted", repairs=(said,)),))
    text = text_of(class_report(Gradebook("1", (one,))))
    assert "searched for" not in text
    assert f"not on the page Learner Exercise What was found Ana Muster 04a {said}" in text
