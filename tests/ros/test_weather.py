"""A sensor that says what it is told, or nothing."""

import math

import pytest

from rosbeat.ros.test_nodes import drift, feeder, hearer, station

pytestmark = pytest.mark.ros


def test_one_reading_a_second_and_none_for_a_silence(ros):
    ros.add(station("gauge", "level", [1, None, math.nan, 2.5]))
    ros.run(seconds=9)
    said = [(one.time, one.value) for one in ros.messages("level")]
    assert [time for time, _ in said] == [1.0, 3.0, 4.0]
    assert math.isnan(said[1][1])
    assert (said[0][1], said[2][1]) == (1.0, 2.5)


def test_every_node_begins_at_the_beginning(ros):
    kind = station("gauge", "level", iter([1.0, 2.0]))
    ros.add(kind)
    ros.run(seconds=1)
    ros.add(kind)
    ros.run(seconds=2)
    assert [one.value for one in ros.messages("level")] == [1.0, 1.0, 2.0]


def test_who_keeps_an_answer_company_offers_nothing_for_parameters(ros):
    ros.add(station("gauge", "level", [1.0]))
    ros.add(feeder("feeder", "word", "std_msgs/msg/String", ["a"]))
    ros.add(hearer("hearer", "word", "std_msgs/msg/String"))
    ros.add(drift([(1.0, 1.0)]))
    assert len(ros.graph().nodes) == 4
    assert not [
        end for end in ros.graph().endpoints if "parameter" in end.name and end.kind == "server"
    ]
