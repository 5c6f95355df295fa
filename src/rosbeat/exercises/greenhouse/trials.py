"""Running somebody's greenhouse through the weather of every trial.

What is seen is plain data, with the numbers that the weather was made of.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Any

from rosbeat.exercises.greenhouse import days
from rosbeat.exercises.greenhouse.days import USUAL, Day
from rosbeat.exercises.scenarios import (
    adding,
    hearer,
    observe,
    observe_system,
    removing,
    station,
)
from rosbeat.records import Observation, QoS

#: Names of the trials.
PLAIN, BROKEN, LOSSY, OTHER = "plain day", "broken sensors", "ending nodes", "other limits"
#: Names of the sensors, and of who joins late.
SENSORS = ("thermometer", "hygrometer")
LATE_VENT, LATE_PUMP = "late_vent_display", "late_pump_display"
_LATE = QoS(durability="TRANSIENT_LOCAL", depth=1)
_BOOL = "std_msgs/msg/Bool"
#: Faults after which another trial would say nothing new.
_HOPELESS = ("DeadlinePassed", "NoSystemError", "SessionError")


@dataclass(frozen=True)
class Trials:
    """What a greenhouse did in every trial.

    Attributes:
        numbers: The numbers of the rubric, by name.
        runs: What was seen, by the name of the trial; some may be left out if the first one says
            that there is no greenhouse.
    """

    numbers: dict[str, float]
    runs: dict[str, Observation]

    @property
    def plain(self) -> Observation:
        """What was seen on the plain day, which every greenhouse goes through."""
        return self.runs[PLAIN]


def aired(answer: Any, numbers: Mapping[str, float] = USUAL) -> Trials:  # noqa: ANN401
    """Run a vent alone through the first part of the plain day.

    Args:
        answer: What should be a node class.
        numbers: Those of the rubric, by name.
    """
    day = days.airing(numbers)
    sensor = station(SENSORS[0], "temperature", day.temperature)
    return Trials(dict(numbers), {PLAIN: observe(answer, day.seconds, others=[sensor])})


def tried(answer: Any, numbers: Mapping[str, float] = USUAL) -> Trials:  # noqa: ANN401
    """Run a greenhouse through all trials.

    Args:
        answer: What should be a function that returns a list of nodes; see `observe_system`.
        numbers: Those of the rubric, by name.
    """
    day = days.plain_day(numbers)
    late = [
        adding(day.seconds - 1, hearer(LATE_VENT, "vent", _BOOL, _LATE)),
        adding(day.seconds - 1, hearer(LATE_PUMP, "pump", _BOOL, _LATE)),
    ]
    runs = {PLAIN: _run(answer, day, late)}
    if not is_hopeless(runs[PLAIN]):
        lossy = days.lossy_day(numbers)
        runs[BROKEN] = _run(answer, days.broken_day(numbers))
        runs[LOSSY] = _run(answer, lossy, _endings(runs[PLAIN], lossy))
        runs[OTHER] = _run(answer, days.other_day(numbers), parameters=days.other_limits(numbers))
    return Trials(dict(numbers), runs)


def is_hopeless(seen: Observation) -> bool:
    """Whether an observation says that there is no system, or that it stands still."""
    blank = any("'____'" in fault.text for fault in seen.faults)
    others = {f"/{name}" for name in (*SENSORS, LATE_VENT, LATE_PUMP)}
    none = seen.faults and set(seen.graph.nodes) <= others
    return bool(blank or none or any(one.kind in _HOPELESS for one in seen.faults))


def _run(answer: Any, day: Day, steps: Iterable[Any] = (), **options: Any) -> Observation:  # noqa: ANN401
    sensors = [
        station(SENSORS[0], "temperature", day.temperature),
        station(SENSORS[1], "humidity", day.humidity),
    ]
    return observe_system(answer, day.seconds, others=sensors, steps=steps, **options)


def _endings(seen: Observation, day: Day) -> list[Any]:
    """Steps that destroy the nodes of the report, the alarm and the pump, one after the other."""
    return [
        removing(day.marks[f"without {name}"] + 0.5, node)
        for name in ("report", "alarm", "pump")
        for node in sorted({end.node for end in seen.graph.on(f"/{name}", "publisher")})
    ]
