"""From trials to an outcome with parts."""

import pytest
from rosbeat.exercises.check import EXERCISES
from rosbeat.exercises.evidence import from_json, to_json

from rosbeat.errors import ExerciseError
from rosbeat.exercises.greenhouse.judge import JUDGES, judge_greenhouse
from rosbeat.exercises.greenhouse.rubric import KNOWN, the_rubric
from rosbeat.exercises.greenhouse.trials import BROKEN, LOSSY, OTHER, PLAIN, Trials
from rosbeat.records import Endpoint, Fault, GraphSnapshot, Observation, QoS

NODE = GraphSnapshot(("/a",), (Endpoint("/a", "/x", "t", "publisher", QoS()),))
EMPTY = Observation(175 * 10**9, 0, graph=NODE)


def trials(plain=EMPTY):
    return Trials(the_rubric().numbers, {PLAIN: plain, BROKEN: EMPTY, LOSSY: EMPTY, OTHER: EMPTY})


def fault(kind, text, callback="__init__", node=""):
    return Fault(0, node, callback, kind, text, 3, "x = 1")


def test_there_is_a_judge_for_every_requirement():
    assert tuple(JUDGES) == KNOWN


def test_silence_meets_no_requirement():
    outcome = judge_greenhouse("13b", trials())
    assert outcome.status == "failed"
    assert outcome.mistake == "no-publisher"
    assert [part.met for part in outcome.parts] == [False] * len(KNOWN)
    assert all(part.evidence for part in outcome.parts)
    assert outcome.evidence.startswith("0 of 11")


def test_points_are_those_of_the_parts():
    judged = EXERCISES["13b"].judged(trials())
    assert (judged.points, judged.out_of) == (0, 20)


def test_a_blank_is_no_attempt():
    blank = Observation(0, 0, faults=(fault("NameError", "name '____' is not defined"),))
    assert judge_greenhouse("13b", trials(blank)).status == "not attempted"


@pytest.mark.parametrize(
    ("one", "mistake"),
    [
        (fault("NoSystemError", "What came is of type int.", "add"), "no-system"),
        (fault("SessionError", "A node cannot be started with name=3.", "run"), "no-system"),
        (fault("DeadlinePassed", "still running after 5 s"), "constructor-blocks"),
    ],
)
def test_without_a_system_there_are_no_parts(one, mistake):
    outcome = judge_greenhouse("13b", trials(Observation(0, 0, faults=(one,))))
    assert (outcome.status, outcome.mistake, outcome.parts) == ("failed", mistake, ())


def test_an_exception_of_a_node_comes_first():
    raised = fault("ZeroDivisionError", "float division by zero", "report", "/a")
    outcome = judge_greenhouse("13b", trials(Observation(0, 0, faults=(raised,), graph=NODE)))
    assert outcome.mistake == "division-by-zero"
    assert "/a" in outcome.evidence
    assert outcome.parts


def test_trials_can_be_written_down():
    assert from_json(to_json(trials())) == trials()


@pytest.mark.parametrize("exercise", ["13a", "13b"])
def test_numbers_that_trials_say_of_themselves_are_not_believed(exercise, says):
    numbers = {**the_rubric().numbers, "react_seconds": 1000.0}
    with pytest.raises(ExerciseError) as caught:
        EXERCISES[exercise].judged(Trials(numbers, trials().runs))
    says(caught.value, "another rubric")


def test_what_is_given_besides_an_answer_are_the_numbers():
    assert EXERCISES["13a"].given() == EXERCISES["13b"].given()
    assert EXERCISES["13b"].given() == {"numbers": the_rubric().numbers}
    assert EXERCISES["12a"].given() == {}
