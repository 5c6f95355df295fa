"""Steps that ask: services, parameters and actions, with what comes back as plain data."""

import pytest
from rcl_interfaces.msg import SetParametersResult
from rclpy.node import Node

from action_nodes import Heater
from nodes import Server
from rosbeat.records import Observation, Reply
from rosbeat.records_json import from_json, to_json
from rosbeat.ros.scenario import Call, SendGoal, SetParameters, observe

pytestmark = pytest.mark.ros
SECOND = 1_000_000_000


def test_a_call_and_its_response():
    steps = [Call(1.5, service="ask"), Call(2.5, service="ask")]
    seen = observe(Server, 4, steps=steps)
    assert [(one.time, one.number, one.data["message"]) for one in seen.replies] == [
        (1.5, 1, "1"),
        (2.5, 2, "2"),
    ]
    assert seen.replies[0].name == "/ask"
    assert [one.name for one in seen.callbacks if one.kind == "step"] == ["Call", "Call"]


def test_a_call_that_nobody_answers():
    assert observe(Server, 4, steps=[Call(1.0, service="other")]).replies == ()


def test_a_goal_with_feedback_and_result():
    seen = observe(Heater, 5, steps=[SendGoal(0.5, action="heat", goal={"order": 2})])
    assert [(one.time, one.word) for one in seen.replies] == [
        (0.5, "goal"),
        (1.0, "feedback"),
        (2.0, "feedback"),
        (2.0, "result"),
    ]
    assert seen.replies[0].data == {"accepted": True}
    assert seen.replies[-1].data == {"status": "SUCCEEDED", "sequence": [1, 2]}
    assert from_json(Observation, to_json(seen), "it") == seen


def test_a_goal_is_canceled_after_a_while():
    steps = [SendGoal(0.5, action="heat", goal={"order": 9}, cancel_after=2.0)]
    words = {one.word: one for one in observe(Heater, 5, steps=steps).replies}
    assert words["cancel"] == Reply(2_500_000_000, "/heat", 1, "cancel", {"count": 1})
    assert words["result"].data["status"] == "CANCELED"


def test_a_rejected_goal_is_not_canceled():
    steps = [SendGoal(0.5, action="heat", goal={"order": 99}, cancel_after=1.0)]
    (reply,) = observe(Heater, 5, steps=steps).replies
    assert (reply.word, reply.data) == ("goal", {"accepted": False})


class Chosen(Node):
    def __init__(self):
        super().__init__("chosen")
        self.declare_parameters("", [("low", 1.0), ("high", 2.0)])
        self.add_on_set_parameters_callback(self.look)

    def look(self, parameters):
        new = {one.name: one.value for one in parameters}
        good = new.get("low", 1.0) < new.get("high", 2.0)
        return SetParametersResult(successful=good, reason="" if good else "swapped")


@pytest.mark.parametrize(
    ("values", "good", "reason", "kept"),
    [
        ({"low": 5.0, "high": 6.0}, True, "", {"low": 5.0, "high": 6.0}),
        ({"low": 6.0, "high": 5.0}, False, "swapped", {"low": 1.0, "high": 2.0}),
        ({"middle": 1.5}, False, "not declared", {}),
    ],
)
def test_parameters_are_set_all_or_none(values, good, reason, kept):
    seen = observe(Chosen, 2, steps=[SetParameters(1.0, values=values)])
    (reply,) = seen.replies
    assert (reply.name, reply.word) == ("/chosen", "parameters")
    assert reply.data == {"successful": good, "reason": reason, "values": kept}


def test_a_parameter_callback_that_raises_is_a_fault():
    class Clumsy(Chosen):
        def look(self, parameters):
            return 1 / 0

    seen = observe(Clumsy, 2, steps=[SetParameters(1.0, values={"low": 1.5})])
    assert [one.kind for one in seen.faults] == ["ZeroDivisionError"]
    assert seen.replies == ()
