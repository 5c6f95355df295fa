"""Calls of a learner's function; what they are told for is in the bank of answers."""

import pytest

from rosbeat.exercises.calls import Calls, call, diagnose_calls


def test_every_call_is_written_down():
    seen = call(lambda *given: " ".join(given))
    assert seen.results[0] == (("talk", "rosie", "voice"), "talk rosie voice")
    assert len(seen.results) == len(seen.kinds) == 3
    assert seen.problem == ""


def test_an_object_that_cannot_be_shown_is_evidence():
    class Shy:
        def __str__(self):
            raise ValueError("no")

    seen = call(lambda *_: Shy())
    assert seen == Calls((), "ValueError: no", ())
    assert diagnose_calls(seen).mistake == "raised"


@pytest.mark.parametrize("answer", [None, 3, "text", [], object()])
def test_what_is_no_function(answer):
    assert diagnose_calls(call(answer)).mistake == "no-function"


def test_a_function_that_is_right():
    assert diagnose_calls(call(lambda e, p, m, f="main": f"{e}={p}.{m}:{f}")) is None
