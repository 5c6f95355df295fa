"""Compare the quality of service of a publisher with that of a subscription.

The publisher offers, the subscription asks; they are connected only if the offer is at least what
is asked (ROS 2 documentation, "About Quality of Service settings", QoS compatibilities). History,
depth and lifespan are each side's own affair and never stand in the way.
"""

from __future__ import annotations

from rosbeat.records import NANOSECONDS, QoS

#: What is offered and what is asked where the offer is too little, by policy.
_TOO_LITTLE = {
    "reliability": ("BEST_EFFORT", "RELIABLE"),
    "durability": ("VOLATILE", "TRANSIENT_LOCAL"),
}
#: For whoever hands over `ReliabilityPolicy.BEST_EFFORT` and no profile.
POLICY_ALONE = (
    "A policy alone isn't a QoS profile: ROS reads it as a number, and so as a queue depth. Pass "
    "it to QoSProfile as a keyword argument."
)
_RULES = {
    "reliability": "a subscription that asks for RELIABLE needs a publisher that offers RELIABLE; "
    "one that asks for BEST_EFFORT takes either",
    "durability": "a subscription that asks for TRANSIENT_LOCAL needs a publisher that offers "
    "TRANSIENT_LOCAL; one that asks for VOLATILE takes either",
    "deadline": "a subscription that asks for a deadline needs a publisher that offers the same "
    "deadline or a shorter one; one that asks for none takes any",
}


def incompatible(publisher: QoS, subscription: QoS) -> tuple[str, ...]:
    """Return the policies that keep two endpoints apart.

    Args:
        publisher: What the publisher offers.
        subscription: What the subscription asks for.

    Returns:
        `reliability`, `durability`, `deadline`, those that do not fit in this order, or nothing if
        the two fit.
    """
    found = [
        policy
        for policy, clash in _TOO_LITTLE.items()
        if (getattr(publisher, policy), getattr(subscription, policy)) == clash
    ]
    offered, asked = publisher.deadline_ns, subscription.deadline_ns
    if asked and (not offered or offered > asked):
        found.append("deadline")
    return tuple(found)


def rule(policy: str) -> str:
    """Return the rule of a policy that `incompatible` names, as a part of a sentence."""
    return _RULES[policy]


def words(qos: QoS, policy: str) -> str:
    """Return what one side offers or asks for, such as `BEST_EFFORT` or `a deadline of 0.5 s`.

    Args:
        qos: Its quality of service.
        policy: One that `incompatible` names.
    """
    if policy != "deadline":
        return str(getattr(qos, policy))
    if not qos.deadline_ns:
        return "no deadline"
    return f"a deadline of {qos.deadline_ns / NANOSECONDS:g} s"
