"""Deadlines in virtual time, and that Fast DDS counts the same by the wall clock."""

import threading

import pytest
from rclpy.event_handler import QoSOfferedDeadlineMissedInfo, QoSRequestedDeadlineMissedInfo
from rclpy.node import Node
from rclpy.qos import ReliabilityPolicy
from std_msgs.msg import Int32

from limited import TOPIC, Heart, Nurse, by_the_wall, quality, virtually
from nodes import Talker
from rosbeat import Session
from rosbeat.observations import digest

pytestmark = pytest.mark.ros
WORLDS = pytest.mark.parametrize("world", [virtually, by_the_wall])
PERIOD = 0.25


def events(session, node="/nurse"):
    return [(one.time, one.name, one.source) for one in session.observation().callbacks
            if one.kind == "event" and one.node == node]  # fmt: skip


# What both clocks must agree on.


@WORLDS
def test_nothing_is_missed_before_the_first_message(world):
    with world() as here:
        nurse = here.make(Nurse, quality(PERIOD))
        here.pass_time(3 * PERIOD)
        heart = here.make(Heart, quality(PERIOD))
        here.pass_time(3 * PERIOD)
        assert (nurse.missed, heart.missed) == ([], [])
        heart.beat(1)
        here.wait_for(lambda: nurse.missed and heart.missed)
        assert nurse.heard == [1]
        assert (nurse.missed[0], heart.missed[0]) == ((1, 1), (1, 1))


@WORLDS
def test_one_is_missed_in_each_period_of_silence_also_when_nobody_is_left(world):
    with world() as here:
        nurse, heart = here.make(Nurse, quality(PERIOD)), here.make(Heart, quality(PERIOD))
        heart.beat(1)
        here.wait_for(lambda: len(nurse.missed) >= 2 and len(heart.missed) >= 2)
        heart.destroy_publisher(heart.publisher)
        known = len(heart.missed)
        here.wait_for(lambda: nurse.missed[-1][0] >= 4)
        assert len(heart.missed) == known
        assert [total for total, _ in nurse.missed] == [
            sum(change for _, change in nurse.missed[: k + 1]) for k in range(len(nurse.missed))
        ]


@WORLDS
def test_who_was_busy_is_told_once_of_all_that_were_missed(world):
    with world() as here:
        nurse, heart = here.make(Nurse, quality(PERIOD)), here.make(Heart, quality(PERIOD))
        heart.beat(1)
        here.wait_for(lambda: nurse.heard)
        with here.busy(nurse):
            here.wait_for(lambda: heart.missed and heart.missed[-1][0] >= 4)
        here.wait_for(lambda: nurse.missed)
        total, change = nurse.missed[0]
        # By the wall, her fourth deadline is a moment later than the publisher's.
        assert total == change >= (4 if world is virtually else 3)


@WORLDS
def test_a_subscription_counts_what_comes_from_all_a_publisher_only_its_own(world):
    with world() as here:
        nurse = here.make(Nurse, quality(5.0))
        hearts = [here.make(Heart, quality(PERIOD), name) for name in ("one", "two")]
        hearts[0].beat(1)
        for number in range(8):
            hearts[1].beat(number)
            here.pass_time(PERIOD / 2)
        assert nurse.missed == []
        assert hearts[0].missed[-1][0] >= 2


@WORLDS
def test_a_publisher_that_nobody_hears_misses_its_deadline_too(world):
    with world() as here:
        heart = here.make(Heart, quality(PERIOD))
        heart.beat(1)
        here.wait_for(lambda: heart.missed)


@WORLDS
def test_a_late_joiner_counts_from_the_stored_message(world):
    with world() as here:
        heart = here.make(Heart, quality(PERIOD, stored=True))
        heart.beat(1)
        here.pass_time(3 * PERIOD)
        nurse = here.make(Nurse, quality(PERIOD, stored=True))
        here.wait_for(lambda: nurse.missed)
        assert nurse.heard == [1]
        assert nurse.missed[0] == (1, 1)


