"""Records as JSON: every record comes back, and anything else is refused."""

import collections.abc
import json
import subprocess
import sys
from dataclasses import asdict, fields
from math import inf, nan
from pathlib import Path
from types import NoneType, UnionType
from typing import Annotated, Any, Union, get_args, get_origin, get_type_hints

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rosbeat.errors import RecordError
from rosbeat.exercises import evidence
from rosbeat.exercises.greenhouse import Rubric
from rosbeat.exercises.progress import Standing
from rosbeat.grading.marks import Gradebook
from rosbeat.page_runs.jobs import PageEvidence, PageJob
from rosbeat.page_runs.traces import Trace
from rosbeat.records import (
    Observation,
    Outcome,
    Part,
    Sample,
)
from rosbeat.records_json import as_data, from_json, read_head, to_json

KINDS = [
    *evidence.KINDS.values(),
    Outcome,
    PageJob,
    PageEvidence,
    Gradebook,
    Trace,
    Standing,
    Rubric,
]
#: What a message may hold, and what a learner's text may: NaN, and half of a surrogate pair.
TEXTS = st.text(st.characters(), max_size=4)
NUMBERS = st.integers(0) | st.integers(-(2**70), 2**70)
VALUES = st.recursive(
    st.booleans() | NUMBERS | st.floats() | TEXTS,
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(TEXTS, inner, max_size=3),
    max_leaves=6,
)
PLAIN = {
    Any: VALUES, str: TEXTS, int: NUMBERS, float: st.floats(), bool: st.booleans(),
    NoneType: st.none(), Path: st.sampled_from([Path("a"), Path("/b/c.txt")]),
}  # fmt: skip


def values_of(kind):
    """Values of a type as the fields of records have it."""
    origin, inner = get_origin(kind), get_args(kind)
    if kind in PLAIN:
        return PLAIN[kind]
    if origin is Annotated:  # numbers from 0 up
        return st.integers(0)
    if origin in (Union, UnionType):
        return st.one_of([values_of(one) for one in inner])
    if origin is tuple and inner[-1] is ...:
        return st.lists(values_of(inner[0]), max_size=2).map(tuple)
    if origin is tuple:
        return st.tuples(*map(values_of, inner))
    if origin in (dict, collections.abc.Mapping):
        return st.dictionaries(values_of(inner[0]), values_of(inner[1]), max_size=2)
    hints = get_type_hints(kind, include_extras=True)
    return st.builds(kind, **{one.name: values_of(hints[one.name]) for one in fields(kind)})


@pytest.mark.parametrize("kind", KINDS, ids=lambda kind: kind.__name__)
@settings(max_examples=20, deadline=None)
@given(data=st.data())
def test_what_is_written_is_read(kind, data):
    value = data.draw(values_of(kind))
    text = to_json(value)
    again = from_json(kind, text, "it")
    assert repr(again) == repr(value)  # NaN is not equal to itself
    assert to_json(again) == text
    text.encode()


@pytest.mark.parametrize("value", [1, 1.0, True, -0.0, 2**70, 1e16, nan, inf, "\ud800", "é\x00"])
def test_what_a_message_holds_keeps_its_type(value):
    sample = Sample(1, "/t", "std_msgs/msg/Float32", "/n", {"data": value, "deep": [{"x": value}]})
    again = from_json(Sample, to_json(sample), "it")
    assert repr(again) == repr(sample)


def test_a_number_or_text_of_a_class_of_its_own_is_written_as_what_it_is():
    class Name(str):
        __slots__ = ()

    assert as_data({"a": Name("x"), "b": Path("a/b")}) == {"a": "x", "b": "a/b"}
    with pytest.raises(TypeError):
        to_json({"a": object()})


# Anything else.

HEAD = {"format": "a test", "version": 1}
ONE = Observation(5, 7, (Sample(1, "/t", "std_msgs/msg/Float32", "/n", {"data": 1.5}),))


def changed(**changes):
    document = json.loads(to_json(ONE))
    document.update(changes)
    return json.dumps(document)


def with_sample(**changes):
    document = json.loads(to_json(ONE))
    document["samples"][0].update(changes)
    return json.dumps(document)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        *((text, "not JSON") for text in ("", "{", f"{to_json(ONE)}]", b"\xff", "x", 5, None)),
        ('{"a":' * 100_000, "not JSON"),
        *((text, "at `it`") for text in ("[]", "null", "5", "{}", "[" * 100_000)),
        (changed(time_ns=1.0), "it.time_ns"),
        (changed(time_ns=True), "it.time_ns"),
        (changed(seed="7"), "it.seed"),
        (changed(samples={}), "it.samples"),
        (changed(samples=[5]), "it.samples[0]"),
        (changed(graph=None), "it.graph"),
        (changed(waits=[{"time_ns": 1}]), "it.waits[0]"),
        (with_sample(data=5), "it.samples[0].data"),
        (with_sample(topic=None), "it.samples[0].topic"),
        (with_sample(topic=nan), "it.samples[0].topic"),
        (to_json(ONE).replace("1.5", "1e999"), "it"),
        (to_json(ONE).replace('"seed":7,', ""), "`seed`"),
    ],
    ids=range(25),
)  # fmt: skip
def test_anything_else_is_refused_with_its_place(text, said, says):
    with pytest.raises(RecordError) as caught:
        from_json(Observation, text, "it")
    says(caught.value, said)


def test_what_a_later_version_has_added_is_passed_over():
    assert from_json(Observation, changed(added=[1]), "it") == ONE
    assert from_json(Observation, with_sample(added=nan), "it") == ONE


@pytest.mark.parametrize(
    ("head", "said"),
    [
        ({"format": "other"}, '"format" should be "a test"'),
        ({"version": 2}, "of version 2"),
        ({"version": True}, "it.version"),
        ({"version": None}, "it.version"),
    ],
)
def test_another_format_or_version_is_refused(head, said, says):
    assert read_head(to_json(ONE, HEAD), "it", "a test", 1).kind == ""
    with pytest.raises(RecordError) as caught:
        read_head(to_json(ONE, {**HEAD, **head}), "it", "a test", 1)
    says(caught.value, said)


@pytest.mark.parametrize("text", ["t", "é", "\ud800"])
def test_indented_json_is_that_of_python(text):
    said = Part("R1", text, True)
    assert to_json({"parts": [said]}, indent=1) == json.dumps({"parts": [asdict(said)]}, indent=1)


RACE = """
import sys, threading
from rosbeat.records import Observation
from rosbeat.records_json import from_json, to_json
sys.setswitchinterval(1e-6)
text, together = to_json(Observation(0, 0)), threading.Barrier(4)

def read():
    together.wait()
    from_json(Observation, text, "it")

threads = [threading.Thread(target=read) for _ in range(4)]
for one in threads:
    one.start()
for one in threads:
    one.join()
"""


def test_threads_may_read_a_class_for_the_first_time_at_once():
    subprocess.run([sys.executable, "-c", RACE], check=True)
