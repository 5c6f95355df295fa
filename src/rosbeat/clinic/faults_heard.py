"""Define faults that silence nothing: all messages arrive, but something is wrong with them.

Each is `(plan, role, rng) -> (plan, truth)`, as in `faults.py`.
"""

from __future__ import annotations

from dataclasses import replace
from random import Random

from rosbeat.clinic.plans import GUARD, SENSOR, Plan, Truth, full
from rosbeat.records import QoS


def two_sources(plan: Plan, role: str, rng: Random) -> tuple[Plan, Truth]:
    """Add a second sensor, which nobody ordered, on the same topic."""
    part = plan.the(SENSOR)
    name = part.name.partition("_")[0] + rng.choice(("_spare", "_old_sensor", "_test_sensor"))
    phase = (int(part.options.get("phase", 0)) + rng.randrange(15, 25)) % 60
    extra = replace(part, name=name, options={"phase": phase})
    return plan.also(extra), Truth("two-sources", (full(part.speaks), extra.path))


def wrong_unit(plan: Plan, role: str, rng: Random) -> tuple[Plan, Truth]:
    """Make the sensor publish its readings in another unit."""
    part = plan.the(SENSOR)
    new = plan.having(part.doing(unit=rng.choice(("Fahrenheit", "Kelvin"))), part)
    return new, Truth("wrong-unit", (part.path, full(part.speaks)))


def short_queue(plan: Plan, role: str, rng: Random) -> tuple[Plan, Truth]:
    """Make a subscription's queue shorter than a burst of messages."""
    part = plan.the(role)
    depth = rng.randrange(1, plan.orders.burst - 1)
    new = plan.having(part.doing(qos=QoS(depth=depth)), part)
    return new, Truth("depth-too-small", (part.path, full(part.listens)))


def other_topic(plan: Plan, role: str, rng: Random) -> tuple[Plan, Truth]:
    """Remap a node's subscription to the humidity topic."""
    part, humid = plan.the(role), plan.parts[-1].speaks
    new = plan.having(replace(part, remappings={part.listens: humid}), part)
    return new, Truth("wrong-topic", (part.path, full(humid)))


def unclamped(plan: Plan, role: str, rng: Random) -> tuple[Plan, Truth]:
    """Make the sensor publish readings without clamping them to its limits."""
    part = plan.the(SENSOR)
    new = plan.having(part.doing(clamp="none"), part)
    return new, Truth("no-clamp", (part.path, full(part.speaks)))


def clamped_first(plan: Plan, role: str, rng: Random) -> tuple[Plan, Truth]:
    """Make the sensor clamp its reading to the limits before it adds the last step."""
    part = plan.the(SENSOR)
    new = plan.having(part.doing(clamp="first"), part)
    return new, Truth("clamped-too-early", (part.path, full(part.speaks)))


def other_rate(plan: Plan, role: str, rng: Random) -> tuple[Plan, Truth]:
    """Give the sensor's timer another period."""
    part = plan.the(SENSOR)
    period = plan.orders.period * rng.choice((0.5, 0.25, 2.0))
    new = plan.having(part.doing(period=period), part)
    return new, Truth("wrong-rate", (part.path, full(part.speaks)))


def at_the_limit(plan: Plan, role: str, rng: Random) -> tuple[Plan, Truth]:
    """Make the guard classify a reading that is exactly at a limit incorrectly."""
    part = plan.the(GUARD)
    option = rng.choice(("high_too", "low_too"))
    new = plan.having(part.doing(**{option: True}), part)
    return new, Truth("boundary", (part.path, full(part.speaks)))


def stuck(plan: Plan, role: str, rng: Random) -> tuple[Plan, Truth]:
    """Make the sensor publish the same number forever."""
    part, orders = plan.the(SENSOR), plan.orders
    value = rng.randrange(int(orders.low) + 1, int(orders.high)) + 0.5
    new = plan.having(part.doing(stuck=value), part)
    return new, Truth("never-changes", (part.path, full(part.speaks)))
