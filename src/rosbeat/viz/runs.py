"""Runs of callbacks that take time: their waits joined, and those that overlap stacked."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace

from rosbeat.records import CallbackRecord, Timed, WaitRecord

#: The reason of a wait that is a sleep.
SLEEP = "sleep"


@dataclass(frozen=True)
class Run(Timed):
    """One run of a callback in which virtual time passed.

    Attributes:
        time_ns: When it began, in nanoseconds of virtual time.
        until_ns: When it ended.
        node: Full name of the node.
        callback: Name of the callback function.
        waits: Its waits, each beginning where the one before ended.
        level: Its place in the stack of runs of this node that overlap, from 0.
    """

    time_ns: int
    until_ns: int
    node: str
    callback: str
    waits: tuple[WaitRecord, ...]
    level: int = 0

    def holds(self, time_ns: int) -> bool:
        """Whether it was under way at a time, its begin and its end not counted."""
        return self.time_ns < time_ns < self.until_ns

    def resumes(self, time_ns: int) -> bool:
        """Whether one of its waits ended at a time."""
        return any(one.until_ns == time_ns for one in self.waits)


def runs_of(waits: Iterable[WaitRecord], callbacks: Iterable[CallbackRecord]) -> tuple[Run, ...]:
    """Join waits to runs, in order of begin.

    A wait that begins when another of the same callback ends belongs to the same run, except where
    a run of that callback began just then. Waits that took no time are left out.

    Args:
        waits: Waits of any nodes.
        callbacks: The runs of callbacks of these nodes.
    """
    begun = Counter((one.node, one.name, one.time_ns) for one in callbacks)
    starts: dict[tuple[str, str, int], list[WaitRecord]] = {}
    for wait in sorted(waits, key=lambda one: one.time_ns):
        if wait.until_ns > wait.time_ns:
            starts.setdefault((wait.node, wait.callback, wait.time_ns), []).append(wait)
    found: list[Run] = []
    for (node, callback, at), group in starts.items():
        ended = [
            k
            for k, one in enumerate(found)
            if (one.node, one.callback, one.until_ns) == (node, callback, at)
        ]
        joined = ended[: max(0, len(group) - begun[node, callback, at])]
        for wait, k in zip(group, joined, strict=False):
            more = (*found[k].waits, wait)
            found[k] = replace(found[k], until_ns=wait.until_ns, waits=more)
        for wait in group[len(joined) :]:
            found.append(Run(at, wait.until_ns, node, callback, (wait,)))
    return _stacked(found)


def levels_of(callbacks: Sequence[CallbackRecord], runs: Iterable[Run]) -> tuple[int, ...]:
    """Find the level of every callback: that of its own run, or the first that is free.

    Args:
        callbacks: Any runs of callbacks.
        runs: Those that take time.
    """
    ours = list(runs)
    free = list(ours)
    levels = []
    for one in callbacks:
        own = next((run for run in free if _begins(run, one)), None)
        if own is not None:
            free.remove(own)
        taken = {run.level for run in ours if run.node == one.node and run.holds(one.time_ns)}
        levels.append(_first_free(taken) if own is None else own.level)
    return tuple(levels)


def instants(
    callbacks: Iterable[CallbackRecord], runs: Iterable[Run]
) -> tuple[CallbackRecord, ...]:
    """The callbacks that took no time."""
    left = list(runs)
    found = []
    for one in callbacks:
        own = next((run for run in left if _begins(run, one)), None)
        if own is None:
            found.append(one)
        else:
            left.remove(own)
    return tuple(found)


def _begins(run: Run, one: CallbackRecord) -> bool:
    return (run.node, run.callback, run.time_ns) == (one.node, one.name, one.time_ns)


def _stacked(runs: Iterable[Run]) -> tuple[Run, ...]:
    placed: list[Run] = []
    for run in sorted(runs, key=lambda one: one.time_ns):
        same = [one for one in placed if one.node == run.node and one.until_ns > run.time_ns]
        placed.append(replace(run, level=_first_free({one.level for one in same})))
    return tuple(placed)


def _first_free(taken: set[int]) -> int:
    return next(level for level in range(len(taken) + 1) if level not in taken)
