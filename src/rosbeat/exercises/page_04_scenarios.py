"""Page 04, write a subscriber: a node that is fed with readings, one a second."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Any

from rosbeat.exercises.scenarios import feeder, observe
from rosbeat.records import Observation

#: Name of the node that publishes the readings, their topic, and their type.
SENSOR, TOPIC, FLOAT = "temperature_sensor", "/temperature", "std_msgs/msg/Float32"
# A float32 holds each of these numbers exactly.
#: Readings of 04a: beyond each border, at it, and as near to it as is told apart.
FRIDGE = (
    *(5.0, 9.5, 12.5, 100.0, 7.75, 8.0, 8.015625, 7.984375, 2.25, 2.0, 1.984375, 2.015625),
    -18.0,
)
#: Readings of 04b: just inside of a limit, at it, and just outside.
ROOM = (22.0, 27.5, 25.5, 26.0, 26.015625, 100.0, 28.25, 20.5, 20.0, 19.984375, 19.75, -5.0)
#: Readings of 04c: every border of a status with hysteresis, from both sides, and jumps across.
CALM = (
    *(22.0, 25.5, 20.5, 26.0, 26.015625, 25.5, 26.25, 25.0, 24.984375, 25.5, 20.0, 19.984375),
    *(20.5, 21.0, 21.015625, 20.5, 41.0, -3.5, 30.0, 23.0, 19.0, 25.5, 27.0, 20.5),
)


def _fed(values: Iterable[float]) -> Callable[[Any], Observation]:
    readings = list(values)

    def run(answer: Any) -> Observation:  # noqa: ANN401
        sensor = feeder(SENSOR, TOPIC, FLOAT, readings)
        return observe(answer, len(readings) + 1, others=[sensor])

    return run


SCENARIOS = {"04a": _fed(FRIDGE), "04b": _fed(ROOM), "04c": _fed(CALM)}
