import pytest

from nodes import Talker
from rosbeat.errors import NodeClassError, SessionError, UnknownTopicError
from rosbeat.runtime import lookups

pytestmark = pytest.mark.ros


def test_nodes_by_name_and_by_themselves(ros):
    node = ros.add(Talker)
    world = ros._world
    assert lookups.find(world, "talker") is lookups.find(world, node)
    assert lookups.find(world, "/talker").node is node
    with pytest.raises(SessionError, match="no node /talkr"):
        lookups.find(world, "talkr")
    ros.remove(node)
    with pytest.raises(NodeClassError, match="does not belong"):
        lookups.state_of(world, node)


def test_messages_and_log_lines(ros):
    ros.add(Talker)
    ros.run(2)
    assert len(lookups.samples(ros._world, "count")) == 2
    with pytest.raises(UnknownTopicError):
        lookups.samples(ros._world, "cuont")
    assert lookups.log_lines(ros._world, "talker") == ()


def test_topic_names():
    assert lookups.full_topic("explain", "a/b_1") == lookups.full_topic("explain", "/a/b_1")
    with pytest.raises(SessionError) as caught:
        lookups.full_topic("explain", "/a b")
    assert caught.value.means.endswith("characters other than alphanumerics, '_', or '/'.")
