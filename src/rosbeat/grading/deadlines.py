"""A deadline, as a person types it."""

from __future__ import annotations

from datetime import datetime, time

from rosbeat.errors import GradingError
from rosbeat.grading.remarks import printable


def read_due(text: str) -> float:
    """Read a deadline.

    Args:
        text: A day, which ends at midnight, or a day and a time, such as `2026-11-30 18:00`; in the
            time zone of this computer unless it names another, as in `2026-11-30 18:00+01:00`.

    Returns:
        Seconds since 1970; what is newer is late.

    Raises:
        GradingError: If it is no such thing.
    """
    text = text.strip()
    try:
        found = datetime.fromisoformat(f"{text[:-1]}+00:00" if text.endswith("Z") else text)
        if len(text) <= len("2026-11-30"):
            found = datetime.combine(found, time(23, 59, 59, 999_999))
        return found.timestamp()
    except (ValueError, OverflowError, OSError):
        raise GradingError(
            f"{printable(text)!r} is no day and no time.",
            "Files that were changed after the deadline are marked as late, so it has to be exact.",
            'Write a day, or a day and a time:  --due "2026-11-30 18:00"',
        ) from None
