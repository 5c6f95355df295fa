from dataclasses import replace

from rosbeat.records import NANOSECONDS, Fault, LogRecord, Observation
from rosbeat.viz.happenings import happenings
from rosbeat.viz.lane_words import describe, left_out


def said(seen):
    return describe(happenings(seen, ("/temperature",), None))


def test_who_did_what(make):
    log = LogRecord(NANOSECONDS, "INFO", "sensor", "hello", "f", 1)
    assert said(make.pair(2, logs=(log,))) == (
        "A timeline from 0 s to 2 s with 2 nodes. /sensor: 2 timer callbacks and 1 log line. "
        "/monitor: 2 subscription callbacks. 2 messages on /temperature from /sensor make a "
        "callback of /monitor run at the same instant."
    )


def test_messages_that_reach_nobody(make):
    seen = Observation(NANOSECONDS, 7, (make.sample(1, 1.0),))
    assert "/sensor: nothing happens." in said(seen)
    assert "1 message on /temperature from /sensor reaches nobody." in said(seen)


def test_several_readers(make):
    calls = (make.heard(1), make.heard(1, "/other"))
    seen = Observation(NANOSECONDS, 7, (make.sample(1, 1.0),), callbacks=calls)
    assert "makes callbacks of /monitor and /other run" in said(seen)


def test_a_fault(make):
    fault = Fault(NANOSECONDS, "/sensor", "publish", "ValueError", "", 1, "")
    seen = Observation(NANOSECONDS, 7, (make.sample(1, 1.0),), faults=(fault,))
    assert "At 1 s, ValueError in publish ended /sensor." in said(seen)


def test_what_is_left_out(make):
    assert said(make.pair(30)).endswith("30 later messages and callbacks are not shown.")
    assert left_out(happenings(make.pair(3), ("/temperature",), None)) == ""


def test_events_and_messages_that_were_too_old(make):
    rare = tuple(
        replace(make.heard(2), kind=kind) for kind in ("event", "event", "expired", "expired")
    )
    seen = Observation(2 * NANOSECONDS, 7, (make.sample(1, 1.0),), callbacks=rare)
    assert "/monitor: 2 event callbacks and 2 messages too old." in said(seen)
    assert "reaches nobody" in said(seen)
