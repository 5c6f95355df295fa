"""A page whose checks say something else than they should is found."""

import pytest
from nbformat.v4 import new_code_cell, new_output

from notebooks.outcomes import OUTCOME, wrong_outcome

CHECK = new_code_cell("check(...)", metadata={"rosbeat": {"check": "03a"}})


def said(status, exercise="03a"):
    data = {"text/plain": "...", OUTCOME: {"exercise": exercise, "status": status}}
    return new_output("execute_result", data=data)


def test_right_outcomes():
    assert wrong_outcome(CHECK, [said("passed")], solved=True) == ""
    assert wrong_outcome(CHECK, [said("not attempted")], solved=False) == ""
    assert wrong_outcome(new_code_cell("1"), [], solved=True) == ""


@pytest.mark.parametrize("solved", [True, False])
@pytest.mark.parametrize(
    "outputs",
    [
        [],
        [said("failed")],
        [said("passed"), said("not attempted")],
        [said("passed", "03b")],
        [new_output("stream", text="passed")],
    ],
)
def test_wrong_outcomes(outputs, solved):
    assert "03a" in wrong_outcome(CHECK, outputs, solved=solved)


def test_the_two_pages_are_told_apart():
    assert wrong_outcome(CHECK, [said("passed")], solved=False)
    assert wrong_outcome(CHECK, [said("not attempted")], solved=True)
