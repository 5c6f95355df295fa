"""Real errors of real nodes, as rclpy and Python word them, and the name that each gets.

`broken_nodes` is beside this file; conftest.py puts the folder on the path.
"""

import linecache

import pytest
from broken_nodes import BROKEN, IMPORTS, UNKNOWN, sensor

from rosbeat.diagnosis.exceptions import diagnose_fault
from rosbeat.diagnosis.mistakes import MISTAKES
from rosbeat.exercises.exercise import before_judging
from rosbeat.ros.scenario import feeder, observe

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
    assert "new to me" not in outcome.hint  # what shows an outcome says that
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
    assert "what it was given is an int." in found.evidence
