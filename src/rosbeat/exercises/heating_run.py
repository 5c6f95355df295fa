"""The goals that a thermostat is sent in its check, and the room that it heats."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from rosbeat.exercises.scenarios import observe
from rosbeat.records import Observation

TYPE = "test_msgs/action/Fibonacci"
#: Where the room begins.
START = 18
_SECONDS = 38


@dataclass(frozen=True)
class Goal:
    """One goal that is sent.

    Attributes:
        at: When.
        order: The target.
        cancel_after: When it is canceled; None for never.
    """

    at: float
    order: int
    cancel_after: float | None = None


#: One to warm up, one that is canceled, three out of reach, a cold one, and one more.
GOALS = (
    Goal(2.5, 22),
    Goal(10.5, 26, cancel_after=2.0),
    Goal(16.5, 99),
    Goal(18.5, 9),
    Goal(20.5, 27),
    Goal(22.5, 10),
    Goal(27.5, 26),
)


def heat(answer: Any) -> Observation:  # noqa: ANN401 - whatever a learner hands over
    """Run a thermostat in a room, and send it goals.

    Args:
        answer: What should be a node class.
    """
    from rosbeat.ros.scenario import SendGoal
    from rosbeat.ros.test_nodes import Room

    steps = [
        SendGoal(
            one.at, action="heat", type_name=TYPE, goal={"order": one.order},
            cancel_after=one.cancel_after,
        )
        for one in GOALS
    ]  # fmt: skip
    return observe(answer, _SECONDS, others=[lambda: Room(START)], steps=steps)
