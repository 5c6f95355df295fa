"""Page 11: each misunderstanding shows in the recordings and gets its name."""

import json
import math

import pytest
from rclpy.node import Node

from rosbeat.exercises import page_11 as page
from rosbeat.exercises.evidence import from_json, to_json
from rosbeat.exercises.scenarios import Report
from rosbeat.records import CallbackRecord, Endpoint, GraphSnapshot, Observation, QoS, Sample

LOOK, SICK, TEST = page.EXERCISES
#: What is played on the page.
(RECORDINGS,) = SICK.inputs()


def judged(model, change=lambda observation: observation, seed=0):
    """What is said of a node that says what a model says on the page, judged with a seed."""
    runs = []
    for recording in RECORDINGS:
        heard = recording.heard
        said = [Sample(at, "/fault", "std_msgs/msg/String", "/node", {"data": word})
                for at, words in model(heard).items() for word in words]  # fmt: skip
        calls = [CallbackRecord(o.time_ns, "/node", "subscription", "f", o.topic) for o in heard]
        ends = (Endpoint("/node", "/temperature", "std_msgs/msg/Float32", "subscription", QoS()),
                Endpoint("/node", "/fault", "std_msgs/msg/String", "publisher", QoS()))  # fmt: skip
        samples = tuple(sorted([*heard, *said], key=lambda one: one.time_ns))
        graph = GraphSnapshot(("/node",), ends)
        seen = Observation(10**11, 0, samples, (), tuple(calls), (), graph, "/node")
        runs.append(page.Replayed(recording.words, change(seen)))
    return SICK.judged(page.Replays(tuple(runs)), seed)


def test_what_no_suspect_reproduces_gets_a_plain_name():
    right, word = page.watch_one, page.WORDS[0]

    def late(heard):
        return {at + 10**8: words for at, words in right(heard).items()}

    def twice(heard):
        return {at: words * 2 for at, words in right(heard).items()}

    def always(heard):
        return {one.time_ns: (word,) for one in heard}

    def loud(heard):
        return {at: (f"{words[0].upper()}",) for at, words in right(heard).items()}

    assert judged(right).status == "passed"
    assert judged(late).mistake == "alert-missing"
    assert judged(always).mistake == "alert-too-many"
    assert judged(lambda heard: {}).mistake == "never-published"
    assert judged(lambda heard: right(heard) | {1: (word,)}).mistake == "alert-too-many"
    found = judged(twice)
    assert (found.mistake, f"{word!r} and {word!r}" in found.evidence) == ("alert-too-many", True)
    found = judged(loud)
    assert (found.mistake, "Capitals" in found.hint) == ("wrong-word", True)


@pytest.mark.ros
@pytest.mark.parametrize("seed", [0, 1, 2])
def test_a_node_hears_what_the_judge_says_that_it_hears(seed):
    (recordings,) = SICK.inputs(seed)
    runs = SICK.observed(lambda: Node("idle"), seed).runs
    for run, recording in zip(runs, recordings, strict=True):
        samples = [one for one in run.observation.samples if one.node == "/replay"]
        assert repr(samples) == repr([*recording.heard])  # NaN is not equal to itself


def test_what_is_right_on_the_page_is_wrong_with_other_recordings():
    assert judged(page.watch_one, seed=1).status == "failed"


def test_evidence_can_be_written_down_though_nan_is_in_it():
    runs = [page.Replayed("x", Observation(1, 0, one.heard)) for one in RECORDINGS]
    text = to_json(page.Replays(tuple(runs)))
    assert to_json(from_json(text)) == text


# 11a.


def reported(*results):
    reports = tuple(Report(json.dumps(one), "", type(one).__name__) for one in results)
    return LOOK.judged(page.BagReports(reports))


(READINGS,) = LOOK.inputs()


@pytest.mark.parametrize(
    ("result", "mistake"),
    [
        ([1, 2, 3], "no-dict"),
        ({"Messages": 1, "gap": 1, "mean": 2}, "key-missing"),
        ({}, "key-missing"),
        ({"messages": "1", "gap": 1, "mean": 1}, "no-number"),
        ({"messages": True, "gap": 1, "mean": 1}, "no-number"),
        ({"messages": None, "gap": 1, "mean": 1}, "no-number"),
        ({"messages": 5, "gap": 4.5, "mean": 22.15}, "fixed-answer"),
        ({"messages": math.nan, "gap": 4.5, "mean": 22.15}, "wrong-values"),
    ],
)
def test_other_results(result, mistake):
    assert reported(*[result] * len(READINGS)).mistake == mistake
