"""A timeline in words: who did what how often, which messages arrived, what is not shown."""

from __future__ import annotations

from collections import Counter

from rosbeat.records import NANOSECONDS
from rosbeat.viz.happenings import Happenings, node_of
from rosbeat.viz.run_words import say_runs
from rosbeat.viz.wiring import say_shared
from rosbeat.viz.words import count, listing, number


def describe(shown: Happenings) -> str:
    """The timeline in whole sentences."""
    said = [f"A timeline from 0 s to {number(shown.end)} s with {count(len(shown.lanes), 'node')}."]
    said += [_lane(shown, name) for name in shown.lanes]
    said += say_shared(shown.processes)
    end_ns = round(shown.end * NANOSECONDS)
    said += say_runs(shown.runs, shown.callbacks, shown.processes, end_ns)
    said += [line for topic in shown.topics for line in _topic(shown, topic)]
    said += [
        f"At {number(one.time)} s, {one.kind} in {one.callback} ended {one.node}."
        for one in shown.faults
    ]
    return " ".join([*said, left_out(shown)]).strip()


def left_out(shown: Happenings) -> str:
    """What the picture does not show, or an empty string."""
    if not shown.skipped:
        return ""
    events = count(shown.skipped, "later message or callback", "later messages and callbacks")
    verb = "is" if shown.skipped == 1 else "are"
    return f"{events} {verb} not shown."


def _lane(shown: Happenings, node: str) -> str:
    kinds = Counter(one.kind for one in shown.callbacks if one.node == node)
    done = [_runs(kind, total) for kind, total in kinds.items()]
    logs = sum(node_of(one) == node for one in shown.logs)
    if logs:
        done.append(count(logs, "log line"))
    if not done and any(run.node == node for run in shown.runs):
        return f"{node} does nothing but wait."
    return f"{node}: {listing(done) or 'nothing happens'}."


def _runs(kind: str, total: int) -> str:
    if kind == "expired":  # a callback that did not run
        return count(total, "message too old", "messages too old")
    return count(total, f"{kind} callback")


def _topic(shown: Happenings, topic: str) -> list[str]:
    ways: Counter[tuple[str, tuple[str, ...]]] = Counter()
    for one in shown.messages:
        if one.topic == topic:
            ways[one.source, one.targets] += one.number
    return [
        f"{count(total, 'message')} on {topic} from {source} {_arrival(targets, total)}."
        for (source, targets), total in ways.items()
    ]


def _arrival(targets: tuple[str, ...], total: int) -> str:
    if not targets:
        return f"{'reaches' if total == 1 else 'reach'} nobody"
    verb = "makes" if total == 1 else "make"
    noun = "a callback" if len(targets) == 1 else "callbacks"
    return f"{verb} {noun} of {listing(targets)} run at the same instant"
