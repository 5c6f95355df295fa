"""How far somebody is with one exercise, as plain data."""

from __future__ import annotations

from dataclasses import asdict, dataclass, replace
from typing import Any

from rosbeat.checks.verdicts import FAILED, NOT_ATTEMPTED, PASSED
from rosbeat.errors import RecordError
from rosbeat.records import Outcome


@dataclass(frozen=True)
class Standing:
    """How far somebody is with one exercise.

    Attributes:
        outcome: What the last check said: `passed`, `failed` or `not attempted`.
        passed: Whether any check so far said `passed`.
        points: The most points that a check gave.
        attempts: How many checks found an answer, right or wrong.
        hints: How many hints were shown.
        answer: Whether the answer was shown.
        mistake: Id of the last mistake, or an empty text.
    """

    outcome: str = NOT_ATTEMPTED
    passed: bool = False
    points: int = 0
    attempts: int = 0
    hints: int = 0
    answer: bool = False
    mistake: str = ""

    @property
    def status(self) -> str:
        """The best that is known: who has passed once has passed."""
        if self.passed:
            return PASSED
        return FAILED if self.attempts else NOT_ATTEMPTED

    def after(self, outcome: Outcome) -> Standing:
        """Return the standing after one more check.

        Args:
            outcome: What the check said.
        """
        return replace(
            self,
            outcome=outcome.status,
            passed=self.passed or outcome.status == PASSED,
            points=max(self.points, outcome.points),
            attempts=self.attempts + (outcome.status != NOT_ATTEMPTED),
            mistake=outcome.mistake or self.mistake,
        )

    def as_dict(self) -> dict[str, Any]:
        """The standing as it is written into a file."""
        return asdict(self)


def parse_standing(data: object) -> Standing:
    """Read a standing back; what a later version added is left out.

    Args:
        data: What `as_dict` gave, from a file that anybody may have edited.

    Raises:
        RecordError: If it is not such a thing.
    """
    if not isinstance(data, dict):
        raise _not_a_standing(data)
    start = Standing()
    known = {key: data[key] for key in start.as_dict() if key in data}
    for key, value in known.items():
        kind = type(getattr(start, key))
        if type(value) is not kind or (kind is int and value < 0):
            raise _not_a_standing(f"{key}: {value!r}")
    return Standing(**known)


def _not_a_standing(found: object) -> RecordError:
    return RecordError(
        f"This says nothing about an exercise: {str(found)[:100]}.",
        "The file of your progress holds something that the course did not write.",
        "Run the check again.",
    )
