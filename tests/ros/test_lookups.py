import pytest

from nodes import Talker
from rosbeat.errors import NodeClassError, SessionError, UnknownTopicError
from rosbeat.ros.world import find, full_topic, state_of

pytestmark = pytest.mark.ros


def test_nodes_by_name_and_by_themselves(ros):
    node = ros.add(Talker)
    world = ros._world
    assert find(world, "talker") is find(world, node)
    assert find(world, "/talker").node is node
    with pytest.raises(SessionError, match="no node /talkr"):
        find(world, "talkr")
    ros.remove(node)
    with pytest.raises(NodeClassError, match="does not belong"):
        state_of(world, node)


def test_messages_and_log_lines(ros):
    ros.add(Talker)
    ros.run(2)
    assert len(ros.messages("count")) == 2
    with pytest.raises(UnknownTopicError):
        ros.messages("cuont")
    assert ros.logs("talker") == ()


def test_topic_names():
    assert full_topic("explain", "a/b_1") == full_topic("explain", "/a/b_1")
    with pytest.raises(SessionError) as caught:
        full_topic("explain", "/a b")
    assert caught.value.means.endswith("characters other than alphanumerics, '_', or '/'.")
