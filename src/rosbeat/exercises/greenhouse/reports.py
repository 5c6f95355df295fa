"""Whether the report is the mean of the right readings, at the right times (R6)."""

from __future__ import annotations

from collections.abc import Sequence

from rosbeat.diagnosis.mistakes import Diagnosis
from rosbeat.exercises.greenhouse.days import plain_day
from rosbeat.exercises.greenhouse.reading import EPS, said, silent, stamp
from rosbeat.exercises.greenhouse.trials import Trials

REPORT = "/report"
#: How far a mean may be away, for what a float32 rounds.
_NEAR = 0.02


def judge_reports(trials: Trials) -> Diagnosis | None:
    """R6: a mean, so often, of so many seconds."""
    seen, every = trials.plain, trials.numbers["report_seconds"]
    quiet = silent(seen, REPORT)
    if quiet:
        return quiet
    reports = [(one.time, float(one.value)) for one in said(seen, REPORT)]
    day = plain_day(trials.numbers)
    readings = [value for value in day.temperature if value is not None]
    times = [0.0, *(time for time, _ in reports)]
    return _wrong_times(times, every, seen.time) or _wrong_means(reports, readings, every)


def _wrong_times(times: list[float], every: float, end: float) -> Diagnosis | None:
    for before, time in zip(times, [*times[1:], max(end, times[-1])], strict=True):
        gap, last = time - before, time == max(end, times[-1])
        if gap > every + 1 + EPS or (gap < every - 1 - EPS and not last):
            evidence = f"After {stamp(before)} no report came until {stamp(time)}."
            hint = f"One report every {every:g} s, and the first after {every:g} s."
            return Diagnosis("wrong-rate", evidence, hint)
    return None


def _wrong_means(
    reports: list[tuple[float, float]], readings: Sequence[float], every: float
) -> Diagnosis | None:
    for time, value in reports:
        means = [
            _mean(readings, time - every + shift, time + shift + more)
            for shift in (-1, 0)
            for more in (0, 1)
            if shift + more <= 0
        ] + [_mean(readings, time - every - 1, time)]
        if min(means) - _NEAR <= value <= max(means) + _NEAR:
            continue
        wanted = _mean(readings, time - every, time)
        evidence = (
            f"The report at {stamp(time)} said {value:.2f}; the mean of the last {every:g} s "
            f"was {wanted:.2f}."
        )
        hint = "Which readings are in it? Those of the last report are not."
        return Diagnosis("wrong-window", evidence, hint)
    return None


def _mean(readings: Sequence[float], after: float, until: float) -> float:
    """The mean of the readings after one time and up to another; one came each second."""
    found = [value for at, value in enumerate(readings, 1) if after < at <= until]
    return sum(found) / len(found) if found else 0.0
