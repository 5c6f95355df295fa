"""What an exercise is."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from rosbeat.checks.verdicts import before_judging
from rosbeat.records import Observation, Outcome


@dataclass(frozen=True)
class Exercise:
    """One exercise.

    Attributes:
        id: Page number and a letter, such as `03a`.
        scenario: Runs an answer and writes down what it did. The only part that runs foreign code.
        judge: A pure function from that to an outcome. It is asked only if the answer has no blank
            left and raised nothing.
    """

    id: str
    scenario: Callable[[Any], Observation]
    judge: Callable[[Observation], Outcome]

    def judged(self, observation: Observation) -> Outcome:
        """The outcome of an observation, blanks and exceptions included."""
        return before_judging(self.id, observation) or self.judge(observation)
