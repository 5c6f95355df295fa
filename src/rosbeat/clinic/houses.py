"""Draw healthy systems at random: their places, names and nodes."""

from __future__ import annotations

from dataclasses import dataclass, replace
from random import Random

from rosbeat.clinic.plans import (
    DIARY,
    DISPLAY,
    GUARD,
    SENSOR,
    TEACHER,
    Orders,
    Part,
    Plan,
    Wiring,
    full,
)


@dataclass(frozen=True)
class _Theme:
    """A place, and what is measured there, in degrees Celsius."""

    place: str
    prefix: str
    topic: str
    least: float
    low: float
    high: float
    most: float


_THEMES = (
    _Theme("greenhouse", "leaf", "leaf_temperature", 16.0, 18.0, 24.0, 26.0),
    _Theme("aquarium", "water", "water_temperature", 20.0, 23.0, 26.0, 29.0),
    _Theme("wine cellar", "cellar", "cellar_temperature", 8.0, 10.0, 14.0, 17.0),
    _Theme("bakery", "dough", "dough_temperature", 22.0, 24.0, 28.0, 31.0),
    _Theme("server room", "rack", "rack_temperature", 15.0, 18.0, 22.0, 25.0),
    _Theme("museum", "hall", "hall_temperature", 16.0, 19.0, 21.0, 24.0),
    _Theme("library", "shelf", "shelf_temperature", 14.0, 16.0, 20.0, 23.0),
    _Theme("beehive", "comb", "comb_temperature", 30.0, 33.0, 36.0, 39.0),
    _Theme("cheese dairy", "milk", "milk_temperature", 4.0, 6.0, 9.0, 12.0),
    _Theme("stable", "stall", "stall_temperature", 10.0, 12.0, 17.0, 20.0),
    _Theme("paint shop", "booth", "booth_temperature", 18.0, 20.0, 25.0, 28.0),
    _Theme("theatre", "stage", "stage_temperature", 17.0, 19.0, 23.0, 26.0),
    _Theme("swimming pool", "pool", "pool_temperature", 23.0, 25.0, 28.0, 31.0),
    _Theme("seed bank", "vault", "vault_temperature", 2.0, 4.0, 7.0, 10.0),
)
PLACES = tuple(theme.place for theme in _THEMES)
_SENSORS = ("sensor", "probe", "thermometer")
_GUARDS = ("monitor", "guard", "watch")
_DISPLAYS = ("lamp", "display", "panel")
_DIARIES = ("diary", "logger", "notebook")


def house(rng: Random, place: str, *, burst: int = 1) -> Plan:
    """Draw a healthy system: a sensor, a guard, a display, and a diary.

    Args:
        rng: Where chance comes from.
        place: Where it stands, one of `PLACES`.
        burst: How many readings the sensor publishes at once.
    """
    theme = next(one for one in _THEMES if one.place == place)
    name = theme.prefix
    topic, status = theme.topic, f"{name}_status"
    first = rng.randrange(20)
    parts = (
        Part(SENSOR, f"{name}_{rng.choice(_SENSORS)}", speaks=topic, options={"phase": first}),
        Part(GUARD, f"{name}_{rng.choice(_GUARDS)}", listens=topic, speaks=status),
        Part(DISPLAY, f"{name}_{rng.choice(_DISPLAYS)}", listens=status),
        Part(DIARY, f"{name}_{rng.choice(_DIARIES)}", listens=topic),
    )
    # Sixty readings, so that every reading between the limits comes, up and down.
    period = float(burst) if burst > 1 else rng.choice((0.5, 1.0))
    orders = Orders(
        full(topic), theme.low, theme.high, theme.least, theme.most, period=period, burst=burst
    )
    return ordered(Plan(f"the {place}", "temperature", orders, parts))


def ordered(plan: Plan) -> Plan:
    """Return the plan with its current wiring as the owner's specification."""
    return replace(plan, orders=replace(plan.orders, wiring=wiring(plan)))


def wiring(plan: Plan) -> tuple[Wiring, ...]:
    """Return the publishers and subscriptions that the nodes' code creates."""
    found = []
    for part in plan.parts:
        if part.speaks:
            once = part.role == TEACHER
            found.append(Wiring(part.path, "publisher", full(part.speaks), once))
        if part.listens:
            found.append(Wiring(part.path, "subscription", full(part.listens)))
    return tuple(found)


def with_humidity(plan: Plan) -> Plan:
    """Return the house with a second sensor, which measures the humidity of the air."""
    name = plan.the(SENSOR).name.partition("_")[0]
    extra = Part(
        SENSOR,
        f"{name}_hygrometer",
        speaks=f"{name}_humidity",
        options={"least": 40.0, "most": 70.0, "step": 1.0, "period": 2.0, "phase": 9},
    )
    return ordered(plan.also(extra))


def with_teacher(plan: Plan) -> Plan:
    """Return the house with a node that publishes the rule once, and a display that shows it."""
    name = plan.the(SENSOR).name.partition("_")[0]
    new = plan.also(Part(TEACHER, f"{name}_rules", speaks=f"{name}_rule"))
    return ordered(new.also(Part(DISPLAY, f"{name}_plate", listens=f"{name}_rule")))
