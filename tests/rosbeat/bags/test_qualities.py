"""Quality of service, there and back."""

from itertools import product

import pytest

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


def test_what_another_process_does_not_tell_stays_unknown():
    assert qualities.read(qualities.stored(QoS(history="UNKNOWN", depth=0))).history == "UNKNOWN"


def test_no_limit_is_written_as_ros_writes_it():
    made = qualities.stored(QoS())
    assert (made.deadline.sec, made.deadline.nsec) == (9223372036, 854775807)
