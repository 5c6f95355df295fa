"""What an exercise is."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any, Generic, TypeVar

from rosbeat.checks.verdicts import PASSED, before_judging
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
        title: What it is about, a few words, such as `another sensor`.
        points: What a right answer is worth.
        hints: What `hint` gives, one more each time, from general to exact. The answer itself is
            not among them; `hint` gives it last.
        given: Makes what the scenario is handed besides an answer, by name, as plain data: what it
            needs where neither this room nor any file of an instructor's can be read.
        tells_hints: Whether a check says how many hints were used. They cost nothing.
    """

    id: str
    scenario: Callable[[Any], Seen]
    judge: Callable[[Seen], Outcome]
    title: str = ""
    points: int = 1
    hints: tuple[str, ...] = ()
    given: Callable[[], dict[str, Any]] = dict
    tells_hints: bool = False

    def judged(self, seen: Seen) -> Outcome:
        """The outcome of what was seen, with its points; blanks and exceptions included."""
        early = before_judging(self.id, seen) if isinstance(seen, Observation) else None
        outcome = early or self.judge(seen)
        reached = self.points if outcome.status == PASSED else 0
        if outcome.parts:  # points for each requirement, whether the whole is right or not
            reached = sum(part.points for part in outcome.parts)
        return replace(outcome, points=reached, out_of=self.points)
