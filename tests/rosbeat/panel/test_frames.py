"""From a session to frames: what is drawn of each topic, what is new, and when one is sent."""

import json
import math
from itertools import pairwise

import pytest

from rosbeat.panel.panel import BEAT, BEATS_FOR, LONGEST_WAIT, WINDOW, FlowControl
from rosbeat.panel.sampling import KEPT_LINES, LINES_PER_FRAME, POINTS, Sampler
from rosbeat.records import Fault, GraphSnapshot, LogRecord


def said(text, level="INFO", time_ns=0):
    return LogRecord(time_ns, level, "sensor", text, "f", 1)


@pytest.fixture
def sampler(made_up):
    made = Sampler(made_up)
    made.look()
    return made


@pytest.fixture
def topic(made_up, sampler):
    """Look at the session after each message, and return what a frame says of the topic."""

    def hear(*values, whole=True, period=1 / 20, **about):
        for value in values:
            made_up.hear(value, **about)
            sampler.look()
            made_up.seconds += period
        made_up.seconds -= period
        return sampler.frame(whole)["topics"].get("/temperature")

    return hear


def test_a_whole_frame_has_everything(made_up, sampler):
    made_up.hear(22.5)
    made_up.said.append(said("hello"))
    sampler.look()
    frame = sampler.frame(whole=True)
    assert frame["live"] is True
    assert frame["nodes"] == {"/monitor": "running", "/sensor": "running"}
    assert [box["name"] for box in frame["graph"]["boxes"]] == [
        "/sensor",
        "/temperature",
        "/monitor",
    ]
    assert frame["topics"]["/temperature"]["text"] == "22.5"
    assert frame["log"] == [(0, "INFO", "sensor", "hello")]
    assert json.loads(json.dumps(frame, allow_nan=False))


def test_a_later_frame_has_only_what_is_new(made_up, sampler):
    sampler.frame(whole=True)
    sampler.look()
    assert set(sampler.frame(whole=False)) == {"whole", "time", "topics"}
    made_up.states["/sensor"] = "paused"
    sampler.look()
    frame = sampler.frame(whole=False)
    assert frame["nodes"]["/sensor"] == "paused"
    assert "graph" not in frame
    made_up.snapshot = GraphSnapshot(("/monitor",))
    sampler.look()
    assert len(sampler.frame(whole=False)["graph"]["boxes"]) == 1


def test_the_frame_after_many_that_were_skipped_is_complete(made_up, sampler):
    sampler.frame(whole=True)
    for k in range(400):
        made_up.seconds = k / 20
        made_up.hear(float(k), count=5)
        made_up.said.append(said(str(k), time_ns=k))
        sampler.look()
    frame = sampler.frame(whole=False)
    topic = frame["topics"]["/temperature"]
    assert topic["total"] == topic["from"]["/sensor"] == 2000
    assert [value for _, value in topic["points"]] == list(range(400))
    assert len(frame["log"]) == LINES_PER_FRAME
    assert frame["left_out"] == 400 - LINES_PER_FRAME
    assert frame["log"][-1][3] == "399"


def test_a_frame_stays_small_whatever_comes(made_up, sampler):
    for k in range(5000):
        made_up.hear(k * 1.234567, count=100, topic=f"/topic{k % 10}")
        made_up.said += [said("x" * 60)] * 3
        sampler.look()
    sampler.frame(whole=True)
    for k in range(10):
        made_up.hear(k * 1.234567, count=100, topic=f"/topic{k}")
    sampler.look()
    assert len(json.dumps(sampler.frame(whole=False))) < 5000
    assert len(json.dumps(sampler.frame(whole=True))) < 300_000
    assert len(sampler.frame(whole=True)["log"]) == KEPT_LINES


def test_points_are_sent_once_and_all_of_them_when_asked_for(topic, made_up, sampler):
    assert topic(0.0, 1.0, 2.0, whole=False, period=1)["points"] == [(0, 0), (1, 1), (2, 2)]
    made_up.seconds = 3
    assert topic(3.0, whole=False)["points"] == [(3, 3)]
    assert len(sampler.frame(True)["topics"]["/temperature"]["points"]) == 4


def test_counts_are_those_of_the_session_and_not_of_the_points(topic, made_up, sampler):
    made_up.hear(1.0, count=7)
    made_up.hear(1.0, count=2, node="/other")
    sampler.look()
    news = sampler.frame(False)["topics"]["/temperature"]
    assert (news["total"], news["from"]) == (9, {"/sensor": 7, "/other": 2})
    news = topic(1.0, whole=False)
    assert (news["total"], news["from"]) == (10, {"/sensor": 1})


