"""What the checks of a page say: passed on a solved page, not attempted on an untouched one."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

#: As an outcome comes with its output; see `rosbeat.exercises.cards`.
OUTCOME = "application/vnd.rosbeat.outcome+json"


def wrong_outcome(cell: Any, outputs: Iterable[Any], *, solved: bool) -> str:
    """Say what is wrong with the outcome of a check, or nothing.

    Args:
        cell: The cell that ran; only one that is marked as a check is looked at.
        outputs: Its outputs.
        solved: Whether the page is the solved one.
    """
    exercise = cell.metadata.get("rosbeat", {}).get("check")
    if not exercise:
        return ""
    found = [one["data"][OUTCOME] for one in outputs if OUTCOME in one.get("data", {})]
    wanted = (exercise, "passed" if solved else "not attempted")
    said = [(one["exercise"], one["status"]) for one in found]
    return "" if said == [wanted] else f"The check should say {wanted}, and says {said}"
