"""Page 03, write a publisher: another sensor's beat, a walk between two limits, a node alone."""

from __future__ import annotations

from collections.abc import Sequence

from rosbeat.diagnosis.mistakes import Diagnosis
from rosbeat.diagnosis.wires import Wire
from rosbeat.exercises.exercise import Exercise, failed, failed_by, passed
from rosbeat.exercises.model import diagnose_beat, missing, on
from rosbeat.exercises.page_03_scenarios import (
    GREENHOUSE,
    GREENHOUSE_RATE,
    ROOM,
    SCENARIOS,
    SECONDS,
)
from rosbeat.exercises.walk_runs import PHASE
from rosbeat.exercises.walks import Walk
from rosbeat.records import Observation, Outcome

_FLOAT = "std_msgs/msg/Float32"
_HUMIDITY = Wire("/humidity", _FLOAT)
_ROOM, _GREENHOUSE = Wire(ROOM, _FLOAT), Wire(GREENHOUSE, _FLOAT)
_DEPTH = 5


def _fahrenheit(celsius: float) -> float:
    return celsius * 9 / 5 + 32


_ROOM_WALK = Walk(18.0, 28.0, 0.3)
_GREENHOUSE_WALK = Walk(
    *(_fahrenheit(10.2), _fahrenheit(28.0), 0.9, "degrees Fahrenheit"),
    " (In Celsius, where it walks, steps go up to 0.5, and the limits are 10.2 and 28.0.)",
)


def _judge_beat(observation: Observation) -> Outcome:
    found = missing(observation, _HUMIDITY) or diagnose_beat(observation, _HUMIDITY, 0.5)
    if found:
        return failed_by("03a", found)
    count = len(on(observation, _HUMIDITY))
    ends = observation.graph.on(_HUMIDITY.topic, "publisher")
    qos = next((end.qos for end in ends if end.qos.depth != _DEPTH), ends[0].qos)
    if qos.history == "KEEP_ALL" or qos.depth != _DEPTH:
        depth = "without end" if qos.history == "KEEP_ALL" else str(qos.depth)
        return failed(
            "03a",
            f"The beat is right, and the publisher's queue depth is {depth}.",
            f"A depth of {_DEPTH} is wanted. Which argument of create_publisher is that?",
            "wrong-depth",
        )
    remark = _BEST_EFFORT if qos.reliability == "BEST_EFFORT" else ""
    evidence = f"{count} readings in {SECONDS} seconds on /humidity."
    return passed("03a", evidence, *([remark] if remark else []))


_BEST_EFFORT = (
    "Your publisher is BEST_EFFORT: it does not repeat what got lost, and a subscriber that asks "
    "for RELIABLE, as they do by default, hears nothing of it."
)


def _judge_room(observation: Observation) -> Outcome:
    found = missing(observation, _ROOM)
    if found:
        return failed_by("03b", found)
    values = _values(observation, _ROOM)
    walk = _ROOM_WALK.decisive(values)
    wrong = diagnose_beat(observation, _ROOM, 1.0) or _ROOM_WALK.diagnose(walk)
    return failed_by("03b", wrong) if wrong else passed("03b", _ROOM_WALK.evidence(walk))


def _judge_greenhouse(observation: Observation) -> Outcome:
    found = missing(observation, _GREENHOUSE)
    if found:
        return failed_by("03c", found)
    values = _values(observation, _GREENHOUSE)
    walk = _GREENHOUSE_WALK.decisive(values)
    wrong = diagnose_beat(observation, _GREENHOUSE, 1 / GREENHOUSE_RATE)
    wrong = wrong or _unit(values) or _GREENHOUSE_WALK.diagnose(walk) or _start(values[0])
    if wrong:
        return failed_by("03c", wrong)
    return passed("03c", f"Four readings a second. {_GREENHOUSE_WALK.evidence(walk)}")


def _unit(values: Sequence[float]) -> Diagnosis | None:
    """Whether a walk is in Fahrenheit and stays so."""
    start, first = _fahrenheit(22.0), values[0]
    if len(set(values[1:PHASE])) == 1 and abs(values[1] - values[0]) > 1.0:
        return Diagnosis(
            "converted-back",
            f"The first reading is {first:.2f}, and then they are all {values[1]:.2f}.",
            "The node walks in Celsius and speaks in Fahrenheit. Is the converted number kept "
            "where the next step begins?",
        )
    if len(set(values)) == 1 and min(abs(first - 10.2), abs(first - 28.0)) < 1e-4:
        hint = "That is a limit in degrees Celsius. Clamp first, in Celsius, and convert then."
        return Diagnosis("wrong-unit", f"All readings are {first:g}.", hint)
    if abs(first - start) <= 0.91 or _GREENHOUSE_WALK.touches(values):
        return None
    if _GREENHOUSE_WALK.stands_or_jumps(values):
        return None
    if abs(first - 22.0) <= 0.51:
        hint = "These are degrees Celsius still. Convert the number before you publish it."
    else:
        hint = "Compare your formula, brackets too: c * 9 / 5 + 32."
    evidence = (
        f"The first reading is {first:.2f}, and 22 degrees Celsius are {start:.1f} Fahrenheit."
    )
    return Diagnosis("wrong-unit", evidence, hint)


def _start(first: float) -> Diagnosis | None:
    if abs(first - _fahrenheit(22.0)) <= 0.91:
        return None
    return Diagnosis(
        "wrong-start",
        f"The walk is right, and its first reading is {first:.2f} degrees.",
        "It starts at 22.0 degrees Celsius, and the first reading is one step from there.",
    )


def _values(observation: Observation, wire: Wire) -> list[float]:
    return [float(sample.value) for sample in on(observation, wire)]


EXERCISES = (
    Exercise(
        "03a",
        SCENARIOS["03a"],
        _judge_beat,
        "another sensor",
        2,
        (
            "Two calls are missing: one makes the publisher, one the timer. The page shows both "
            "for the temperature sensor.",
            "create_publisher takes the message type, the topic's name in quotes, and the queue "
            "depth, in this order.",
            "create_timer takes the time between two calls in seconds, and then the method, "
            "without brackets. Twice a second: how long is that from one call to the next?",
        ),
    ),
    Exercise(
        "03b",
        SCENARIOS["03b"],
        _judge_room,
        "a living room",
        2,
        (
            "Three things happen at each tick: a random step, the clamp, and a message.",
            "random.uniform(a, b) is a number between a and b, and += adds it to what was there.",
            "min(high, x) cuts off what is above, max(low, x) what is below. Put one into the "
            "other, and keep the result in self.temperature.",
            "A message is made with Float32(data=...), and self.publisher_.publish sends it.",
        ),
    ),
    Exercise(
        "03c",
        SCENARIOS["03c"],
        _judge_greenhouse,
        "a greenhouse, alone",
        4,
        (
            "Begin with the sensor of this page, copied, and change one thing after the other: "
            "topic, rate, unit. Check after each change.",
            "Four times a second means a quarter of a second between two calls.",
            "Let self.temperature stay in Celsius, with the step and the clamp as they were. "
            "Convert only what goes into the message.",
            "The result of a calculation such as c * 9 / 5 + 32 is a float already; put it into "
            "a variable of its own.",
        ),
    ),
)
