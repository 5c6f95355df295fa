"""From what came out of a sandbox to an outcome, whatever it was."""

import gc
import signal

import pytest

from rosbeat.diagnosis.mistakes import MISTAKES
from rosbeat.exercises.evidence import to_json
from rosbeat.exercises.registry import EXERCISES
from rosbeat.grading.jobs import FORGED, LOST, Observed
from rosbeat.grading.judging import judge, untouched
from rosbeat.records import Fault, Observation

EXERCISE = EXERCISES["03a"]
FAULT = Fault(0, "/humidity_sensor", "tick", "ZeroDivisionError", "division by zero", 3, "1 / 0")
RAISED = to_json(Observation(10**9, 1, faults=(FAULT,), subject="/humidity_sensor"))


def judged(how="ended", number=0, **more):
    return judge(EXERCISE, Observed(how, number, **more))


def test_evidence_is_judged_as_on_the_page():
    outcome = judged(evidence=RAISED)
    assert outcome == EXERCISE.judged(
        Observation(10**9, 1, faults=(FAULT,), subject="/humidity_sensor")
    )
    assert outcome.mistake == "division-by-zero"


@pytest.mark.parametrize("evidence", [RAISED, "{"])
def test_garbage_is_collected_afterwards_as_before(evidence):
    judged(evidence=evidence)
    assert gc.isenabled()
    gc.disable()
    try:
        judged(evidence=evidence)
        assert not gc.isenabled()
    finally:
        gc.enable()


@pytest.mark.parametrize(
    ("how", "number", "mistake", "words"),
    [
        ("deadline", 0, "too-long", "does not come to an end"),
        ("memory", 0, "too-much-memory", "too much memory"),
        ("output", 0, "too-much-output", "too much output"),
        ("result", 0, "too-much-output", "too much output"),
        ("signal", signal.SIGSEGV, "crashed", "SIGSEGV"),
        ("signal", signal.SIGKILL, "crashed", "SIGKILL"),
        ("signal", signal.SIGXCPU, "too-long", "does not come to an end"),
        ("signal", 127, "crashed", "signal 127"),
        ("exit", 7, "left-early", "exit code 7"),
        ("ended", 0, "left-early", "before anything could be seen"),
        (FORGED, 0, "evidence-unreadable", "no seal"),
        (LOST, 0, "crashed", "was lost"),
        ("some other word", 0, "left-early", "before anything could be seen"),
    ],
)
def test_each_ending_has_its_words(how, number, mistake, words):
    outcome = judged(how, number)
    assert (outcome.status, outcome.mistake) == ("failed", mistake)
    assert words in outcome.evidence
    assert outcome.hint
    assert (outcome.points, outcome.out_of) == (0, EXERCISE.points)
    assert mistake in MISTAKES


@pytest.mark.parametrize("how", ["deadline", "memory", "result", "signal", "exit", FORGED, LOST])
def test_evidence_counts_only_if_the_run_came_to_its_end(how):
    assert judged(how, 1, evidence=RAISED).mistake != "division-by-zero"


@pytest.mark.parametrize(
    "evidence",
    ["x", "{}", "[" * 100_000, '{"format": "rosbeat evidence", "version": 1, "kind": "Outcome"}',
     RAISED[:-1], RAISED.replace('"seed":1', '"seed":"1"'), RAISED.replace("Observation", "Report"),
     RAISED.replace('"line":3', '"line":3,"status":"passed"')],
    ids=range(8),
)  # fmt: skip
def test_what_the_course_has_not_written_is_refused(evidence):
    outcome = judged(evidence=evidence)
    assert (outcome.status, outcome.mistake) == ("failed", "evidence-unreadable")


def test_evidence_of_another_exercise_stops_nothing():
    for exercise in EXERCISES.values():
        outcome = judge(exercise, Observed("ended", evidence=to_json(Observation(0, 0))))
        assert outcome.status != "passed", exercise.id
        assert outcome.exercise == exercise.id


def test_a_changed_course_is_named_and_nothing_is_judged():
    outcome = judged(evidence=RAISED, changed=("json.dumps", "rclpy.node.Node"))
    assert outcome.mistake == "changes-the-course"
    assert "json.dumps, rclpy.node.Node" in outcome.evidence


@pytest.mark.parametrize(
    ("raised", "text", "status", "mistake"),
    [
        ("NameError", "name '____' is not defined", "not attempted", ""),
        ("ZeroDivisionError", "division by zero", "failed", "division-by-zero"),
        ("<b>", "\x1b[31m\ud800", "failed", "raised"),
    ],
)
def test_a_cell_that_cannot_be_run_is_told_why(raised, text, status, mistake):
    outcome = judged(raised=raised, text=text, line=2, code="1 / 0")
    assert outcome.status == status
    assert not mistake or outcome.mistake in (mistake, "new-to-me"), outcome
    assert status != "failed" or raised in outcome.evidence


@pytest.mark.parametrize(
    ("raised", "text", "hint"),
    [
        ("SyntaxError", "expected ':'", "a colon"),
        ("IndentationError", "unexpected indent", "same column"),
        ("TabError", "inconsistent use of tabs and spaces in indentation", "tab"),
        ("SyntaxError", "", "a colon"),
    ],
)
def test_a_cell_that_python_cannot_read_has_a_name(raised, text, hint):
    outcome = judged(raised=raised, text=text, line=2, code="class A(Node)")
    assert (outcome.status, outcome.mistake, outcome.points) == ("failed", "unreadable-cell", 0)
    assert f"Python says: {text or raised}. Line 2: `class A(Node)`." in outcome.evidence
    assert hint in outcome.hint
    assert "Print the values" not in outcome.hint


def test_a_cell_that_nobody_has_filled_in_is_no_mistake():
    outcome = untouched(EXERCISE)
    assert (outcome.status, outcome.mistake, outcome.points) == ("not attempted", "", 0)
    assert outcome.out_of == EXERCISE.points
