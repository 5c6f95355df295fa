from itertools import product

import pytest

from rosbeat.diagnosis.qos import incompatible, rule
from rosbeat.records import QoS

WEAK = QoS(reliability="BEST_EFFORT")
STORED = QoS(durability="TRANSIENT_LOCAL")


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


@pytest.mark.ros
def test_rclpy_says_the_same():
    from rclpy.qos import QoSCompatibility, QoSProfile, qos_check_compatible

    from rosbeat.runtime.introspection import qos_of

    profiles = [
        QoSProfile(depth=5, reliability=reliability, durability=durability)
        for reliability, durability in product((1, 2), (1, 2))
    ]
    for offered, asked in product(profiles, profiles):
        fits = qos_check_compatible(offered, asked)[0] != QoSCompatibility.ERROR
        assert fits == (not incompatible(qos_of(offered), qos_of(asked)))
