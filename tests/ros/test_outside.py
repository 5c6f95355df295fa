"""A domain that was joined on purpose: the nodes of other processes in the graph."""

import gc
import time
from dataclasses import replace
from functools import partial

import psutil
import pytest
from rclpy.node import Node
from std_msgs.msg import String

from nodes import Doer, Listener, Server, Talker
from other_process import other_process
from rosbeat import Session
from rosbeat.domains import lease_domain
from rosbeat.errors import DurationError, SessionError, UnknownTopicError
from rosbeat.records import QoS
from rosbeat.viz import graph as picture

#: What the nodes of the other process are, each with a comma.
NODES = "Talker(), Listener(), Server(), Listener('_hidden'),"


@pytest.fixture(scope="module")
def domain():
    lease = lease_domain()
    with other_process(lease.domain_id, NODES):
        yield lease.domain_id
    lease.release()


@pytest.fixture
def joined(domain):
    with Session(domain_id=domain) as session:
        session.wait_for_nodes("talker", "/listener", "server", timeout=30)
        yield session


def without_history(end):
    return replace(end, qos=replace(end.qos, history="", depth=0), matched=-1)


def test_the_nodes_of_another_process_are_there_without_an_own_one(joined):
    graph = joined.graph()
    assert graph.nodes == ("/listener", "/server", "/talker")
    assert graph.topics() == ("/count",)
    (talks,) = graph.on("/count", "publisher")
    assert (talks.node, talks.type_name) == ("/talker", "std_msgs/msg/Int32")
    assert talks.qos == QoS(history="UNKNOWN", depth=0)
    assert [end.node for end in graph.on("/ask", "server")] == ["/server"]
    assert joined.nodes == ()
    assert repr(joined).endswith("no nodes)")


def test_they_look_as_they_do_in_their_own_session(joined, ros):
    for node in Listener, Server, Talker:
        ros.add(node)
    inside, outside = ros.graph(), joined.graph()
    assert outside.nodes == inside.nodes
    assert {*map(without_history, outside.endpoints)} == {*map(without_history, inside.endpoints)}


def test_they_are_matched_among_themselves_and_with_own_nodes(joined, eventually):
    def matched(kind):
        return {end.node: end.matched for end in joined.graph().on("/count", kind)}

    # The hidden one listens, too.
    assert matched("publisher") == {"/talker": 2}
    assert matched("subscription") == {"/listener": 1}
    joined.add(partial(Listener, "ear"))
    eventually(lambda: matched("subscription") == {"/ear": 1, "/listener": 1}, 30)
    assert matched("publisher") == {"/talker": 3}
    assert joined.graph().nodes == ("/ear", "/listener", "/server", "/talker")


def test_a_pair_that_does_not_fit_is_not_matched(joined):
    joined.add(lambda: Node("words")).create_publisher(String, "count", 10)
    words, talker = joined.graph().on("/count", "publisher")
    assert (words.node, words.matched, talker.matched) == ("/words", 0, 2)
    (listener,) = joined.graph().on("/count", "subscription")
    assert listener.matched == 1


def test_two_nodes_of_one_name_are_two(joined):
    joined.add(Talker)
    assert sorted(joined.graph().nodes) == ["/listener", "/server", "/talker", "/talker"]


def test_the_picture_shows_them(joined):
    assert picture(joined.graph()).description == (
        "3 nodes and 1 topic. /count (Int32): published by /talker, subscribed to by /listener. "
        "/ask (Trigger) is a service: offered by /server, used by nobody."
    )


def test_the_lookout_is_seen_by_nobody(joined):
    with Session(domain_id=joined.domain_id) as other:
        other.wait_for_nodes("talker", timeout=30)
        assert other.graph() == joined.graph()


def test_joining_again_and_again_leaves_nothing(domain, eventually):
    process = psutil.Process()
    Session(domain_id=domain).close()
    gc.collect()
    descriptors, threads = process.num_fds(), process.num_threads()
    for _ in range(5):
        ros = Session(domain_id=domain)  # the one before is dropped, not closed
        ros.add(Listener)
        ros.start()
        ros.graph()
    ros.close()
    gc.collect()
    eventually(lambda: process.num_threads() <= threads)
    eventually(lambda: process.num_fds() <= descriptors)


def test_after_the_end_the_graph_is_as_it_was(domain):
    with Session(domain_id=domain) as ros:
        ros.wait_for_nodes("talker", timeout=30)
        before = ros.graph()
    assert ros.graph() == before
    assert before.nodes


def test_a_node_that_does_not_come_gets_three_parts(joined, says):
    begin = time.monotonic()
    with pytest.raises(SessionError) as caught:
        joined.wait_for_nodes("talker", "talkr", timeout=0.5)
    assert 0.5 <= time.monotonic() - begin < 20
    says(caught.value, "/talkr is not there after 0.5 s", "/listener, /server, /talker")
    assert caught.value.to_try == "Did you mean /talker?"
    with pytest.raises(SessionError) as caught:
        joined.wait_for_nodes("zebra", "lion", timeout=0)
    says(caught.value, "/zebra, /lion are not there", "in a terminal")


def test_waiting_in_an_empty_domain(says):
    lease = lease_domain()
    with Session(domain_id=lease.domain_id) as ros:
        assert ros.graph().nodes == ()
        with pytest.raises(SessionError) as caught:
            ros.wait_for_nodes("talker", timeout=0)
        says(caught.value, f"In domain {lease.domain_id} the session sees: no node at all")
        ros.add(Talker)
        ros.wait_for_nodes("talker", timeout=30)
    lease.release()


def test_waiting_is_refused_where_nobody_can_come(ros, says):
    with pytest.raises(SessionError) as caught:
        ros.wait_for_nodes("talker")
    says(caught.value, "domain to itself", "ROS_DOMAIN_ID")


def test_what_is_asked_for_is_checked(joined, says, capsys):
    with pytest.raises(SessionError) as caught:
        joined.wait_for_nodes(5)
    says(caught.value, "quotation marks")
    with pytest.raises(DurationError) as error:
        joined.wait_for_nodes("talker", timeout=-1)
    says(error.value, "wait_for_nodes(timeout=...)")
    joined.add(partial(Doer, lambda _: joined.wait_for_nodes("talker")))
    joined.run(1)
    assert [fault.kind for fault in joined.observation().faults] == ["SessionError"]
    capsys.readouterr()


def test_a_topic_that_only_others_use_is_explained(joined, says):
    with pytest.raises(UnknownTopicError) as caught:
        joined.messages("count")
    says(caught.value, "/talker publishes there, in another process", "ros.add")