@WORLDS
def test_a_best_effort_late_joiner_gets_nothing_that_is_stored_and_waits_for_a_message(world):
    with world() as here:
        heart = here.make(Heart, quality(PERIOD, stored=True))
        heart.beat(1)
        asked = quality(PERIOD, stored=True)
        asked.reliability = ReliabilityPolicy.BEST_EFFORT
        nurse = here.make(Nurse, asked)
        here.pass_time(3 * PERIOD)
        assert (nurse.heard, nurse.missed) == ([], [])


@WORLDS
@pytest.mark.parametrize(
    ("offered", "asked", "fit"),
    [(0.2, 0.3, True), (0.3, 0.3, True), (0.3, 0.2, False), (0.0, 0.3, False), (0.3, 0.0, True),
     (0.0, 0.0, True), (86400.0, 3600.0, False), (3600.0, 86400.0, True)],
)  # fmt: skip
def test_an_offer_must_be_as_short_as_what_is_asked(world, offered, asked, fit):
    with world() as here:
        nurse, heart = here.make(Nurse, quality(asked)), here.make(Heart, quality(offered))
        here.pass_time(0.1)
        assert heart.publisher.get_subscription_count() == int(fit)
        assert len(nurse.misfits) == int(not fit)
        heart.beat(1)
        here.pass_time(0.1)
        assert nurse.heard == ([1] if fit else [])


# What virtual time adds.


def test_the_times_are_exact_and_recorded(ros):
    nurse = ros.add(lambda: Nurse(quality(1.5)))
    heart = ros.add(lambda: Heart(quality(1.5)))
    heart.beat(1)
    ros.run(4.5)
    assert nurse.missed == [(1, 1), (2, 1), (3, 1)] == heart.missed
    told = [(1.5, "on_missed", "deadline of /pulse"), (3.0, "on_missed", "deadline of /pulse"),
            (4.5, "on_missed", "deadline of /pulse")]  # fmt: skip
    assert events(ros) == told == events(ros, "/heart")


def test_rclpys_own_info_objects_are_handed_over(ros):
    nurse = ros.add(lambda: Nurse(quality(1.0)))
    heart = ros.add(lambda: Heart(quality(1.0)))
    heart.beat(1)
    ros.run(2)
    assert isinstance(nurse.infos[0], QoSRequestedDeadlineMissedInfo)
    assert isinstance(heart.infos[0], QoSOfferedDeadlineMissedInfo)
    # An info is what was known then, and does not grow.
    assert [one.total_count for one in nurse.infos] == [1, 2]


def test_a_message_exactly_at_the_deadline_is_in_time(ros):
    nurse = ros.add(lambda: Nurse(quality(1.0)))
    ros.add(lambda: Talker(topic=TOPIC, period=1.0, qos=quality(1.0)))
    ros.run(10)
    assert nurse.missed == []
    assert len(nurse.heard) == 10


def test_a_slower_publisher_misses_one_in_each_gap(ros):
    nurse = ros.add(lambda: Nurse(quality(1.0)))
    ros.add(lambda: Talker(topic=TOPIC, period=1.5, qos=quality(1.0)))
    ros.run(15)
    assert len(nurse.heard) == 10
    assert nurse.missed == [(number, 1) for number in range(1, 10)]


def test_a_message_that_does_not_fit_moves_nothing(ros):
    nurse = ros.add(lambda: Nurse(quality(1.0)))
    strict = ros.add(lambda: Heart(quality(1.0), "strict"))
    strict.beat(1)
    loose = ros.add(lambda: Heart(quality(2.0), "loose"))
    ros.run(0.9)
    loose.beat(2)
    ros.run(0.2)
    assert nurse.heard == [1]
    assert nurse.missed == [(1, 1)]


def test_a_callback_of_an_event_may_publish(ros):
    class Doctor(Nurse):
        def __init__(self):
            super().__init__(quality(1.0), "doctor")
            self.alarm = self.create_publisher(Int32, "alarm", 10)

        def on_missed(self, info):
            super().on_missed(info)
            self.alarm.publish(Int32(data=info.total_count))

    ros.add(Doctor)
    heart = ros.add(lambda: Heart(quality(1.0)))
    heart.beat(1)
    ros.run(3)
    alarms = [(one.time, one.value) for one in ros.messages("alarm")]
    assert alarms == [(1.0, 1), (2.0, 2), (3.0, 3)]


