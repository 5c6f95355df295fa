"""A function that looks into a bag: given several recordings, and asked what it found in them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import nan
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from rosbeat import bags
from rosbeat.exercises.replays import FLOAT, STRING, seen_in
from rosbeat.exercises.scenarios import Report, report
from rosbeat.records import NANOSECONDS, Sample

#: Times in seconds, and the reading at each. A float32 holds each of these numbers exactly.
Readings = Sequence[tuple[float, float]]
#: The longest gap lies at the beginning, in the middle, at the end, and beside a NaN; NaN stands at
#: the beginning, in the middle and at the end. No number is the same as another by chance.
RECORDINGS: tuple[Readings, ...] = (
    ((3, 21.0), (7.5, 21.5), (8.5, 22.25), (10, 24.0), (11, 22.0)),
    ((1, nan), (2, 20.0), (3, 19.5), (9, nan), (10, 18.25), (12.5, 18.0), (14, 20.75)),
    ((10, 25.5), (10.5, 26.5), (14, 30.0), (15.25, nan)),
    ((2, -4.0), (2.75, 2.5)),
)
#: Another topic in the same bags; of these, as many as `words_beside` says.
_STATUS = ((3, "Normal"), (9.5, "Low"), (10.5, "High"), (11.5, "Normal"))


@dataclass(frozen=True)
class BagReports:
    """What a function found in several recordings.

    Attributes:
        reports: One for each, up to the first that has no result.
    """

    reports: tuple[Report, ...]


def look_into_bags(answer: Any) -> BagReports:  # noqa: ANN401 - whatever a learner hands over
    """Call a function with one bag after the other.

    Args:
        answer: The function.
    """
    found: list[Report] = []
    with TemporaryDirectory(prefix="rosbeat-") as folder:
        for number, readings in enumerate(RECORDINGS):
            bag = bags.record(seen_in(_samples(readings)), Path(folder, f"bag_{number}"))
            found.append(report(answer, bag))
            if not found[-1].result:
                break
    return BagReports(tuple(found))


def words_beside(readings: Readings) -> Sequence[tuple[float, str]]:
    """What is on the other topic: half as many messages as on the first, and one.

    Args:
        readings: Those of the same recording.
    """
    return _STATUS[: len(readings) // 2 + 1]


def _samples(readings: Readings) -> list[Sample]:
    made = [_sample(at, "/temperature", FLOAT, value) for at, value in readings]
    return made + [_sample(at, "/status", STRING, word) for at, word in words_beside(readings)]


def _sample(at: float, topic: str, kind: str, value: Any) -> Sample:  # noqa: ANN401
    return Sample(round(at * NANOSECONDS), topic, kind, "/recorded", {"data": value})
