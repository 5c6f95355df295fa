"""Define faults that silence part of a system: each turns a plan into one with that fault.

A fault is `(plan, role, rng) -> (plan, truth)`. It changes one node, as the author or operator of
that node might by mistake, and returns the diagnosis with all places that count as right.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from random import Random
from typing import Any

from rosbeat.clinic.plans import (
    DIARY,
    DISPLAY,
    GUARD,
    OVER,
    SENSOR,
    STEP,
    TEACHER,
    Part,
    Plan,
    Truth,
    full,
)
from rosbeat.records import QoS

Fault = Callable[[Plan, str, Random], tuple[Plan, Truth]]


def misspelled(plan: Plan, role: str, rng: Random) -> tuple[Plan, Truth]:
    """Misspell the name of the topic that a node uses."""
    part = plan.the(role)
    wrong = _twisted(_topic(part), rng)
    new = _with_topic(part, wrong)
    return plan.having(new, part), Truth("topic-misspelled", (full(wrong), part.path))


def _topic(part: Part) -> str:
    return part.listens or part.speaks


def _with_topic(part: Part, topic: str) -> Part:
    return replace(part, listens=topic) if part.listens else replace(part, speaks=topic)


def _twisted(name: str, rng: Random) -> str:
    """A name with a small slip of the hand in its second half."""
    at = rng.randrange(len(name) // 2, len(name) - 1)
    slips = (
        name[:at] + name[at + 1 :],
        name + "s",
        name[:at] + name[at + 1] + name[at] + name[at + 2 :],
        name.rpartition("_")[0] + "_" + name.rpartition("_")[2].capitalize(),
    )
    return rng.choice([slip for slip in slips if slip != name and not slip.endswith("_")])


def namespaced(plan: Plan, role: str, rng: Random) -> tuple[Plan, Truth]:
    """Move a node's topic into a namespace that the other nodes do not use.

    Either the node is started in the namespace, or its code names it.
    """
    part, where = plan.the(role), rng.choice(("north", "hall_2", "test", "upstairs"))
    topic = f"{where}/{_topic(part)}"
    if rng.random() < 0.5:
        new = _with_topic(part, topic)
        return plan.having(new, part), Truth("wrong-namespace", (full(topic), part.path))
    new = replace(part, namespace=where)
    changed = _renamed(plan, part.path, new.path).having(new, part)
    return changed, Truth("wrong-namespace", (full(topic), new.path))


def _renamed(plan: Plan, old: str, new: str) -> Plan:
    """The orders speak of the node under the name that it has now."""
    wires = tuple(
        replace(one, node=new if one.node == old else one.node) for one in plan.orders.wiring
    )
    return replace(plan, orders=replace(plan.orders, wiring=wires))


def unfit(plan: Plan, role: str, rng: Random) -> tuple[Plan, Truth]:
    """Make the QoS of a node incompatible with that of the other side."""
    part = plan.the(role)
    if role == SENSOR:
        qos = QoS(reliability="BEST_EFFORT")
    else:
        qos = QoS(durability="TRANSIENT_LOCAL", depth=rng.choice((1, 5, 10)))
    ends = {SENSOR: (GUARD, DIARY), DISPLAY: (GUARD,)}.get(role, (SENSOR,))
    others = [one.path for one in plan.parts if one.role in ends]
    places = (full(part.speaks if role == SENSOR else part.listens), part.path, *others)
    return plan.having(part.doing(qos=qos), part), Truth("qos-mismatch", places)


def ended(plan: Plan, role: str, rng: Random) -> tuple[Plan, Truth]:
    """Make a callback of a node raise, which ends the node."""
    part = plan.the(role)
    how: dict[str, dict[str, Any]] = {
        SENSOR: {"calibrated": rng.randrange(15, 40)},
        GUARD: {"forgets_high": True},
        DIARY: {"pages": rng.randrange(10, 30)},
    }
    options = how[role]
    if role == GUARD:
        plan = _from_normal(plan)
    return plan.having(part.doing(**options), part), Truth("node-ended", (part.path,))


def _from_normal(plan: Plan) -> Plan:
    """The same system; its readings begin a little above the lower limit, and rise."""
    sensor, orders = plan.the(SENSOR), plan.orders
    begin = orders.low + STEP - (orders.least - OVER)
    return plan.having(sensor.doing(phase=round(begin / STEP)), sensor)


def mute(plan: Plan, role: str, rng: Random) -> tuple[Plan, Truth]:
    """Keep a node from ever reaching its call of `publish`."""
    part = plan.the(role)
    new = plan.having(part.doing(mute=True), part)
    return new, Truth("never-published", (part.path, full(part.speaks)))


def unspun(plan: Plan, role: str, rng: Random) -> tuple[Plan, Truth]:
    """Create a node without spinning it."""
    part = plan.the(role)
    return plan.having(replace(part, handed_over=False), part), Truth("not-spun", (part.path,))


def late(plan: Plan, role: str, rng: Random) -> tuple[Plan, Truth]:
    """Start the node that displays the rule after the rule has been published."""
    part = plan.parts[-1]
    new = replace(part, joins=float(rng.randrange(5, 25)))
    places = (full(part.listens), part.path, plan.the(TEACHER).path)
    return plan.having(new, part), Truth("first-messages-lost", places)


def quiet(plan: Plan, role: str, rng: Random) -> tuple[Plan, Truth]:
    """Make a node stop publishing after a while, although it keeps running."""
    part = plan.the(role)
    new = plan.having(part.doing(stops_after=rng.randrange(18, 32)), part)
    return new, Truth("gone-quiet", (part.path, full(part.speaks)))
