from itertools import product

import pytest

from rosbeat.diagnosis.qos import incompatible, rule, words
from rosbeat.records import QoS

WEAK = QoS(reliability="BEST_EFFORT")
STORED = QoS(durability="TRANSIENT_LOCAL")
FAST, SLOW = QoS(deadline_ns=500_000_000), QoS(deadline_ns=2_000_000_000)


def test_what_does_not_fit_is_named_in_order():
    assert incompatible(WEAK, STORED) == ("reliability", "durability")
    assert incompatible(SLOW, FAST) == ("deadline",)
    unknown = QoS("UNKNOWN", "SYSTEM_DEFAULT", "KEEP_ALL", 50, lifespan_ns=1)
    assert incompatible(unknown, STORED) == ()


def test_each_policy_has_a_rule():
    assert "RELIABLE" in rule("reliability")
    assert "TRANSIENT_LOCAL" in rule("durability")
    assert "shorter" in rule("deadline")


def test_what_a_side_offers_or_asks_for_in_words():
    assert words(WEAK, "reliability") == "BEST_EFFORT"
    assert words(QoS(), "deadline") == "no deadline"
    assert words(FAST, "deadline") == "a deadline of 0.5 s"


@pytest.mark.ros
def test_rclpy_says_the_same():
    from rclpy.duration import Duration
    from rclpy.qos import QoSCompatibility, QoSProfile, qos_check_compatible

    from rosbeat.ros.graph import qos_of

    profiles = [
        QoSProfile(
            depth=5,
            reliability=reliability,
            durability=durability,
            **({"deadline": Duration(seconds=deadline)} if deadline else {}),
        )
        for reliability, durability, deadline in product((1, 2), (1, 2), (0, 1, 2))
    ]
    for offered, asked in product(profiles, profiles):
        fits = qos_check_compatible(offered, asked)[0] != QoSCompatibility.ERROR
        assert fits == (not incompatible(qos_of(offered), qos_of(asked)))
