"""A node that says what is wrong with a sensor: judged by what it said of several recordings.

Pure functions from what it published to an outcome. What it should have said, and what it would
have said had it been misunderstood in one way or another, comes from small models of such a node.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

from rosbeat.diagnosis.mistakes import Diagnosis
from rosbeat.diagnosis.wires import Wire, why_not_heard, why_not_published
from rosbeat.exercises.exercise import before_judging, failed, failed_by, passed
from rosbeat.exercises.replays import STRING, Replayed, Replays
from rosbeat.records import INFRASTRUCTURE_TOPICS, NANOSECONDS, Outcome, Sample

FAULT = Wire("/fault", STRING)
#: Python's words for a None where a number is meant.
_NOT_FOR_NONE = re.compile(r"supported .*'NoneType'|must be real number, not NoneType")
#: What a node says of what it heard: words by time, in nanoseconds.
Words = Mapping[int, str]
Model = Callable[[Sequence[Sample]], Words]


@dataclass(frozen=True)
class Suspect:
    """A misunderstanding: what somebody who has it would write.

    Attributes:
        mistake: Its id, from `diagnosis.mistakes`.
        hint: Where to look, without the answer.
        model: What such a node says.
    """

    mistake: str
    hint: str
    model: Model


@dataclass(frozen=True)
class Task:
    """What is asked for.

    Attributes:
        wires: What the node has to listen to.
        words: What it may say.
        model: What it should say.
        suspects: What it might say instead, and why; the likely ones first.
        context: What was heard until a time, in a few words.
    """

    wires: tuple[Wire, ...]
    words: tuple[str, ...]
    model: Model
    suspects: tuple[Suspect, ...]
    context: Callable[[Sequence[Sample], int], str]


def judge_alarms(exercise: str, seen: Replays, task: Task) -> Outcome:
    """Judge a node by what it said of each recording.

    Args:
        exercise: The exercise's id.
        seen: What it did.
        task: What it should have done.
    """
    for run in seen.runs:
        early = _nothing_yet(exercise, run) or before_judging(exercise, run.observation)
        if early:
            return early
    wrong = _deaf(seen, task) or _dumb(seen, task) or _strange(seen, task) or _differs(seen, task)
    if wrong:
        return failed_by(exercise, wrong)
    count = sum(len(task.model(run.heard)) for run in seen.runs)
    return passed(
        exercise,
        f"{len(seen.runs)} recordings, {sum(len(run.heard) for run in seen.runs)} readings: "
        f"{count} alarms where there was something wrong, and none where all was well.",
    )


def _nothing_yet(exercise: str, run: Replayed) -> Outcome | None:
    """A calculation with the None that stands for a reading which has not come yet."""
    for fault in run.observation.faults[:1]:
        if fault.kind == "TypeError" and _NOT_FOR_NONE.search(fault.text):
            return failed(
                exercise,
                f"{_in(run)} {fault.callback} calculated with None at {fault.time:g} s, in line "
                f"{fault.line}: {fault.code}",
                "What is in your node's memory before the first reading has come? Ask for that.",
                "none-used",
            )
    return None


# Nothing heard, nothing said.


def _deaf(seen: Replays, task: Task) -> Diagnosis | None:
    for wire in task.wires:
        if any(one.source == wire.topic for run in seen.runs for one in run.observation.callbacks):
            continue
        count = sum(one.topic == wire.topic for run in seen.runs for one in run.heard)
        return (
            _half_deaf(seen.runs[0], wire, task)
            or why_not_heard(seen.runs[0].observation, wire)
            or Diagnosis(
                "new-to-me",
                f"{count} messages were published on {wire.topic} and the node got none.",
                f"Does it call create_subscription, with the topic {wire.topic.strip('/')!r}?",
            )
        )
    return None


def _half_deaf(run: Replayed, wire: Wire, task: Task) -> Diagnosis | None:
    """The node listens to something else that was asked for, and to nothing besides."""
    seen = run.observation
    ends = {
        one.name
        for one in seen.graph.endpoints
        if (one.node, one.kind) == (seen.subject, "subscription")
    } - INFRASTRUCTURE_TOPICS
    if not ends or wire.topic in ends or not ends <= {one.topic for one in task.wires}:
        return None
    return Diagnosis(
        "no-subscription",
        f"The node listens to {' and '.join(sorted(ends))} only; {wire.topic} passes it by.",
        "A node may have as many subscriptions as it needs, each with its own callback.",
    )


def _dumb(seen: Replays, task: Task) -> Diagnosis | None:
    said = [one for run in seen.runs for one in _published(run)]
    if said and said[0].type_name != FAULT.type_name:
        return Diagnosis(
            "type-mismatch",
            f"The messages on {FAULT.topic} are of type {said[0].type_name}.",
            f"Here they are {FAULT.type_name}: both sides of a topic must agree on it.",
        )
    if said:
        return None
    run = next(run for run in seen.runs if task.model(run.heard))
    return why_not_published(run.observation, FAULT) or Diagnosis(
        "never-published",
        f"{_in(run)} something is wrong, and nothing was published on {FAULT.topic}.",
        "Does the callback come to the line that publishes? Print what it compares.",
    )


def _strange(seen: Replays, task: Task) -> Diagnosis | None:
    known = ", ".join(repr(word) for word in task.words)
    for run in seen.runs:
        for one in _published(run):
            if _word(one) not in task.words:
                return Diagnosis(
                    "wrong-word",
                    f"{_in(run)} the node published {one.value!r} on {FAULT.topic}.",
                    f"Each message there is one of these, letter by letter: {known}.",
                )
    return None


# Something else said.


def _differs(seen: Replays, task: Task) -> Diagnosis | None:
    run = next((one for one in seen.runs if _said(one) != _asked(one, task)), None)
    if run is None:
        return None
    plain = _first_difference(run, task)
    fit = [one for one in task.suspects if _explains(one, run) and _speaks(one, seen)]
    if not fit:
        return plain
    likely = max(fit, key=lambda one: sum(_explains(one, other) for other in seen.runs))
    return Diagnosis(likely.mistake, plain.evidence, likely.hint)


def _explains(suspect: Suspect, run: Replayed) -> bool:
    return _said(run) == _as_lists(suspect.model(run.heard))


def _speaks(suspect: Suspect, seen: Replays) -> bool:
    """Whether it explains something that was said: silence alone has too many explanations."""
    return any(_said(run) and _explains(suspect, run) for run in seen.runs)


def _first_difference(run: Replayed, task: Task) -> Diagnosis:
    said, asked = _said(run), _asked(run, task)
    at = min(time for time in {*said, *asked} if said.get(time) != asked.get(time))
    before = f"{_in(run)} at {at / NANOSECONDS:g} s, {task.context(run.heard, at)},"
    found, wanted = said.get(at, []), asked.get(at, [])
    if not found:
        return Diagnosis(
            "alert-missing",
            f"{before} the node said nothing, and {wanted[0]!r} was due.",
            f"Which condition of yours decides about {wanted[0]!r}? Print what it compares.",
        )
    if not wanted:
        return Diagnosis(
            "alert-too-many",
            f"{before} the node said {_listed(found)}, and nothing was due.",
            f"Which condition of yours decides about {found[0]!r}? Print what it compares.",
        )
    if set(found) == set(wanted):
        return Diagnosis(
            "alert-too-many",
            f"{before} the node said {wanted[0]!r} {len(found)} times.",
            "One message for each fault that is found is enough.",
        )
    return Diagnosis(
        "wrong-word",
        f"{before} the node said {_listed(found)}, and {wanted[0]!r} was due.",
        "Go through your conditions in their order with this reading.",
    )


def _published(run: Replayed) -> list[Sample]:
    return [one for one in run.observation.samples if one.topic == FAULT.topic]


def _word(one: Sample) -> str:
    return str(one.value).strip().lower()


def _said(run: Replayed) -> dict[int, list[str]]:
    found: dict[int, list[str]] = {}
    for one in _published(run):
        found.setdefault(one.time_ns, []).append(_word(one))
    return found


def _asked(run: Replayed, task: Task) -> dict[int, list[str]]:
    return _as_lists(task.model(run.heard))


def _as_lists(words: Words) -> dict[int, list[str]]:
    return {at: [word] for at, word in words.items()}


def _listed(words: Sequence[str]) -> str:
    return " and ".join(repr(word) for word in words)


def _in(run: Replayed) -> str:
    return f"In the recording of {run.recording},"
