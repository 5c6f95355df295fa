"""What `rosbeat grade` says at its end."""

from pathlib import Path

import pytest

from graded_classes import HOSTILE, a_class, hostile_learner, mark
from rosbeat.grading.marks import Gradebook, Graded
from rosbeat.grading.remarks import Remark
from rosbeat.grading.summary import summary

OUT = Path("GRADES")


def book(*marks, remarks=(), own=()):
    return Gradebook("0.1.0", (Graded("ana", "Ana", "folder", marks, own),), remarks)


def test_learners_exercises_and_outcomes_are_counted():
    marks = (mark(), mark("03b", "failed"), mark("03c", "failed"), mark("04a", "not attempted"),
             mark("04b", "missing"))  # fmt: skip
    lines = summary(book(*marks), OUT).splitlines()
    assert lines[0] == (
        "1 learner, 5 exercises: 1 right, 2 wrong, 1 not attempted, 1 not handed in."
    )
    assert lines[1] == "On average 1 of 5 points."
    assert "GRADES" in lines[-1]
    assert len(lines) == 3


def test_the_most_frequent_mistake_is_named():
    marks = [mark("03b", "failed", mistake="topic-misspelled")] * 3
    marks += [mark("03a", "failed", mistake="depth-missing")] * 2
    told = summary(book(*marks), OUT)
    assert "a topic's name that nobody else uses (3 times, in 03b)" in told
    assert "queue depth" not in told


def test_a_mistake_that_was_made_once_is_not_called_frequent():
    told = summary(book(mark("04c", "failed", mistake="wrong-window")), OUT)
    assert "frequent" not in told


def test_what_is_held_is_named_with_what_to_do():
    held = mark("03b", "held", answer="import os", file="x")
    told = summary(book(mark(), held), OUT)
    assert "1 held" in told
    assert "Held for you to look at: Ana (ana) 03b." in told
    assert f"into {OUT / 'manual.csv'}" in told
    many = summary(book(*[held] * 100), OUT)
    assert "and 95 more" in many


def test_exercises_behind_the_end_of_a_file_are_told():
    half = [mark(name, "held", file="x") for name in ("04a", "04b")]
    told = summary(book(mark(), *half), OUT)
    assert "Half uploaded, so without points for these exercises: Ana (ana) 04a, 04b." in told
    assert "Held for you" not in told


def test_what_a_person_has_looked_at_is_not_wrong():
    told = summary(book(mark(), mark("03b", "looked at")), OUT)
    assert "1 right, 1 looked at by you." in told


def test_remarks_about_files_are_counted_and_lines_by_hand_are_shown():
    late = Remark("late", "a", "b")
    by_hand = Remark("manual", "manual.csv, line 7", "There is no learner 'x'.")
    told = summary(
        book(mark(), remarks=(by_hand, Remark("left-out", "a", "b")), own=(late,) * 2), OUT
    )
    assert "3 remarks about files: 2 late, 1 left-out." in told
    assert "manual.csv, line 7: There is no learner 'x'." in told
    assert "and 15 more" in summary(book(remarks=(by_hand,) * 20), OUT)


def test_a_class_of_nobody_has_a_summary():
    assert summary(Gradebook("0.1.0", ()), OUT).startswith("0 learners, 0 exercises: nothing")


@pytest.mark.parametrize("size", [1, 30, 300])
def test_a_few_lines_are_enough_for_every_class(size):
    assert len(summary(a_class(size), OUT).splitlines()) <= 8


@pytest.mark.parametrize("text", [*HOSTILE, "x\x1b]0;title\x07", "\u009b31m"])
def test_no_text_reaches_the_terminal_as_it_is(text):
    remarks = tuple(Remark(about, text, text) for about in ("manual", text))
    told = summary(Gradebook("0.1.0", (hostile_learner(text),), remarks), Path(text or "out"))
    assert all(line.isprintable() for line in told.split("\n"))
    assert len(told) < 6_000
    assert len(told.splitlines()) <= 12
