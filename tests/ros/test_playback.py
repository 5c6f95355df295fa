"""A node that publishes what was prepared."""

import pytest
from rclpy.serialization import serialize_message
from std_msgs.msg import Int32

from nodes import Listener
from rosbeat.errors import BagError
from rosbeat.records import QoS
from rosbeat.ros.playback import PlayedStep, PlayedTopic, player

pytestmark = pytest.mark.ros
COUNT = PlayedTopic("/count", "std_msgs/msg/Int32", QoS())


def post(value):
    return 0, serialize_message(Int32(data=value))


def test_each_step_comes_at_its_nanosecond(ros):
    steps = [
        PlayedStep(0, (post(1),)),
        PlayedStep(1, (post(2), post(3))),
        PlayedStep(7_000_000_001, (post(4),)),
    ]
    ros.add(player("player", [COUNT], steps))
    listener = ros.add(Listener)
    ros.run(10)
    assert listener.heard == [1, 2, 3, 4]
    assert [one.time_ns for one in ros.messages("count")] == [0, 1, 1, 7_000_000_001]


def test_what_follows_from_a_step_is_over_before_the_next(ros):
    ros.add(
        player("player", [COUNT], [PlayedStep(5, (post(1), post(2))), PlayedStep(5, (post(3),))])
    )
    listener = ros.add(lambda: Listener(qos=1))
    ros.run(1)
    assert listener.heard == [2, 3]


def test_a_recording_s_unknown_quality_becomes_ros_s_default(ros):
    ros.add(player("player", [PlayedTopic("/count", COUNT.type_name, QoS("?", "?", "?", 0))], []))
    (end,) = ros.graph().on("/count", "publisher")
    assert end.qos == QoS("RELIABLE", "VOLATILE", "KEEP_LAST", 10)


def test_it_keeps_all_if_that_was_offered(ros):
    ros.add(player("player", [PlayedTopic("/count", COUNT.type_name, QoS(history="KEEP_ALL"))], []))
    (end,) = ros.graph().on("/count", "publisher")
    assert end.qos.history == "KEEP_ALL"


@pytest.mark.parametrize("name", ["a_msgs/msg/A", "std_msgs/msg/Nothing", "nonsense"])
def test_an_unknown_type_gets_three_parts(says, name):
    with pytest.raises(BagError) as caught:
        player("player", [PlayedTopic("/count", name, QoS())], [])
    says(caught.value, "cannot be published here")
