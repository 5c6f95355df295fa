"""Lifespans in virtual time, and that Fast DDS drops the same by the wall clock."""

import pytest
from std_msgs.msg import Int32

from limited import Heart, Nurse, by_the_wall, quality, virtually
from nodes import Talker

pytestmark = pytest.mark.ros
WORLDS = pytest.mark.parametrize("world", [virtually, by_the_wall])
SHORT, LONG, NONE = 0.5, 60.0, 0.0


def expired(session):
    return [(one.time, one.node, one.name, one.source) for one in session.observation().callbacks
            if one.kind == "expired"]  # fmt: skip


@WORLDS
@pytest.mark.parametrize(
    ("offered", "asked", "heard"),
    [(NONE, NONE, [1, 2]), (SHORT, NONE, [1, 2]), (NONE, SHORT, [2]), (SHORT, SHORT, [2]),
     (SHORT, LONG, [1, 2]), (LONG, SHORT, [2])],
)  # fmt: skip
def test_the_queue_of_a_busy_subscription_drops_by_its_own_lifespan(world, offered, asked, heard):
    with world() as here:
        heart = here.make(Heart, quality(lifespan=offered))
        nurse = here.make(Nurse, quality(lifespan=asked))
        with here.busy(nurse):
            heart.beat(1)
            here.pass_time(1.5)
            heart.beat(2)
        here.wait_for(lambda: 2 in nurse.heard)
        assert nurse.heard == heard


@WORLDS
@pytest.mark.parametrize(
    ("offered", "asked", "heard"),
    [(NONE, NONE, [1, 2]), (SHORT, NONE, [2]), (NONE, SHORT, [2]), (LONG, LONG, [1, 2]),
     (SHORT, SHORT, [2])],
)  # fmt: skip
def test_what_a_publisher_stores_is_dropped_by_either_lifespan(world, offered, asked, heard):
    with world() as here:
        heart = here.make(Heart, quality(lifespan=offered, stored=True))
        heart.beat(1)
        here.pass_time(1.5)
        heart.beat(2)
        nurse = here.make(Nurse, quality(lifespan=asked, stored=True))
        here.wait_for(lambda: 2 in nurse.heard)
        here.pass_time(0.2)
        assert nurse.heard == heard


@WORLDS
def test_what_has_reached_a_late_joiner_in_time_stays(world):
    with world() as here:
        heart = here.make(Heart, quality(lifespan=1.0, stored=True))
        nurse = here.make(Nurse, quality(stored=True))
        with here.busy(nurse):
            heart.beat(1)
            here.pass_time(2.0)
        here.wait_for(lambda: nurse.heard)
        assert nurse.heard == [1]


def test_what_was_dropped_is_recorded_and_runs_no_callback(ros):
    heart = ros.add(lambda: Heart(quality()))
    nurse = ros.add(lambda: Nurse(quality(lifespan=1.0)))
    ros.pause(nurse)
    for number in range(4):
        heart.beat(number)
        ros.run(0.5)
    ros.resume(nurse)
    ros.run(0)
    # At 2.0 s the messages are 2.0, 1.5, 1.0 and 0.5 s old.
    assert nurse.heard == [3]
    assert expired(ros) == [(2.0, "/nurse", "hear", "/pulse")] * 3
    assert len(ros.messages("pulse")) == 4
    ran = [one for one in ros.observation().callbacks if one.kind == "subscription"]
    assert len(ran) == 1


def test_several_publishers_are_told_apart(ros):
    hearts = [ros.add(lambda name=name: Heart(quality(), name)) for name in ("one", "two")]
    nurse = ros.add(lambda: Nurse(quality(lifespan=1.0)))
    ros.pause(nurse)
    hearts[0].beat(1)  # each publisher's first
    ros.run(2)
    hearts[1].beat(2)
    ros.resume(nurse)
    ros.run(0)
    assert nurse.heard == [2]


def test_a_publisher_that_came_first_is_told_from_a_later_one(ros):
    first = ros.add(lambda: Heart(quality(stored=True), "first"))
    first.beat(1)  # before anybody had a lifespan
    ros.run(2)
    nurse = ros.add(lambda: Nurse(quality(lifespan=1.0, stored=True)))
    second = ros.add(lambda: Heart(quality(stored=True), "second"))
    ros.pause(nurse)
    second.beat(2)
    ros.run(0.5)
    first.beat(3)
    ros.run(0.7)
    ros.resume(nurse)
    ros.run(0)
    assert nurse.heard == [3]


def test_a_subscription_that_keeps_up_loses_nothing(ros):
    nurse = ros.add(lambda: Nurse(quality(lifespan=0.001)))
    ros.add(lambda: Talker(topic="pulse", period=0.1, qos=quality(lifespan=0.001)))
    ros.run(10)
    assert len(nurse.heard) == 100
    assert expired(ros) == []


def test_a_stored_message_that_is_too_old_begins_no_deadline(ros):
    heart = ros.add(lambda: Heart(quality(0.3, lifespan=1.0, stored=True)))
    heart.beat(1)
    ros.run(2)
    nurse = ros.add(lambda: Nurse(quality(0.3, stored=True)))
    ros.run(2)
    assert (nurse.heard, nurse.missed) == ([], [])


def test_raw_messages_and_infos_are_handed_over_as_always(ros):
    heart = ros.add(lambda: Heart(quality()))
    got = []
    qos = quality(lifespan=1.0)
    heart.create_subscription(Int32, "pulse", lambda m, info: got.append((m.data, type(info))), qos)
    heart.create_subscription(Int32, "pulse", lambda m: got.append(type(m)), qos, raw=True)
    heart.beat(7)
    ros.run(0)
    assert got == [(7, dict), bytes]
