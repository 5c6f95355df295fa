"""Time spans that a person typed."""

from __future__ import annotations

from math import inf, isfinite
from numbers import Real
from typing import Any

from rosbeat.errors import DurationError
from rosbeat.records import NANOSECONDS

#: About 31 years; a longer span is a slip, and ROS time ends at 2**63 nanoseconds.
LONGEST = 1e9


def duration_ns(seconds: Any, what: str = "run(seconds=...)") -> int:  # noqa: ANN401 - unchecked
    """Seconds as whole nanoseconds.

    Args:
        seconds: A number from 0 to 1e9, in seconds.
        what: The call it was given to, for the error.

    Raises:
        DurationError: If it is not a number, negative, not finite or above 1e9.
    """
    if not isinstance(seconds, Real) or isinstance(seconds, bool):
        kind = type(seconds).__name__
        raise _refusal(f"{what} was given {seconds!r}, which is of type {kind}.")
    try:
        span = float(seconds)
    except OverflowError:
        span = inf
    if not isfinite(span):
        raise _refusal(f"{what} was given {span}.")
    if span < 0:
        raise _refusal(f"{what} was given {span:g}: a negative time.")
    if span > LONGEST:
        raise _refusal(f"{what} was given {span:g}: more than {LONGEST:g} seconds.")
    return round(span * NANOSECONDS)


def _refusal(what: str) -> DurationError:
    return DurationError(
        what,
        "Time in a session only moves forward, by a number of seconds.",
        "Give a number from 0 up, such as 60 for one minute.",
    )
