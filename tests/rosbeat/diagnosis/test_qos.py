from itertools import product

import pytest

from rosbeat.diagnosis.qos import incompatible, rule, words
from rosbeat.records import QoS

WEAK = QoS(reliability="BEST_EFFORT")
STORED = QoS(durability="TRANSIENT_LOCAL")
FAST, SLOW = QoS(deadline_ns=500_000_000), QoS(deadline_ns=2_000_000_000)


@pytest.mark.parametrize(
    ("offered", "asked", "policies"),
    [
        (QoS(), QoS(), ()),
        (QoS(), WEAK, ()),
        (WEAK, WEAK, ()),
        (WEAK, QoS(), ("reliability",)),
        (STORED, QoS(), ()),
        (QoS(), STORED, ("durability",)),
        (WEAK, STORED, ("reliability", "durability")),
        (FAST, SLOW, ()),
        (FAST, FAST, ()),
        (FAST, QoS(), ()),
        (SLOW, FAST, ("deadline",)),
        (QoS(), FAST, ("deadline",)),
        (QoS("BEST_EFFORT", deadline_ns=2), QoS(deadline_ns=1), ("reliability", "deadline")),
        (QoS(lifespan_ns=1), QoS(lifespan_ns=2), ()),
        (QoS(history="KEEP_LAST", depth=1), QoS(history="KEEP_ALL", depth=50), ()),
        (QoS("UNKNOWN", "UNKNOWN"), STORED, ()),
        (QoS("SYSTEM_DEFAULT", "SYSTEM_DEFAULT"), QoS("BEST_AVAILABLE", "BEST_AVAILABLE"), ()),
    ],
)
def test_the_offer_must_be_at_least_what_is_asked(offered, asked, policies):
    assert incompatible(offered, asked) == policies


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
