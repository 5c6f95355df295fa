"""Page 09, test the five claims: a silence noticed, work beside a beat, a monitor for any place."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any

from rosbeat.exercises.scenarios import feeder, observe, started
from rosbeat.records import Observation

FLOAT, INT = "std_msgs/msg/Float32", "std_msgs/msg/Int32"

# 09a: readings with silences between them.

TEMPERATURE = "/temperature"
#: When readings come: late at first, then with pauses too short to count, and two silences.
READINGS = (5.25, 6.25, 7.25, 10.0, 11.0, 12.0, 20.0, 21.0, 23.5, 31.0, 32.0, 34.5)


def _silenced(answer: Any) -> Observation:  # noqa: ANN401 - whatever a learner hands over
    from rosbeat.ros.scenario import Publish

    steps = [Publish(at, topic=TEMPERATURE, type_name=FLOAT, values=(22.0,)) for at in READINGS]
    return observe(answer, READINGS[-1] + 2, steps=steps)


# 09b: orders.

ORDER = "/order"
#: When orders come, and their numbers: one while another is worked on, then three at once.
ORDERS = ((2.5, 7), (4.75, 3), (12.5, 12), (12.5, 5), (12.5, 9))
_WATCHED = 29.0


def _ordered(answer: Any) -> Observation:  # noqa: ANN401
    from rosbeat.ros.scenario import Publish

    steps = [Publish(at, topic=ORDER, type_name=INT, values=(number,)) for at, number in ORDERS]
    return observe(answer, _WATCHED, steps=steps)


# 09c: three places at once.


@dataclass(frozen=True)
class Start:
    """How a monitor is started somewhere, and what it is fed there.

    Attributes:
        topic: Full name of the topic on which readings come.
        readings: What they are, one a second, the first at 1 s.
        arguments: How the node is started, as in `Session.add`; empty for the plain class.
    """

    topic: str
    readings: tuple[float, ...]
    arguments: Mapping[str, Any] = field(default_factory=dict)


#: Readings at the limits of a place, just outside, and between the limits of the others. A float32
#: holds each of the numbers at a limit exactly.
HOME = Start("/reading", (22.0, 27.5, 26.0, 26.015625, 25.5, 20.0, 19.984375, 12.5, 20.5, 55.0))
GREENHOUSE = Start(
    "/greenhouse/humidity",
    (55.0, 72.5, 70.0, 70.015625, 40.0, 39.984375, 22.0, 27.5, 65.5, 30.5),
    {
        "name": "humidity_monitor",
        "namespace": "greenhouse",
        "remappings": {"reading": "humidity"},
        "parameters": {"low": 40.0, "high": 70.0, "unit": "%"},
    },
)
PORCH = Start(
    "/porch/reading",
    (300.0, 810.5, 800.0, 19.5, 20.0, 27.5, 65.5, 12.0, 900.5, 400.0),
    {
        "name": "light_monitor",
        "namespace": "porch",
        "remappings": {"status": "light"},
        "parameters": {"high": 800.0, "unit": "lx"},
    },
)


def _everywhere(answer: Any) -> Observation:  # noqa: ANN401
    """Start an answer in three places at once; the one without arguments is looked at."""
    feeds = [
        feeder(f"sensor_{number}", one.topic, FLOAT, one.readings)
        for number, one in enumerate((HOME, GREENHOUSE, PORCH), 1)
    ]
    elsewhere = [started(answer, **one.arguments) for one in (GREENHOUSE, PORCH)]
    return observe(answer, len(HOME.readings) + 1, others=[*feeds, *elsewhere])


SCENARIOS: dict[str, Callable[[Any], Any]] = {
    "09a": _silenced,
    "09b": _ordered,
    "09c": _everywhere,
}
