"""The page of one learner: everything that was found, in kind and exact words."""

import re
from itertools import pairwise

import pytest

from graded_classes import HOSTILE, hostile_learner, mark, one_of_each
from parsed_html import ELEMENTS, Parsed
from rosbeat.grading.feedback import feedback
from rosbeat.grading.marks import Graded
from rosbeat.grading.mending import NOT_THERE, PART_NOT_THERE
from rosbeat.grading.rendering import STATUSES


@pytest.fixture(scope="module")
def page():
    return feedback(one_of_each())


@pytest.fixture(scope="module")
def text(page):
    return " ".join(Parsed(page).text.split())


@pytest.mark.parametrize(
    "said",
    [
        "Feedback for Ana Muster",
        "7.5 of 17 points so far",
        "In 60 s there were 60 messages on /temperature.",
        "A topic's name that nobody else uses.",
        "Compare the two names letter by letter.",
        "Open the page and run hint(\"03b\").",
        "it has no name for this mistake yet",
        "There is still a blank, ____.",
        "It used more memory than there is.",
        "The page was handed in after the deadline.",
        "Its cell has lost its name.",
        "Your instructor has set the points",
        "A nice idea. Next time with a shorter name?",
        "It has the exercises 05a, 05b.",
        "R2 It closes it again below 26. (optional)",
        "The window stayed open at 25.",
        "homework (1).ipynb",
        "04b raise the alarm: waits for your instructor, no points yet",
        "looked at by your instructor, 1 of 1 point Points Your instructor has set the points",
        "From your instructor Fine, for once.",
        "You have come far.",
    ],
)  # fmt: skip
def test_everything_is_said(text, said):
    assert said in text


def test_each_status_has_its_sign_and_its_word(text):
    for look in STATUSES.values():
        assert f"{look.sign} {look.word}" in text


def test_evidence_keeps_its_shape(page):
    assert "<pre>KeyError: &#39;x&#39;.\n  line 2</pre>" in page


def test_headings_skip_no_level(page):
    levels = [int(tag[1]) for tag, _ in Parsed(page).elements if re.fullmatch(r"h[1-6]", tag)]
    assert levels[0] == 1
    assert levels.count(1) == 1
    assert all(after - before <= 1 for before, after in pairwise(levels))


def test_links_lead_somewhere(page):
    elements = Parsed(page).elements
    targets = {attrs.get("id") for _, attrs in elements}
    links = [attrs["href"] for tag, attrs in elements if tag == "a"]
    assert len(links) == 4
    assert all(link.removeprefix("#") in targets for link in links)


def test_nobody_is_blamed(text):
    assert not re.search(
        r"\b(wrong|fault|bad|fail(ed|ure)?|careless)\b", text.replace("It is failed", "")
    )


def test_the_same_learner_gives_the_same_bytes():
    assert feedback(one_of_each()) == feedback(one_of_each())


@pytest.mark.parametrize("text", HOSTILE, ids=range(len(HOSTILE)))
def test_a_strange_text_stays_text(text):
    page = feedback(hostile_learner(text))
    page.encode("utf-8")
    elements = Parsed(page).elements
    assert {tag for tag, _ in elements} <= ELEMENTS
    assert not any(name.startswith("on") for _, attrs in elements for name in attrs)
    assert not set("\0\x1b\u202e") & set(page)
    assert len(page) < 400_000


def test_somebody_of_whom_nothing_was_graded_gets_a_page():
    page = feedback(Graded("7", "", "folder", ()))
    assert "No exercise was graded." in page
    assert "0 of 0 points" in page


def test_a_comment_on_a_page_that_is_missing_is_not_lost():
    page = feedback(Graded("7", "Bo", "folder", (mark("05a", "missing", comment="You were ill."),)))
    assert "You were ill." in page


def said_of(**values):
    graded = Graded("4711", "Ana", "folder", (mark("04a", **values),))
    return " ".join(Parsed(feedback(graded)).text.split())


def test_an_exercise_behind_the_end_of_its_file_says_so_and_nothing_else():
    said = "The file stops before this exercise: hand it in again."
    text = said_of(status="held", cause=said, evidence=said, file="ana/04.ipynb")
    assert f"04a watch a fridge: waits for the whole file, no points yet {said} What you" in text
    assert "0 of 1 point so far" in text
    assert "instructor looks" not in text


def test_an_answer_that_is_nowhere_is_not_said_to_have_been_found():
    text = said_of(status="not attempted", evidence=NOT_THERE, repairs=(NOT_THERE,))
    assert text.count(NOT_THERE) == 1
    assert "How your answer was found" not in text
    text = said_of(status="failed", repairs=(PART_NOT_THERE,))
    assert f"What is missing {PART_NOT_THERE}" in text
