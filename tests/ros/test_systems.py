"""Several nodes of a learner's, as a launch file would start them."""

import pytest
from rclpy.node import Node
from std_msgs.msg import Float32

from rosbeat.ros.launch import Maker
from rosbeat.ros.scenario import MOST_NODES, observe_system

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


def test_an_endless_list_is_broken_off():
    def forever():
        while True:
            pass

    (fault,) = observe_system(forever, 1, deadline=0.3).faults
    assert fault.kind == "DeadlinePassed"
