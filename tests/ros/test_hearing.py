"""Nodes that say in their log what they hear."""

import pytest

from rosbeat import Session
from rosbeat.records import QoS
from rosbeat.ros.test_nodes import feeder, hearer

pytestmark = pytest.mark.ros
STRING = "std_msgs/msg/String"
KEPT = QoS(depth=2, durability="TRANSIENT_LOCAL")


def heard(*, joins, qos, offers=KEPT, words=("a", "b", "c", "d")):
    with Session() as ros:
        ros.add(feeder("speaker", "word", STRING, words, qos=offers))
        ros.run(joins)
        ros.add(hearer("ear", "word", STRING, qos))
        ros.run(len(words) + 1 - joins)
        return [line.text for line in ros.logs("ear")]


def test_it_logs_each_message_once():
    assert heard(joins=0, qos=10) == ["a", "b", "c", "d"]


def test_it_asks_for_what_it_was_told_to():
    assert heard(joins=3, qos=KEPT) == ["b", "c", "d"]
    assert heard(joins=3, qos=10) == ["d"]
    assert heard(joins=3, qos=KEPT, offers=10) == []
