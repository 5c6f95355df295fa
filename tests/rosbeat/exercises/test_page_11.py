"""Page 11: what is played is what the judge says is heard, and results that are no numbers."""

import json
import math

import pytest
from rclpy.node import Node

from rosbeat.exercises import page_11 as page
from rosbeat.exercises.evidence import from_json, to_json
from rosbeat.exercises.scenarios import Report
from rosbeat.records import Observation

LOOK, SICK, _ = page.EXERCISES
#: What is played on the page.
(RECORDINGS,) = SICK.inputs()


@pytest.mark.ros
@pytest.mark.parametrize("seed", [0, 1, 2])
def test_a_node_hears_what_the_judge_says_that_it_hears(seed):
    (recordings,) = SICK.inputs(seed)
    runs = SICK.observed(lambda: Node("idle"), seed).runs
    for run, recording in zip(runs, recordings, strict=True):
        samples = [one for one in run.observation.samples if one.node == "/replay"]
        assert repr(samples) == repr([*recording.heard])  # NaN is not equal to itself


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
