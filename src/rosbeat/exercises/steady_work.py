"""A worker that works for three seconds on each order, while its beat goes on.

Pure functions from what it did to an outcome.
"""

from __future__ import annotations

import itertools
from collections.abc import Sequence

from rosbeat.diagnosis.mistakes import Diagnosis
from rosbeat.diagnosis.wires import Wire, why_not_heard, why_not_published
from rosbeat.exercises import page_09_scenarios as page_09
from rosbeat.exercises.exercise import failed_by, passed
from rosbeat.records import Observation, Outcome, Sample

ORDER = Wire(page_09.ORDER, page_09.INT)
DONE = Wire("/done", page_09.INT)
BEAT = Wire("/beat", "std_msgs/msg/String")

#: Seconds that an order takes, and how many more nobody minds.
WORK, PATIENCE = 3.0, 1.0
_BEAT = 1.0
#: How much a beat may be off; a counter of small steps needs some room.
_ROOM = 0.1
#: How much it may be off in the mean.
_DRIFT = 0.02

Orders = Sequence[tuple[float, int]]


def judge_work(exercise: str, observation: Observation, orders: Orders) -> Outcome:
    """Judge a worker.

    Args:
        exercise: The exercise's id.
        observation: What it did.
        orders: When each order came, in seconds, and its number; no number twice.
    """
    wrong = _deaf(observation) or _missing(observation, BEAT, DONE)
    wrong = wrong or _beats(observation, orders) or _missing(observation, DONE, BEAT)
    wrong = wrong or _reports(observation, orders) or _spans(observation, orders)
    if wrong:
        return failed_by(exercise, wrong)
    beats = len(_on(observation, BEAT))
    return passed(
        exercise,
        f"{len(orders)} orders, each done after {WORK:g} s, one after the other; meanwhile "
        f"{beats} beats, none of them late.",
    )


def _on(observation: Observation, wire: Wire) -> list[Sample]:
    return [
        one
        for one in observation.samples
        if (one.topic, one.node) == (wire.topic, observation.subject)
    ]


def _deaf(observation: Observation) -> Diagnosis | None:
    heard = [
        one
        for one in observation.callbacks
        if (one.node, one.source) == (observation.subject, ORDER.topic)
    ]
    if heard:
        return None
    return why_not_heard(observation, ORDER) or Diagnosis(
        "no-subscription",
        "Orders were published on /order, and the node got none.",
        "What listens to them, and under which name?",
    )


def _missing(observation: Observation, wire: Wire, other: Wire) -> Diagnosis | None:
    found = _on(observation, wire)
    if found and found[0].type_name != wire.type_name:
        return Diagnosis(
            "type-mismatch",
            f"The messages on {wire.topic} are of type {found[0].type_name}.",
            f"Here they are {wire.type_name}: both sides of a topic must agree on it.",
        )
    if found:
        return None
    thread = " A thread of its own counts real time, which does not pass here." * (wire == DONE)
    silent = why_not_published(observation, wire, (other.topic,))
    if silent and silent.mistake != "never-published":
        return silent
    return Diagnosis(
        "never-published",
        f"Nothing was published on {wire.topic} in {observation.time:g} s.",
        "Which callback comes to the line that publishes, and who calls it?" + thread,
    )


# The beat.


def _beats(observation: Observation, orders: Orders) -> Diagnosis | None:
    times = [0.0, *(one.time for one in _on(observation, BEAT)), observation.time]
    # Behind the last beat, and before the first, a gap may be shorter, and no longer.
    gaps = list(itertools.pairwise(times))
    idle_until = orders[0][0]
    short = [gap for gap in gaps[1:-1] if gap[1] - gap[0] < _BEAT - _ROOM]
    long = [gap for gap in gaps if gap[1] - gap[0] > _BEAT + _ROOM]
    if not (short or long):
        return _drifting(times[1:-1])
    begin, end = min(short + long)
    if short and (begin, end) in short:
        evidence = f"A beat came at {begin:g} s, and the next at {end:g} s already."
        return Diagnosis("wrong-rate", evidence, "One beat a second, whether it works or not.")
    if begin < idle_until and end <= idle_until:
        evidence = f"Between {begin:g} s and {end:g} s there was no beat, and no work to do."
        return Diagnosis("wrong-rate", evidence, "One beat a second needs a timer of 1.0 s.")
    return _starved(begin, end, orders)


