"""Page 12, beyond topics: a threshold behind a service, checked parameters, an action."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

from rosbeat.exercises.heating_run import heat
from rosbeat.exercises.scenarios import feeder, observe
from rosbeat.records import Observation

FLOAT, BASIC = "std_msgs/msg/Float32", "test_msgs/srv/BasicTypes"
SERVICE = "/set_high"
_NAN, _INF = float("nan"), float("inf")

#: The limits that are asked for, and the readings that are fed then; nothing is asked for at first.
Request = tuple[dict[str, float], tuple[float, ...]]
BY_SERVICE: tuple[Request, ...] = (
    ({}, (25.0, 26.5, 26.0)),
    ({"high": 24.0}, (25.0, 24.0, 23.0)),
    ({"high": 60.0}, (25.0, 23.0)),
    ({"high": _NAN}, (25.0, 23.0)),
    ({"high": -5.0}, (23.0, 25.0)),
    ({"high": 10.0}, (11.0, 9.5)),
    ({"high": 40.0}, (39.0, 41.0)),
    ({"high": 40.25}, (40.125, 39.0)),
    ({"high": 9.75}, (40.125, 39.0)),
    ({"high": _INF}, (41.0, 39.0)),
    ({"high": 22.5}, (22.75, 22.25)),
)
BY_PARAMETER: tuple[Request, ...] = (
    ({}, (25.0, 26.5, 19.5)),
    ({"high": 24.0}, (25.0, 23.0, 19.5)),
    ({"high": 19.0}, (22.0, 25.0, 19.5)),
    ({"high": 20.0}, (22.0, 25.0)),
    ({"low": 24.5}, (24.25, 22.0, 19.5)),
    ({"low": 24.0}, (23.0, 25.0)),
    ({"low": 22.0}, (21.0, 23.0, 25.0)),
    ({"low": 28.0, "high": 30.0}, (27.0, 29.0, 31.0)),
    ({"high": 8.0, "low": 5.0}, (9.0, 7.0, 4.0)),
    ({"low": 9.0, "high": 6.0}, (7.0, 10.0, 4.0)),
    ({"high": 5.5}, (5.25, 5.75, 4.0)),
    ({"high": _NAN}, (5.25, 5.75)),
)


def readings_of(requests: Sequence[Request]) -> list[float]:
    """Everything that is fed, one a second.

    Args:
        requests: The requests, in order.
    """
    return [reading for _, readings in requests for reading in readings]


def request_times(requests: Sequence[Request]) -> list[float]:
    """When each request is made: half a second before its first reading.

    Args:
        requests: The requests, in order; the first stands for the beginning.
    """
    times, second = [], 0.5
    for _, readings in requests:
        times.append(second)
        second += len(readings)
    return times


def _asked(answer: Any, requests: Sequence[Request], step: Callable[..., Any]) -> Observation:  # noqa: ANN401
    """Run an answer that is fed readings and gets requests between them."""
    times, readings = request_times(requests), readings_of(requests)
    steps = [step(at, values) for at, (values, _) in zip(times, requests, strict=True) if values]
    sensor = feeder("temperature_sensor", "temperature", FLOAT, readings)
    return observe(answer, len(readings) + 1, others=[sensor], steps=steps)


def _by_service(answer: Any) -> Observation:  # noqa: ANN401 - whatever a learner hands over
    from rosbeat.ros.scenario import Call

    def call(at: float, values: dict[str, float]) -> Call:
        name = SERVICE.strip("/")
        return Call(at, service=name, type_name=BASIC, values={"float32_value": values["high"]})

    return _asked(answer, BY_SERVICE, call)


def _by_parameter(answer: Any) -> Observation:  # noqa: ANN401
    from rosbeat.ros.scenario import SetParameters

    return _asked(answer, BY_PARAMETER, lambda at, values: SetParameters(at, values=values))


SCENARIOS: dict[str, Callable[[Any], Any]] = {
    "12a": _by_service,
    "12b": _by_parameter,
    "12c": heat,
}
