"""Silence has a reason: which one, from the record of a run alone, and for real."""

import pytest
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from std_msgs.msg import Float32, Float64

from failed_calls import failed_call
from rosbeat.diagnosis.connections import Wire, diagnose_unheard, diagnose_unpublished, why_raised
from rosbeat.records import (
    CallbackRecord,
    Endpoint,
    Fault,
    GraphSnapshot,
    Observation,
    QoS,
    Sample,
    TimerRecord,
)
from rosbeat.ros.scenario import observe
from rosbeat.ros.test_nodes import feeder

FLOAT = "std_msgs/msg/Float32"
WIRE = Wire("/temperature", FLOAT)
NODE, ROOM = "/answer", "/room"


def end(kind, name="/temperature", node=NODE, type_name=FLOAT, qos=None, matched=1):
    return Endpoint(node, name, type_name, kind, qos or QoS(), matched)


def seen(*endpoints, **more):
    """A run of ten seconds of the node `/answer`."""
    timers = more.pop("timers", ())
    graph = GraphSnapshot((ROOM, NODE), endpoints, timers)
    return Observation(10_000_000_000, 0, graph=graph, subject=NODE, **more)


def tick(calls=10, seconds=1.0):
    return TimerRecord(NODE, "tick", round(seconds * 1e9), calls)


RAN = (CallbackRecord(1, NODE, "timer", "tick", "1 s"),)
HEARD = (Sample(1, "/temperature", FLOAT, ROOM, {"data": 1.0}),)
ROSOUT = end("publisher", "/rosout", type_name="rcl_interfaces/msg/Log")
BEST_EFFORT = QoS("BEST_EFFORT")

#: What no node below does for real.
SILENT = [
    ("no-publisher", seen(ROSOUT, end("publisher", node=ROOM)), "no publisher at all"),
    ("topic-misspelled", seen(end("publisher", "/Temperature")), "capital"),
    ("wrong-topic", seen(end("publisher", "/humidity")), "/humidity instead of /temperature"),
    (
        "never-published",
        seen(end("publisher"), timers=(tick(),), callbacks=RAN),
        "published nothing there",
    ),
    (
        "never-published",
        seen(end("publisher"), end("subscription", "/a")),
        "published nothing there",
    ),
    ("wrong-rate", seen(end("publisher"), timers=(tick(0, 1000.0),)), "1000 s before its first"),
    ("never-published", seen(end("publisher"), timers=(tick(0),)), "published nothing there"),
]
UNHEARD = [
    ("type-mismatch", seen(end("subscription", type_name="std_msgs/msg/String")), "String"),
    ("not-spun", seen(end("subscription"), samples=HEARD), "ran for none of them"),
    ("new-to-me", seen(end("publisher", node=ROOM), end("subscription", qos=BEST_EFFORT)), "none"),
    (
        "qos-mismatch",
        seen(end("publisher", node=ROOM, qos=BEST_EFFORT), end("subscription", matched=0)),
        "requests RELIABLE, but /room offers BEST_EFFORT",
    ),
]


@pytest.mark.parametrize(
    ("why", "mistake", "observation", "text"),
    [
        *((diagnose_unpublished, *case) for case in SILENT),
        *((diagnose_unheard, *case) for case in UNHEARD),
    ],
)
def test_why_nothing_came(why, mistake, observation, text):
    found = why(observation, WIRE)
    assert (found.mistake, text in found.evidence, bool(found.hint)) == (mistake, True, True), found


def test_a_second_topic_that_is_wanted_too_is_not_a_wrong_one():
    observation = seen(end("publisher", "/status"))
    found = diagnose_unpublished(observation, Wire("/mean", FLOAT), ("/mean", "/status"))
    assert found.mistake == "no-publisher"
    assert diagnose_unpublished(observation, Wire("/mean", FLOAT)).mistake == "wrong-topic"


def test_a_second_publisher_that_is_used_in_its_place():
    sent = Sample(1, "/temperatures", FLOAT, NODE, {"data": 1.0})
    made = (end("publisher"), end("publisher", "/temperatures"))
    observation = seen(*made, samples=(sent,), callbacks=RAN)
    assert diagnose_unpublished(observation, WIRE).mistake == "topic-misspelled"
    found = diagnose_unpublished(observation, WIRE, ("/temperatures",))
    assert found.mistake == "never-published"


def test_two_types_on_a_topic_are_both_said():
    text = "create_publisher() called for existing topic name rt/temperature with incompatible type"
    asked = "create_publisher(message_type[String], str, int)"
    fault = Fault(1, NODE, "__init__", "RCLError", text, 3, "make()", failed_call(asked))
    found = why_raised(seen(end("subscription", node=ROOM)), fault)
    assert found.mistake == "type-mismatch"
    said = "On /temperature, your node uses String and the other side Float32."
    assert found.evidence.endswith(said)
    other = end("subscription", "/room/temperature", ROOM, "std_msgs/msg/Int32")
    two = why_raised(seen(end("subscription", node=ROOM), other), fault)
    assert two.mistake == "type-mismatch"
    assert "the other side" not in two.evidence


def test_a_message_of_another_type_says_nothing_of_other_topics():
    text = "Expected <class 'std_msgs.msg._float32.Float32'>, got <class 'std_msgs.msg._string."
    asked = failed_call("publish(message[String])")
    fault = Fault(1, NODE, "listen", "TypeError", f"{text}String'>", 3, "publish(msg)", asked)
    found = why_raised(seen(end("publisher", node=ROOM)), fault)
    assert found.mistake == "type-mismatch"
    assert "the other side" not in found.evidence


# For real.


def answer(make):
    class Answer(Node):
        def __init__(self):
            super().__init__("answer")
            make(self)

    return Answer


def publishes(topic="temperature", kind=Float32, timer=True):
    def make(node):
        made = node.create_publisher(kind, topic, 10)
        if timer:
            node.create_timer(1.0, lambda: made.publish(kind(data=1.0)))

    return answer(make)


def listens(topic="temperature", qos=10):
    return answer(lambda node: node.create_subscription(Float32, topic, lambda msg: None, qos))


STORED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)


@pytest.mark.ros
@pytest.mark.parametrize(
    ("why", "mistake", "made"),
    [
        (diagnose_unpublished, None, publishes()),
        (diagnose_unpublished, None, publishes("/temperature")),
        (diagnose_unpublished, "topic-misspelled", publishes("~/temperature")),
        (diagnose_unpublished, "topic-misspelled", publishes("temperatur")),
        (diagnose_unpublished, "type-mismatch", publishes(kind=Float64)),
        (diagnose_unpublished, "no-timer", publishes(timer=False)),
        (diagnose_unpublished, "no-publisher", answer(lambda node: None)),
        (diagnose_unheard, None, listens()),
        (diagnose_unheard, None, listens("/temperature")),
        (diagnose_unheard, "topic-misspelled", listens("Temperature")),
        (diagnose_unheard, "wrong-topic", listens("pressure")),
        (diagnose_unheard, "qos-mismatch", listens(qos=STORED)),
        (diagnose_unheard, None, listens(qos=QoSProfile(
            depth=1, reliability=ReliabilityPolicy.BEST_EFFORT))),
        (diagnose_unheard, "no-subscription", answer(lambda node: None)),
    ],
)  # fmt: skip
def test_for_real(why, mistake, made):
    others = [feeder("room", "temperature", FLOAT, [22.0])] if why is diagnose_unheard else []
    found = why(observe(made, 3.0, others=others), WIRE)
    assert (found and found.mistake) == mistake
