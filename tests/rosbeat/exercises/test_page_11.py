"""The judges of page 11, asked about made-up runs. Needs no ROS."""

import json
import math
from dataclasses import replace

import pytest
from rosbeat.exercises.evidence import from_json, to_json
from rosbeat.exercises.scenarios import Report

from rosbeat.bags import inject
from rosbeat.exercises import bag_reports, page_11, sick_sensor, two_sensors
from rosbeat.exercises.bag_report_runs import RECORDINGS, BagReports
from rosbeat.exercises.bag_reports import judge_bag_reports
from rosbeat.exercises.page_11_scenarios import SICK as SICK_RECORDINGS
from rosbeat.exercises.page_11_scenarios import TWO as TWO_RECORDINGS
from rosbeat.exercises.replays import PLAYER, STRING, Replayed, Replays, seen_in
from rosbeat.records import CallbackRecord, Endpoint, Fault, GraphSnapshot, Observation, QoS, Sample

SICK = (page_11.EXERCISES[1], SICK_RECORDINGS, sick_sensor.TASK)
TWO = (page_11.EXERCISES[2], TWO_RECORDINGS, two_sensors.TASK)
BOTH = pytest.mark.parametrize("case", [SICK, TWO], ids=["11b", "11c"])


def played(recording):
    """What a node hears of a recording."""
    samples = inject(seen_in(recording.samples), *recording.faults)
    return tuple(replace(one, node=PLAYER) for one in samples)


def said(at, word, kind=STRING):
    return Sample(at, "/fault", kind, "/watch", {"data": word})


def run(recording, task, model, topic="/fault", extra=()):
    """What a node does with a recording that says what a model says."""
    heard = played(recording)
    words = [replace(said(at, word), topic=topic) for at, word in model(heard).items()]
    calls = tuple(CallbackRecord(o.time_ns, "/watch", "subscription", "f", o.topic) for o in heard)
    ends = [Endpoint("/watch", topic, STRING, "publisher", QoS())]
    ends += [
        Endpoint("/watch", wire.topic, wire.type_name, "subscription", QoS()) for wire in task.wires
    ]
    samples = sorted([*heard, *words, *extra], key=lambda one: one.time_ns)
    length = max(one.time_ns for one in samples) + 1
    graph = GraphSnapshot(("/watch",), tuple(ends))
    seen = Observation(length, 0, tuple(samples), (), calls, (), graph, "/watch")
    return Replayed(recording.words, seen)


def judged(case, model, **options):
    exercise, recordings, task = case
    return exercise.judge(Replays(tuple(run(one, task, model, **options) for one in recordings)))


@BOTH
def test_what_is_asked_for_passes(case):
    found = judged(case, case[2].model)
    assert (found.status, found.mistake) == ("passed", "")
    assert str(len(case[1])) in found.evidence


SUSPECTS = [
    pytest.param(case, suspect, id=f"{case[0].id} {suspect.mistake} {number}")
    for case in (SICK, TWO)
    for number, suspect in enumerate(case[2].suspects)
]


@pytest.mark.parametrize(("case", "suspect"), SUSPECTS)
def test_each_misunderstanding_shows_in_the_recordings_and_gets_its_name(case, suspect):
    found = judged(case, suspect.model)
    assert found.status == "failed"
    silent = not any(suspect.model(played(one)) for one in case[1])
    assert found.mistake == ("never-published" if silent else suspect.mistake)
    assert found.evidence
    assert found.hint


@BOTH
def test_what_nobody_would_think_of_gets_a_plain_name(case):
    right, first = case[2].model, case[2].words[0]

    def late(heard):
        return {at + 10**8: word for at, word in right(heard).items()}

    def other(heard):
        return dict.fromkeys([*right(heard)][1:], first)

    assert judged(case, late).mistake == "alert-missing"
    assert judged(case, other).mistake in ("alert-missing", "wrong-word")
    assert judged(case, lambda heard: {one.time_ns: first for one in heard}).mistake in (
        "alert-too-many",
        "wrong-window",
    )
    assert judged(case, lambda heard: {}).mistake == "never-published"


@BOTH
def test_a_word_twice_or_at_no_reading_is_too_many(case):
    word = case[2].words[0]
    assert judged(case, case[2].model, extra=[said(1, word)]).mistake == "alert-too-many"
    first = next(iter(case[2].model(played(case[1][3]))))
    exercise, recordings, task = case
    twice = [
        run(one, task, task.model, extra=[said(first, task.model(played(one))[first])])
        if one is recordings[3] else run(one, task, task.model)
        for one in recordings
    ]  # fmt: skip
    found = exercise.judge(Replays(tuple(twice)))
    assert found.mistake == "alert-too-many"
    assert "2 times" in found.evidence


