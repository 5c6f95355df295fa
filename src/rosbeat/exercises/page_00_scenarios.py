"""Page 00, hear the heartbeat: a reader among reporters, and a reporter alone."""

from __future__ import annotations

from typing import Any

from rosbeat.exercises.scenarios import feeder, observe
from rosbeat.records import Observation

#: The type of what is published.
STRING = "std_msgs/msg/String"
#: How many articles each reporter publishes, one a second.
ARTICLES = 3
_TOPICS = ("weather", "sports", "politics")


def _among_reporters(answer: Any) -> Observation:  # noqa: ANN401
    reporters = [
        feeder(f"{topic}_reporter", topic, STRING, [f"{topic} {n}" for n in range(ARTICLES)])
        for topic in _TOPICS
    ]
    return observe(answer, 5, others=reporters)


def _alone(answer: Any) -> Observation:  # noqa: ANN401
    return observe(answer, 9)


SCENARIOS = {"00a": _among_reporters, "00b": _alone}
