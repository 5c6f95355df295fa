"""A late joiner has all that is stored for it when it has been made."""

import time
from types import SimpleNamespace

import pytest
from rclpy.duration import Duration
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from std_msgs.msg import Int32

from limited import Heart, Nurse, quality
from rosbeat.ros import qos_events
from rosbeat.ros.qos_events import wait_for_stored

STORED = quality(stored=True)
#: Fast DDS is late with stored messages 1 time in 5 to 1 time in 2.
TIMES = 30


def in_the_queue(nurse):
    """What has arrived there by now, taken out."""
    got = []
    while (taken := nurse.subscription.handle.take_message(Int32, False)) is not None:
        got.append(taken[0].data)
    return got


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
        assert in_the_queue(nurse) == list(range(1, number + 1))[-10:]


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


@pytest.mark.ros
def test_nobody_waits_for_a_volatile_subscription_that_came_late(ros):
    asked = quality(stored=True, depth=1)
    heart = ros.add(lambda: Heart(asked))
    for number in (1, 2):  # the first is not stored any more
        heart.beat(number)
    ros.add(lambda: Nurse(quality(), "passer_by"))
    heart.beat(3)
    assert not heart.publisher.wait_for_all_acked(Duration(seconds=0.2))
    begin = time.monotonic()
    for number in range(4, 7):
        nurse = ros.add(lambda number=number: Nurse(STORED, f"nurse{number}"))
        heart.beat(number)
        assert in_the_queue(nurse) == [number - 1, number]
    assert time.monotonic() - begin < 1.5


class Tap:
    """A publisher that has delivered when it was asked so many times."""

    def __init__(self, asked_before_it_has=0, stores=True, stored=1):
        self.left, self.stores, self.stored = asked_before_it_has, stores, stored

    def stores_for(self, qos):
        assert qos is STORED
        return self.stores

    def has_delivered(self):
        self.left -= 1
        return self.left < 0


class Queue:
    """A queue in which there is one message more each time that somebody looks, or none ever."""

    def __init__(self, step):
        self._step, self._count = step, 0

    def __enter__(self):
        return self

    def __exit__(self, *_):
        pass

    def count(self):
        self._count += self._step
        return self._count


@pytest.fixture(params=[0])
def clock(request, monkeypatch):
    """Time that passes by sleeping only, and a queue that stays empty or fills itself."""
    now = [0.0]
    clock = SimpleNamespace(
        monotonic=lambda: now[0], sleep=lambda seconds: now.__setitem__(0, now[0] + seconds)
    )
    monkeypatch.setattr(qos_events, "time", clock)
    monkeypatch.setattr(qos_events, "Unread", lambda _: Queue(request.param))
    return now


SUBSCRIPTION = SimpleNamespace(qos_profile=STORED)


def test_each_publisher_that_stores_something_is_waited_for(clock):
    taps = [Tap(3), Tap(5, stores=False), Tap(0), Tap(2)]
    wait_for_stored(taps, SUBSCRIPTION)
    assert [tap.stores and tap.left < 0 for tap in taps] == [True, False, True, True]
    assert taps[1].left == 5


def test_who_never_acknowledges_is_not_waited_for_without_end(clock):
    wait_for_stored([Tap(10**9), Tap(10**9)], SUBSCRIPTION)
    assert clock[0] == pytest.approx(2.0, abs=0.01)


@pytest.mark.parametrize("clock", [1], indirect=True)
def test_a_queue_with_all_that_is_stored_is_a_sign(clock):
    wait_for_stored([Tap(10**9, stored=4), Tap(10**9, stored=3)], SUBSCRIPTION)
    assert clock[0] == pytest.approx(6 * 0.0005)
