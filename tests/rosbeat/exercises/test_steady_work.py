"""The judge of a worker that beats, asked about made-up runs. Needs no ROS."""

import pytest

from rosbeat.exercises.steady_work import judge_work
from rosbeat.records import CallbackRecord, Endpoint, GraphSnapshot, Observation, QoS, Sample

NODE, INT, STRING = "/worker", "std_msgs/msg/Int32", "std_msgs/msg/String"
ORDERS = ((2.5, 7), (4.5, 3), (12.5, 9))
DONE = ((5.5, 7), (8.5, 3), (15.5, 9))
BEATS = tuple(float(at) for at in range(1, 21))
SECOND = 10**9


def outcome(done=DONE, beats=BEATS, heard=True, others=()):
    said = [Sample(round(at * SECOND), "/beat", STRING, NODE, {"data": ""}) for at in beats]
    said += [Sample(round(at * SECOND), "/done", INT, NODE, {"data": one}) for at, one in done]
    calls = [CallbackRecord(5 * SECOND, NODE, "subscription", "take", "/order")] * heard
    ends = [Endpoint(NODE, "/order", INT, "subscription", QoS())]
    ends += [Endpoint(NODE, "/beat", STRING, "publisher", QoS())]
    ends += [Endpoint(NODE, "/done", INT, "publisher", QoS())]
    graph = GraphSnapshot((NODE,), tuple(ends))
    seen = Observation(20 * SECOND, 0, (*said, *others), (), tuple(calls), (), graph, NODE)
    return judge_work("09b", seen, ORDERS)


def test_work_and_beats():
    found = outcome()
    assert found.status == "passed"
    assert "3 orders" in found.evidence
    assert "20 beats" in found.evidence


def test_a_second_more_for_each_is_fine_and_what_others_publish_does_not_count():
    stranger = Sample(SECOND, "/done", INT, "/stranger", {"data": 99})
    found = outcome(((6.0, 7), (10.0, 3), (16.5, 9)), others=(stranger,))
    assert found.status == "passed"


def beats_without(*gone):
    return tuple(at for at in BEATS if at not in gone)


WRONG = {
    "late beats": (DONE, (*beats_without(3.0, 4.0, 5.0), 5.5), "beat-starved", "order 7"),
    "no beat for the second": (DONE, beats_without(6.0, 7.0), "beat-starved", "order 3"),
    "no beat at the end": (DONE, BEATS[:16], "beat-starved", "Between 16 s and 20 s"),
    "no first beat": (DONE, BEATS[1:], "wrong-rate", "Between 0 s and 2 s"),
    "beats twice": (DONE, (*BEATS, 1.5), "wrong-rate", "at 1.5 s already"),
    "another number": (((5.5, 8), *DONE[1:]), BEATS, "wrong-values", "8"),
    "twice done": ((*DONE, (18.0, 9)), BEATS, "done-twice", "Order 9 was reported done 2 times"),
    "forgotten": (DONE[::2], BEATS, "order-lost", "Order 3 came at 4.5 s"),
    "slow, and so not ready": (((8.5, 7), (14.5, 3)), BEATS, "work-too-long", "at 8.5 s"),
    "swapped": (((5.5, 3), (8.5, 7), DONE[2]), BEATS, "order-swapped", "done as 3, 7, 9"),
    "at once": ((DONE[0], (7.5, 3), DONE[2]), BEATS, "work-at-once", "Order 3 was done at 7.5 s"),
    "together": (((7.0, 7), (7.0, 3), DONE[2]), BEATS, "work-too-long", "Order 7"),
    "together, in time": (((6.0, 7), (6.0, 3), DONE[2]), BEATS, "work-at-once", "Order 3"),
    "too short": (((3.0, 7), *DONE[1:]), BEATS, "work-too-short", "at 3 s already"),
}


@pytest.mark.parametrize("case", WRONG)
def test_a_mistake_has_its_name(case):
    done, beats, mistake, evidence = WRONG[case]
    found = outcome(done, tuple(sorted(beats)))
    assert (found.status, found.mistake) == ("failed", mistake), found
    assert evidence in found.evidence
    assert found.hint


def test_what_is_missing_is_told_first():
    assert outcome(heard=False).status == "failed"
    assert outcome(done=()).mistake == "never-published"
    assert "thread" in outcome(done=()).hint
    assert outcome(beats=()).mistake == "never-published"
