"""Page 10: diagnoses are read, and compared with charts, where no learner's code runs."""

import subprocess
import sys
from functools import cache

import pytest

from rosbeat.clinic.diagnoses import KNOWN
from rosbeat.clinic.patients import Ward
from rosbeat.exercises.check import check
from rosbeat.exercises.hint import hint
from rosbeat.exercises.page_10 import Claim, weigh
from rosbeat.exercises.registry import EXERCISES

pytestmark = pytest.mark.ros

RIGHT = {
    1: ("topic-misspelled", "/hall_Temperature"),
    2: ("first-messages-lost", "/cellar_rule"),
    3: ("node-ended", "/shelf_sensor"),
    4: ("not-spun", "/booth_probe"),
}
BLANK = ("____", "____")
CODE = """
import sys
from rosbeat.exercises.registry import scenario
seen = scenario("10a")(lambda: {1: ("not-spun", "/a"), "ward": 8})
assert seen.value == {"1": ["not-spun", "/a"], "ward": 8}
sys.exit(any(name.startswith("rosbeat.clinic") for name in sys.modules))
"""


def seen(value):
    return EXERCISES["10a"].scenario(lambda: value)


def judged(value):
    return EXERCISES["10a"].judged(seen(value))


def test_the_clinic_is_not_loaded_where_an_answer_runs():
    assert subprocess.run([sys.executable, "-c", CODE], check=False).returncode == 0


# What can be read.


@pytest.mark.parametrize("entry", [BLANK, [], [("____", "b")], ("a", "____"), ("", "")])
def test_a_blank_is_no_diagnosis(entry):
    assert judged({}).status == "not attempted"
    # Nothing was tried only where nothing is written at all.
    begun = entry in ([("____", "b")], ("a", "____"))
    assert judged({1: entry}).status == ("failed" if begun else "not attempted")
    outcome = judged(RIGHT | {1: entry})
    assert outcome.mistake == "no-diagnosis-yet"
    assert outcome.evidence == "Patients 2, 3 and 4 are right. Patient 1: no diagnosis yet."


@pytest.mark.parametrize(
    ("value", "said"),
    [
        ([], "a list instead of a dict"),
        ({"ward": "seven"}, "no ward 'seven'"),
        ({"ward": -1}, "no ward -1"),
        ({"ward": True}, "no ward True"),
        ({9: ("a", "b")}, "the key 9, and this exercise is about patients 1 to 4"),
        ({"first": ("a", "b")}, "the key first"),
        *(({1: entry}, "patient 1 is not a pair") for entry in
          ("a", ("a",), ("a", 3), [("a", "b"), "c"], [("a", "b", "c")], {"a": "b"}, None)),
    ],
)  # fmt: skip
def test_what_cannot_be_read_is_said(value, said):
    outcome = judged(value)
    assert outcome.mistake == "no-diagnoses"
    assert said in outcome.evidence


# What is right.


@cache
def chart(number):
    return Ward(7).chart(number)


@pytest.mark.parametrize("number", range(1, 12))
def test_nothing_but_the_truth_is_accepted(number):
    patient = chart(number)
    right = {"half-a-diagnosis"} if len(patient.truths) == 2 else {None}
    for name in KNOWN:
        for place in (*patient.nodes, *patient.topics):
            found = weigh(patient, [Claim(name, place)])
            true = any(name == one.mistake and place in one.places for one in patient.truths)
            assert ((found.mistake if found else None) in right) == true, (name, place, found)


def test_hints_are_counted_and_cost_nothing():
    assert check("10a", lambda: RIGHT).outcome.evidence.endswith("are diagnosed.")
    for said in ("(With 1 hint.)", "(With 2 hints.)"):
        hint("10a")
        outcome = check("10a", lambda: RIGHT).outcome
        assert outcome.evidence == f"Patients 1, 2, 3 and 4 are diagnosed. {said}"
    assert (outcome.status, outcome.points) == ("passed", 2)
    assert check("10a", lambda: {**RIGHT, 1: BLANK}).outcome.evidence.endswith("(With 2 hints.)")
