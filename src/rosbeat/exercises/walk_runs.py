"""Random walks between two limits, looked at until they have shown both of their ends.

The walk is driven up, then down, and then left alone (see `ros.test_nodes`). So both limits are
met, and a walk that is still beyond a limit when the drift has turned gives itself away: what is
published was cut off, and what is kept was not. Numbers that the drift does not reach may wander
for long before they meet a limit; then more readings are needed. That is decided here without
knowing the limits: a walk that is held somewhere meets the very same number again and again.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from math import isfinite
from operator import sub
from typing import Any

from rosbeat.exercises.scenarios import drift, observe
from rosbeat.records import Observation

#: Readings while the drift goes in one direction.
PHASE = 600
#: Exponents of the drift: readings tend upwards, downwards, nowhere.
UP, DOWN, FREE = 1 / 3, 3.0, 1.0
#: Readings of a run: drift up, drift down, and then none.
READINGS = 6 * PHASE
#: Further readings without drift; a walk misses a limit in one of 10,000 such runs.
LONG = 8 * READINGS
#: How often a walk meets the very same number at its end if something cuts it off there.
_AGAIN = 5
#: What gets farther than this many of its widest steps has followed the drift, and met no limit.
_FAR = 100
#: Seconds of wall time for a walk that wanders freely; a busy machine needs half of it.
_PATIENCE = 30.0


def watch_walk(answer: Any, topic: str, rate: int) -> Observation:  # noqa: ANN401
    """Run a sensor whose readings walk, until the walk has shown both of its ends.

    Args:
        answer: The class of the node, or what makes it.
        topic: Full name of the topic on which the readings are asked for.
        rate: Readings a second.

    Returns:
        A run of `READINGS` readings; of `READINGS + LONG` if the first ones leave it open where
        the walk ends.
    """
    seen = _run(answer, READINGS, rate)
    values = [sample.value for sample in seen.samples if sample.topic == topic]
    # Without the drift it is a long look, and a busy machine takes its time.
    return _run(answer, READINGS + LONG, rate, deadline=_PATIENCE) if is_open(values) else seen


def _run(answer: Any, readings: int, rate: int, **options: Any) -> Observation:  # noqa: ANN401
    return observe(answer, readings / rate, others=[weather(rate)], seed=3, **options)


def is_open(values: Sequence[Any]) -> bool:
    """Whether a walk of `READINGS` readings may have ends that the drift has not driven it to.

    Args:
        values: What was published, which need not be numbers.
    """
    numbers = [value for value in values if isinstance(value, int | float) and isfinite(value)]
    if len(numbers) != READINGS or len(values) != READINGS:
        return False
    low, high, stride = min(numbers), max(numbers), widest(numbers)
    ends = stays(numbers, low) and stays(numbers, high)
    return not ends and 2 * stride < high - low <= _FAR * stride


def weather(rate: int) -> Callable[[], Any]:
    """The drift, as a node for `observe`.

    Args:
        rate: Readings a second.
    """
    return drift([(PHASE / rate, UP), (PHASE / rate, DOWN), (0, FREE)])


def stays(values: Sequence[float], end: float) -> bool:
    """Whether a walk meets the very same number again and again: something cuts it off there."""
    return sum(one == end for one in values) >= _AGAIN


def widest(values: Sequence[float]) -> float:
    """The widest step between two readings that follow each other; 0 for fewer than two."""
    # With functions of C only: of one walk it is asked several times.
    return max(map(abs, map(sub, values[1:], values)), default=0.0)
