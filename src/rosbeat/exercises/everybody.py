"""Listen to everybody: which readings an archive got that was away for a while.

Pure functions from an observation to an outcome.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence

from rosbeat.diagnosis.mistakes import UNKNOWN, Diagnosis
from rosbeat.diagnosis.qos import POLICY_ALONE, incompatible, rule, words
from rosbeat.diagnosis.wires import Wire, why_not_heard, why_not_published
from rosbeat.exercises import page_08_scenarios as page_08
from rosbeat.exercises.exercise import failed_by, passed
from rosbeat.records import Endpoint, Observation, Outcome

READING = Wire(page_08.READING, page_08.FLOAT)
ARCHIVE = Wire("/archive", "std_msgs/msg/Float32")


def judge_everybody(
    exercise: str, observation: Observation, readings: Mapping[str, Sequence[float]]
) -> Outcome:
    """Judge a node that passes every reading on, although it is away for a while.

    Args:
        exercise: The exercise's id.
        observation: What the node did.
        readings: What each sensor published, by the full name of its node; no number twice.
    """
    kept = [one for one in observation.samples if one.topic == ARCHIVE.topic]
    wrong = _silent(observation, readings) if not kept else None
    if not wrong and kept[0].type_name != ARCHIVE.type_name:
        wrong = Diagnosis(
            "type-mismatch",
            f"The messages on /archive are of type {kept[0].type_name}.",
            "What comes in goes out: both topics carry the same type.",
        )
    wrong = wrong or _compared(observation, [float(one.value) for one in kept], readings)
    if wrong:
        return failed_by(exercise, wrong)
    count = sum(map(len, readings.values()))
    return passed(
        exercise,
        f"{len(readings)} sensors, {count} readings, {count} in the archive: it heard everybody, "
        "and nothing was lost while it was away.",
    )


def _silent(observation: Observation, readings: Mapping[str, Sequence[float]]) -> Diagnosis:
    heard = any(
        (one.node, one.source) == (observation.subject, READING.topic)
        for one in observation.callbacks
    )
    if not heard:
        return (
            _unfit(observation, list(readings))
            or why_not_heard(observation, READING)
            or Diagnosis(
                UNKNOWN,
                "Readings were published on /reading, and the node got none.",
                "Is it connected? Compare what it asks for with what the sensors offer.",
            )
        )
    return why_not_published(observation, ARCHIVE) or Diagnosis(
        "never-published",
        "Readings came in, and nothing was published on /archive.",
        "Does the callback come to the line that publishes?",
    )


def _compared(
    observation: Observation, kept: Sequence[float], readings: Mapping[str, Sequence[float]]
) -> Diagnosis | None:
    known = [value for values in readings.values() for value in values]
    strange = next((value for value in kept if value not in known), None)
    if strange is not None:
        return Diagnosis(
            "wrong-values",
            f"{strange:g} is in the archive, and no sensor has published it.",
            "Each reading goes into the archive as it is.",
        )
    counts = Counter(kept)
    unheard = [name for name, values in readings.items() if not any(counts[v] for v in values)]
    return (
        _unheard(observation, unheard, len(readings))
        or _twice(observation, counts)
        or _lost(observation, counts, readings)
        or _order(kept, readings)
    )


# What may be wrong.


def _unheard(observation: Observation, names: Sequence[str], count: int) -> Diagnosis | None:
    if not names:
        return None
    return _unfit(observation, names) or Diagnosis(
        UNKNOWN,
        f"Of {count} sensors, nothing of {names[0]} is in the archive.",
        "Look at each sensor alone: does its reading get as far as the callback?",
    )


def _unfit(observation: Observation, names: Sequence[str]) -> Diagnosis | None:
    """Which policy keeps every subscription of the node away from one of these sensors."""
    mine = _mine(observation)
    for publisher in observation.graph.on(READING.topic, "publisher"):
        if publisher.node not in names or not mine:
            continue
        clashes = [incompatible(publisher.qos, end.qos) for end in mine]
        if all(clashes):
            return _clash(publisher, mine[0], clashes[0][0])
    return None


def _mine(observation: Observation) -> list[Endpoint]:
    ends = observation.graph.on(READING.topic, "subscription")
    return [end for end in ends if end.node == observation.subject]


def _clash(publisher: Endpoint, mine: Endpoint, policy: str) -> Diagnosis:
    offers, asks = words(publisher.qos, policy), words(mine.qos, policy)
    alone = f" {POLICY_ALONE}" if mine.qos.depth == 2 else ""  # the number of BEST_EFFORT
    return Diagnosis(
        "qos-mismatch",
        f"{publisher.node} offers {offers} and the archive asks for {asks}, so it heard nothing "
        "of that sensor.",
        f"The rule of {policy}: {rule(policy)}.{alone}",
    )


def _twice(observation: Observation, counts: Mapping[float, int]) -> Diagnosis | None:
    value = next((value for value, count in counts.items() if count > 1), None)
    if value is None:
        return None
    if len(_mine(observation)) > 1:
        return Diagnosis(
            "heard-twice",
            f"{value:g} is in the archive {counts[value]} times: the node has "
            f"{len(_mine(observation))} subscriptions to /reading, and each of them got it.",
            "One subscription is enough, if it asks for no more than the poorest sensor offers.",
        )
    evidence = f"{value:g} is in the archive {counts[value]} times, and was published once."
    return Diagnosis("wrong-values", evidence, "Publish each reading once, when it comes.")


def _lost(
    observation: Observation, counts: Mapping[float, int], readings: Mapping[str, Sequence[float]]
) -> Diagnosis | None:
    every = [one for one in observation.samples if one.topic == READING.topic]
    missing = [one for one in every if not counts[float(one.value)]]
    if not missing:
        return None
    begin, end = away(observation)
    inside = [one for one in missing if begin < one.time <= end]
    if len(inside) < len(missing):
        stray = next(one for one in missing if one not in inside)
        return Diagnosis(
            "wrong-values",
            f"The reading {float(stray.value):g} came at {stray.time:g} s, while the archive was "
            "listening, and it is not in the archive.",
            "Publish every reading that the callback gets.",
        )
    waited = sum(begin < one.time <= end for one in every)
    lost = "1 of them is lost" if len(missing) == 1 else f"{len(missing)} of them are lost"
    return Diagnosis(
        "queue-too-short",
        f"The archive was away from {begin:g} s to {end:g} s. {waited} readings came meanwhile, "
        f"and {lost}.",
        "How many readings come while it is away, from all sensors together? They all wait in "
        "one queue.",
    )


def away(observation: Observation) -> tuple[float, float]:
    """From when to when the node was paused, in seconds."""
    steps = [one for one in observation.callbacks if one.kind == "step"]
    begin = next((one.time for one in steps if one.name == "Pause"), 0.0)
    end = next((one.time for one in steps if one.name == "Resume"), observation.time)
    return begin, end


def _order(kept: Sequence[float], readings: Mapping[str, Sequence[float]]) -> Diagnosis | None:
    for name, values in readings.items():
        mine = [value for value in kept if value in values]
        if mine != list(values):
            return Diagnosis(
                "wrong-values",
                f"The readings of {name} are in the archive in another order than it published "
                "them.",
                "What came first waits at the front. Does something turn the order round?",
            )
    return None
