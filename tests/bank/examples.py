"""Write `grading/examples.json`: for each mistake of an exercise, one wrong answer of the bank.

`rosbeat class` shows a mistake to a class with what such an answer did, what the check says of it,
and a hint. Nobody's own answer is needed for that. After a change to the bank, a judge or a hint:

    PYTHONPATH=tests .venv/bin/python -m bank.examples 03a

Without an exercise, it writes those of all, which takes some minutes.
"""

from __future__ import annotations

import json
import os
import re
import sys
from collections.abc import Collection, Iterator
from dataclasses import replace
from functools import cache
from hashlib import sha256
from math import inf
from pathlib import Path
from tempfile import TemporaryDirectory
from unittest.mock import patch

from bank import workspaces
from bank.pages import ROOT, solution, subject
from bank.reading import Answer, answers, held_out
from bank.running import observed, told
from rosbeat.diagnosis.mistakes import MISTAKES
from rosbeat.exercises.registry import EXERCISES
from rosbeat.page_runs.traces import HEARD, Lane, Trace, read_trace, trace_of
from rosbeat.records import Outcome
from rosbeat.records_json import as_data

FILE = ROOT / "src" / "rosbeat" / "grading" / "examples.json"
WORKSPACE = "ROS2_and_RL_Tutorials"
#: Of a trace only what a picture has room for: places, and moments of the published solution.
_LANES, _MOMENTS = 3, 40

_LINE = re.compile(r" Line \d+: `[^`\n]*`\.")

Example = dict[str, object]


def candidates() -> dict[tuple[str, str], list[Answer]]:
    """Return the wrong answers to each exercise by mistake, those with no other mistake first."""
    found: dict[tuple[str, str], list[Answer]] = {}
    for one in (*answers(), *held_out()):
        if one.status == "failed":
            for name in one.mistakes:
                if name in MISTAKES:
                    found.setdefault((one.exercise, name), []).append(one)
    return {
        key: sorted(some, key=lambda one: len(one.mistakes)) for key, some in sorted(found.items())
    }


def seen(answer: Answer, home: Path) -> tuple[Outcome, str]:
    """Return what the check says of an answer, and the trace of what it did."""
    if answer.exercise in workspaces.EXERCISES:
        with TemporaryDirectory(dir=home) as own, patch.dict(os.environ, ROSBEAT_STEADY_HOME=own):
            return told(answer, Path(own) / WORKSPACE), ""
    evidence = observed(answer)
    return EXERCISES[answer.exercise].judged(evidence), trace_of(evidence)


def digest(answer: Answer) -> str:
    """Return what tells an answer from all others: names are unique only within a folder."""
    return sha256(f"{answer.subject}\n{answer.before}\n{answer.text}".encode()).hexdigest()[:8]


def example(name: str, some: list[Answer], home: Path) -> Example | None:
    """Return what there is to show of the first answer whose check names a mistake."""
    for one in some[:6]:
        outcome, trace = seen(one, home)
        if outcome.mistake == name:
            right = solved(one.exercise)
            drawn = drawable(trace, right.seconds if right else inf, without=HEARD)
            picture = {"trace": as_data(drawn)} if drawn else {}
            said = dict(zip(("seen", "hint"), words(outcome), strict=True))
            return {"answer": digest(one), **said, **picture}
    return None


def words(outcome: Outcome) -> tuple[str, str]:
    """Return what is said of an answer, without the line of its code, which a class could copy."""
    return _LINE.sub("", outcome.evidence), outcome.hint


def drawable(text: str, until: float, without: str = "") -> Trace | None:
    """Return as much of a trace as a picture has room for; None for nothing.

    What a function returned, or a terminal shows, is left out: a class would read the answer.

    Args:
        text: The trace.
        until: Where the picture ends, in seconds.
        without: A role whose lanes are left out: the published solution's show the same.
    """
    trace = read_trace(text) if text else None
    lanes = [one for one in trace.lanes if one.role != without][:_LANES] if trace else []
    if trace is None or not lanes:
        return None
    ends = (one.times[_MOMENTS - 1] for one in lanes if len(one.times) >= _MOMENTS)
    # Where only one of two answers was cut, the other would seem to do something else.
    until = min(until, trace.seconds, *ends) if without == "" else min(until, trace.seconds)
    return replace(trace, seconds=until, lanes=tuple(_cut(one, until) for one in lanes), text="")


def _cut(lane: Lane, until: float) -> Lane:
    many = sum(at <= until for at in lane.times)
    times = tuple(round(at, 3) for at in lane.times[:many])
    return replace(
        lane, count=many, times=times, values=lane.values[:many], words=lane.words[:many]
    )


@cache
def shown() -> dict[tuple[str, str, str], tuple[str, str]]:
    """Return what the file says, evidence and hint, by exercise, answer's digest and mistake."""
    made = json.loads(FILE.read_text(encoding="utf-8"))
    return {
        (exercise, one["answer"], name): (one["seen"], one["hint"])
        for exercise, some in made.items()
        for name, one in some.items()
        if name
    }


def every(home: Path, chosen: Collection[str]) -> Iterator[tuple[str, str, Example]]:
    """Yield exercise, mistake, and what there is to show."""
    for (exercise, name), some in candidates().items():
        found = example(name, some, home) if exercise in chosen else None
        if found:
            yield exercise, name, found


@cache
def solved(exercise: str) -> Trace | None:
    """Return the trace of the published solution; None for nothing to draw."""
    if exercise in workspaces.EXERCISES:
        return None
    right = Answer(exercise, "", solution(exercise), subject=subject(exercise))
    return drawable(trace_of(observed(right)), inf)


def write(*names: str) -> None:
    """Run the answers to these exercises, or to all, and write the file."""
    known = {one for one, _ in candidates()}
    chosen = known.intersection(names) if names else known
    before = json.loads(FILE.read_text(encoding="utf-8"))
    made: dict[str, dict[str, object]] = {
        exercise: some for exercise, some in before.items() if exercise in known - chosen
    }
    with TemporaryDirectory() as home, patch.dict(os.environ, ROSBEAT_STEADY_HOME=home):
        for exercise in sorted(chosen):
            if right := solved(exercise):
                made[exercise] = {"": {"trace": as_data(right)}}  # with what both were fed
        for exercise, name, found in every(Path(home), chosen):
            made.setdefault(exercise, {})[name] = found
            print(exercise, name, flush=True)
    rows = (
        f" {json.dumps(exercise)}: {{\n"
        + ",\n".join(
            f"  {json.dumps(name)}: {json.dumps(one, ensure_ascii=False)}"
            for name, one in some.items()
        )
        + "\n }"
        for exercise, some in sorted(made.items())
    )
    FILE.write_text("{\n" + ",\n".join(rows) + "\n}\n", encoding="utf-8")


if __name__ == "__main__":
    write(*sys.argv[1:])
