"""Whether a reading that cannot be changes nothing (R5)."""

from __future__ import annotations

from collections.abc import Mapping
from math import isfinite

from rosbeat.diagnosis.mistakes import Diagnosis
from rosbeat.exercises.greenhouse.days import air, broken_day
from rosbeat.exercises.greenhouse.reading import EPS, said, silent, stamp, switch
from rosbeat.exercises.greenhouse.reports import judge_reports
from rosbeat.exercises.greenhouse.trials import BROKEN, Trials
from rosbeat.records import Observation

_HINT = "Who looks whether a reading can be, before anybody else uses it?"


def judge_belief(trials: Trials) -> Diagnosis | None:
    """R5: nonsense moves no actuator and no mean."""
    seen, n = trials.runs[BROKEN], trials.numbers
    marks, react = broken_day(n).marks, n["react_seconds"]
    for topic in ("/vent", "/pump", "/report"):
        quiet = silent(seen, topic)
        if quiet:
            return quiet
    some = air(n)
    # A report that is wrong on a plain day, too, is another matter.
    return (
        _vent(seen, marks["hot"], marks["cool"], react)
        or _pump(seen, marks["dry"], react)
        or (None if judge_reports(trials) else _report(seen, n, (some.cold - 1, some.hot + 1)))
    )


def _vent(seen: Observation, hot: float, cool: float, react: float) -> Diagnosis | None:
    spans = switch(seen, "/vent").spans(seen.time)
    if not spans or not hot - EPS <= spans[0][0] <= hot + react + EPS:
        evidence = f"It was hot from {stamp(hot)} on, and the vent did not open then."
        return Diagnosis("never-switched-on", evidence, "Let the vent work first.")
    closed = spans[0][1]
    if closed < cool - EPS:
        evidence = f"The vent was closed at {stamp(closed)}, by a reading that cannot be."
        return Diagnosis("nonsense-believed", evidence, _HINT)
    if closed > cool + react + EPS:
        evidence = f"It was cool from {stamp(cool)} on, and the vent stayed open."
        hint = "What remains of a NaN or of infinity in what the node calculates?"
        return Diagnosis("nonsense-believed", evidence, hint)
    if len(spans) > 1:
        evidence = f"The vent was opened at {stamp(spans[1][0])}, by a reading that cannot be."
        return Diagnosis("nonsense-believed", evidence, _HINT)
    return None


def _pump(seen: Observation, dry: float, react: float) -> Diagnosis | None:
    begins = [begin for begin, _ in switch(seen, "/pump").spans(seen.time)]
    if begins and begins[0] < dry - EPS:
        evidence = f"The pump was started at {stamp(begins[0])}, by a reading that cannot be."
        return Diagnosis("nonsense-believed", evidence, _HINT)
    if begins and begins[0] <= dry + react + EPS:
        return None
    evidence = f"After some humidities that cannot be, it was dry at {stamp(dry)}, and no pump ran."
    hint = "The next reading that can be counts again."
    return Diagnosis("never-switched-on", evidence, hint)


def _report(
    seen: Observation, n: Mapping[str, float], span: tuple[float, float]
) -> Diagnosis | None:
    temperatures = list(enumerate(broken_day(n).temperature, 1))
    for one in said(seen, "/report"):
        value, since = float(one.value), one.time - n["report_seconds"] - 1
        if not any(since < at <= one.time and reading is not None for at, reading in temperatures):
            continue  # A mean of no readings: nobody has said what that is.
        if not isfinite(value) or not span[0] <= value <= span[1]:
            evidence = f"The report at {stamp(one.time)} said {value:g}"
            evidence += "; a reading that cannot be is in it."
            return Diagnosis("nonsense-believed", evidence, _HINT)
    return None
