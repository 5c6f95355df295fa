"""What an observation looks like on paper."""

import pytest

from rosbeat.clinic.charts import chart
from rosbeat.clinic.plans import FLOAT, STRING, Orders, Truth
from rosbeat.records import (
    CallbackRecord,
    Endpoint,
    Fault,
    GraphSnapshot,
    LogRecord,
    Observation,
    QoS,
    Sample,
    TimerRecord,
)

SECOND = 10**9
ORDERS = Orders("/t", 1.0, 2.0, 0.0, 3.0)


def sample(at, value, node="/a", topic="/t", type_name=FLOAT):
    return Sample(int(at * SECOND), topic, type_name, node, {"data": value})


def line(at, name):
    return LogRecord(int(at * SECOND), "INFO", name, f"{name} started", "__init__", 1)


def ran(at, node, kind="subscription", source="/t"):
    return CallbackRecord(int(at * SECOND), node, kind, "hear", source)


def seen(**changes):
    ends = (
        Endpoint("/a", "/t", FLOAT, "publisher", QoS()),
        Endpoint("/b", "/t", FLOAT, "subscription", QoS()),
        Endpoint("/a", "/rosout", "rcl_interfaces/msg/Log", "publisher", QoS()),
        Endpoint("/a", "/a/get", "x/srv/Y", "server", QoS()),
    )
    timers = (TimerRecord("/a", "tick", SECOND, 4),)
    base = {
        "samples": tuple(sample(at, at / 2) for at in (1, 2, 3, 4)),
        "logs": (line(0, "a"), line(2.5, "b")),
        "callbacks": tuple(ran(at, "/b") for at in (3, 4)),
        "graph": GraphSnapshot(("/a", "/b"), ends, timers),
        **changes,
    }
    return Observation(5 * SECOND, 0, **base)


def test_only_topics_are_on_the_chart():
    found = chart(seen(), ORDERS, number=4, truths=[Truth("gone-quiet", ("/a",))])
    assert found.topics == ("/t",)
    assert found.nodes == ("/a", "/b")
    assert (found.number, found.seconds, found.truths[0].places) == (4, 5.0, ("/a",))


def test_what_came_before_somebody_listened_does_not_count_as_sent():
    (heard,) = chart(seen(), ORDERS).hearings
    assert (heard.count, heard.sent, heard.before, heard.last) == (2, 2, 2, 4.0)


def test_a_publisher_that_does_not_fit_sends_nothing():
    asks = QoS(durability="TRANSIENT_LOCAL")
    graph = seen().graph
    ends = (graph.endpoints[0], Endpoint("/b", "/t", FLOAT, "subscription", asks))
    (heard,) = chart(seen(graph=GraphSnapshot(graph.nodes, ends)), ORDERS).hearings
    assert (heard.sent, heard.before) == (0, 0)


def test_what_was_said_is_counted_and_each_value_stands_once():
    (talk,) = chart(seen(), ORDERS).talks
    assert (talk.count, talk.first, talk.last, talk.gap) == (4, 1.0, 4.0, 1.0)
    assert talk.values == (0.5, 1.0, 1.5, 2.0)
    assert talk.texts == ()


@pytest.mark.parametrize(
    ("times", "gap"),
    [((), 0.0), ((1,), 0.0), ((1, 1, 1), 0.0), ((5, 5, 10, 10, 15), 5.0), ((1, 2, 3, 9), 1.0)],
)
def test_the_gap_is_the_usual_one_between_moments(times, gap):
    (talk,) = chart(seen(samples=tuple(sample(at, 1.0) for at in times)), ORDERS).talks
    assert talk.gap == gap


def test_texts_are_texts():
    ends = (Endpoint("/a", "/t", STRING, "publisher", QoS()),)
    samples = (sample(1, "High", type_name=STRING), sample(2, "High", type_name=STRING))
    (talk,) = chart(seen(graph=GraphSnapshot(("/a",), ends), samples=samples), ORDERS).talks
    assert (talk.values, talk.texts) == ((), ("High",))


def test_callbacks_of_the_middleware_do_not_count():
    calls = (ran(1, "/b", "waitable", ""), ran(2, "/b"), ran(1, "/a", "timer", "1 s"))
    a, b = chart(seen(callbacks=calls), ORDERS).members
    assert (a.callbacks, a.ticks, a.due, a.started) == (1, 1, 5, 0.0)
    assert (b.callbacks, b.ticks, b.due, b.started) == (1, 0, 0, 2.5)


def test_a_node_that_has_ended_was_due_until_then_and_is_still_listed():
    fault = Fault(3 * SECOND, "/a", "tick", "IndexError", "out of range", 0, "")
    graph = seen().graph
    found = chart(seen(faults=(fault,)), ORDERS)
    assert found.members[0].due == 3
    gone = GraphSnapshot(("/b",), graph.endpoints[1:2])
    assert chart(seen(faults=(fault,), graph=gone), ORDERS).nodes == ("/b", "/a")


def test_who_is_not_spun_is_said_from_outside():
    assert [one.spun for one in chart(seen(), ORDERS, unspun={"/b"}).members] == [True, False]