def test_only_half_a_minute_is_drawn(topic):
    at = [point[0] for point in topic(*[0.0] * 2 * POINTS)["points"]]
    assert 29 < at[-1] - at[0] <= 30.001
    assert at[-1] == pytest.approx(63.95)


def test_a_rate_is_counted_over_two_seconds_and_a_silent_topic_is_told_once_more(made_up, sampler):
    rates = []
    for k in range(160):
        made_up.seconds = k / 20
        if k < 60:
            made_up.hear(0.0, count=5)
        sampler.look()
        rates += [topic["rate"] for topic in sampler.frame(whole=False)["topics"].values()]
    assert rates[55] == 100
    assert rates[-1] == 0
    assert rates[1:].count(0) == 1


@pytest.mark.parametrize(
    ("data", "text", "field", "points"),
    [
        (22.123456789, "22.12", "", [22.123456789]),
        ("Normal", "Normal", "", []),
        (True, "True", "", [1.0]),
        ({}, "{}", "", []),
        ({"header": {"stamp": {"sec": 3}}, "temperature": 4.5}, "4.5", "temperature", [4.5]),
        ({"position": {"x": 1.5}, "y": 2}, "1.5", "position.x", [1.5]),
        ("x" * 500, "x" * 119 + "…", "", []),
        # What has no place on an axis is a gap.
        (math.nan, "nan", "", [None]),
        (math.inf, "inf", "", [None]),
        (-math.inf, "−inf", "", [None]),
    ],
)
def test_any_message_has_words_and_numbers_have_points(topic, data, text, field, points):
    news = topic(data)
    assert (news["text"], news["field"]) == (text, field)
    found = [value for _, value in news["points"]]
    assert found == (points if None in points else pytest.approx(points, rel=1e-4))


def test_an_exception_is_in_the_log(made_up, sampler):
    fault = Fault(2_000_000_000, "/room/sensor", "talk", "ZeroDivisionError", "by zero", 3, "1 / 0")
    made_up.failed.append(fault)
    sampler.look()
    (line,) = sampler.frame(whole=False)["log"]
    assert line[:3] == (2.0, "FATAL", "room.sensor")
    assert line[3] == "stopped in talk: ZeroDivisionError: by zero, line 3: 1 / 0"


# When a frame may be sent.


def sent_within(flow, begin, seconds):
    """Frames that go out when somebody wants to send twenty a second."""
    times = [begin + k / 20 for k in range(round(20 * seconds))]
    return [flow.sent(now) for now in times if flow.may_send(now)]


@pytest.fixture
def flow():
    made = FlowControl()
    assert sent_within(made, 0, 10) == []  # nothing before a browser asks
    made.ask(10)
    return made


def test_a_browser_that_answers_gets_every_frame(flow):
    for k in range(200):
        assert flow.may_send(k / 20)
        number = flow.sent(k / 20)
        assert number == k + 1
        if number % 3 == 0:
            flow.heard(number, k / 20)
    assert not flow.asked


def test_a_browser_that_sleeps_for_an_hour_gets_hardly_any(flow):
    assert WINDOW + 5 < len(sent_within(flow, 0, 3600)) < 3600 / LONGEST_WAIT + 20


def test_silence_is_never_longer_than_a_beat_until_nobody_seems_to_be_there(flow):
    times = [10 + k / 20 for k in range(1, round(20 * BEATS_FOR))]
    came = [now for now in times if signs_of_life(flow, now)]
    assert max(b - a for a, b in pairwise(came)) <= BEAT + 0.1
    later = [now for now in range(700, 720) if flow.beats(now)]
    assert later == []
    flow.heard(flow.number, 720)
    assert flow.beats(722)
    assert not flow.beats(722.5)


def signs_of_life(flow, now):
    return flow.sent(now) if flow.may_send(now) else flow.beats(now)


def test_when_it_wakes_up_all_is_as_before(flow):
    last = sent_within(flow, 0, 600)[-1]
    flow.heard(last, 600)
    assert len(sent_within(flow, 600, 0.3)) == WINDOW
    assert not flow.may_send(600.4)
    assert flow.may_send(601)


def test_a_new_view_begins_anew_although_the_old_one_never_answered(flow):
    sent_within(flow, 0, 100)
    flow.ask(100)
    assert flow.asked
    assert len(sent_within(flow, 100, 0.3)) == WINDOW


def test_answers_from_elsewhere_change_nothing(flow):
    sent_within(flow, 0, 0.4)
    for number in (-3, 99):
        flow.heard(number, 0.4)
    assert not flow.may_send(0.5)
