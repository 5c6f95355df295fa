"""The moments of a queue, and the queue in words."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from rosbeat.records import QueueStep
from rosbeat.viz.words import count, ranges, seconds


@dataclass(frozen=True)
class Moment:
    """One column of the picture: a message arrives (and may push one out), or one is taken.

    Attributes:
        time_ns: When, in nanoseconds of virtual time.
        waiting: Numbers of the messages in the queue afterwards, the oldest first.
        arrived: Number of the message that arrived, or 0.
        taken: Number of the message that was taken, or 0.
        dropped: Number of the message that was dropped, or 0.
    """

    time_ns: int
    waiting: tuple[int, ...]
    arrived: int = 0
    taken: int = 0
    dropped: int = 0


def moments(steps: Sequence[QueueStep]) -> list[Moment]:
    """Replay the steps; a drop and the arrival that caused it are one moment."""
    found: list[Moment] = []
    waiting: tuple[int, ...] = ()
    dropped = 0
    for step in steps:
        if step.kind == "arrived":
            waiting = (*waiting, step.number)
            found.append(Moment(step.time_ns, waiting, arrived=step.number, dropped=dropped))
            dropped = 0
            continue
        waiting = tuple(number for number in waiting if number != step.number)
        if step.kind == "taken":
            found.append(Moment(step.time_ns, waiting, taken=step.number))
        else:
            dropped = step.number
    return found


def describe(every: Sequence[Moment], depth: int) -> str:
    """The queue in whole sentences."""
    first, last = seconds(every[0].time_ns), seconds(every[-1].time_ns)
    span = f"at {first}" if first == last else f"from {first} to {last}"
    arrived = sum(one.arrived > 0 for one in every)
    taken = [one.taken for one in every if one.taken]
    dropped = [one.dropped for one in every if one.dropped]
    waiting = every[-1].waiting
    fullest = max(len(one.waiting) for one in every)
    return " ".join(
        (
            f"A queue of depth {depth}, {span}: {count(arrived, 'message')} arrived.",
            _share("was taken", "were taken", taken),
            _share("was dropped", "were dropped", dropped),
            _share("waits at the end", "wait at the end", waiting),
            f"At its fullest the queue held {count(fullest, 'message')}.",
        )
    )


def _share(one: str, many: str, numbers: Sequence[int]) -> str:
    if not numbers:
        return f"None {one}."
    which = f"number {ranges(numbers)}" if len(numbers) == 1 else f"numbers {ranges(numbers)}"
    return f"{len(numbers)} {one if len(numbers) == 1 else many}: {which}."
