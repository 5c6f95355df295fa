"""What waits in a queue is counted, and stays there."""

import os
import time

import pytest

from limited import Heart, Nurse, quality
from rosbeat.ros.qos_events import Unread


@pytest.fixture
def pair(ros):
    return ros.add(lambda: Heart(quality())), ros.add(lambda: Nurse(quality()))


def comes_to(queue, number):
    end = time.monotonic() + 10
    while queue.count() != number and time.monotonic() < end:
        time.sleep(0.001)
    return queue.count() == number


@pytest.mark.ros
def test_what_is_there_and_what_comes_is_counted_and_nothing_taken_out(ros, pair):
    heart, nurse = pair
    for number in (1, 2):
        heart.beat(number)
    with Unread(nurse.subscription) as queue:
        assert comes_to(queue, 2)
        heart.beat(3)
        assert comes_to(queue, 3)
    ros.run(1)
    assert nurse.heard == [1, 2, 3]


@pytest.mark.ros
def test_afterwards_nobody_listens_and_nothing_is_left_open(ros, pair):
    heart, nurse = pair
    before = os.listdir("/proc/self/fd")
    with Unread(nurse.subscription) as queue:
        assert queue.count() == 0
    heart.beat(1)
    ros.run(1)
    assert nurse.heard == [1]
    assert len(os.listdir("/proc/self/fd")) == len(before)


@pytest.mark.ros
def test_where_there_is_no_such_counter_nothing_is_counted(ros, pair, monkeypatch):
    heart, nurse = pair
    monkeypatch.delattr(os, "eventfd")
    with Unread(nurse.subscription) as queue:
        heart.beat(1)
        assert queue.count() == 0
    ros.run(1)
    assert nurse.heard == [1]
