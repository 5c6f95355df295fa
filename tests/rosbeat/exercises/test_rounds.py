"""Rounds through the ward: what is judged is plain data, and hints are counted."""

import json
from dataclasses import replace

import pytest
from rosbeat.exercises.check import check
from rosbeat.exercises.evidence import from_json, to_json
from rosbeat.exercises.hint import hint
from rosbeat.exercises.scenarios import Report

from rosbeat.exercises.page_10_scenarios import SCENARIOS
from rosbeat.exercises.rounds import Rounds, examine, judge, judge_rounds

pytestmark = pytest.mark.ros

SILENT = range(1, 5)
RIGHT = {
    1: ("topic-misspelled", "/hall_Temperature"),
    2: ("first-messages-lost", "/cellar_rule"),
    3: ("node-ended", "/shelf_sensor"),
    4: ("not-spun", "/booth_probe"),
}
BLANK = ("____", "____")


def given(**changes):
    return {**RIGHT, **{int(key[1:]): value for key, value in changes.items()}}


def seen(**changes):
    return SCENARIOS["10a"](lambda: given(**changes))


def judged(report):
    return judge("10a", SILENT)(report)


def test_four_right_diagnoses_pass():
    outcome = judged(seen())
    assert outcome.status == "passed"
    assert outcome.evidence == "Patients 1, 2, 3 and 4 are diagnosed."


def test_an_untouched_cell_is_not_attempted():
    outcome = judged(seen(p1=BLANK, p2=BLANK, p3=BLANK, p4=BLANK))
    assert (outcome.status, outcome.evidence) == (
        "not attempted",
        "No patient has a diagnosis yet.",
    )


def test_blanks_wait_until_what_is_there_is_right():
    outcome = judged(seen(p2=BLANK, p4=BLANK))
    assert outcome.mistake == "no-diagnosis-yet"
    assert outcome.evidence == "Patients 1 and 3 are right. Patient 2: no diagnosis yet."
    outcome = judged(seen(p2=BLANK, p3=("gone-quiet", "/shelf_sensor"), p4=BLANK))
    assert outcome.mistake == "contradicted"
    assert outcome.evidence.startswith("Patient 1 is right. Patient 3: you say gone-quiet at")


def test_every_wrong_patient_is_told_what_speaks_against_it():
    outcome = judged(seen(p1=("not-spun", "/hall_notebook"), p4=("node-ended", "/booth_probe")))
    assert "Patients 2 and 3 are right." in outcome.evidence
    assert "Patient 1: you say not-spun at /hall_notebook; yet" in outcome.evidence
    assert "Patient 4: you say node-ended at /booth_probe; yet no exception" in outcome.evidence


def test_hints_are_counted_and_cost_nothing():
    assert check("10a", given).outcome.evidence.endswith("are diagnosed.")
    hint("10a")
    assert check("10a", given).outcome.evidence.endswith("are diagnosed. (With 1 hint.)")
    hint("10a")
    outcome = check("10a", lambda: given(p1=("not-spun", "/hall_notebook"))).outcome
    assert outcome.evidence.endswith("(With 2 hints.)")
    outcome = check("10a", given).outcome
    assert (outcome.status, outcome.points) == ("passed", 2)


def test_what_cannot_be_read_is_not_run():
    for value in ([1, 2], {"ward": "x"}, {"9": ["not-spun", "/a"]}, None):
        report = Report(json.dumps(value), "", "x")
        assert examine("10a", report, SILENT) == Rounds(report)
        assert judged(report).status == "failed"
    assert judged(Report("", "NameError: name '____' is not defined")).status == "not attempted"


def test_the_evidence_is_the_same_when_it_was_written_down():
    report = seen(p3=("gone-quiet", "/shelf_watch"))
    again = from_json(to_json(report))
    assert again == report
    assert judged(again) == judged(report)


def test_the_judge_goes_by_what_the_case_says():
    rounds = examine("10a", seen(), SILENT)
    assert judge_rounds("10a", rounds, SILENT).status == "passed"
    others = tuple(replace(chart, truths=()) for chart in rounds.charts)
    assert judge_rounds("10a", replace(rounds, charts=others), SILENT).status == "failed"
