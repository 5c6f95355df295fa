"""Page 08, tune quality of service: the last word waits, listen to everybody, silence is news."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

from rosbeat.exercises.scenarios import feeder, hearer, observe
from rosbeat.records import NANOSECONDS, Observation, QoS

FLOAT, STRING = "std_msgs/msg/Float32", "std_msgs/msg/String"

# 08a: displays that come at different times.

COMMAND, MODE = "/command", "/mode"


@dataclass(frozen=True)
class Display:
    """Somebody who wants to know the mode.

    Attributes:
        name: The name of its node.
        joins: When it comes, in seconds.
        qos: What it asks for.
    """

    name: str
    joins: float
    qos: QoS = field(default_factory=QoS)


#: Commands for the mode that there is are among them, the very first one too, and modes come back.
COMMANDS = (
    *((0.75, "idle"), (1.0, "drive"), (2.0, "drive"), (3.0, "stop"), (5.0, "idle")),
    *((6.0, "dock"), (7.0, "drive")),
)
_ONE_STORED = QoS(depth=1, durability="TRANSIENT_LOCAL")
_TEN_STORED = QoS(depth=10, durability="TRANSIENT_LOCAL")
DISPLAYS = (
    Display("display_from_the_start", 0.0, _ONE_STORED),
    Display("display_after_the_first_mode", 0.5, _TEN_STORED),
    Display("display_of_what_is_new", 2.5, QoS(depth=10)),
    Display("display_in_between", 2.5, _TEN_STORED),
    Display("display_of_one_word", 4.0, _ONE_STORED),
    Display("display_that_is_in_no_hurry", 4.0, QoS("BEST_EFFORT", depth=5)),
    Display("display_at_the_end", 28.0, _TEN_STORED),
)
_END_OF_COMMANDS = 30.0


def _keep(answer: Any) -> Observation:  # noqa: ANN401 - whatever a learner hands over
    from rosbeat.ros.scenario import Add, Publish

    steps = [Publish(at, topic=COMMAND, type_name=STRING, values=(word,)) for at, word in COMMANDS]
    late = [Add(one.joins, make=_display(one)) for one in DISPLAYS if one.joins]
    others = [_display(one) for one in DISPLAYS if not one.joins]
    return observe(answer, _END_OF_COMMANDS, others=others, steps=[*steps, *late])


def _display(display: Display) -> Any:  # noqa: ANN401 - makes a node
    return hearer(display.name, MODE, STRING, display.qos)


# 08b: two sensors, and a node that is away for a while.

READING = "/reading"
#: What the two sensors publish, once a second each: no number twice, and none follows from another.
#: A float32 holds each of them exactly.
READINGS = {
    "/new_sensor": tuple(20.0 + number * number % 61 / 8 for number in range(20)),
    "/old_sensor": tuple(40.0 + number / 8 for number in range(20)),
}
_QUALITIES = {"/new_sensor": QoS("BEST_EFFORT", depth=5), "/old_sensor": QoS(depth=5)}
_AWAY = (5.5, 13.5)


def _archive(answer: Any) -> Observation:  # noqa: ANN401
    from rosbeat.ros.scenario import Pause, Resume

    sensors = [
        feeder(name.strip("/"), READING, FLOAT, values, qos=_QUALITIES[name])
        for name, values in READINGS.items()
    ]
    steps = [Pause(_AWAY[0]), Resume(_AWAY[1])]
    return observe(answer, 21.0, others=sensors, steps=steps)


# 08c: readings that stop for a while.

TEMPERATURE = "/temperature"
#: The deadline that the sensor offers, in seconds: no longer silence is none.
LIMIT = 2.0
#: Readings a second apart, or nearly two; a long silence, a short one, and one to the end.
TIMES = (1.0, 2.0, 3.0, 4.75, 6.0, 13.5, 14.5, 15.5, 18.0)
_END_OF_SILENCE = 25.0


def _watch(answer: Any) -> Observation:  # noqa: ANN401
    from rosbeat.ros.scenario import Publish

    qos = QoS(deadline_ns=round(LIMIT * NANOSECONDS))
    steps = [Publish(at, topic=TEMPERATURE, values=(21.5,), qos=qos) for at in TIMES]
    return observe(answer, _END_OF_SILENCE, steps=steps)


SCENARIOS: dict[str, Callable[[Any], Any]] = {"08a": _keep, "08b": _archive, "08c": _watch}