@BOTH
def test_other_words_types_and_topics(case):
    model = case[2].model
    assert judged(case, model, extra=[said(1, "help")]).mistake == "wrong-word"
    assert judged(case, model, extra=[said(0, "x", "std_msgs/msg/Float32")]).mistake == (
        "type-mismatch"
    )
    assert judged(case, model, topic="/faults").mistake == "topic-misspelled"
    loud = judged(case, lambda heard: {at: f" {w.upper()}\n" for at, w in model(heard).items()})
    assert loud.status == "passed"


def test_one_of_two_sensors_is_not_heard():
    exercise, recordings, task = TWO
    one = run(recordings[0], task, task.model)
    seen = one.observation
    ends = tuple(end for end in seen.graph.endpoints if end.name != "/reference")
    calls = tuple(call for call in seen.callbacks if call.source != "/reference")
    half = replace(seen, callbacks=calls, graph=replace(seen.graph, endpoints=ends))
    found = exercise.judge(Replays((replace(one, observation=half),)))
    assert found.mistake == "no-subscription"
    assert "/reference passes it by" in found.evidence


def test_none_before_the_first_reading_gets_its_name():
    exercise, recordings, task = SICK
    one = run(recordings[0], task, lambda heard: {})
    text = "unsupported operand type(s) for -: 'float' and 'NoneType'"
    fault = Fault(10**9, "/watch", "listen", "TypeError", text, 17, "abs(msg.data - self.last)")
    seen = replace(one, observation=replace(one.observation, faults=(fault,)))
    found = exercise.judge(Replays((seen,)))
    assert (found.status, found.mistake) == ("failed", "none-used")
    assert "line 17" in found.evidence


@BOTH
def test_evidence_can_be_written_down(case):
    exercise, recordings, task = case
    seen = Replays(tuple(run(one, task, task.model) for one in recordings))
    text = to_json(seen)
    assert to_json(from_json(text)) == text  # NaN is in it, which is not equal to itself
    assert exercise.judge(from_json(text)) == exercise.judge(seen)


# 11a.


def numbers(readings):
    return {key: bag_reports.ASKED[key](readings) for key in bag_reports.KEYS}


def reported(*results):
    reports = tuple(Report(json.dumps(one), "", type(one).__name__) for one in results)
    return judge_bag_reports("11a", BagReports(reports))


def test_the_right_numbers_pass_rounded_or_not():
    right = [numbers(one) for one in RECORDINGS]
    assert reported(*right).status == "passed"
    assert reported(*({k: round(v, 2) for k, v in one.items()} for one in right)).status == "passed"
    assert from_json(to_json(BagReports((Report("1"),)))).reports[0].value == 1


OTHERS = [
    pytest.param(key, mistake, way, id=f"{key} {mistake} {number}")
    for key, ways in bag_reports.OTHERS.items()
    for number, (mistake, _, way) in enumerate(ways)
]


@pytest.mark.parametrize(("key", "mistake", "way"), OTHERS)
def test_each_other_number_gets_its_name(key, mistake, way):
    found = reported(*({**numbers(one), key: way(one)} for one in RECORDINGS))
    assert (found.status, found.mistake) == ("failed", mistake)


@pytest.mark.parametrize(
    ("result", "mistake"),
    [
        ([1, 2, 3], "no-dict"),
        ({"messages": 1, "mean": 2}, "key-missing"),
        ({}, "key-missing"),
        ({"messages": "1", "gap": 1, "mean": 1}, "no-number"),
        ({"messages": True, "gap": 1, "mean": 1}, "no-number"),
        ({"messages": None, "gap": 1, "mean": 1}, "no-number"),
        ({"messages": 5, "gap": 4.5, "mean": 22.15}, "fixed-answer"),
        ({"messages": math.nan, "gap": 4.5, "mean": 22.15}, "wrong-values"),
    ],
)
def test_other_results(result, mistake):
    assert reported(*[result] * len(RECORDINGS)).mistake == mistake


def test_no_result_at_all():
    problem = judge_bag_reports("11a", BagReports((Report("", "", "NoneType"),)))
    assert problem.mistake == "returns-nothing"
    for kind, (mistake, hint) in bag_reports._RAISED.items():
        found = judge_bag_reports("11a", BagReports((Report("", f"{kind}: Oh.\nMore."),)))
        assert (found.mistake, found.hint) == (mistake, hint)
        assert found.evidence == f"The function raised {kind}: Oh."
    blank = Report("", "NameError: name '____' is not defined")
    assert judge_bag_reports("11a", BagReports((blank,))).status == "not attempted"
