"""Whether the qualities of service of a publisher and a subscription fit.

The publisher offers, the subscription asks; they are connected only if the offer is at least what
is asked (ROS 2 documentation, "About Quality of Service settings", QoS compatibilities). History
and depth are each side's own affair and never stand in the way.
"""

from __future__ import annotations

from rosbeat.records import QoS

#: What is offered and what is asked where the offer is too little, by policy.
_TOO_LITTLE = {
    "reliability": ("BEST_EFFORT", "RELIABLE"),
    "durability": ("VOLATILE", "TRANSIENT_LOCAL"),
}
_RULES = {
    "reliability": "a subscription that asks for RELIABLE needs a publisher that offers RELIABLE; "
    "one that asks for BEST_EFFORT takes either",
    "durability": "a subscription that asks for TRANSIENT_LOCAL needs a publisher that offers "
    "TRANSIENT_LOCAL; one that asks for VOLATILE takes either",
}


def incompatible(publisher: QoS, subscription: QoS) -> tuple[str, ...]:
    """Return the policies that keep two endpoints apart.

    Args:
        publisher: What the publisher offers.
        subscription: What the subscription asks for.

    Returns:
        `reliability`, `durability`, both in this order, or nothing if the two fit.
    """
    return tuple(
        policy
        for policy, clash in _TOO_LITTLE.items()
        if (getattr(publisher, policy), getattr(subscription, policy)) == clash
    )


def rule(policy: str) -> str:
    """Return the rule of a policy that `incompatible` names, as a part of a sentence."""
    return _RULES[policy]
