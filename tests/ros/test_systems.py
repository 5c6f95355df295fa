"""Several nodes of a learner's, as a launch file would start them."""

import pytest
from rclpy.node import Node
from std_msgs.msg import Float32

from rosbeat.ros.launch import Launch, Maker
from rosbeat.ros.scenario import MOST_NODES, Remove, observe_system

pytestmark = pytest.mark.ros


class Talker(Node):
    def __init__(self):
        super().__init__("talker")
        self.value = self.declare_parameter("value", 1.0).value
        self.out = self.create_publisher(Float32, "said", 10)
        self.create_timer(1.0, lambda: self.out.publish(Float32(data=self.value)))


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


def test_a_system_is_a_function_that_returns_a_list():
    seen = observe_system(lambda: [Talker, Fragile], 2)
    assert values(seen) == [("/talker", 1.0)] * 2
    assert seen.graph.nodes == ("/talker", "/fragile")
    assert seen.subject == ""


@pytest.mark.parametrize(
    "system",
    [[Talker], (Talker,), (kind for kind in [Talker]), lambda: Talker().get_name() and [Talker],
     [Maker(Talker)], [(Talker, {})], [lambda: Talker()], lambda: [Talker()]],
    ids=range(8),
)  # fmt: skip
def test_a_list_may_come_in_many_ways(system):
    assert {value for _, value in values(observe_system(system, 2))} == {1.0}


def test_members_say_how_they_are_started():
    start = {"name": "a", "namespace": "b", "parameters": {"value": 2.0}}
    seen = observe_system([Talker, (Talker, start), Maker(Talker, Launch(name="c"))], 1)
    assert values(seen) == [("/talker", 1.0), ("/b/a", 2.0), ("/c", 1.0)]
    assert [sample.topic for sample in seen.samples] == ["/said", "/b/said", "/said"]


def test_parameters_reach_every_node_besides_its_own():
    seen = observe_system([Talker, (Talker, {"name": "b"})], 1, parameters={"value": 5.0})
    assert [value for _, value in values(seen)] == [5.0, 5.0]


def test_a_node_that_raises_ends_alone():
    seen = observe_system([Broken, Fragile, Talker], 3)
    assert [fault.kind for fault in seen.faults] == ["ZeroDivisionError", "ValueError"]
    assert len(seen.samples) == 3


def test_a_node_can_be_ended():
    seen = observe_system([Talker, (Talker, {"name": "b"})], 4, steps=[Remove(2.5, "b")])
    assert [node for node, _ in values(seen)].count("/b") == 2
    assert len(seen.samples) == 6


def test_nodes_of_one_name_do_not_replace_each_other():
    assert len(observe_system([Talker, Talker], 2).samples) == 4


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


def test_a_start_that_cannot_be_is_told():
    (fault,) = observe_system([(Talker, {"name": 3})], 1).faults
    assert fault.kind == "SessionError"


def test_a_member_that_is_no_node_is_left_out():
    seen = observe_system([7, Talker], 1)
    assert [fault.kind for fault in seen.faults] == ["NodeClassError"]
    assert len(seen.samples) == 1


def test_an_endless_list_is_broken_off():
    def forever():
        while True:
            pass

    (fault,) = observe_system(forever, 1, deadline=0.3).faults
    assert fault.kind == "DeadlinePassed"
