"""Nodes that run beside an answer, the greenhouse of page 07, and a node that plays a bag."""

import random

import pytest
from rclpy.node import Node

from rosbeat import Session
from rosbeat.errors import BagError
from rosbeat.exercises.scenarios import station
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


def test_who_keeps_an_answer_company_offers_nothing_for_parameters(ros):
    ros.add(station("gauge", "level", [1.0]))
    ros.add(feeder("feeder", "word", "std_msgs/msg/String", ["a"]))
    ros.add(listener("listener", "word", "std_msgs/msg/String"))
    ros.add(drift([(1.0, 1.0)]))
    assert len(ros.graph().nodes) == 4
    assert not [
        end for end in ros.graph().endpoints if "parameter" in end.name and end.kind == "server"
    ]


# Nodes that log what they receive.


def heard(*, joins, qos, offers=KEPT, words=("a", "b", "c", "d")):
    with Session() as ros:
        ros.add(feeder("speaker", "word", STRING, words, qos=offers))
        ros.run(joins)
        ros.add(listener("ear", "word", STRING, qos))
        ros.run(len(words) + 1 - joins)
        return [line.text for line in ros.logs("ear")]


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


@pytest.mark.parametrize(
    "draw",
    [lambda: random.random(), lambda: random.choice(range(100)) / 100, lambda: random.gauss(1, 2)],
)
def test_other_functions_drift_too(draw):
    class Gambler(Node):
        def __init__(self):
            super().__init__("gambler")
            self.drawn = []
            self.create_timer(1.0, lambda: self.drawn.append(draw()))

    with Session(seed=5) as ros:
        ros.add(drift([(200, 1 / 3), (0, 3.0)]))
        gambler = ros.add(Gambler)
        ros.run(400)
    assert mean(gambler.drawn[:200]) != pytest.approx(mean(gambler.drawn[200:]), abs=0.2)


def test_nothing_is_left_of_it():
    plain = random.Random(9)
    drawn([(0, 50.0)], 3)
    random.seed(9)
    assert [random.uniform(0, 1) for _ in range(5)] == [plain.uniform(0, 1) for _ in range(5)]


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
    with pytest.raises(BagError) as caught:
        player("player", [PlayedTopic("/count", name, QoS())], [])
    says(caught.value, "cannot be published here")
