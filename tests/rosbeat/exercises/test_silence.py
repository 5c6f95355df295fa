"""The judge of the watchdog, asked about made-up runs. Needs no ROS."""

import pytest

from rosbeat.exercises.silence import judge_silence
from rosbeat.records import CallbackRecord, Endpoint, GraphSnapshot, Observation, QoS, Sample

FLOAT, STRING = "std_msgs/msg/Float32", "std_msgs/msg/String"
TIMES = (1.0, 2.0, 3.0, 8.0, 9.0, 11.0)  # exactly two seconds are no silence
RIGHT = ((5.0, "lost"), (8.0, "back"), (13.0, "lost"))
DEADLINE = QoS(deadline_ns=2 * 10**9)


def ns(seconds):
    return round(seconds * 10**9)


def run(words=RIGHT, asks=DEADLINE, offers=QoS(), event=True, times=TIMES, type_name=STRING):  # noqa: B008
    """Ask about a watchdog that said these words."""
    samples = [Sample(ns(at), "/health", type_name, "/dog", {"data": word}) for at, word in words]
    calls = [CallbackRecord(ns(at), "/dog", "subscription", "hear", "/temperature") for at in TIMES]
    if event:
        calls.append(CallbackRecord(ns(5), "/dog", "event", "miss", "deadline of /temperature"))
    ends = (
        Endpoint("/dog", "/temperature", FLOAT, "subscription", asks),
        Endpoint("/dog", "/health", STRING, "publisher", offers),
    )
    graph = GraphSnapshot(("/dog",), ends)
    seen = Observation(ns(20), 0, tuple(samples), (), tuple(calls), (), graph, "/dog")
    return judge_silence("08c", seen, times)


def test_the_right_one():
    assert run().status == "passed"
    assert "2 silences" in run().evidence
    assert run(((5.25, "lost"), (8.25, "back"), (13.25, "lost"))).status == "passed"


@pytest.mark.parametrize(
    ("options", "mistake", "said"),
    [
        ({"words": (), "event": False}, "deadline-unheard", "deadline of 2 s"),
        ({"words": (), "event": False, "asks": QoS()}, "no-deadline", "no deadline"),
        ({"words": (), "event": False, "asks": QoS(), "offers": DEADLINE},
         "deadline-wrong-side", "publisher on /health"),
        ({"words": ()}, "never-published", "never used"),
        ({"words": ((5.0, "LOST"),)}, "wrong-word", "'LOST'"),
        ({"words": ((1.0, "back"), *RIGHT)}, "wrong-start", "at 1 s"),
        ({"words": (RIGHT[0], (7.0, "lost"), *RIGHT[1:])}, "status-repeated", "again at 7 s"),
        ({"words": (*RIGHT[:2], (9.0, "back"))}, "status-repeated", "again at 9 s"),
        ({"words": ((6.0, "lost"), *RIGHT[1:]), "asks": QoS(deadline_ns=3 * 10**9)},
         "wrong-deadline", "3 s later. Its deadline is 3 s."),
        ({"words": ((4.0, "lost"), *RIGHT[1:]), "asks": QoS()}, "wrong-deadline", "1 s later."),
        ({"words": (RIGHT[0], (9.0, "back"), RIGHT[2])}, "wrong-rate", "at 9 s"),
        ({"words": RIGHT[:1]}, "change-missing", "a reading came again"),
        ({"words": RIGHT[:2]}, "change-missing", "nothing had come for 2 s"),
        ({"words": (*RIGHT, (15.0, "back"))}, "alert-too-many", "At 15 s"),
        ({"type_name": "std_msgs/msg/Int32"}, "type-mismatch", "Int32"),
    ],
)  # fmt: skip
def test_what_is_wrong(options, mistake, said):
    outcome = run(**options)
    assert (outcome.status, outcome.mistake) == ("failed", mistake)
    assert said in outcome.evidence
    assert outcome.hint
