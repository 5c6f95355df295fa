"""Quality of service, there and back."""

from itertools import product

import pytest
from rosbags.interfaces import QosTime

from rosbeat.bags import qualities
from rosbeat.records import QoS


@pytest.mark.parametrize(
    "words",
    list(
        product(
            ["RELIABLE", "BEST_EFFORT"], ["VOLATILE", "TRANSIENT_LOCAL"], ["KEEP_LAST", "KEEP_ALL"]
        )
    ),
)
@pytest.mark.parametrize("depth", [0, 1, 1000])
def test_it_comes_back(words, depth):
    assert qualities.read(qualities.stored(QoS(*words, depth))) == QoS(*words, depth)


@pytest.mark.parametrize("limits", [(0, 0), (1_500_000_000, 0), (0, 7), (10**9, 2 * 10**9)])
def test_limits_are_stored_and_read(limits):
    qos = QoS("RELIABLE", "VOLATILE", "KEEP_LAST", 10, *limits)
    assert qualities.read(qualities.stored(qos)) == qos


def test_what_another_process_does_not_tell_stays_unknown():
    assert qualities.read(qualities.stored(QoS(history="UNKNOWN", depth=0))).history == "UNKNOWN"


def test_no_limit_is_written_as_ros_writes_it():
    made = qualities.stored(QoS())
    assert (made.deadline.sec, made.deadline.nsec) == (9223372036, 854775807)


def test_the_longest_time_of_32_bits_is_no_limit_either():
    long = qualities.stored(QoS())._replace(lifespan=QosTime(2147483647, 999999999))
    assert qualities.read(long) == QoS()
