"""Many records at once."""

from dataclasses import FrozenInstanceError

import pytest

from rosbeat.record_columns import records_of
from rosbeat.records import CallbackRecord, Sample


def test_they_are_those_that_the_constructor_makes():
    columns = ([0, 5], ["/a", "/b"], ["std_msgs/msg/Bool"] * 2, ["/n", "/m"], [{"data": True}, {}])
    made = list(records_of(Sample, *columns))
    assert made == [Sample(*row) for row in zip(*columns, strict=True)]
    assert (made[1].time, made[0].value, repr(made[0])) == (5e-9, True, repr(Sample(
        0, "/a", "std_msgs/msg/Bool", "/n", {"data": True})))  # fmt: skip


def test_they_cannot_be_changed():
    (made,) = records_of(CallbackRecord, [1], ["/n"], ["timer"], ["tick"], ["1 s"])
    assert hash(made) == hash(CallbackRecord(1, "/n", "timer", "tick", "1 s"))
    with pytest.raises(FrozenInstanceError):
        made.node = "/m"


def test_none_are_none():
    assert list(records_of(CallbackRecord, [], [], [], [], [])) == []


def test_a_column_too_few_is_an_error():
    with pytest.raises(ValueError, match="shorter"):
        records_of(CallbackRecord, [1], ["/n"])
