"""Every answer to an exercise of page 13 gets its outcome, and its mistake a name."""

from importlib.resources import files

import pytest

from bank.answer import edited
from bank.beyond import greenhouse_right, greenhouse_wrong, page_13, page_13_more
from bank.running import outcome_of
from bank.verdicts import assert_named, assert_sorted_out, assert_told, assert_wide, outcome

pytestmark = pytest.mark.ros

RIGHT = (*greenhouse_right.ANSWERS, *page_13_more.RIGHT)
WRONG = (*greenhouse_wrong.ANSWERS, *page_13_more.WRONG)
MISSES = greenhouse_wrong.MISSES | page_13_more.MISSES


@pytest.mark.parametrize("answer", page_13.ANSWERS, ids=lambda answer: answer.id)
def test_an_answer_is_told_what_is_right_or_wrong(answer):
    assert_told(answer, page_13.SECRETS)


def test_no_right_answer_is_refused_and_no_wrong_one_accepted():
    assert_sorted_out(page_13.ANSWERS)


def test_nineteen_of_twenty_single_mistakes_are_named():
    assert_named(page_13.ANSWERS)


def test_each_exercise_has_enough_answers():
    assert_wide("13", page_13.ANSWERS, page_13.SECRETS)


def missed(answer):
    return {part.id for part in outcome(answer).parts if not part.met}


@pytest.mark.parametrize("answer", WRONG, ids=lambda answer: answer.name)
def test_exactly_these_requirements_are_missed(answer):
    assert missed(answer) == MISSES[answer.name]


@pytest.mark.parametrize("answer", RIGHT, ids=lambda answer: answer.name)
def test_a_right_greenhouse_misses_optional_requirements_only(answer):
    assert missed(answer) <= {"R10", "R11"}
    assert outcome(answer).points == outcome(answer).out_of - len(missed(answer))


def test_the_optional_requirements_are_met_by_some_and_missed_by_others():
    kinds = {frozenset(missed(answer)) for answer in RIGHT}
    assert {frozenset(), frozenset({"R10", "R11"})} <= kinds


def test_an_adjusted_rubric_judges_by_its_own_numbers(monkeypatch, tmp_path):
    own = files("rosbeat.exercises").joinpath("rubrics/greenhouse.json").read_text()
    numbers = {'"open_above": 28.0': '"open_above": 31.5', '"pump_seconds": 5': '"pump_seconds": 8'}
    for old, new in numbers.items():
        own = own.replace(old, new)
    path = tmp_path / "mine.json"
    path.write_text(own.replace("The pump does not run", "Never runs the pump"))
    monkeypatch.setenv("ROSBEAT_RUBRIC", str(path))
    usual = outcome_of("13b", greenhouse_right.BASE, "greenhouse")
    assert {part.id for part in usual.parts if not part.met} >= {"R1", "R2"}
    text = edited(greenhouse_right.BASE, ("28.0", "31.5"), ("timer(5.0", "timer(8.0"))
    adjusted = outcome_of("13b", text, "greenhouse")
    assert (adjusted.status, adjusted.points) == ("passed", 20)
    assert "Never runs the pump" in adjusted.parts[2].text


def test_a_temperature_of_zero_is_in_the_mean(monkeypatch, tmp_path):
    own = files("rosbeat.exercises").joinpath("rubrics/greenhouse.json").read_text()
    numbers = (("28.0", "6.0"), ("26.0", "4.0"), ("-20.0", "-60.0"))
    for old, new in numbers:
        own = own.replace(old, new)
    path = tmp_path / "cold.json"
    path.write_text(own, encoding="utf-8-sig")
    monkeypatch.setenv("ROSBEAT_RUBRIC", str(path))
    judged = outcome_of("13b", edited(greenhouse_right.BASE, *numbers), "greenhouse")
    assert (judged.status, judged.points) == ("passed", 20)
