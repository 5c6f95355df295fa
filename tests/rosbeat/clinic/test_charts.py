"""What an observation looks like on paper."""

from dataclasses import replace

import pytest

from made_records import STRING, at, call, graph_of, heard, pub, sample, sub
from rosbeat.clinic.charts import chart
from rosbeat.clinic.plans import Orders, Truth
from rosbeat.records import Endpoint, Fault, LogRecord, Observation, QoS, TimerRecord

ORDERS = Orders("/t", 1.0, 2.0, 0.0, 3.0)
A, B = pub("/a", "/t"), sub("/b", "/t")
INFRASTRUCTURE = (
    pub("/a", "/rosout", type_name="rcl_interfaces/msg/Log"),
    Endpoint("/a", "/a/get", "x/srv/Y", "server", QoS()),
)
SEEN = Observation(
    at(5),
    0,
    tuple(sample(time, time / 2, "/t", "/a") for time in (1, 2, 3, 4)),
    tuple(LogRecord(at(time), "INFO", name, "started", "__init__", 1)
          for time, name in ((0, "a"), (2.5, "b"))),
    callbacks=tuple(heard(time, "/b", "/t") for time in (3, 4)),
    graph=replace(graph_of(A, B, *INFRASTRUCTURE), timers=(TimerRecord("/a", "tick", at(1), 4),)),
)  # fmt: skip
ENDED = (Fault(at(3), "/a", "tick", "IndexError", "out of range", 0, ""),)
UNFIT = sub("/b", "/t", qos=QoS(durability="TRANSIENT_LOCAL"))
WORDS = tuple(sample(time, "High", "/t", "/a", STRING) for time in (1, 2))
CALLS = (call(1, "/b", "hear", "waitable", ""), heard(2, "/b", "/t"), call(1, "/a", "tick"))


def spoken(*times):
    return {"samples": tuple(sample(time, 1.0, "/t", "/a") for time in times)}


def talk(found):
    (one,) = found.talks
    return one


def hearing(found):
    (one,) = found.hearings
    return one.count, one.sent, one.before, one.last


@pytest.mark.parametrize(
    ("changes", "read", "expected"),
    [
        # Only topics are on the chart.
        ({}, lambda found: (found.topics, found.nodes), (("/t",), ("/a", "/b"))),
        # What came before somebody listened does not count as sent,
        ({}, hearing, (2, 2, 2, 4.0)),
        # and a publisher that does not fit sends nothing.
        ({"graph": graph_of(A, UNFIT)}, lambda found: hearing(found)[1:3], (0, 0)),
        # Each value stands once, and texts are texts.
        ({}, lambda found: (talk(found).count, talk(found).first, talk(found).last),
         (4, 1.0, 4.0)),
        ({}, lambda found: (talk(found).values, talk(found).texts), ((0.5, 1.0, 1.5, 2.0), ())),
        ({"graph": graph_of(pub("/a", "/t", type_name=STRING)), "samples": WORDS},
         lambda found: (talk(found).values, talk(found).texts), ((), ("High",))),
        # The gap is the usual one between moments.
        *((spoken(*times), lambda found: talk(found).gap, gap) for times, gap in (
            ((), 0.0), ((1,), 0.0), ((1, 1, 1), 0.0), ((5, 5, 10, 10, 15), 5.0),
            ((1, 2, 3, 9), 1.0))),
        # Callbacks of the middleware do not count.
        ({"callbacks": CALLS},
         lambda found: [(m.callbacks, m.ticks, m.due, m.started) for m in found.members],
         [(1, 1, 5, 0.0), (1, 0, 0, 2.5)]),
        # A node that has ended was due until then, and is still listed.
        ({"faults": ENDED}, lambda found: found.members[0].due, 3),
        ({"faults": ENDED, "graph": graph_of(B)}, lambda found: found.nodes, ("/b", "/a")),
    ],
)  # fmt: skip
def test_what_is_on_a_chart(changes, read, expected):
    assert read(chart(replace(SEEN, **changes), ORDERS)) == expected


def test_what_only_the_ward_knows():
    found = chart(SEEN, ORDERS, number=4, truths=[Truth("gone-quiet", ("/a",))], unspun={"/b"})
    assert (found.number, found.seconds, found.truths[0].places) == (4, 5.0, ("/a",))
    assert [one.spun for one in found.members] == [True, False]
