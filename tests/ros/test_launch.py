"""Nodes started under another name or with other parameters; several, as by a launch file."""

import pytest
from rclpy.node import Node
from std_msgs.msg import Float32

from rosbeat.errors import SessionError
from rosbeat.ros.launch import Launch, Maker
from rosbeat.ros.scenario import MOST_NODES, Add, observe, observe_system
from rosbeat.ros.session import Session

pytestmark = pytest.mark.ros


class Talker(Node):
    def __init__(self):
        super().__init__("talker")
        self.declare_parameter("value", 1.0)
        self.words = self.declare_parameter("words", ["a"]).value
        self.pub = self.create_publisher(Float32, "temperature", 10)
        self.create_timer(1.0, self.tick)

    def tick(self):
        self.pub.publish(Float32(data=self.get_parameter("value").value))


def test_a_node_keeps_its_class_and_gets_another_place():
    with Session() as ros:
        node = ros.add(
            Talker,
            name="hygrometer",
            namespace="greenhouse",
            remappings={"temperature": "humidity"},
            parameters={"value": 60.5, "words": ["x: y", "'"]},
        )
        ros.run(seconds=2)
        assert ros.graph().nodes == ("/greenhouse/hygrometer",)
        assert [one.value for one in ros.messages("greenhouse/humidity")] == [60.5, 60.5]
        assert list(node.words) == ["x: y", "'"]
        assert type(node) is Talker


@pytest.mark.parametrize(
    "start",
    [
        {"name": 3},
        {"name": ""},
        {"namespace": "/"},
        {"remappings": ["a"]},
        {"remappings": {"a": 3}},
        {"remappings": {3: "a"}},
        {"parameters": {"a": None}},
        {"parameters": {"a": float("nan")}},
        {"parameters": {"a": [1, "b"]}},
        {"parameters": {"a": []}},
    ],
)
def test_what_cannot_be_a_name_or_a_value_is_refused(start, says):
    with Session() as ros, pytest.raises(SessionError) as caught:
        ros.add(Talker, **start)
    says(caught.value, "cannot be started with", "ros.add(")


def test_a_node_that_exists_cannot_be_renamed(says):
    with Session() as ros:
        node = ros.add(Talker)
        with pytest.raises(SessionError) as caught:
            ros.add(node, name="other")
        says(caught.value, "already exists", "without parentheses")


def test_a_scenario_starts_its_answer_and_the_others():
    seen = observe(
        Talker,
        3,
        others=[Maker(Talker, Launch(name="other"))],
        start=Launch(namespace="house", parameters={"value": 2.0}),
        steps=[Add(1.5, make=Talker, start=Launch(name="late"))],
    )
    assert not seen.faults
    assert seen.subject == "/house/talker"
    assert {"/other", "/late", "/house/talker"} == set(seen.graph.nodes)
    assert [one.value for one in seen.samples if one.topic == "/house/temperature"] == [2.0] * 3


# Several nodes of a learner's: a system.


class Broken(Node):
    def __init__(self):
        super().__init__("broken")
        raise ValueError("no")


class Fragile(Node):
    def __init__(self):
        super().__init__("fragile")
        self.create_timer(1.0, lambda: 1 / 0)


def values(seen):
    return [(one.node, one.value) for one in seen.samples]


@pytest.mark.parametrize(
    "system",
    [[Talker], (Talker,), (kind for kind in [Talker]), lambda: Talker().get_name() and [Talker],
     [Maker(Talker)], [(Talker, {})], [lambda: Talker()], lambda: [Talker()]],
    ids=range(8),
)  # fmt: skip
def test_a_list_may_come_in_many_ways(system):
    assert {value for _, value in values(observe_system(system, 2))} == {1.0}


def test_a_node_that_raises_ends_alone():
    seen = observe_system([Broken, Fragile, Talker], 3)
    assert [fault.kind for fault in seen.faults] == ["ZeroDivisionError", "ValueError"]
    assert len(seen.samples) == 3


@pytest.mark.parametrize(
    "system",
    [None, 5, "Talker", Talker, [], lambda: None, lambda: Talker, {"a": Talker},
     [(Talker, "b")], [(Talker, {"colour": 1})], [Talker] * (MOST_NODES + 1)],
    ids=range(11),
)  # fmt: skip
def test_anything_else_is_no_system(system):
    seen = observe_system(system, 1)
    assert [fault.kind for fault in seen.faults] == ["NoSystemError"]
    assert seen.samples == ()
