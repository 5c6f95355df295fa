"""The calm monitor: a mean of the last five readings, and a status that does not flicker.

Pure functions from what a node published to an outcome.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from rosbeat.diagnosis.mistakes import Diagnosis
from rosbeat.diagnosis.wires import Wire
from rosbeat.exercises.exercise import failed_by, passed
from rosbeat.exercises.model import missing, on
from rosbeat.records import Observation, Outcome

MEAN = Wire("/mean", "std_msgs/msg/Float32")
STATUS = Wire("/status", "std_msgs/msg/String")

_OF_WHAT = " Is the status found from the reading itself, and not from the mean?"
_WINDOW = 5
_START = "Normal"
_WORDS = ("High", "Low", "Normal")
_HIGH, _LOW, _BACK_FROM_HIGH, _BACK_FROM_LOW = 26.0, 20.0, 25.0, 21.0
#: A mean has gone through 32 bits.
_ROUNDING = 1e-3


def judge_calm(exercise: str, observation: Observation, readings: Sequence[float]) -> Outcome:
    """Judge a monitor with a running mean and a hysteresis.

    Args:
        exercise: The exercise's id.
        observation: What the node did.
        readings: What it was fed, one a second, the first at 1 s.
    """
    wrong = _missing(observation, MEAN) or _means(observation, readings)
    wrong = wrong or _missing(observation, STATUS) or _statuses(observation, readings)
    if wrong:
        return failed_by(exercise, wrong)
    changes = len(on(observation, STATUS))
    return passed(exercise, f"{len(readings)} readings, as many means, {changes} changes.")


def _missing(observation: Observation, wire: Wire) -> Diagnosis | None:
    silent = Diagnosis(
        "never-published",
        "Readings arrived, and nothing was published on {topic}.",
        "Does the callback come to the line that publishes?" + _OF_WHAT * (wire == STATUS),
    )
    return missing(observation, wire, (MEAN.topic, STATUS.topic), silent)


# The mean.


def _mean(values: Sequence[float]) -> float:
    return sum(values) / len(values)


def _means(observation: Observation, readings: Sequence[float]) -> Diagnosis | None:
    found = {sample.time: float(sample.value) for sample in on(observation, MEAN)}
    wanted = {
        float(second): _mean(readings[max(0, second - _WINDOW) : second])
        for second in range(1, len(readings) + 1)
    }
    count = len(on(observation, MEAN))
    if sorted(found) != sorted(wanted) or count != len(wanted):
        first = next((second for second in wanted if second not in found), None)
        late = f" The first one that is missing is for reading {first:g}." if first else ""
        return Diagnosis(
            "wrong-rate",
            f"{len(wanted)} readings arrived, and {count} means were published.{late}",
            "Publish one mean for each reading, also while there are fewer than five.",
        )
    off = [second for second in wanted if not abs(found[second] - wanted[second]) < _ROUNDING]
    return _wrong_mean(found, readings, off[0]) if off else None


def _wrong_mean(found: dict[float, float], readings: Sequence[float], at: float) -> Diagnosis:
    second = round(at)
    evidence = (
        f"After {_counted(second)}, {_listed(readings[:second][-6:], second > 6)}, the mean was "
        f"{found[at]:.3f}; of the last five it is {_mean(readings[:second][-_WINDOW:]):.3f}."
    )
    return Diagnosis("wrong-window", evidence, _window_hint(found, readings))


def _window_hint(found: dict[float, float], readings: Sequence[float]) -> str:
    """Which other mean it is: one that fits all that was published."""
    others: list[tuple[Callable[[int], float], str]] = [
        (lambda n: _mean(readings[:n]), "It is the mean of all readings so far."),
        (lambda n: readings[n - 1], "It is the last reading alone."),
        (
            lambda n: sum(readings[max(0, n - _WINDOW) : n]) / _WINDOW,
            "While there are fewer than five, divide by how many there are.",
        ),
        (
            lambda n: _mean(readings[max(0, n - 1 - _WINDOW) : n - 1] or [0.0]),
            "The newest reading is not in it. Which comes first, to keep it or to calculate?",
        ),
    ]
    for width in (2, 3, 4, 6, 7, 8, 10):
        others.append((_last(readings, width), f"It is the mean of the last {width} readings."))
    for mean, hint in others:
        if all(abs(mean(round(at)) - value) < _ROUNDING for at, value in found.items()):
            return f"{hint} The last five count."
    return "The sum of the last five, divided by how many they are. Print both to compare."


def _last(readings: Sequence[float], width: int) -> Callable[[int], float]:
    return lambda n: _mean(readings[max(0, n - width) : n])


def _counted(number: int) -> str:
    return "1 reading" if number == 1 else f"{number} readings"


def _listed(values: Sequence[float], more: bool) -> str:
    return ("..., " if more else "") + ", ".join(f"{value:g}" for value in values)


# The status.


@dataclass(frozen=True)
class _Change:
    second: float
    word: str


def _calm(readings: Sequence[float]) -> list[str]:
    """The status after each reading."""
    status, found = _START, []
    for value in readings:
        back = (status == "High" and value < _BACK_FROM_HIGH) or (
            status == "Low" and value > _BACK_FROM_LOW
        )
        status = _plain(value) if back or _plain(value) != _START else status
        found.append(status)
    return found


def _plain(value: float) -> str:
    return "High" if value > _HIGH else "Low" if value < _LOW else _START


def _statuses(observation: Observation, readings: Sequence[float]) -> Diagnosis | None:
    changes = [_Change(one.time, str(one.value).strip()) for one in on(observation, STATUS)]
    strange = next((one for one in changes if one.word.capitalize() not in _WORDS), None)
    if strange:
        return Diagnosis(
            "wrong-state",
            f"On /status appeared {strange.word!r}.",
            "The status is one word: High, Low or Normal, and nothing else.",
        )
    held = _held(changes, len(readings))
    if [one.lower() for one in held] != [one.lower() for one in _calm(readings)]:
        return _wrong_status(held, readings)
    return _repeated(changes) or _extra(changes, readings)


def _held(changes: Sequence[_Change], count: int) -> list[str]:
    """The status that counts after each reading: the last one that was published."""
    found = []
    for second in range(1, count + 1):
        said = [one.word.capitalize() for one in changes if one.second <= second]
        found.append(said[-1] if said else _START)
    return found


def _wrong_status(held: Sequence[str], readings: Sequence[float]) -> Diagnosis:
    wanted = _calm(readings)
    at = next(n for n in range(len(readings)) if held[n] != wanted[n])
    value, before = readings[at], wanted[at - 1] if at else _START
    evidence = (
        f"The status was {before}, then came a reading of {value:g}, and then it was {held[at]}."
    )
    if list(held) == [_plain(one) for one in readings]:
        hint = f"Back to {_START} only below 25 or above 21: what counts is also what was before."
        return Diagnosis("no-hysteresis", evidence, hint)
    if value in (_HIGH, _LOW, _BACK_FROM_HIGH, _BACK_FROM_LOW):
        hint = f"Exactly {value:g} changes nothing: above and below leave the limit out."
        return Diagnosis("boundary", evidence, hint)
    return _lost_or_wrong(held[at], wanted[at], before, evidence)


def _lost_or_wrong(held: str, wanted: str, before: str, evidence: str) -> Diagnosis:
    if held == before and wanted == _START:
        hint = "It has come far enough back. From High that is below 25, from Low above 21."
        return Diagnosis("hysteresis-lost", evidence, hint)
    if held == _START and wanted == before:
        hint = "It has not come far enough back: from High that is below 25, from Low above 21."
        return Diagnosis("no-hysteresis", evidence, hint)
    hint = f"It should be {wanted}. Follow your conditions from top to bottom with this reading."
    return Diagnosis("wrong-state", evidence, hint)


def _repeated(changes: Sequence[_Change]) -> Diagnosis | None:
    before = _START
    for one in changes:
        if one.word.capitalize() == before:
            return Diagnosis(
                "status-repeated",
                f"At {one.second:g} s the status {before} was published, and it was {before} "
                "before.",
                "Compare the new status with the old one, and publish only a change. It begins as "
                "Normal, and nobody has to be told that.",
            )
        before = one.word.capitalize()
    return None


def _extra(changes: Sequence[_Change], readings: Sequence[float]) -> Diagnosis | None:
    """A status that was published although no reading asked for it: a stop on the way."""
    wanted = list(zip(range(1, len(readings) + 1), _calm(readings), strict=True))
    for one in changes:
        if (one.second, one.word.capitalize()) not in wanted:
            return Diagnosis(
                "wrong-state",
                f"At {one.second:g} s the status {one.word} was published as well.",
                "One reading, one status: find it first, and publish it then, if it is new.",
            )
    return None
