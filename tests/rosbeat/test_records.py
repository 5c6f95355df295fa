"""Records are plain, frozen and small; the queue obeys the laws of a queue."""

import dataclasses
import inspect
from itertools import pairwise

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rosbeat import records
from rosbeat.records import (
    Endpoint,
    GraphSnapshot,
    LogRecord,
    Observation,
    QoS,
    Sample,
    queue_steps,
)

FLOAT = "std_msgs/msg/Float32"
RECORDS = [kind for kind in vars(records).values() if dataclasses.is_dataclass(kind)]
times = st.lists(st.integers(0, 50), max_size=40).map(sorted)


@pytest.mark.parametrize("kind", RECORDS)
def test_records_are_frozen(kind):
    assert kind.__dataclass_params__.frozen


@pytest.mark.parametrize("kind", RECORDS)
def test_every_attribute_is_described(kind):
    described = inspect.getdoc(kind)
    missing = [one.name for one in dataclasses.fields(kind) if f"    {one.name}: " not in described]
    assert missing == []


def test_time_is_in_seconds():
    assert Sample(1_500_000_000, "/t", FLOAT, "/a", {"data": 1.0}).time == 1.5
    assert Observation(2 * records.NANOSECONDS, 0).time == 2.0
    assert LogRecord(1, "INFO", "a", "hello", "f", 1).time == 1e-9


def test_the_only_field_is_the_value():
    assert Sample(0, "/t", FLOAT, "/a", {"data": 1.0}).value == 1.0
    assert Sample(0, "/t", FLOAT, "/a", {"x": 1, "y": 2}).value == {"x": 1, "y": 2}
    assert Sample(0, "/t", "std_msgs/msg/Empty", "/a", {}).value == {}


def test_topics_leave_infrastructure_and_services_out():
    ends = (
        Endpoint("/a", "/rosout", FLOAT, "publisher", QoS()),
        Endpoint("/a", "/b", FLOAT, "subscription", QoS()),
        Endpoint("/a", "/a", FLOAT, "publisher", QoS()),
        Endpoint("/a", "/add", FLOAT, "server", QoS()),
    )
    graph = GraphSnapshot(("/a",), ends)
    assert graph.topics() == ("/a", "/b")
    assert graph.topics(infrastructure=True) == ("/a", "/b", "/rosout")
    assert graph.on("/b", "subscription") == ends[1:2]
    assert graph.on("/b", "publisher") == ()


def test_a_full_queue_drops_its_oldest():
    kinds = [(step.kind, step.number, step.length) for step in queue_steps([0, 1, 2], [3], 2)]
    assert kinds == [
        ("arrived", 1, 1),
        ("arrived", 2, 2),
        ("dropped", 1, 1),
        ("arrived", 3, 2),
        ("taken", 2, 1),
    ]


def test_at_equal_times_an_arrival_comes_first():
    assert [step.kind for step in queue_steps([5], [5], 1)] == ["arrived", "taken"]


@pytest.mark.parametrize("depth", [0, -1])
def test_a_queue_has_room_for_one_at_least(depth):
    with pytest.raises(ValueError, match="at least 1"):
        queue_steps([0], [], depth)


@given(times, times, st.integers(1, 12))
def test_the_laws_of_a_queue(arrivals, takes, depth):
    steps = queue_steps(arrivals, takes, depth)
    by_kind = {kind: [step.number for step in steps if step.kind == kind]
               for kind in ("arrived", "taken", "dropped")}  # fmt: skip
    waiting = steps[-1].length if steps else 0
    # No message is lost or made, and the first in is the first out.
    assert by_kind["arrived"] == list(range(1, len(arrivals) + 1))
    assert len(arrivals) == len(by_kind["taken"]) + len(by_kind["dropped"]) + waiting
    gone = [step.number for step in steps if step.kind != "arrived"]
    assert gone == list(range(1, len(gone) + 1))
    # The length follows from the steps, and never exceeds the depth.
    length = 0
    for step in steps:
        length += 1 if step.kind == "arrived" else -1
        assert step.length == length
        assert 0 <= length <= depth
    # In the order of time; what is dropped makes room for what arrives.
    assert [step.time_ns for step in steps] == sorted(step.time_ns for step in steps)
    for drop, arrival in pairwise(steps):
        if drop.kind == "dropped":
            assert drop.length == depth - 1
            assert (arrival.kind, arrival.time_ns) == ("arrived", drop.time_ns)
