"""Nodes that do not do their part."""

from dataclasses import replace

import pytest
from scenes import (
    TOPIC,
    elsewhere,
    ended,
    heard,
    pub,
    scene,
    silent,
    spoke,
    sub,
    timer,
    well,
)

from rosbeat.diagnosis.explanation import explain
from rosbeat.diagnosis.mistakes import UNKNOWN
from rosbeat.diagnosis.situation import Condition


def causes(told):
    return [one.mistake for one in explain(TOPIC, told).diagnoses]


def first(told):
    found = explain(TOPIC, told)
    return found.diagnoses[0], found.headlines[0], found.marks


def test_a_node_that_has_ended_and_why():
    diagnosis, headline, marks = first(silent(ended()))
    assert causes(silent(ended())) == ["node-ended"]
    assert headline == "/sensor has ended"
    assert "At 3 s publish raised ZeroDivisionError: division by zero." in diagnosis.evidence
    assert "Line 5: `1 / 0`" in diagnosis.evidence
    assert [(mark.kind, mark.subject) for mark in marks] == [("node", "/sensor")]


def test_a_node_that_ended_itself():
    diagnosis, _, _ = first(silent(Condition("/sensor", "ended")))
    assert "rclpy.shutdown()" in diagnosis.evidence


@pytest.mark.parametrize(
    ("state", "mistake", "words"),
    [
        ("paused", "not-spun", 'ros.resume("sensor")'),
        ("not added", "not-spun", "ros.add(...)"),
        ("no answer", "not-spun", "rclpy.spin(node)"),
        ("blocked", "callback-blocks", "no `time.sleep`"),
    ],
)
def test_a_node_that_nobody_runs(state, mistake, words):
    told = silent(Condition("/sensor", state, callback="publish"))
    diagnosis, headline, (mark,) = first(told)
    assert causes(told) == [mistake]
    assert "/sensor" in headline
    assert words in diagnosis.hint
    assert mark.kind == "node"


def test_who_blocks_need_not_be_on_the_topic():
    told = silent(Condition("/busy", "blocked", callback="work"))
    told = replace(told, own=told.own | {"/busy"}, virtual=False)
    assert causes(told) == ["callback-blocks"]
    assert "no other node of the session" in first(told)[0].evidence


def test_who_publishes_in_a_loop_of_its_own_need_not_answer():
    told = elsewhere(well(conditions=(Condition("/sensor", "no answer"),)))
    assert explain(TOPIC, told).is_well
    deaf = elsewhere(well(conditions=(Condition("/monitor", "no answer"),)))
    assert causes(deaf) == ["not-spun"]


def test_a_node_elsewhere_is_not_on_the_topic():
    assert explain(TOPIC, well(conditions=(ended("/other"),))).is_well


def test_no_time_has_passed():
    beats = (spoke(number=0, watched=0), heard(number=0, since=0))
    told = scene(pub(), sub(), beats=beats, now_ns=0)
    diagnosis, headline, _ = first(told)
    assert causes(told) == ["not-spun"]
    assert "no time has passed" in headline
    assert "ros.run" in diagnosis.hint
    assert causes(replace(told, virtual=False)) == ["never-published"]


def test_what_was_published_waits_for_the_next_run():
    beats = (spoke(number=1, last=0, rate=0.0, watched=0), heard(number=0, since=1))
    told = scene(pub(), sub(), beats=beats, now_ns=0, waiting=True)
    assert causes(told) == ["not-spun"]


def test_a_publisher_without_a_timer():
    diagnosis, headline, _ = first(silent())
    assert causes(silent()) == ["never-published"]
    assert headline == "/sensor has not published anything"
    assert "It has no timer" in diagnosis.evidence


@pytest.mark.parametrize(
    ("clock", "evidence", "hint"),
    [
        (timer(calls=10), "publish_temperature ran 10 times", "as far as `publish`"),
        (timer(period=60.0), "a period of 60 s and has not fired", "longer than 60 s"),
        (timer(), "a period of 1 s and has not fired", "cancels"),
    ],
)
def test_a_publisher_with_a_timer(clock, evidence, hint):
    diagnosis, _, _ = first(silent(timers=(clock,)))
    assert evidence in diagnosis.evidence
    assert hint in diagnosis.hint


def test_a_silent_publisher_of_another_process():
    diagnosis, _, _ = first(elsewhere(silent()))
    assert diagnosis.mistake == "never-published"
    assert "in 10 s no message came" in diagnosis.evidence
    assert "--seconds 30" in diagnosis.hint


def test_a_publisher_that_has_stopped():
    beats = (spoke(number=4, last=4.0), heard(number=4, last=4.0))
    diagnosis, headline, _ = first(scene(pub(), sub(), beats=beats))
    assert diagnosis.mistake == "gone-quiet"
    assert headline == "/sensor has stopped publishing"
    assert "4 messages, the last at 4 s, and nothing in the 6 s since" in diagnosis.evidence
    slow = (spoke(number=2, last=6.0, rate=0.25), heard(number=2))
    assert explain(TOPIC, scene(pub(), sub(), beats=slow)).is_well
    once = (spoke(number=1, last=1.0, rate=0.0), heard(number=1))
    assert explain(TOPIC, scene(pub(), sub(), beats=once)).is_well


def test_two_nodes_of_one_name():
    told = scene(pub(), pub(), sub(), twins=("/sensor",), beats=(spoke(), heard()))
    diagnosis, headline, _ = first(told)
    assert causes(told) == ["run-twice"]
    assert headline == "2 nodes are called /sensor"
    assert "each publishes" in diagnosis.evidence
    deaf = scene(pub(), sub(), sub(), twins=("/monitor",), beats=(spoke(), heard()))
    assert "each hears all" in first(deaf)[0].evidence


def test_another_of_that_name_that_is_not_on_the_topic():
    told = scene(pub(), sub(), twins=("/sensor",), beats=(spoke(), heard()))
    assert explain(TOPIC, told).is_well
    two = scene(pub(), pub(), sub(), beats=(spoke(), heard()))
    assert explain(TOPIC, two).is_well


@pytest.mark.parametrize(
    ("number", "words"), [(1, "The only message was"), (5, "All 5 messages were")]
)
def test_the_first_messages_are_lost(number, words):
    beats = (spoke(number=number, rate=0.0), heard(number=0, missed=number, since=0))
    told = scene(pub(), sub(), beats=beats)
    diagnosis, _, _ = first(told)
    assert causes(told) == ["first-messages-lost"]
    assert words in diagnosis.evidence
    assert "TRANSIENT_LOCAL" in diagnosis.hint


def test_messages_that_nobody_can_account_for():
    told = scene(pub(), sub(), beats=(spoke(), heard(number=0, since=3)))
    assert causes(told) == [UNKNOWN]
    assert first(told)[1] == "this is new to me"
    # Live, a message or two may be on their way.
    live = replace(told, virtual=False, beats=(spoke(), heard(number=0, since=2)))
    assert explain(TOPIC, live).is_well