def test_an_exception_in_it_ends_the_node_and_its_deadline(ros, capsys):
    class Faint(Nurse):
        def on_missed(self, info):
            super().on_missed(info)
            raise ValueError("faint")

    nurse = ros.add(lambda: Faint(quality(1.0)))
    heart = ros.add(lambda: Heart(quality(1.0)))
    heart.beat(1)
    ros.run(5)
    (fault,) = ros.observation().faults
    assert (fault.callback, fault.kind, fault.time) == ("on_missed", "ValueError", 1.0)
    assert len(nurse.missed) == 1
    assert len(heart.missed) == 5
    capsys.readouterr()


def test_a_destroyed_node_is_not_called(ros):
    nurse = ros.add(lambda: Nurse(quality(1.0)))
    heart = ros.add(lambda: Heart(quality(1.0)))
    heart.beat(1)
    ros.run(1)
    ros.remove(nurse)
    ros.run(3)
    assert (len(nurse.missed), len(heart.missed)) == (1, 4)


def test_a_message_of_another_thread_counts(ros):
    heart = ros.add(lambda: Heart(quality(1.0)))
    nurse = ros.add(lambda: Nurse(quality(1.0)))
    thread = threading.Thread(target=heart.beat, args=(1,))
    thread.start()
    thread.join()
    ros.run(2)
    assert nurse.heard == [1]
    assert len(nurse.missed) == 2 == len(heart.missed)


def test_live_time_is_not_counted_and_virtual_time_begins_with_a_message(ros):
    nurse = ros.add(lambda: Nurse(quality(0.05)))
    heart = ros.add(lambda: Heart(quality(0.05)))
    heart.beat(1)
    ros.run(0.05)
    ros.start()
    heart.beat(2)
    assert ros.wait(10, until=lambda: nurse.heard == [1, 2])
    ros.wait(0.2)
    ros.stop()
    ros.run(1)
    assert (len(nurse.missed), len(heart.missed)) == (1, 1)
    heart.beat(3)
    ros.run(0.1)
    assert nurse.missed == [(1, 1), (2, 1), (3, 1)]


def test_what_is_made_live_is_left_to_the_middleware(ros):
    ros.start()
    nurse = ros.add(lambda: Nurse(quality(0.05)))
    heart = ros.add(lambda: Heart(quality(0.05)))
    heart.beat(1)
    assert ros.wait(10, until=lambda: nurse.missed and heart.missed)
    ros.stop()
    assert events(ros)[0][1:] == ("on_missed", "deadline of /pulse")


def test_a_domain_that_was_joined_shows_what_was_written(ros):
    with Session(domain_id=ros.domain_id) as joined:
        heart = joined.add(lambda: Heart(quality(0.5, 0.25)))
        told = joined.add(lambda: Node("asker"))
        (info,) = told.get_publishers_info_by_topic(f"/{TOPIC}")
        assert info.qos_profile.deadline.nanoseconds == 500_000_000
        heart.beat(1)
        joined.run(5)
        assert heart.missed == []


def test_a_run_that_was_broken_off_goes_on_counting(ros):
    nurse = ros.add(lambda: Nurse(quality(1.0)))
    heart = ros.add(lambda: Heart(quality(1.0)))

    def interrupt():
        raise KeyboardInterrupt

    heart.create_timer(2.5, interrupt)
    heart.beat(1)
    with pytest.raises(KeyboardInterrupt):
        ros.run(5)
    ros.run(1.5)
    assert len(nurse.missed) == 4


def watched_for_a_minute():
    with Session(seed=3) as session:
        session.add(lambda: Nurse(quality(1.0, 0.7)))
        session.add(lambda: Talker(topic=TOPIC, period=1.3, qos=quality(1.0, 0.7)))
        session.run(20, quiet=True)
        session.pause("nurse")
        session.run(20, quiet=True)
        session.resume("nurse")
        session.run(20, quiet=True)
        return session.observation()


def test_every_run_is_the_same():
    assert len({digest(watched_for_a_minute()) for _ in range(100)}) == 1
