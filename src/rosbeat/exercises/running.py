"""Scenarios of `runtime`, imported when the first one runs.

So judges can be imported, tested and asked where ROS is not installed, and a page that only shows
hints need not wait for it.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from typing import Any

from rosbeat.records import Observation

#: A node, or what makes one; its type is rclpy's, which is not imported here.
Node = Any


def observe(answer: Any, seconds: float, **options: Any) -> Observation:  # noqa: ANN401
    """Run an answer in virtual time; see `rosbeat.runtime.scenario.observe`."""
    from rosbeat.runtime import scenario

    return scenario.observe(answer, seconds, **options)


def feeder(name: str, topic: str, type_name: str, values: Iterable[Any]) -> Callable[[], Node]:
    """A node that publishes one value a second; see `rosbeat.runtime.scenario.feeder`."""
    from rosbeat.runtime import scenario

    return scenario.feeder(name, topic, type_name, values)


def drift(phases: Sequence[tuple[float, float]]) -> Callable[[], Node]:
    """A node that tilts random numbers; see `rosbeat.runtime.drift.drift`."""
    from rosbeat.runtime import drift as module

    return module.drift(phases)
