"""Recordings that are played to an answer, one after the other, and what it did with each."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from typing import Any

from rosbeat import bags
from rosbeat.exercises.scenarios import observe
from rosbeat.records import NANOSECONDS, Observation, Sample

FLOAT, STRING = "std_msgs/msg/Float32", "std_msgs/msg/String"
#: The node that plays a recording, and the one that is said to have made it.
PLAYER, _MAKER = "/replay", "/recorded"
#: How long a run goes on after the last message, in seconds.
_AFTER = 1.0
#: A fault of `rosbeat.bags`: messages in, messages with the fault out.
Change = Callable[[Sequence[Sample]], Sequence[Sample]]


@dataclass(frozen=True)
class Replayed:
    """What an answer did with one recording.

    Attributes:
        recording: What is in the recording, in a few words.
        observation: What happened while it was played.
    """

    recording: str
    observation: Observation

    @property
    def heard(self) -> tuple[Sample, ...]:
        """What was played, in order."""
        return tuple(one for one in self.observation.samples if one.node == PLAYER)


@dataclass(frozen=True)
class Replays:
    """What an answer did with several recordings.

    Attributes:
        runs: One for each recording; the last one is the first in which an exception was raised.
    """

    runs: tuple[Replayed, ...]


@dataclass(frozen=True)
class Recording:
    """A recording to play.

    Attributes:
        words: What is in it, in a few words.
        samples: Its messages.
        faults: What is broken in it on purpose.
    """

    words: str
    samples: tuple[Sample, ...]
    faults: tuple[Change, ...] = ()


def column(
    values: Iterable[Any], topic: str = "/temperature", first: float = 1.0, kind: str = FLOAT
) -> tuple[Sample, ...]:
    """Messages on a topic, one a second.

    Args:
        values: What they hold.
        topic: The topic's full name.
        first: When the first one comes, in seconds.
        kind: The message type.
    """
    begin = round(first * NANOSECONDS)
    return tuple(
        Sample(begin + number * NANOSECONDS, topic, kind, _MAKER, {"data": value})
        for number, value in enumerate(values)
    )


def seen_in(samples: Iterable[Sample]) -> Observation:
    """Messages as what a session has seen, which can be recorded and replayed."""
    ordered = tuple(sorted(samples, key=lambda one: one.time_ns))
    return Observation(max((one.time_ns for one in ordered), default=0), 0, ordered)


def replayed(answer: Any, recordings: Iterable[Recording]) -> Replays:  # noqa: ANN401
    """Play recordings to an answer, each in a session of its own.

    Args:
        answer: What should be a node class.
        recordings: What to play.
    """
    runs: list[Replayed] = []
    for one in recordings:
        seen = seen_in(one.samples)
        player = bags.replay(seen, faults=one.faults, name=PLAYER.strip("/"))
        runs.append(Replayed(one.words, observe(answer, seen.time + _AFTER, others=[player])))
        if runs[-1].observation.faults:
            break
    return Replays(tuple(runs))
