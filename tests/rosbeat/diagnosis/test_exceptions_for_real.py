"""Real errors of real nodes, as rclpy and Python word them, and the name that each gets."""

import linecache

import pytest
from rclpy.node import Node

from broken_nodes import BROKEN, IMPORTS, UNKNOWN, sensor
from rosbeat.diagnosis.exceptions import diagnose_fault
from rosbeat.diagnosis.mistakes import MISTAKES
from rosbeat.exercises.exercise import before_judging
from rosbeat.ros.launch import Launch
from rosbeat.ros.scenario import observe
from rosbeat.ros.test_nodes import feeder

pytestmark = pytest.mark.ros


def observation_of(broken):
    """What a cell does, with its lines where a traceback finds them."""
    name = f"<cell {broken.name}>"
    text = f"{IMPORTS}{broken.text}"
    linecache.cache[name] = (len(text), None, text.splitlines(keepends=True), name)
    space = {"__name__": "__main__"}
    exec(compile(text, name, "exec", dont_inherit=True), space)
    others = [feeder("room", "temperature", "std_msgs/msg/Float32", [22.0])] if broken.hears else []
    return observe(space["Answer"], 2.0, others=others), text


@pytest.mark.parametrize("broken", BROKEN, ids=lambda one: one.name)
def test_the_mistake_is_named(broken):
    observation, text = observation_of(broken)
    fault = observation.faults[0]
    found = diagnose_fault(fault)
    assert found, fault
    assert found.mistake == broken.mistake, (fault, found)
    assert found.hint
    if fault.line:
        assert fault.code == text.splitlines()[fault.line - 1].strip()
        assert f"Line {fault.line}: `{fault.code}`." in found.evidence
    assert before_judging(observation).mistake in MISTAKES


@pytest.mark.parametrize("broken", UNKNOWN, ids=lambda one: one.name)
def test_what_nobody_knows_stays_unnamed(broken):
    observation, _ = observation_of(broken)
    fault = observation.faults[0]
    assert diagnose_fault(fault) is None
    outcome = before_judging(observation)
    assert outcome.mistake == "new-to-me"
    assert fault.kind in outcome.evidence
    assert "recognize" not in outcome.hint  # what shows an outcome says that
    assert "The last sentence of an error" in outcome.hint


def test_names_are_unique():
    names = [one.name for one in (*BROKEN, *UNKNOWN)]
    assert sorted(names) == sorted(set(names))


def test_a_right_node_raises_nothing():
    observation, _ = observation_of(sensor("right", ""))
    assert observation.faults == ()
    assert len(observation.samples) == 2


def test_the_type_of_a_value_that_was_calculated_is_known():
    (broken,) = (one for one in BROKEN if one.name == "a calculated int")
    found = diagnose_fault(observation_of(broken)[0].faults[0])
    assert "the value given is an int." in found.evidence


# What rclpy says of parameters.

PARAMETERS = {
    "whole": ("parameter-type", lambda node: node.declare_parameter("low", 20),
              "The parameter low was set to 40.0, of type DOUBLE, but was declared with a value"),
    "text": ("parameter-type", lambda node: node.declare_parameter("low", "20"),
             "declared with a value of type STRING."),
    "list": ("parameter-type", lambda node: node.declare_parameter("low", [20.0]),
             "a value of type DOUBLE_ARRAY."),
    "undeclared": ("parameter-undeclared", lambda node: node.get_parameter("high"),
                   "not declared: high."),
    "twice": ("parameter-twice", lambda node: [node.declare_parameter("low", 1.0) for _ in "ab"],
              "The parameter low is declared twice."),
    "compared": ("parameter-for-value", lambda node: node.declare_parameter("low", 1.0) > 3,
                 "as if it were the value."),
    "added": ("parameter-for-value", lambda node: 3.0 - node.declare_parameter("low", 1.0),
              "as if it were the value."),
}  # fmt: skip


@pytest.mark.parametrize("case", PARAMETERS)
def test_an_error_about_a_parameter_has_a_name(case):
    mistake, body, text = PARAMETERS[case]

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
