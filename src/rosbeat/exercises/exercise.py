"""What an exercise is."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Generic, TypeVar

from rosbeat.checks.verdicts import before_judging
from rosbeat.records import Observation, Outcome

Seen = TypeVar("Seen")


@dataclass(frozen=True)
class Exercise(Generic[Seen]):
    """One exercise.

    Attributes:
        id: Page number and a letter, such as `03a`.
        scenario: Runs an answer, or looks at what it left, and writes down what is there as plain
            data. The only part that runs foreign code.
        judge: A pure function from that to an outcome. Of a node it is asked only if the answer has
            no blank left and raised nothing.
    """

    id: str
    scenario: Callable[[Any], Seen]
    judge: Callable[[Seen], Outcome]

    def judged(self, seen: Seen) -> Outcome:
        """The outcome of what was seen; of a node, blanks and exceptions included."""
        early = before_judging(self.id, seen) if isinstance(seen, Observation) else None
        return early or self.judge(seen)
