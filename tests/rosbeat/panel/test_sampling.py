"""From a session to frames."""

import json

import pytest

from rosbeat.panel.sampling import KEPT_LINES, LINES_PER_FRAME, Sampler
from rosbeat.records import Fault, GraphSnapshot, LogRecord


def said(text, level="INFO", time_ns=0):
    return LogRecord(time_ns, level, "sensor", text, "f", 1)


@pytest.fixture
def sampler(made_up):
    made = Sampler(made_up)
    made.look()
    return made


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


def test_a_topic_that_falls_silent_is_told_once_more(made_up, sampler):
    for k in range(10):
        made_up.seconds = k / 20
        made_up.hear(1.0)
        sampler.look()
        sampler.frame(whole=False)
    rates = []
    for k in range(10, 80):
        made_up.seconds = k / 20
        sampler.look()
        topics = sampler.frame(whole=False)["topics"]
        rates += [topic["rate"] for topic in topics.values()]
    assert rates[-1] == 0
    assert rates.count(0) == 1


def test_an_exception_is_in_the_log(made_up, sampler):
    fault = Fault(2_000_000_000, "/room/sensor", "talk", "ZeroDivisionError", "by zero", 3, "1 / 0")
    made_up.failed.append(fault)
    sampler.look()
    (line,) = sampler.frame(whole=False)["log"]
    assert line[:3] == (2.0, "FATAL", "room.sensor")
    assert line[3] == "stopped in talk: ZeroDivisionError: by zero, line 3: 1 / 0"
