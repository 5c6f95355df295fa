"""Calls of a learner's function; what they are told for is in the bank of answers."""

import pytest

from rosbeat.exercises.call_runs import ARGUMENTS, LATE, Calls, call


def test_every_call_is_written_down():
    seen = call(lambda *given: " ".join(given))
    assert seen.results[0] == (("talk", "rosie", "voice"), "talk rosie voice")
    assert tuple(arguments for arguments, _ in seen.results) == ARGUMENTS
    assert seen.kinds == ("str",) * len(ARGUMENTS)
    assert seen.problem == ""


def test_an_object_that_cannot_be_shown_is_evidence():
    class Shy:
        def __str__(self):
            raise ValueError("no")

    assert call(lambda *_: Shy()) == Calls((), "ValueError: no", ())


def test_what_was_given_back_before_an_exception_stays():
    seen = call(lambda e, p, m: e)
    assert (len(seen.results), seen.kinds) == (1, ("str",))
    assert seen.problem.startswith("TypeError")


def endless(*_):
    while True:
        pass


def leaves(*_):
    raise SystemExit(0)


@pytest.mark.parametrize(("answer", "problem"), [(endless, LATE), (leaves, "SystemExit")])
def test_a_call_that_does_not_come_back_is_evidence(answer, problem):
    assert call(answer).problem.startswith(problem)
