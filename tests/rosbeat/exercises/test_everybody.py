"""The judge of the archive, asked about made-up runs. Needs no ROS."""

import pytest

from rosbeat.exercises.everybody import judge_everybody
from rosbeat.records import CallbackRecord, Endpoint, GraphSnapshot, Observation, QoS, Sample

FLOAT = "std_msgs/msg/Float32"
READINGS = {"/new": (1.0, 2.0, 3.0, 4.0), "/old": (11.0, 12.0, 13.0, 14.0)}
ALL = (1.0, 11.0, 2.0, 12.0, 3.0, 13.0, 4.0, 14.0)
BEST_EFFORT = QoS("BEST_EFFORT")


def ns(seconds):
    return round(seconds * 10**9)


def run(kept=ALL, asks=(BEST_EFFORT,), heard=True, type_name=FLOAT):
    """Ask about an archive that kept these readings; it was away from 1.5 s to 3.5 s."""
    samples = [
        Sample(ns(at), "/reading", FLOAT, node, {"data": value})
        for node, values in READINGS.items()
        for at, value in enumerate(values, 1)
    ]
    samples += [Sample(ns(5), "/archive", type_name, "/archive", {"data": one}) for one in kept]
    calls = [CallbackRecord(ns(1.5), "/archive", "step", "Pause", ""),
             CallbackRecord(ns(3.5), "/archive", "step", "Resume", "")]  # fmt: skip
    if heard:
        calls.append(CallbackRecord(ns(4), "/archive", "subscription", "copy", "/reading"))
    ends = [
        Endpoint("/new", "/reading", FLOAT, "publisher", BEST_EFFORT),
        Endpoint("/old", "/reading", FLOAT, "publisher", QoS()),
        *(Endpoint("/archive", "/reading", FLOAT, "subscription", qos) for qos in asks),
    ]
    graph = GraphSnapshot(("/new", "/old", "/archive"), tuple(ends))
    seen = Observation(ns(6), 0, tuple(samples), (), tuple(calls), (), graph, "/archive")
    return judge_everybody("08b", seen, READINGS)


def test_the_right_one():
    assert run().status == "passed"
    assert run(asks=(BEST_EFFORT, QoS())).status == "passed"
    assert "8 readings, 8 in the archive" in run().evidence


@pytest.mark.parametrize(
    ("options", "mistake", "said"),
    [
        ({"kept": ALL[:2] + ALL[4:]}, "queue-too-short", "4 readings came meanwhile, and 2 of"),
        ({"kept": ALL[:2] + ALL[3:]}, "queue-too-short", "1 of them is lost"),
        ({"kept": ALL[1::2], "asks": (QoS(),)}, "qos-mismatch", "/new offers BEST_EFFORT"),
        ({"kept": (), "heard": False, "asks": (QoS("RELIABLE", "TRANSIENT_LOCAL"),)},
         "qos-mismatch", "/new offers BEST_EFFORT"),
        ({"kept": (), "heard": False, "asks": (QoS("BEST_EFFORT", deadline_ns=1),)},
         "qos-mismatch", "deadline"),
        ({"kept": (), "heard": False, "asks": ()}, "no-subscription", "no subscription"),
        ({"kept": ALL + ALL[:1], "asks": (BEST_EFFORT, QoS())}, "heard-twice", "1 is in the"),
        ({"kept": ALL + ALL[:1]}, "wrong-values", "was published once"),
        ({"kept": (*ALL, 5.5)}, "wrong-values", "no sensor has published it"),
        ({"kept": ALL[:-1]}, "wrong-values", "came at 4 s"),
        ({"kept": ALL[::-1]}, "wrong-values", "another order"),
        ({"kept": (1.0,), "type_name": "std_msgs/msg/Int32"}, "type-mismatch", "Int32"),
        # Connected, and yet nothing of one sensor: no policy explains it.
        ({"kept": ALL[::2]}, "new-to-me", "nothing of /old"),
    ],
)  # fmt: skip
def test_what_is_wrong(options, mistake, said):
    outcome = run(**options)
    assert (outcome.status, outcome.mistake) == ("failed", mistake)
    assert said in outcome.evidence
    assert outcome.hint
