"""What is said of calls; which answers it is said of is in the bank of answers."""

import pytest

from rosbeat.exercises.call_runs import Calls, call
from rosbeat.exercises.calls import diagnose_calls


def test_an_object_that_cannot_be_shown():
    assert diagnose_calls(Calls((), "ValueError: no", ())).mistake == "raised"


@pytest.mark.parametrize("answer", [None, 3, "text", [], object()])
def test_what_is_no_function(answer):
    assert diagnose_calls(call(answer)).mistake == "no-function"


def right(executable, package, module, function="main"):
    return f"{executable}={package}.{module}:{function}"


def test_a_function_that_is_right():
    assert diagnose_calls(call(right)) is None


def test_evidence_does_not_choose_the_arguments():
    same = ("a", "b", "c")
    forged = Calls(((same, right(*same)),) * 3, "", ("str",) * 3)
    assert diagnose_calls(forged) is not None


def test_evidence_of_fewer_calls_than_were_made_is_refused():
    with pytest.raises(ValueError, match="zip"):
        diagnose_calls(Calls(()))
