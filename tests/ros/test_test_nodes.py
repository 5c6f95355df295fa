"""Nodes that run beside an answer, the greenhouse of page 07, and a node that plays a bag."""

import random

import pytest
from rclpy.node import Node

from rosbeat import Session
from rosbeat.errors import SessionError
from rosbeat.records import QoS
from rosbeat.ros.test_nodes import (
    GREENHOUSE,
    PlayedTopic,
    drift,
    feeder,
    listener,
    observe_greenhouse,
    player,
)

pytestmark = pytest.mark.ros
STRING = "std_msgs/msg/String"
KEPT = QoS(depth=2, durability="TRANSIENT_LOCAL")

# Sensors.


# Nodes that log what they receive.


def heard(*, joins, qos, offers=KEPT, words=("a", "b", "c", "d")):
    with Session() as ros:
        ros.add(feeder("speaker", "word", STRING, words, qos=offers))
        ros.run(joins)
        ros.add(listener("ear", "word", STRING, qos))
        ros.run(len(words) + 1 - joins)
        return [line.text for line in ros.logs("ear") if line.level == "INFO"]


def test_it_asks_for_what_it_was_told_to():
    assert heard(joins=3, qos=KEPT) == ["b", "c", "d"]
    assert heard(joins=3, qos=10) == ["d"]
    assert heard(joins=3, qos=KEPT, offers=10) == []


# A tendency in the random numbers, for as long as a run lasts.


class Dice(Node):
    def __init__(self):
        super().__init__("dice")
        self.drawn = []
        self.create_timer(1.0, lambda: self.drawn.append(random.uniform(2.0, 3.0)))


def drawn(phases, seconds=300):
    with Session(seed=5) as ros:
        ros.add(drift(phases))
        dice = ros.add(Dice)
        ros.run(seconds)
        return dice.drawn


def mean(values):
    return sum(values) / len(values)


def test_numbers_tend_upwards_then_downwards_then_nowhere():
    values = drawn([(100, 1 / 3), (100, 3.0), (0, 1.0)])
    assert mean(values[:100]) == pytest.approx(2.75, abs=0.06)
    assert mean(values[100:200]) == pytest.approx(2.25, abs=0.06)
    assert mean(values[200:]) == pytest.approx(2.5, abs=0.09)
    assert all(2.0 <= value <= 3.0 for value in values)


# The greenhouse: what there is to find in it, and that it is the same each time.


def test_there_is_one_answer_to_each_question():
    system, parameters = observe_greenhouse()
    graph, names = system.graph, system.graph.topics()
    assert len(graph.nodes) == len(GREENHOUSE) == 5
    assert [one.node for one in graph.on("/moisture", "publisher")] == ["/soil_probe"]
    assert [name for name in names if not graph.on(name, "subscription")] == ["/lights"]
    assert [name for name in names if not graph.on(name, "publisher")] == ["/light"]
    assert {log.name for log in system.logs if log.level == "WARN"} == {"lamp"}
    assert parameters == {"/window open_above": 25.0, "/gardener dry_below": 35}
    assert not system.faults


# A node that plays a bag; see also `tests/rosbeat/bags/test_replay.py`.


@pytest.mark.parametrize(
    ("recorded", "offered"),
    [
        (QoS("?", "?", "?", 0), QoS("RELIABLE", "VOLATILE", "KEEP_LAST", 10)),
        (QoS(history="KEEP_ALL"), QoS(history="KEEP_ALL")),
    ],
)
def test_an_unknown_quality_becomes_the_default_of_ros(ros, recorded, offered):
    ros.add(player("player", [PlayedTopic("/word", STRING, recorded)], []))
    (end,) = ros.graph().on("/word", "publisher")
    assert (end.qos.reliability, end.qos.history) == (offered.reliability, offered.history)


@pytest.mark.parametrize("name", ["a_msgs/msg/A", "std_msgs/msg/Nothing", "nonsense"])
def test_an_unknown_type_gets_three_parts(says, name):
    with pytest.raises(SessionError) as caught:
        player("player", [PlayedTopic("/count", name, QoS())], [])
    says(caught.value, "cannot be published here")