def _drifting(times: Sequence[float]) -> Diagnosis | None:
    """A beat that is off by a little each time."""
    mean = (times[-1] - times[0]) / max(1, len(times) - 1)
    if len(times) < 2 or abs(mean - _BEAT) <= _DRIFT:
        return None
    evidence = (
        f"{len(times)} beats came from {times[0]:g} s to {times[-1]:g} s: every {mean:.2f} s."
    )
    return Diagnosis("wrong-rate", evidence, "One beat a second, whether it works or not.")


def _starved(begin: float, end: float, orders: Orders) -> Diagnosis:
    before = [number for at, number in orders if at < begin]
    within = [number for at, number in orders if begin <= at < end]
    order = (within or before[-1:])[0]
    return Diagnosis(
        "beat-starved",
        f"Between {begin:g} s and {end:g} s there was no beat, while there was order {order}.",
        "A node runs one callback at a time. While yours waits for the work to be done, no other "
        "can run: who could call you back when it is done?",
    )


# The work.


def _reports(observation: Observation, orders: Orders) -> Diagnosis | None:
    done = [int(one.value) for one in _on(observation, DONE)]
    wanted = [number for _, number in orders]
    strange = [number for number in done if number not in wanted]
    if strange:
        evidence = f"On /done appeared {strange[0]}, and no order has that number."
        return Diagnosis("wrong-values", evidence, "What was ordered is what gets done.")
    twice = [number for number in wanted if done.count(number) > 1]
    if twice:
        evidence = f"Order {twice[0]} was reported done {done.count(twice[0])} times."
        hint = "A timer calls again and again until somebody stops it."
        return Diagnosis("done-twice", evidence, hint)
    lost = [number for number in wanted if number not in done]
    if lost:
        slow = _spans(observation, orders) if done == wanted[: len(done)] else None
        return slow or _lost(lost[0], done, observation, orders)
    if done != wanted:
        evidence = f"The orders came as {_listed(wanted)}, and were done as {_listed(done)}."
        return Diagnosis("order-swapped", evidence, "Who came first is served first.")
    return None


def _lost(number: int, done: Sequence[int], observation: Observation, orders: Orders) -> Diagnosis:
    at = next(at for at, one in orders if one == number)
    return Diagnosis(
        "order-lost",
        f"Order {number} came at {at:g} s, and at {observation.time:g} s it was not done; done "
        f"were {_listed(done)}.",
        "An order that comes while another one is worked on has to wait somewhere.",
    )


def _spans(observation: Observation, orders: Orders) -> Diagnosis | None:
    free = 0.0
    for (at, number), sample in zip(orders, _on(observation, DONE), strict=False):
        begun, done = max(at, free), sample.time
        if done - begun < WORK - _ROOM:
            return _short(number, at, begun, done)
        if done - begun > WORK + PATIENCE + _ROOM:
            return Diagnosis(
                "work-too-long",
                f"Order {number} could begin at {begun:g} s, and was done at {done:g} s.",
                f"It takes {WORK:g} s from there. What does it wait for besides?",
            )
        free = done
    return None


def _short(number: int, at: float, begun: float, done: float) -> Diagnosis:
    if begun > at and (done - at >= WORK - _ROOM or done - begun < _ROOM):
        return Diagnosis(
            "work-at-once",
            f"Order {number} was done at {done:g} s, and the one before it at {begun:g} s.",
            f"The worker has two hands and one oven: the next {WORK:g} s begin when the last order "
            "is done.",
        )
    return Diagnosis(
        "work-too-short",
        f"Order {number} could begin at {begun:g} s, and was done at {done:g} s already.",
        f"The work itself takes {WORK:g} s, however it is called.",
    )


def _listed(numbers: Sequence[int]) -> str:
    return ", ".join(map(str, numbers)) or "none"
