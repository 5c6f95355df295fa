"""The graph: of a session, of other processes in a domain that was joined, and waiting for it."""

import time
from dataclasses import replace
from functools import partial

import pytest
from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data
from std_msgs.msg import String
from std_srvs.srv import Trigger

from nodes import Doer, Listener, Server, Talker
from other_process import other_process
from rosbeat import Session
from rosbeat.domains import lease_domain, participants, udp_ports
from rosbeat.errors import DurationError, SessionError
from rosbeat.records import QoS
from rosbeat.ros.graph import count_participants, domains_in_use

pytestmark = pytest.mark.ros

# A session's own nodes.


def test_endpoints_and_their_quality(ros):
    ros.add(Talker)
    ros.add(Listener)
    ros.add(partial(Listener, "other", qos=qos_profile_sensor_data))
    graph = ros.graph()
    assert graph.nodes == ("/talker", "/listener", "/other")
    assert graph.topics() == ("/count",)
    assert "/rosout" not in graph.topics()
    assert "/parameter_events" in graph.topics(infrastructure=True)
    (publisher,) = graph.on("/count", "publisher")
    assert (publisher.node, publisher.type_name) == ("/talker", "std_msgs/msg/Int32")
    assert publisher.qos == QoS()
    assert publisher.matched == 2
    one, two = graph.on("/count", "subscription")
    assert (one.qos.reliability, two.qos.reliability) == ("RELIABLE", "BEST_EFFORT")
    assert (one.matched, two.matched) == (1, 1)


def test_services_and_clients(ros):
    ros.add(Server)
    ros.add(lambda: Node("asker")).create_client(Trigger, "ask")
    (server,), (client,) = ros.graph().on("/ask", "server"), ros.graph().on("/ask", "client")
    assert (server.type_name, client.node) == ("std_srvs/srv/Trigger", "/asker")


def test_what_was_destroyed_is_not_there(ros):
    talker, listener = ros.add(Talker), ros.add(Listener)
    talker.destroy_publisher(talker.publisher)
    listener.destroy_subscription(listener.subscription)
    assert ros.graph().topics() == ()
    ros.run(2)
    ros.remove(talker)
    assert ros.graph().nodes == ("/listener",)


# Nodes of another process, in a domain that was joined.


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


def test_a_pair_that_does_not_fit_is_not_matched(joined):
    joined.add(lambda: Node("words")).create_publisher(String, "count", 10)
    words, talker = joined.graph().on("/count", "publisher")
    assert (words.node, words.matched, talker.matched) == ("/words", 0, 2)
    (listener,) = joined.graph().on("/count", "subscription")
    assert listener.matched == 1


def test_a_node_that_does_not_come_gets_three_parts(joined, says):
    begin = time.monotonic()
    with pytest.raises(SessionError) as caught:
        joined.wait_for_nodes("talker", "talkr", timeout=0.5)
    assert time.monotonic() - begin >= 0.5
    says(caught.value, "/talkr is not in the graph after 0.5 s", "/listener, /server, /talker")
    assert caught.value.to_try == "Did you mean /talker?"
    with pytest.raises(SessionError) as caught:
        joined.wait_for_nodes("zebra", "lion", timeout=0)
    says(caught.value, "/zebra, /lion are not in the graph", "in a terminal")


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
    says(caught.value, "A session is private", "ROS_DOMAIN_ID")


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


# The hidden node through which a session sees other processes.


def test_the_observer_is_no_node_of_the_session_and_has_nothing_to_say(empty_domain):
    with Session(domain_id=empty_domain) as ros:
        observer = ros._core.graph_observer
        assert ros.nodes == ()
        assert ros.graph().nodes == ros.graph().endpoints == ()
        assert observer.get_name().startswith("_")
        assert observer.get_service_names_and_types() == []
        assert not any(observer.publishers("/rosout"))
        assert observer.nodes() == [f"/{observer.get_name()}"]
        ros.add(Listener)
        ros.run(1)
        assert ros.observation().callbacks == ()


def test_a_node_that_is_listed_after_it_has_left_does_not_count(
    empty_domain, eventually, monkeypatch
):
    with Session(domain_id=empty_domain) as one, Session(domain_id=empty_domain) as two:
        two.add(Talker)
        eventually(lambda: one.graph().nodes == ("/talker",), 30)
        # As the middleware does it now and then on a busy machine.
        observer = one._core.graph_observer
        listed = [*observer.get_node_names_and_namespaces(), ("ghost", "/"), ("talker", "/")]
        monkeypatch.setattr(observer, "get_node_names_and_namespaces", lambda: listed)
        assert one.graph().nodes == ("/talker",)


# Participants, counted by the ports that they bind.


def row(port, user=1000, inode=1):
    """Return what the system says of a socket."""
    return f"  1: 00000000:{port:04X} 00000000:0000 07 00000000:0 00:0 0 {user} 0 {inode} 2 0 0"


@pytest.mark.parametrize(
    ("rows", "ignored", "found"),
    [
        ([row(9160), row(9161)], (), [1000]),
        ([row(9160), row(9161), row(9162), row(9163, 1001)], (), [1000]),
        ([row(9160)], (), []),
        ([row(9160), row(9161)], ["1"], []),
    ],
)
def test_a_participant_holds_two_ports_of_one_user(rows, ignored, found):
    table = "\n".join(["  sl  local_address rem_address", *rows])
    assert participants(7, udp_ports(table, ignored)) == found


def test_a_session_is_counted_and_is_no_other(empty_domain):
    with Session(domain_id=empty_domain):
        assert count_participants(empty_domain) == 1
        assert empty_domain not in domains_in_use()
