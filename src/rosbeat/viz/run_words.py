"""Runs of callbacks that take time, in words: which, how long, and what ran meanwhile."""

from __future__ import annotations

import itertools
from collections.abc import Sequence

from rosbeat.records import CallbackRecord
from rosbeat.viz.runs import SLEEP, Run, instants
from rosbeat.viz.words import count, listing, seconds

#: More times than this in one sentence nobody follows.
_MOST = 5


def say_runs(
    runs: Sequence[Run],
    callbacks: Sequence[CallbackRecord],
    processes: Sequence[tuple[str, ...]],
    end_ns: int,
) -> list[str]:
    """Tell of runs that take time in whole sentences.

    Args:
        runs: The runs.
        callbacks: All runs of callbacks of the nodes shown.
        processes: The nodes that share a process.
        end_ns: The last time shown.
    """
    kinds: dict[tuple[str, str], list[Run]] = {}
    for run in runs:
        kinds.setdefault((run.node, run.callback), []).append(run)
    said = [line for same in kinds.values() for line in _durations(same, end_ns)]
    shared = {name for names in processes for name in names}
    alone = ((name,) for name in dict.fromkeys(run.node for run in runs) if name not in shared)
    for names in (*processes, *alone):
        said += _meanwhile(names, runs, callbacks)
    return said


def _durations(runs: Sequence[Run], end_ns: int) -> list[str]:
    name = _name(runs[0])
    done = [run for run in runs if run.until_ns < end_ns]
    said = []
    if done:
        lengths = sorted(run.until_ns - run.time_ns for run in done)
        long = " to ".join(map(seconds, dict.fromkeys((lengths[0], lengths[-1]))))
        each = " each time" if len(done) > 1 and lengths[0] == lengths[-1] else ""
        times = [f"from {seconds(run.time_ns)} to {seconds(run.until_ns)}" for run in done]
        said.append(f"{name} takes {long}{each}, as it {_why(done)}: {_some(times)}.")
    said += [
        f"{name} begins at {seconds(run.time_ns)} and is not done when the timeline ends, as it "
        f"{_why([run])}."
        for run in runs
        if run.until_ns >= end_ns
    ]
    return said


def _name(run: Run) -> str:
    return f"{run.callback} of {run.node}"


def _why(runs: Sequence[Run]) -> str:
    reasons = dict.fromkeys(wait.reason for run in runs for wait in run.waits)
    others = [reason for reason in reasons if reason != SLEEP]
    does = ["sleeps"] if SLEEP in reasons else []
    return listing([*does, *([f"waits for {listing(others)}"] if others else [])])


def _some(times: Sequence[str]) -> str:
    if len(times) <= _MOST:
        return listing(times)
    return listing([*times[: _MOST - 1], f"{len(times) - _MOST + 1} times more"])


def _meanwhile(
    names: tuple[str, ...], runs: Sequence[Run], callbacks: Sequence[CallbackRecord]
) -> list[str]:
    """What ran in one process while callbacks in it took their time."""
    ours = [run for run in runs if run.node in names]
    if not ours:
        return []
    said = _overlaps(ours)
    others = [one for one in instants(callbacks, runs) if one.node in names]
    inside = sum(any(run.holds(one.time_ns) for run in ours) for one in others)
    where = f"in the process of {listing(names)}"
    if inside:
        verb = "runs" if inside == 1 else "run"
        said.append(f"Meanwhile, {count(inside, 'other callback')} {verb} {where}.")
    return said or [f"Meanwhile, no other callback runs {where}."]


def _overlaps(runs: Sequence[Run]) -> list[str]:
    found: dict[tuple[str, str], list[str]] = {}
    for one, other in itertools.combinations(runs, 2):
        begin, end = max(one.time_ns, other.time_ns), min(one.until_ns, other.until_ns)
        if begin < end:
            pair = (_name(one), _name(other))
            known = pair if pair in found else pair[::-1]
            times = found.setdefault(known if known in found else pair, [])
            times.append(f"from {seconds(begin)} to {seconds(end)}")
    return [
        f"Runs of {one} overlap {_some(times)}."
        if one == other
        else f"{one} and {other} overlap {_some(times)}."
        for (one, other), times in found.items()
    ]
