"""A beat: messages that come one period apart, the first after one period."""

from __future__ import annotations

from rosbeat.diagnosis.mistakes import Diagnosis
from rosbeat.diagnosis.wires import Wire
from rosbeat.exercises.heard import on
from rosbeat.records import NANOSECONDS, Observation, Sample

_WORDS = {1: "One", 2: "Two", 4: "Four"}


def diagnose_beat(
    observation: Observation, wire: Wire, period: float, what: str = "readings"
) -> Diagnosis | None:
    """Say what is wrong with a beat, or None if it is right.

    Args:
        observation: What was seen; at least one message was published on the topic.
        wire: The topic.
        period: Seconds from one message to the next.
        what: What the messages are, in the plural.
    """
    times = [sample.time_ns for sample in on(observation, wire)]
    wait = round(period * NANOSECONDS)
    if times == [n * wait for n in range(1, observation.time_ns // wait + 1)]:
        return None
    if not any(times):
        return _only_at_once(len(times), what)
    if len(set(times)) < len(times):
        return _several_at_once(times, what)
    if not times[0]:
        return _from_the_start(len(times), what)
    return _another_rate(observation, on(observation, wire), period, what)


def _another_rate(
    observation: Observation, heard: list[Sample], period: float, what: str
) -> Diagnosis:
    times = ", ".join(f"{sample.time:g}" for sample in heard[:5])
    return Diagnosis(
        "wrong-rate",
        f"In {observation.time:g} seconds {len(heard)} {what} appeared, the first ones at these "
        f"seconds: {times}.",
        f"{_wanted(period)} is wanted. What does the first argument of create_timer count: "
        "calls in a second, or seconds between two calls?",
    )


def _wanted(period: float) -> str:
    if period > 1:
        return f"One every {period:g} seconds"
    rate = round(1 / period)
    return f"{_WORDS.get(rate, str(rate))} a second"


def _several_at_once(times: list[int], what: str) -> Diagnosis:
    first = next(time for time in times if times.count(time) > 1)
    return Diagnosis(
        "wrong-rate",
        f"At {first / NANOSECONDS:g} s, {times.count(first)} {what} were published at once.",
        "One for each tick is enough. Does anything publish twice, or are there two timers?",
    )


def _from_the_start(count: int, what: str) -> Diagnosis:
    return Diagnosis(
        "wrong-rate",
        f"{count} {what} appeared, and the first one at 0 s.",
        "The first tick comes after one period. What publishes while the node is being made?",
    )


def _only_at_once(count: int, what: str) -> Diagnosis:
    return Diagnosis(
        "no-timer",
        f"{count} {what} were published while the node was made, and none later.",
        "The constructor runs once. What calls the method again and again?",
    )
