from math import nan

import pytest

from rosbeat.exercises.adjusting import (
    Answer,
    Limits,
    judge_answers,
    kept,
    phases,
)

PHASES = phases(
    Limits(26.0),
    (
        ({}, (25.0, 27.0)),
        ({"high": 24.0}, (25.0, 23.0)),
        ({"high": nan}, (25.0,)),
        ({"high": 90.0}, (25.0,)),
    ),
    lambda limits: limits.high < 90,
)
GOOD = (Answer(True), Answer(False, "no number"), Answer(False, "too hot"))
WORDS = (["Normal", "High"], ["High", "Normal"], ["High"], ["High"])


def test_what_holds_when():
    assert [one.limits.high for one in PHASES] == [26.0, 24.0, 24.0, 24.0]
    assert [one.good for one in PHASES] == [True, True, False, False]


def test_all_is_well():
    assert judge_answers(PHASES, GOOD, WORDS) is None


@pytest.mark.parametrize(
    ("place", "answer", "word", "mistake"),
    [
        (0, Answer(False, "no"), ["Normal", "Normal"], "good-value-refused"),
        (0, Answer(True), ["Normal", "Normal"], "accepted-and-lost"),
        (0, Answer(True, "thanks"), None, "reason-too-many"),
        (1, Answer(True), ["Normal"], "nan-accepted"),
        (2, Answer(True), ["Normal"], "nonsense-accepted"),
        (2, Answer(False, "no"), ["Normal"], "refused-and-kept"),
        (2, Answer(False, " "), None, "reason-missing"),
    ],
)
def test_each_mistake_has_its_name(place, answer, word, mistake):
    answers, words = list(GOOD), list(WORDS)
    answers[place] = answer
    words[place + 1] = word or words[place + 1]
    found = judge_answers(PHASES, answers, words)
    assert found is not None
    assert found.mistake == mistake


def test_a_node_that_does_everything_and_says_no():
    found = judge_answers(PHASES, [Answer(False, "")] * 3, WORDS)
    assert found is not None
    assert found.mistake == "response-not-filled"


def test_two_limits_that_depend_on_each_other_are_both_told():
    script = (({}, (25.0,)), ({"high": 19.0}, (22.0,)))
    both = phases(Limits(26.0, 20.0), script, lambda limits: limits.low < limits.high)
    found = judge_answers(both, [Answer(True)], (["Normal"], ["Normal"]))
    assert found is not None
    assert found.mistake == "nonsense-accepted"
    assert "low = 20 and high = 19" in found.evidence


def test_what_was_kept():
    assert kept(PHASES[1], ["High", "Normal"]) == "as wanted"
    assert kept(PHASES[1], ["Normal", "Normal"]) == "as before"
    assert kept(PHASES[3], ["Normal"]) == "as asked"
    assert kept(PHASES[1], ["-", "Low"]) == "otherwise"
