"""Commands as spans, and outputs that stay silent."""

from rosbeat.exercises.greenhouse.reading import Switch, silent, stamp, switch
from rosbeat.records import Endpoint, GraphSnapshot, Observation, QoS, Sample

BOOL = "std_msgs/msg/Bool"


def test_a_switch_is_off_until_its_first_command():
    vent = Switch(((2.0, True), (5.0, False)))
    assert [vent.at(time) for time in (0, 1.9, 2.0, 4.9, 5.0, 9)] == [False] * 2 + [True] * 2 + [
        False,
        False,
    ]


def test_spans_end_with_the_run():
    assert Switch(((2.0, True), (3.0, True), (5.0, False), (7.0, True))).spans(9.0) == [
        (2.0, 5.0),
        (7.0, 9.0),
    ]
    assert Switch(((2.0, True), (2.0, False))).spans(9.0) == []
    assert Switch(()).spans(9.0) == []


def seen(*ends, samples=()):
    points = tuple(Endpoint("/a", name, kind, "publisher", QoS()) for name, kind in ends)
    return Observation(10**9, 0, samples=samples, graph=GraphSnapshot(("/a",), points))


def test_why_an_output_is_silent():
    assert silent(seen(), "/vent").mistake == "no-publisher"
    assert silent(seen(("/vents", BOOL)), "/vent").mistake == "topic-misspelled"
    assert silent(seen(("/greenhouse/vent", BOOL)), "/vent").mistake == "topic-misspelled"
    assert silent(seen(("/vent", BOOL)), "/vent").mistake == "never-published"
    assert silent(seen(("/vent", "std_msgs/msg/Float32")), "/vent").mistake == "type-mismatch"
    sample = Sample(5, "/vent", BOOL, "/a", {"data": True})
    heard = seen(("/vent", BOOL), samples=(sample,))
    assert silent(heard, "/vent") is None
    assert switch(heard, "/vent").at(1.0)


def test_times_are_short():
    assert stamp(5.0) == "5 s"
    assert stamp(5.25000001) == "5.25 s"
