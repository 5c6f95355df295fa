"""Messages from other processes, recorded as a node of the session gets them."""

from functools import partial

import pytest
from rclpy.node import Node
from std_msgs.msg import Int32

from nodes import Listener, Talker
from other_process import other_process
from rosbeat import Session
from rosbeat.domains import lease_domain
from rosbeat.viz import values


@pytest.fixture(scope="module")
def domain():
    lease = lease_domain()
    nodes = "Talker(period=0.02), Talker('twin', 'twins', 0.05), Talker('other', 'twins', 0.05),"
    with other_process(lease.domain_id, nodes):
        yield lease.domain_id
    lease.release()


@pytest.fixture
def joined(domain):
    with Session(domain_id=domain) as session:
        session.wait_for_nodes("talker", "twin", "other", timeout=30)
        yield session


def numbers(session, node, topic="count"):
    return [sample.value for sample in session.messages(topic) if sample.node == node]


def is_rising(found):
    """Whether none is there twice; on a busy machine a queue may have dropped some."""
    return bool(found) and found == sorted(set(found))


def test_what_another_process_publishes_is_recorded(joined):
    ear = joined.add(Listener)
    assert joined.messages("count") == ()
    joined.start()
    assert joined.wait(30, until=lambda: len(joined.messages("count")) >= 20)
    joined.stop()
    samples = joined.messages("count")
    assert {(s.node, s.type_name) for s in samples} == {("/talker", "std_msgs/msg/Int32")}
    assert [s.value for s in samples] == ear.heard
    assert is_rising(ear.heard)
    assert [s.time_ns for s in samples] == sorted(s.time_ns for s in samples)
    assert "/talker" in values(samples).description
    assert joined.observation().samples == samples


def test_own_messages_are_recorded_once_and_under_their_own_name(joined):
    own, ear = joined.add(partial(Talker, "own", period=0.01)), joined.add(Listener)
    joined.start()
    assert joined.wait(30, until=lambda: own.count >= 50 and numbers(joined, "/talker"))
    joined.stop()
    assert numbers(joined, "/own") == list(range(1, own.count + 1))
    assert is_rising(numbers(joined, "/talker"))
    assert len(ear.heard) <= len(joined.messages("count"))


def test_who_published_is_unknown_if_several_could_have(joined):
    joined.add(partial(Listener, topic="twins"))
    joined.start()
    assert joined.wait(30, until=lambda: len(joined.messages("twins")) >= 5)
    assert {sample.node for sample in joined.messages("twins")} == {"?"}


def test_callbacks_of_every_kind_still_get_what_they_ask_for(joined):
    heard = {"info": [], "later": [], "raw": []}

    async def later(message):
        heard["later"].append(message.data)

    def with_info(message, info):
        heard["info"].append((message.data, info["publication_sequence_number"]))

    node = joined.add(lambda: Node("kinds"))
    node.create_subscription(Int32, "count", with_info, 10)
    node.create_subscription(Int32, "count", later, 10)
    node.create_subscription(Int32, "count", heard["raw"].append, 10, raw=True)
    joined.start()
    assert joined.wait(30, until=lambda: all(len(one) >= 5 for one in heard.values()))
    joined.stop()
    assert joined.observation().faults == ()
    assert all(data == number for data, number in heard["info"])
    assert isinstance(heard["raw"][0], bytes)
    assert is_rising(heard["later"])
    assert is_rising(numbers(joined, "/talker"))
