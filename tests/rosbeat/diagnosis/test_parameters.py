"""What rclpy says of parameters, in words; each error is a real one."""

import pytest
from rclpy.node import Node

from rosbeat.diagnosis.exceptions import diagnose_fault
from rosbeat.diagnosis.mistakes import MISTAKES
from rosbeat.ros.launch import Launch
from rosbeat.ros.scenario import observe

pytestmark = pytest.mark.ros

CASES = {
    "whole": ("parameter-type", lambda node: node.declare_parameter("low", 20),
              "The parameter low got 40.0, of type DOUBLE, and it was declared with a value of"),
    "text": ("parameter-type", lambda node: node.declare_parameter("low", "20"),
             "declared with a value of type STRING."),
    "list": ("parameter-type", lambda node: node.declare_parameter("low", [20.0]),
             "a value of type DOUBLE_ARRAY."),
    "undeclared": ("parameter-undeclared", lambda node: node.get_parameter("high"),
                   "not declared: high."),
    "twice": ("parameter-twice", lambda node: [node.declare_parameter("low", 1.0) for _ in "ab"],
              "The parameter low is declared twice."),
    "compared": ("parameter-for-value", lambda node: node.declare_parameter("low", 1.0) > 3,
                 "as if it were its value."),
    "added": ("parameter-for-value", lambda node: 3.0 - node.declare_parameter("low", 1.0),
              "as if it were its value."),
}  # fmt: skip


@pytest.mark.parametrize("case", CASES)
def test_an_error_about_a_parameter_has_a_name(case):
    mistake, body, text = CASES[case]

    class Tuned(Node):
        def __init__(self):
            super().__init__("tuned")
            body(self)

    (fault,) = observe(Tuned, 1, start=Launch(parameters={"low": 40.0})).faults
    found = diagnose_fault(fault)
    assert found.mistake == mistake in MISTAKES
    assert text in found.evidence
    assert found.hint


def test_other_type_errors_are_not_about_parameters():
    class Broken(Node):
        def __init__(self):
            super().__init__("broken")
            self.declare_parameter("low", 1.0).value.nothing  # noqa: B018

    (fault,) = observe(Broken, 1).faults
    assert not diagnose_fault(fault).mistake.startswith("parameter")
