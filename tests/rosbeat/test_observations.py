"""Observations as text."""

import json
import math
from dataclasses import replace

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rosbeat.errors import RecordError
from rosbeat.observations import FORMAT, VERSION, digest, from_json, to_json
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
    WaitRecord,
)

TIMES = st.integers(0, 2**63)
TEXTS = st.text(max_size=8)
FLOATS = st.floats(allow_nan=False)
NAMES = st.from_regex(r"[a-z][a-z0-9_]{0,6}", fullmatch=True)
VALUES = st.recursive(
    st.booleans() | st.integers() | FLOATS | TEXTS,
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(NAMES, inner, max_size=3),
    max_leaves=6,
)


def several(record, *fields):
    return st.lists(st.builds(record, *fields), max_size=3).map(tuple)


GRAPHS = st.builds(
    GraphSnapshot,
    st.lists(TEXTS, max_size=2).map(tuple),
    several(Endpoint, TEXTS, TEXTS, TEXTS, TEXTS, st.builds(QoS), st.integers(-1, 9)),
    several(TimerRecord, TEXTS, TEXTS, TIMES, st.integers(0, 9)),
    st.lists(st.lists(TEXTS, max_size=3).map(tuple), max_size=2).map(tuple),
)
OBSERVATIONS = st.builds(
    Observation,
    TIMES,
    st.integers(0, 2**63),
    several(Sample, TIMES, TEXTS, TEXTS, TEXTS, st.dictionaries(NAMES, VALUES, max_size=3)),
    several(LogRecord, TIMES, TEXTS, TEXTS, TEXTS, TEXTS, st.integers(0, 999)),
    several(CallbackRecord, TIMES, TEXTS, TEXTS, TEXTS, TEXTS),
    several(Fault, TIMES, TEXTS, TEXTS, TEXTS, TEXTS, st.integers(0, 999), TEXTS),
    GRAPHS,
    waits=several(WaitRecord, TIMES, TIMES, TEXTS, TEXTS, TEXTS),
)
ONE = Observation(5, 7, (Sample(1, "/t", "std_msgs/msg/Float32", "/n", {"data": 1.5}),))


@settings(max_examples=60, deadline=None)
@given(OBSERVATIONS)
def test_what_is_written_is_read(observation):
    text = to_json(observation)
    again = from_json(text)
    assert again == observation
    assert to_json(again) == text
    assert digest(again) == digest(observation)


@pytest.mark.parametrize("value", [math.nan, math.inf, -math.inf])
def test_odd_floats(value):
    sample = replace(ONE.samples[0], data={"data": value, "deep": [{"x": [value, 1.0]}]})
    text = to_json(replace(ONE, samples=(sample,)))
    json.loads(text, parse_constant=pytest.fail)
    assert repr(from_json(text).samples) == repr((sample,))


def test_integers_and_floats_stay_apart():
    for value in (1, 1.0, True, -0.0):
        sample = replace(ONE.samples[0], data={"data": value})
        again = from_json(to_json(replace(ONE, samples=(sample,)))).samples[0].value
        assert repr(again) == repr(value)


def test_digest_does_not_depend_on_the_order_of_fields():
    one = replace(ONE, samples=(replace(ONE.samples[0], data={"a": 1, "b": 2}),))
    two = replace(ONE, samples=(replace(ONE.samples[0], data={"b": 2, "a": 1}),))
    assert one == two
    assert digest(one) == digest(two) != digest(ONE)


def changed(**changes):
    document = json.loads(to_json(ONE))
    document.update(changes)
    return json.dumps(document)


def with_sample(**changes):
    document = json.loads(to_json(ONE))
    document["samples"][0].update(changes)
    return json.dumps(document)


@pytest.mark.parametrize(
    "text",
    [
        "", "{", "[]", "null", "5", "{}", '{"format": "other"}', 5, None, b"\xff", "[" * 100_000,
        changed(version=VERSION + 1), changed(version=True), changed(version="1"),
        changed(format="x"), changed(extra=1), changed(time_ns=1.0), changed(time_ns=True),
        changed(time_ns=-1), changed(seed="7"), changed(samples={}), changed(samples=[5]),
        changed(graph=None), changed(graph={}), changed(logs=None),
        with_sample(data=5), with_sample(data={"x": None}), with_sample(topic=None),
        with_sample(data={"x": {"$float": "big"}}), with_sample(data={"x": {"$float": 5}}),
        with_sample(data={"x": {"$float": "nan", "y": 1}}), with_sample(more=1),
        to_json(ONE).replace("1.5", "NaN"), to_json(ONE).replace("1.5", "1e999"),
        to_json(ONE).replace('"seed":7', '"seed":7,"seed":8'),
        to_json(ONE).replace('"seed":7,', ""),
    ],
    ids=range(36),
)  # fmt: skip
def test_anything_else_is_refused(text):
    with pytest.raises(RecordError) as caught:
        from_json(text)
    assert caught.value.what
    assert caught.value.means
    assert caught.value.to_try


def test_the_format_is_named():
    document = json.loads(to_json(ONE))
    assert (document["format"], document["version"]) == (FORMAT, VERSION)


def test_waits_and_processes_are_omitted_while_they_are_empty():
    document = json.loads(to_json(ONE))
    assert "waits" not in document
    assert "processes" not in document["graph"]
    # The digest from before the two fields were added.
    assert digest(ONE) == "b2c4b6795fbd7f6584b13191b862d47cdb3b59072ee24b4cbce3cba993c01609"


def test_waits_and_processes_are_written_and_read():
    graph = GraphSnapshot(("/a", "/b"), processes=(("/a", "/b"),))
    seen = replace(ONE, graph=graph, waits=(WaitRecord(1, 3, "/a", "read", "sleep"),))
    assert from_json(to_json(seen)) == seen
    assert digest(seen) != digest(ONE)


@pytest.mark.parametrize("waits", [None, {}, [5], [{"time_ns": 1}]])
def test_wrong_waits_are_refused(waits):
    with pytest.raises(RecordError):
        from_json(changed(waits=waits))
