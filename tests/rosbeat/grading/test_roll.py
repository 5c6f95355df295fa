"""Who is meant in a table that went through a person's hands."""

import pytest

from rosbeat.grading.cells import cell
from rosbeat.grading.marks import Graded
from rosbeat.grading.roll import Roll, UnusableError

FORMULA = '=HYPERLINK("http://a.b")'


def roll(*learners):
    return Roll(Graded(*one, "folder", ()) for one in learners)


CLASS = roll(
    ("0047", "Ana Muster"), ("ben", "Ben"), ("Cy", "Cy One"), ("cy", "Cy Two"), ("0", "Zero"),
    (FORMULA, FORMULA), ("a\u202eb", "Deniz"), ("e1", "Kim Twin"), ("e2", "Kim Twin"), ("E 3", ""),
)  # fmt: skip


@pytest.mark.parametrize(
    ("text", "learner"),
    [
        ("0047", "0047"),
        ("47", "0047"),
        ("Ana Muster", "0047"),
        (" ana   muster ", "0047"),
        ("BEN", "ben"),
        ("'ben", "ben"),
        ("Cy", "Cy"),
        ("cy", "cy"),
        ("Cy Two", "cy"),
        ("0", "0"),
        ("00", "0"),
        (FORMULA, FORMULA),
        (cell(FORMULA), FORMULA),
        (cell("a\u202eb"), "a\u202eb"),
        ("e 3", "E 3"),
    ],
)
def test_a_learner_is_found(text, learner):
    assert CLASS.learner(text).learner == learner


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("", "names no learner"),
        ("nobody", "There is no learner 'nobody'"),
        ("CY", "2 learners; write the id"),
        ("Kim Twin", "2 learners; write the id"),
        ("48", "There is no learner"),
        ("ban", "There is no learner"),
        ("x\x1b" * 9_999, "\\\\u001b"),
    ],
)
def test_whoever_is_not_there_or_not_one_is_told(text, said):
    with pytest.raises(UnusableError) as caught:
        CLASS.learner(text)
    assert said in str(caught.value)
    assert "\x1b" not in str(caught.value)
    assert len(str(caught.value)) < 120


def test_an_id_comes_before_the_name_of_another():
    both = roll(("1", "2"), ("2", "1"))
    assert both.learner("1").learner == "1"
    assert both.learner("2").learner == "2"


def test_a_learner_is_found_by_what_moodle_s_worksheet_says():
    both = Roll(
        Graded(one, "Ana", system, ()) for one, system in (("11", "moodle"), ("12", "canvas"))
    )
    for text in ("Participant 11", " participant  11 "):
        assert both.learner(text).learner == "11"
    with pytest.raises(UnusableError, match="There is no learner"):
        both.learner("Participant 12")


def test_whoever_calls_himself_a_participant_is_not_taken_for_another():
    other = Graded("12", "Participant 11", "moodle", ())
    with pytest.raises(UnusableError, match="2 learners; write the id"):
        Roll([Graded("11", "Ana", "moodle", ()), other]).learner("Participant 11")
    same = Graded("11", "Participant 11", "moodle", ())
    assert Roll([same]).learner("Participant 11") is same


def test_it_is_said_where_to_look_a_learner_up():
    with pytest.raises(UnusableError) as caught:
        CLASS.learner("nobody")
    assert "the column learner of grades.csv" in caught.value.to_try


def test_an_empty_name_is_nobody_s():
    nameless = roll(("x", ""), ("y", "'"))
    for text in ("0", "00", "'", "' '"):
        with pytest.raises(UnusableError, match="There is no learner"):
            nameless.learner(text)


def test_an_id_as_a_table_shows_it_comes_before_one_that_is_only_alike():
    both = roll(("=A", ""), ("=a", ""))
    assert both.learner("'=A").learner == "=A"
    assert both.learner("'=a").learner == "=a"
