"""What a session counts of deadlines and lifespans, and what it leaves alone."""

import pytest
from rcl_interfaces.msg import Log
from rclpy.qos import DurabilityPolicy, QoSProfile

from limited import TOPIC, Heart, Nurse, quality
from nodes import Listener, Talker
from rosbeat import Session
from rosbeat.records import NANOSECONDS, QoS
from rosbeat.ros.scenario import Publish, observe
from rosbeat.ros.test_nodes import feeder, profile

pytestmark = pytest.mark.ros


def test_nothing_is_heard_where_nobody_counts(ros):
    talker, ear = ros.add(Talker), ros.add(Listener)
    ros.run(3)
    assert not ros._world.virtual.deadlines
    entry = ros._world._entries[ear.subscription]
    assert entry.take.__name__ == "take_message"
    assert talker.publisher.qos_profile.depth == 10


def test_who_listens_hears_publishers_that_come_later(ros):
    nurse = ros.add(lambda: Nurse(quality(1.0)))
    ros.add(lambda: Talker(topic=TOPIC, period=2.0, qos=quality(1.0)))
    ros.run(5)
    assert [total for total, _ in nurse.missed] == [1, 2]


def test_a_deadline_without_a_callback_is_shown_and_not_counted(ros):
    ros.add(lambda: Talker(qos=quality(0.5)))
    ros.add(lambda: Listener(qos=quality(0.5)))
    ros.run(3)
    assert not ros._world.virtual.deadlines
    (end,) = ros.graph().on("/count", "subscription")
    assert end.qos.deadline_ns == NANOSECONDS // 2


def test_a_lifespan_on_a_topic_of_every_node_is_left_to_the_middleware(ros):
    node = ros.add(Talker)
    heard = []
    qos = QoSProfile(
        depth=1000, durability=DurabilityPolicy.TRANSIENT_LOCAL, lifespan=quality(0, 60).lifespan
    )
    node.create_subscription(Log, "/rosout", lambda line: heard.append(line.msg), qos)
    node.get_logger().info("hello")
    ros.run(1)
    assert heard == ["hello"]


def test_a_joined_domain_is_left_to_the_middleware(ros):
    with Session(domain_id=ros.domain_id) as joined:
        joined.add(lambda: Nurse(quality(1.0, 1.0)))
        joined.add(lambda: Heart(quality(1.0)))
        assert not joined._world.virtual.deadlines


def test_feeders_and_steps_have_limits_too():
    limited = QoS(deadline_ns=NANOSECONDS, lifespan_ns=2 * NANOSECONDS)
    made = profile(limited)
    assert (made.deadline.nanoseconds, made.lifespan.nanoseconds) == (10**9, 2 * 10**9)
    assert profile(QoS()) == QoSProfile(depth=10)
    seen = observe(
        lambda: Nurse(quality(1.0)),
        6,
        others=[feeder("feeder", TOPIC, "std_msgs/msg/Int32", [1, 2, 3], qos=limited)],
        steps=[Publish(4.5, topic=f"/{TOPIC}", type_name="std_msgs/msg/Int32", values=(4,),
                       qos=limited)],
    )  # fmt: skip
    ends = seen.graph.on(f"/{TOPIC}", "publisher")
    assert {end.qos for end in ends} == {limited}
    missed = [one.time for one in seen.callbacks if one.kind == "event"]
    assert missed == [4.0, 5.5]


def test_explain_names_a_deadline_that_does_not_fit(ros):
    ros.add(lambda: Nurse(quality(1.0, 1.2)))
    heart = ros.add(lambda: Heart(quality(2.0)))
    heart.beat(1)
    ros.run(2)
    said = str(ros.explain(TOPIC))
    assert "deadline of /heart and /nurse does not fit" in said
    assert "offers a deadline of 2 s" in said
    assert "lifespan 1.2 s" in said
