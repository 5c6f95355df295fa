"""A late joiner has all that is stored for it when it has been made."""

import time
from types import SimpleNamespace

import pytest
from rclpy.duration import Duration
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy

from limited import Heart, Nurse, quality
from rosbeat.ros.qos_events import wait_for_stored

STORED = quality(stored=True)
#: Fast DDS is late with stored messages 1 time in 5 to 1 time in 2.
TIMES = 30


@pytest.mark.ros
@pytest.mark.parametrize(
    "asked",
    [STORED, QoSProfile(depth=10, durability=DurabilityPolicy.BEST_AVAILABLE)],
    ids=["transient local", "best available"],
)
def test_stored_messages_hold_back_nothing_that_follows(ros, asked):
    heart = ros.add(lambda: Heart(STORED))
    for number in (1, 2):
        heart.beat(number)
    for number in range(3, TIMES + 3):
        nurse = ros.add(lambda number=number: Nurse(asked, f"nurse{number}"))
        heart.beat(number)
        ros.run(0)
        assert nurse.heard == list(range(1, number + 1))[-10:]


@pytest.mark.ros
def test_nobody_waits_for_what_a_best_effort_late_joiner_does_not_get(ros):
    heart = ros.add(lambda: Heart(STORED))
    heart.beat(1)
    begin = time.monotonic()
    asked = quality(stored=True)
    asked.reliability = ReliabilityPolicy.BEST_EFFORT
    nurse = ros.add(lambda: Nurse(asked))
    ros.run(1)
    assert nurse.heard == []
    assert time.monotonic() - begin < 1.0


@pytest.mark.ros
def test_nobody_waits_for_what_was_heard_in_real_time(ros):
    heart = ros.add(lambda: Heart(STORED))
    heart.beat(1)
    nurse = ros.add(lambda: Nurse(STORED))
    ros.start()
    assert ros.wait(10, until=lambda: nurse.heard)
    ros.stop()
    begin = time.monotonic()
    ros.run(1)
    assert nurse.heard == [1]
    assert time.monotonic() - begin < 1.0


@pytest.fixture
def unacknowledged(ros):
    """A publisher that knows of nobody what has arrived: a volatile subscription came too late."""
    heart = ros.add(lambda: Heart(quality(stored=True, depth=1)))
    for number in (1, 2):  # the first is not stored any more
        heart.beat(number)
    ros.add(lambda: Nurse(quality(), "passer_by"))
    heart.beat(3)
    assert not heart.publisher.wait_for_all_acked(Duration(seconds=0.2))
    return heart


@pytest.mark.ros
def test_nobody_waits_for_a_volatile_subscription_that_came_late(ros, unacknowledged):
    begin = time.monotonic()
    for number in range(4, 7):
        nurse = ros.add(lambda number=number: Nurse(STORED, f"nurse{number}"))
        unacknowledged.beat(number)
        ros.run(0)
        assert nurse.heard == [number - 1, number]
    assert time.monotonic() - begin < 1.5


@pytest.mark.ros
def test_what_was_taken_early_is_a_part_of_the_queue(ros, unacknowledged):
    nurse = ros.add(lambda: Nurse(quality(stored=True, depth=2)))
    ros.pause(nurse)
    for number in (4, 5):
        unacknowledged.beat(number)
    ros.resume(nurse)
    ros.run(0)
    assert nurse.heard == [4, 5]
    unacknowledged.beat(6)
    ros.run(0)
    assert nurse.heard == [4, 5, 6]


@pytest.mark.ros
def test_what_was_taken_early_is_heard_in_real_time(ros, unacknowledged):
    nurse = ros.add(lambda: Nurse(STORED))
    ros.start()
    assert ros.wait(10, until=lambda: nurse.heard)
    unacknowledged.beat(4)
    assert ros.wait(10, until=lambda: len(nurse.heard) > 1)
    assert nurse.heard == [3, 4]


class Tap:
    """A publisher that has delivered when it was asked so many times."""

    def __init__(self, asked_before_it_has=0, stores=True):
        self.left, self.stores = asked_before_it_has, stores

    def stores_for(self, qos):
        assert qos is STORED
        return self.stores

    def has_delivered(self):
        self.left -= 1
        return self.left < 0


def test_each_publisher_that_stores_something_is_waited_for():
    taps = [Tap(3), Tap(5, stores=False), Tap(0), Tap(2)]
    wait_for_stored(taps, SimpleNamespace(entity=SimpleNamespace(qos_profile=STORED)))
    assert [tap.stores and tap.left < 0 for tap in taps] == [True, False, True, True]
    assert taps[1].left == 5
