"""The questions at the end of a page: what is shown, what is said to an answer, and bad calls."""

import re

import pytest

from rosbeat import quiz
from rosbeat.errors import ExerciseError
from rosbeat.exercises.quiz import QUESTIONS

EVERY = [question for questions in QUESTIONS.values() for question in questions]


def letters(number, right=True):
    """A letter for each question of a page: of its right choice, or of its first wrong one."""
    found = [[one.right for one in question.choices] for question in QUESTIONS[number]]
    return ["abc"[choices.index(right)] for choices in found]


@pytest.mark.parametrize("question", EVERY, ids=lambda one: one.id)
def test_a_question_has_one_right_choice_and_a_reason_for_each(question):
    assert re.fullmatch(r"\d\d\.[123]", question.id)
    assert len(question.choices) == 3
    assert sum(one.right for one in question.choices) == 1
    assert question.text.endswith("?")
    assert len({one.text for one in question.choices}) == 3
    for one in question.choices:
        assert one.reason.endswith(".")
        assert (one.text + one.reason).count("`") % 2 == 0


@pytest.mark.parametrize("number", QUESTIONS)
def test_a_page_has_three_questions_whose_right_letters_differ(number):
    assert [one.id for one in QUESTIONS[number]] == [f"{number}.{n}" for n in (1, 2, 3)]
    assert len(set(letters(number))) > 1  # a person who always takes the same letter is not right


@pytest.mark.parametrize("number", QUESTIONS)
def test_right_answers_are_confirmed_with_their_reasons(number):
    said = str(quiz(number, *letters(number)))
    assert said.count("\N{CHECK MARK}") == 3
    for question in QUESTIONS[number]:
        (right,) = [one for one in question.choices if one.right]
        assert right.reason in said
    assert "To answer" not in said


def test_a_wrong_answer_gets_its_own_reason_and_does_not_give_the_right_one_away():
    said = str(quiz("03", *letters("03", right=False)))
    assert said.count("\N{BALLOT X}") == 3
    for question in QUESTIONS["03"]:
        (right,) = [one for one in question.choices if one.right]
        assert right.reason not in said
    assert "To answer" in said


def test_every_choice_stays_the_chosen_one_is_marked_and_its_reason_comes_once():
    first, *_ = QUESTIONS["03"]
    shown = quiz("03", "a")
    for said in (str(shown).split("Question 03.2")[0], shown.html().split("Question 03.2")[0]):
        assert all(f"{letter}) " in said for letter in "abc")
        assert "\N{RIGHTWARDS ARROW} a)" in said
    said = str(shown)
    assert said.count(first.choices[0].reason) == 1
    assert not any(one.reason in said for one in first.choices[1:])


@pytest.mark.parametrize(
    ("call", "said"),
    [
        (("99",), "There are no questions for page '99'."),
        (("03", "b", "a", "c", "a"), "`quiz` was given 4 answers."),
        (("03", "d"), "'d' is not an answer to question 03.1."),
        (("03", 1), "1 is not an answer to question 03.1."),
    ],
)
def test_a_wrong_call_is_answered_in_three_parts(call, said):
    with pytest.raises(ExerciseError) as raised:
        quiz(*call)
    assert raised.value.what == said
    assert raised.value.means
    assert raised.value.to_try


def test_a_call_without_a_page_means_the_page_at_hand(monkeypatch):
    monkeypatch.setenv("JPY_SESSION_NAME", "/home/ana/03_write_a_publisher.ipynb")
    assert str(quiz()) == str(quiz("03"))
    monkeypatch.setenv("JPY_SESSION_NAME", "/home/ana/Untitled.ipynb")
    with pytest.raises(ExerciseError, match="Which page is meant"):
        quiz()
