"""The graph: nodes, endpoints and timers as they are."""

from functools import partial

from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data
from std_srvs.srv import Trigger

from nodes import SECOND, Listener, Server, Talker, Ticker
from rosbeat.records import QoS


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


def test_timers(ros):
    ticker = ros.add(partial(Ticker, 0.5, 2.0))
    ros.run(4)
    assert [(timer.period_ns, timer.calls) for timer in ros.graph().timers] == [
        (SECOND // 2, 8), (2 * SECOND, 2),
    ]  # fmt: skip
    ticker.destroy_timer(ticker.clocks[0])
    assert [timer.period_ns for timer in ros.graph().timers] == [2 * SECOND]


def test_what_was_destroyed_is_not_there(ros):
    talker, listener = ros.add(Talker), ros.add(Listener)
    talker.destroy_publisher(talker.publisher)
    listener.destroy_subscription(listener.subscription)
    assert ros.graph().topics() == ()
    ros.run(2)
    ros.remove(talker)
    assert ros.graph().nodes == ("/listener",)
