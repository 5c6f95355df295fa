import pytest
from scenes import pub, silent, spoke, sub, well

from rosbeat.diagnosis.situation import Beat, Condition, rate_of


def test_what_is_not_known_is_not_made_up():
    told = silent()
    assert told.beat(pub("/other")) == Beat("/other", "publisher", -1)
    assert told.condition("/other") == Condition("/other", "running")


def test_a_node_may_publish_and_subscribe():
    told = well()
    assert told.beat(pub()) == spoke()
    assert told.beat(sub("/sensor")).count == -1
    assert spoke().seconds == 10.0


@pytest.mark.parametrize(
    ("times", "rate"),
    [
        ([], 0.0),
        ([5], 0.0),
        ([5, 5], 0.0),
        ([0, 1_000_000_000], 1.0),
        ([0, 250_000_000, 500_000_000], 4.0),
    ],
)
def test_rates(times, rate):
    assert rate_of(times) == rate
