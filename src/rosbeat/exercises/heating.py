"""A thermostat that is an action: it heats to a target, reports, and can be stopped.

It stands in a room of whole degrees and is sent goals: one that is reached, one that is canceled,
some that make no sense, one that is reached already, and one more. A judge looks at what the client
got, and at the heater.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from rosbeat.diagnosis.mistakes import Diagnosis
from rosbeat.diagnosis.silence import difference, nearest
from rosbeat.diagnosis.wires import Wire, why_not_published
from rosbeat.exercises.exercise import failed_by, passed
from rosbeat.exercises.heating_run import GOALS, START, TYPE, Goal
from rosbeat.records import Observation, Outcome, Reply

_ACTION, _TYPE = "/heat", TYPE
_HEATER = Wire("/heater", "std_msgs/msg/Bool")
_TEMPERATURE = "/temperature"
_START = START
#: Reached, canceled, reached already, and one more; those in between make no sense.
_FIRST, _CANCELED, _REACHED, _LAST = GOALS[0], GOALS[1], GOALS[5], GOALS[6]
_LEAST, _MOST = 10, 26


def judge(observation: Observation) -> Outcome:
    """Judge a thermostat."""
    run = _Run(observation)
    found = (
        _no_action(observation)
        or _blocked(run)
        or _decisions(run)
        or _first(run)
        or _heater_after(run, _FIRST)
        or _cancel(run)
        or _heater_after(run, _CANCELED)
        or _rest(run)
    )
    if found:
        return failed_by("12c", found)
    degrees = run.result(_FIRST)["sequence"]
    return passed(
        "12c",
        f"Heated to {degrees[-1]}, with a report each second; stopped when it was canceled; "
        f"{sum(not _is_good(one) for one in GOALS)} goals that make no sense were rejected.",
    )


class _Run:
    """What came back for each goal, and what the heater did."""

    def __init__(self, observation: Observation) -> None:
        self.seen = observation
        self.switched = [
            (one.time, bool(one.value)) for one in observation.samples if one.topic == _HEATER.topic
        ]
        self.heard = [one.time for one in observation.callbacks if one.source == _TEMPERATURE]

    def replies(self, goal: Goal, word: str) -> list[Reply]:
        number = GOALS.index(goal) + 1
        return [one for one in self.seen.replies if (one.number, one.word) == (number, word)]

    def accepted(self, goal: Goal) -> bool | None:
        """Whether a goal was accepted; None without an answer."""
        found = self.replies(goal, "goal")
        return bool(found[0].data["accepted"]) if found else None

    def ended(self, goal: Goal) -> float | None:
        """When its result came."""
        found = self.replies(goal, "result")
        return found[0].time if found else None

    def result(self, goal: Goal) -> dict[str, Any]:
        return self.replies(goal, "result")[0].data

    def on_at(self, time: float) -> bool:
        """Whether the heater was on, after all that happened at that time."""
        before = [state for at, state in self.switched if at <= time]
        return bool(before) and before[-1]


# What is there at all.


def _no_action(observation: Observation) -> Diagnosis | None:
    ends = [end for end in observation.graph.endpoints if end.node == observation.subject]
    offered = [end for end in ends if end.kind == "action server"]
    here = [end for end in offered if end.name == _ACTION]
    if here and here[0].type_name == _TYPE:
        return None
    if here:
        return Diagnosis(
            "type-mismatch",
            f"{_ACTION} is of type {here[0].type_name}; its goals are of type {_TYPE}.",
            "Both sides of an action have to name the same type, as with topics.",
        )
    names = [end.name for end in offered]
    near = nearest(_ACTION, names) or next(iter(names), "")
    if near:
        return Diagnosis(
            "service-misspelled",
            f"The node offers the action {near}, and goals go to {_ACTION}: "
            f"{difference(near, _ACTION)}.",
            "Who sends a goal has nothing but the name, as with topics.",
        )
    return Diagnosis(
        "no-action",
        f"A goal was sent to {_ACTION}, and the node has no action server.",
        "The constructor that you were given makes one.",
    )


def _blocked(run: _Run) -> Diagnosis | None:
    """Whether the work keeps the node from hearing anything else."""
    if not run.accepted(_FIRST) or not run.heard:
        return None
    end = run.ended(_FIRST) or _FIRST.at + 4
    meanwhile = [at for at in run.heard if _FIRST.at < at < end]
    if meanwhile or end < _FIRST.at + 2:
        return None
    return Diagnosis(
        "callback-blocks",
        f"From {_FIRST.at:g} to {end:g} s the node did not hear a single reading: while its work "
        "sleeps, nothing else of it runs, no cancel either.",
        "An `async` callback gives the others room while it awaits something.",
    )


# Which goals are taken.


def _is_good(goal: Goal) -> bool:
    return _LEAST <= goal.order <= _MOST


def _decisions(run: _Run) -> Diagnosis | None:
    if run.accepted(_FIRST) is None:
        return Diagnosis(
            "new-to-me",
            "The first goal was neither accepted nor rejected.",
            "Does the callback that decides come to an end?",
        )
    for goal in GOALS:
        if _is_good(goal) and not run.accepted(goal):
            edge = " 10 and 26 themselves are fine." if goal.order in (_LEAST, _MOST) else ""
            return Diagnosis(
                "boundary" if edge and run.accepted(_FIRST) else "good-value-refused",
                f"The goal {goal.order} was rejected.",
                f"Goals from 10 to 26 make sense.{edge} Does the callback return one of the two "
                "GoalResponses on each way?",
            )
        if not _is_good(goal) and run.accepted(goal):
            return Diagnosis(
                "nonsense-accepted",
                f"The goal {goal.order} was accepted.",
                "Only goals from 10 to 26 make sense. Compare in the callback that decides.",
            )
    return None


# A goal that is reached.


def _first(run: _Run) -> Diagnosis | None:
    if not any(state for _, state in run.switched):
        return why_not_published(run.seen, _HEATER) or Diagnosis(
            "never-switched-on",
            "The goal 22 was accepted, and the heater was never switched on.",
            "The room only gets warmer after a Bool that is True on /heater.",
        )
    return _work(run, _FIRST, _START)


def _work(run: _Run, goal: Goal, start: int) -> Diagnosis | None:
    if run.ended(goal) is None:
        return Diagnosis(
            "never-ends",
            f"The goal {goal.order} was accepted at {goal.at:g} s, and there never was a result.",
            "What makes the condition of the loop false? Print it in each round.",
        )
    return _status(run, goal) or _degrees(run, goal, start) or _feedback(run, goal)


def _status(run: _Run, goal: Goal) -> Diagnosis | None:
    status = run.result(goal)["status"]
    if status == "SUCCEEDED":
        return None
    if status == "ABORTED":
        return Diagnosis(
            "succeed-forgotten",
            f"The work on the goal {goal.order} ended, and the client was told ABORTED.",
            "Who does not say how a goal ended has given it up: so ROS takes it.",
        )
    return Diagnosis(
        "wrong-state",
        f"The goal {goal.order} was reached, and the client was told {status}.",
        "There are two ways for the work to end. Which call belongs to which?",
    )


def _degrees(run: _Run, goal: Goal, start: int) -> Diagnosis | None:
    found = list(run.result(goal)["sequence"])
    at = run.ended(goal) or 0.0
    if not found:
        return Diagnosis(
            "result-wrong",
            f"The goal {goal.order} succeeded, and the result holds no temperatures.",
            "The result has a field for them, like the feedback.",
        )
    wanted = list(range(start + 1, goal.order + 1))
    if found in (wanted, [start, *wanted]):
        return None
    # A heater that is never on for so long cannot have got so far.
    if found[-1] < goal.order and at < goal.at + len(wanted):
        return Diagnosis(
            "ends-too-soon",
            f"The work on the goal {goal.order} ended at {found[-1]} degrees.",
            "It goes on as long as it is colder than the target, and no longer.",
        )
    if found[-1] > goal.order and found[:-1] in (wanted, [start, *wanted]):
        return Diagnosis(
            "boundary",
            f"The goal was {goal.order}, and the heater was on until {found[-1]} degrees.",
            "Exactly the target is warm enough.",
        )
    return Diagnosis(
        "result-wrong",
        f"The room went from {start} to {goal.order} degrees, one a second; the result holds "
        f"{_listed(found)}.",
        "Every temperature that was read since the goal came, in order.",
    )


def _feedback(run: _Run, goal: Goal) -> Diagnosis | None:
    reports = run.replies(goal, "feedback")
    final = list(run.result(goal)["sequence"])
    times = sorted({one.time for one in reports})
    wanted = max(1, goal.order - _START - 1) if goal is _FIRST else 1
    if len(times) < wanted:
        got = "no feedback" if not reports else f"feedback at {len(times)} of {len(final)} seconds"
        return Diagnosis(
            "feedback-missing",
            f"On the way to {goal.order} degrees the client got {got}.",
            "Publish feedback in each round of the loop, with what was read so far.",
        )
    wrong = [one for one in reports if list(one.data["sequence"]) not in _parts(final)]
    if wrong:
        return Diagnosis(
            "wrong-values",
            f"One feedback held {_listed(wrong[0].data['sequence'])}; in the end there were "
            f"{_listed(final)}.",
            "Feedback holds all temperatures so far, as the result does in the end.",
        )
    return None


def _parts(final: list[int]) -> list[list[int]]:
    return [final[:length] for length in range(1, len(final) + 1)]


def _listed(values: Iterable[Any]) -> str:
    return f"[{', '.join(str(one) for one in list(values)[:8])}]"


def _heater_after(run: _Run, goal: Goal) -> Diagnosis | None:
    end = run.ended(goal)
    if end is None or not run.on_at(end + 1):
        return None
    how = "canceled" if goal is _CANCELED else "reached"
    return Diagnosis(
        "left-on",
        f"The goal {goal.order} was {how} at {end:g} s, and a second later the heater was still "
        "on.",
        "Which line switches it off, and is it on each way out of the work?",
    )


# A goal that is canceled.


def _cancel(run: _Run) -> Diagnosis | None:
    goal = _CANCELED
    at = goal.at + (goal.cancel_after or 0)
    end = run.ended(goal)
    if end is not None and end < at:
        return Diagnosis(
            "ends-too-soon",
            f"The second goal, {goal.order}, ended at {end:g} s with {run.result(goal)['status']}, "
            "long before it was reached.",
            "Is anything left over from the goal before?",
        )
    replies = run.replies(goal, "cancel")
    if not replies or not replies[0].data["count"]:
        return Diagnosis(
            "cancel-refused",
            f"The goal {goal.order} was to be canceled at {at:g} s, and the node refused.",
            "An action server refuses to cancel unless a callback of its own accepts.",
        )
    return _after_cancel(run, goal, at)


def _after_cancel(run: _Run, goal: Goal, at: float) -> Diagnosis | None:
    end = run.ended(goal)
    status = run.result(goal)["status"] if end is not None else ""
    if end is None or end > at + 1:
        later = f"went on until {end:g} s" if end is not None else "never ended"
        return Diagnosis(
            "cancel-ignored",
            f"The goal {goal.order} was canceled at {at:g} s, and the work {later}.",
            "To accept a cancel is a promise: the work has to ask its goal handle in each round.",
        )
    if status != "CANCELED":
        return Diagnosis(
            "cancel-not-reported",
            f"The work stopped when it was canceled, and the client was told {status}.",
            "There are two ways for the work to end. Which call belongs to which?",
        )
    if not list(run.result(goal)["sequence"]):
        return Diagnosis(
            "result-wrong",
            "The canceled goal gave back no temperatures, although some were read.",
            "Both ways give the same result back: what was read so far.",
        )
    return _read_so_far(run, goal, end)


def _read_so_far(run: _Run, goal: Goal, end: float) -> Diagnosis | None:
    """Whether the result holds the last temperatures; one that came at the end may be missing."""
    found = list(run.result(goal)["sequence"])
    room = [
        int(one.value) for one in run.seen.samples if one.topic == _TEMPERATURE and one.time <= end
    ]
    if found in (room[-len(found) :], room[-len(found) - 1 : -1]):
        return None
    return Diagnosis(
        "result-wrong",
        f"The canceled goal gave back {_listed(found)}; the room had "
        f"{_listed(room[-len(found) :])}.",
        "Every temperature that was read since the goal came, in order.",
    )


# What comes after.


def _rest(run: _Run) -> Diagnosis | None:
    start = _room_before(run, _REACHED)
    end = run.ended(_REACHED)
    if end is None or end > _REACHED.at + 2 or run.result(_REACHED)["status"] != "SUCCEEDED":
        return Diagnosis(
            "never-ends" if end is None else "wrong-state",
            f"The goal {_REACHED.order} was reached already, at {start} degrees, and did not end "
            "as a success within two seconds.",
            "Who is warm enough has nothing to wait for.",
        )
    found = _heater_after(run, _REACHED)
    return found or _work(run, _LAST, _room_before(run, _LAST)) or _heater_after(run, _LAST)


def _room_before(run: _Run, goal: Goal) -> int:
    """The last temperature before a goal came."""
    readings = [one for one in run.seen.samples if one.topic == _TEMPERATURE]
    return int([one.value for one in readings if one.time < goal.at][-1])
