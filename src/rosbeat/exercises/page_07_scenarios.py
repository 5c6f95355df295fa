"""Page 07, look inside the graph: findings about a system, limits as parameters, a log watcher."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from rosbeat.exercises.scenarios import feeder, observe, report
from rosbeat.records import Observation, QoS

# 07b: limits that change while the node runs.

TEMPERATURE, FLOAT = "/temperature", "std_msgs/msg/Float32"
#: What is set, half a second before the reading of this number.
CHANGES = ((9, {"high": 24.0}), (13, {"low": 22.0}), (17, {"low": 10.0, "high": 30.0}))
#: One reading a second. Those before the first change, and at each border a reading.
READINGS = (
    *(23.0, 26.0, 26.25, 20.0, 19.75, 25.5, 20.5, 25.0),
    *(25.0, 24.0, 24.25, 21.0),
    *(21.0, 22.0, 23.0, 21.75),
    *(28.0, 15.0, 30.0, 30.25, 10.0, 9.75),
)


def _tune(answer: Any) -> Observation:  # noqa: ANN401 - whatever a learner hands over
    from rosbeat.ros.scenario import SetParameter

    sensor = feeder("temperature_sensor", TEMPERATURE, FLOAT, READINGS)
    steps = [
        SetParameter(second - 0.5, name=name, value=value)
        for second, values in CHANGES
        for name, value in values.items()
    ]
    return observe(answer, len(READINGS) + 0.5, others=[sensor], steps=steps)


# 07c: log lines.

ROSOUT, LOG = "/rosout", "rcl_interfaces/msg/Log"
DEBUG, INFO, WARN, ERROR, FATAL = 10, 20, 30, 40, 50


@dataclass(frozen=True)
class Line:
    """One log line that is fed in.

    Attributes:
        level: Its level, as a number.
        name: The name of who says it.
        msg: What it says.
    """

    level: int
    name: str
    msg: str

    @property
    def fields(self) -> dict[str, object]:
        """Its fields as a message has them."""
        return {"level": self.level, "name": self.name, "msg": self.msg}


#: One a second. Texts say `warning` and `error` where there is none; a name comes twice.
LINES = (
    Line(INFO, "gardener", "The window is shut"),
    Line(WARN, "lamp", "I do not know how bright it is"),
    Line(DEBUG, "weather", "warning: only a test"),
    Line(ERROR, "soil_probe", "The cable is loose"),
    Line(INFO, "window", "No error, no WARN, nothing"),
    Line(WARN, "lamp", "I do not know how bright it is"),
    Line(FATAL, "pump", "No water"),
    Line(DEBUG, "lamp", "12 readings"),
    Line(WARN, "greenhouse.fan", "It is getting loud"),
    Line(ERROR, "lamp", "The bulb is broken"),
    Line(WARN, "lamp", "It is dark now"),
    Line(INFO, "lamp", "A new bulb"),
)


def _log(answer: Any) -> Observation:  # noqa: ANN401
    from rosbeat.ros.scenario import Publish

    steps = [
        Publish(
            second,
            topic=ROSOUT,
            type_name=LOG,
            values=(line.fields,),
            qos=QoS(durability="TRANSIENT_LOCAL", depth=1000),  # as every node's own publisher
        )
        for second, line in enumerate(LINES, 1)
    ]
    return observe(answer, len(LINES) + 0.5, steps=steps)


SCENARIOS: dict[str, Callable[[Any], Any]] = {"07a": report, "07b": _tune, "07c": _log}
