"""Page 03, write a publisher: a node alone, and walks between two limits."""

from __future__ import annotations

from typing import Any

from rosbeat.exercises.scenarios import observe
from rosbeat.exercises.walk_runs import watch_walk
from rosbeat.records import Observation

#: Seconds to look at a beat.
SECONDS = 5
#: Topics of the two walks, and how many readings a second are asked for on the second one.
ROOM, GREENHOUSE = "/temperature", "/greenhouse/temperature"
GREENHOUSE_RATE = 4


def _five_seconds(answer: Any) -> Observation:  # noqa: ANN401
    return observe(answer, SECONDS)


def _in_a_room(answer: Any) -> Observation:  # noqa: ANN401
    return watch_walk(answer, ROOM, 1)


def _in_a_greenhouse(answer: Any) -> Observation:  # noqa: ANN401
    return watch_walk(answer, GREENHOUSE, GREENHOUSE_RATE)


SCENARIOS = {"03a": _five_seconds, "03b": _in_a_room, "03c": _in_a_greenhouse}
