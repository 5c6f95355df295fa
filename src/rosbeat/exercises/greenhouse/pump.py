"""Whether the pump runs when it should, and only then (R2, R3)."""

from __future__ import annotations

from itertools import pairwise

from rosbeat.diagnosis.mistakes import Diagnosis
from rosbeat.exercises.greenhouse.days import plain_day
from rosbeat.exercises.greenhouse.reading import EPS, silent, stamp, switch
from rosbeat.exercises.greenhouse.trials import Trials

PUMP, VENT = "/pump", "/vent"
#: Seconds by which a run of the pump may be shorter or longer.
_SLACK = 1.0
Span = tuple[float, float]


def judge_pump(trials: Trials) -> Diagnosis | None:
    """R2: the pump runs for so long, rests for so long, and only when it is dry."""
    quiet = silent(trials.plain, PUMP)
    if quiet:
        return quiet
    n = trials.numbers
    day = plain_day(n)
    end = float(day.marks["both"])
    spans = [s for s in switch(trials.plain, PUMP).spans(trials.plain.time) if s[0] < end]
    return (
        _too_early(spans, day.marks["dry"], day.marks["at the limit"], n["dry_below"])
        or _not_started(spans, day.marks["dry"], n["react_seconds"])
        or _wrong_span(spans, n["pump_seconds"])
        or _wrong_rest(spans, n["rest_seconds"], n["react_seconds"])
        or _in_the_wet(spans, day.marks["wet"] + n["react_seconds"])
    )


def _too_early(spans: list[Span], dry: float, at_limit: float, limit: float) -> Diagnosis | None:
    early = next((begin for begin, _ in spans if begin < dry - EPS), None)
    if early is None:
        return None
    evidence = f"The pump was started at {stamp(early)}, and no humidity was below {limit:g} yet."
    if early >= at_limit:
        hint = f"Exactly {limit:g} is not below {limit:g}."
        return Diagnosis("boundary", evidence, hint)
    return Diagnosis("wrong-state", evidence, "Which reading starts it, and what does it say?")


def _not_started(spans: list[Span], due: float, react: float) -> Diagnosis | None:
    if spans and spans[0][0] <= due + react + EPS:
        return None
    evidence = f"From {stamp(due)} on it was dry, and by {stamp(due + react)} no pump was running."
    return Diagnosis(
        "never-switched-on", evidence, "What has to hold before it starts? Print each of these."
    )


def _wrong_span(spans: list[Span], wanted: float) -> Diagnosis | None:
    for begin, until in spans:
        if abs(until - begin - wanted) > _SLACK + EPS:
            evidence = (
                f"The pump ran from {stamp(begin)} to {stamp(until)}, which is "
                f"{stamp(until - begin)}."
            )
            hint = f"It should run for {wanted:g} s. Who switches it off, and when?"
            return Diagnosis("wrong-duration", evidence, hint)
    return None


def _wrong_rest(spans: list[Span], rest: float, react: float) -> Diagnosis | None:
    for (_, off), (on, _) in pairwise(spans):
        if on - off < rest - EPS:
            evidence = f"The pump stopped at {stamp(off)} and ran again at {stamp(on)}."
            hint = f"It has to rest for {rest:g} s, counted from when it stops."
            return Diagnosis("rest-too-short", evidence, hint)
    off = spans[0][1]
    if len(spans) > 1 and spans[1][0] <= off + rest + react + 1 + EPS:
        return None
    evidence = f"The pump stopped at {stamp(off)}. It was still dry, and it did not run again."
    hint = f"After a rest of {rest:g} s it may run again. What tells it that the rest is over?"
    return Diagnosis("never-switched-on", evidence, hint)


def _in_the_wet(spans: list[Span], wet: float) -> Diagnosis | None:
    late = next((begin for begin, _ in spans if begin > wet + EPS), None)
    if late is None:
        return None
    evidence = f"The pump was started at {stamp(late)}, and it was no longer dry."
    return Diagnosis("wrong-state", evidence, "Does it start again only because the rest is over?")


def judge_interlock(trials: Trials) -> Diagnosis | None:
    """R3: vent and pump exclude each other, and the pump comes back afterwards."""
    n, seen = trials.numbers, trials.plain
    day, react = plain_day(n), n["react_seconds"]
    vent = [s for s in switch(seen, VENT).spans(seen.time) if s[1] > day.marks["both"]]
    pump = [s for s in switch(seen, PUMP).spans(seen.time) if s[1] > day.marks["both"]]
    for one in vent:
        for other in pump:
            begin, until = max(one[0], other[0]), min(one[1], other[1])
            if until - begin > react + EPS:
                return _both(begin, until, other[0] < one[0])
    if not vent:
        evidence = f"It was hot from {stamp(day.marks['both'])} on, and no vent was open."
        hint = "Let the vent work first; then this can be tried."
        return Diagnosis("never-switched-on", evidence, hint)
    due = day.marks["cool and dry"]
    if any(due <= begin <= due + 2 * react + 1 + EPS for begin, _ in pump):
        return None
    evidence = f"It was cool and dry from {stamp(due)} on, and the pump did not start."
    hint = "When the vent is closed again, the pump may run. Does it hear of that?"
    return Diagnosis("never-switched-on", evidence, hint)


def _both(begin: float, until: float, pump_first: bool) -> Diagnosis:
    evidence = f"From {stamp(begin)} to {stamp(until)} the vent was open and the pump was running."
    hint = "The node of the pump has to know how the vent stands. Which topic says that?"
    if pump_first:
        hint = "The pump was running already when the vent opened. Who stops it then?"
    return Diagnosis("no-interlock", evidence, hint)
