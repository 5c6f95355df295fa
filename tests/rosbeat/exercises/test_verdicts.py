from rosbeat.exercises.exercise import before_judging, failed, is_blank, not_attempted, passed
from rosbeat.records import Fault, Observation


def fault(kind="ValueError", text="too small", callback="tick", line=4, code="f(x)"):
    return Fault(0, "/sensor", callback, kind, text, line, code)


def test_a_blank_is_recognised_by_its_name_error():
    assert is_blank(fault("NameError", "name '____' is not defined"))
    assert not is_blank(fault("NameError", "name '___' is not defined"))
    assert not is_blank(fault("ValueError", "name '____' is not defined"))


def test_a_blank_means_not_attempted_whatever_else_went_wrong():
    observation = Observation(0, 0, faults=(fault(), fault("NameError", "name '____' is not ...")))
    assert before_judging(observation) == not_attempted()


def test_an_exception_is_told_with_the_learners_line():
    outcome = before_judging(Observation(0, 0, faults=(fault(),)))
    assert "tick raised ValueError: too small." in outcome.evidence
    assert "Line 4" in outcome.evidence
    assert "`f(x)`" in outcome.evidence
    assert outcome.hint


def test_an_unknown_line_is_not_mentioned():
    outcome = before_judging(Observation(0, 0, faults=(fault(line=0, code=""),)))
    assert "Line" not in outcome.evidence


def test_what_the_session_refused_is_told_in_its_own_words():
    refused = fault("NodeClassError", "3 is not a node.", callback="add")
    assert before_judging(Observation(0, 0, faults=(refused,))).evidence == "3 is not a node."


def test_nothing_to_say_before_judging_when_nothing_was_raised():
    assert before_judging(Observation(0, 0)) is None


def test_the_three_outcomes_differ_by_status():
    statuses = {passed("e").status, failed("1", "e", "h").status, not_attempted().status}
    assert statuses == {"passed", "failed", "not attempted"}
