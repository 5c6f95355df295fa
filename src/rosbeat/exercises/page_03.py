"""Page 03, write a publisher: another sensor's beat, a walk between two limits, a node alone."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from rosbeat.checks.verdicts import failed, failed_by, passed
from rosbeat.diagnosis.mistakes import Diagnosis
from rosbeat.diagnosis.wires import Wire, why_not_published
from rosbeat.exercises.exercise import Exercise
from rosbeat.exercises.running import observe
from rosbeat.exercises.walks import PHASE, Walk, watch_walk
from rosbeat.records import NANOSECONDS, Observation, Outcome, Sample

_FLOAT = "std_msgs/msg/Float32"
_HUMIDITY = Wire("/humidity", _FLOAT)
_ROOM = Wire("/temperature", _FLOAT)
_GREENHOUSE = Wire("/greenhouse/temperature", _FLOAT)

#: Seconds to look at a beat of two a second.
_SECONDS = 5
_DEPTH = 5
_FAHRENHEIT_RATE = 4
#: Seconds of wall time for a walk that wanders freely; about one is needed.
_PATIENCE = 30.0


def _fahrenheit(celsius: float) -> float:
    return celsius * 9 / 5 + 32


_ROOM_WALK = Walk(18.0, 28.0, 0.3)
_GREENHOUSE_WALK = Walk(
    *(_fahrenheit(10.2), _fahrenheit(28.0), 0.9, "degrees Fahrenheit"),
    " (In Celsius, where it walks, steps go up to 0.5, and the limits are 10.2 and 28.0.)",
)


def _judge_beat(observation: Observation) -> Outcome:
    found = _missing(observation, _HUMIDITY) or _beat(observation, _HUMIDITY, 2)
    if found:
        return failed_by("03a", found)
    count = len(_on(observation, _HUMIDITY))
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
    evidence = f"{count} readings in {_SECONDS} seconds on /humidity."
    return passed("03a", evidence, *([remark] if remark else []))


_BEST_EFFORT = (
    "Your publisher is BEST_EFFORT: it does not repeat what got lost, and a subscriber that asks "
    "for RELIABLE, as they do by default, hears nothing of it."
)


def _judge_room(observation: Observation) -> Outcome:
    found = _missing(observation, _ROOM)
    if found:
        return failed_by("03b", found)
    values = _values(observation, _ROOM)
    wrong = _beat(observation, _ROOM, 1) or _ROOM_WALK.diagnose(values)
    return failed_by("03b", wrong) if wrong else passed("03b", _ROOM_WALK.evidence(values))


def _judge_greenhouse(observation: Observation) -> Outcome:
    found = _missing(observation, _GREENHOUSE)
    if found:
        return failed_by("03c", found)
    values = _values(observation, _GREENHOUSE)
    wrong = _beat(observation, _GREENHOUSE, _FAHRENHEIT_RATE)
    wrong = wrong or _unit(values) or _GREENHOUSE_WALK.diagnose(values) or _start(values[0])
    if wrong:
        return failed_by("03c", wrong)
    return passed("03c", f"Four readings a second. {_GREENHOUSE_WALK.evidence(values)}")


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


# What all three share.


def _on(observation: Observation, wire: Wire) -> list[Sample]:
    return [sample for sample in observation.samples if sample.topic == wire.topic]


def _values(observation: Observation, wire: Wire) -> list[float]:
    return [float(sample.value) for sample in _on(observation, wire)]


def _missing(observation: Observation, wire: Wire) -> Diagnosis | None:
    """Why there is too little to judge on a topic, or None if there is enough."""
    heard = _on(observation, wire)
    if heard and heard[0].type_name != wire.type_name:
        return Diagnosis(
            "type-mismatch",
            f"The messages on {wire.topic} are of type {heard[0].type_name}.",
            f"Publisher and subscriber must agree on the type: here it is {wire.type_name}.",
        )
    if heard:
        return None
    return why_not_published(observation, wire) or Diagnosis(
        "new-to-me",
        f"Nothing was published on {wire.topic}.",
        "Follow the data: what calls the callback, and does the callback call publish?",
    )


def _beat(observation: Observation, wire: Wire, rate: int) -> Diagnosis | None:
    """Whether readings came `rate` times a second, first after one period."""
    heard = _on(observation, wire)
    period, seconds = NANOSECONDS // rate, observation.time
    count = observation.time_ns // period
    if [sample.time_ns for sample in heard] == [n * period for n in range(1, count + 1)]:
        return None
    if not any(sample.time_ns for sample in heard):
        return _only_at_once(observation, len(heard))
    if len({sample.time_ns for sample in heard}) < len(heard):
        return _several_at_once(heard)
    if not heard[0].time_ns:
        return _from_the_start(len(heard))
    times = ", ".join(f"{sample.time:g}" for sample in heard[:5])
    return Diagnosis(
        "wrong-rate",
        f"In {seconds:g} seconds {len(heard)} readings appeared, the first ones at these seconds: "
        f"{times}.",
        f"{_WORDS[rate]} a second is wanted. What does the first argument of create_timer count: "
        "calls in a second, or seconds between two calls?",
    )


def _several_at_once(heard: list[Sample]) -> Diagnosis:
    times = [sample.time_ns for sample in heard]
    first = next(sample for sample in heard if times.count(sample.time_ns) > 1)
    return Diagnosis(
        "wrong-rate",
        f"At {first.time:g} s, {times.count(first.time_ns)} readings were published at once.",
        "One reading for each tick is enough. Does anything publish twice, or are there two "
        "timers?",
    )


def _from_the_start(count: int) -> Diagnosis:
    return Diagnosis(
        "wrong-rate",
        f"{count} readings appeared, and the first one at 0 s.",
        "The first tick comes after one period. What publishes while the node is being made?",
    )


def _only_at_once(observation: Observation, count: int) -> Diagnosis:
    return Diagnosis(
        "no-timer",
        f"{count} readings were published while the node was made, and none later.",
        "The constructor runs once. What calls the method again and again?",
    )


_WORDS = {1: "One", 2: "Two", 4: "Four"}


def _five_seconds(answer: Any) -> Observation:  # noqa: ANN401
    return observe(answer, _SECONDS)


def _walking(answer: Any, walk: Walk, wire: Wire, rate: int) -> Observation:  # noqa: ANN401
    def look(seconds: float, others: list[Any]) -> tuple[Observation, list[float]]:
        # Without the drift it is a long look, and a busy machine takes its time.
        patience = {} if others else {"deadline": _PATIENCE}
        seen = observe(answer, seconds, others=others, seed=3, **patience)
        return seen, _values(seen, wire)

    found: Observation = watch_walk(walk, rate, look)
    return found


EXERCISES = (
    Exercise(
        "03a",
        _five_seconds,
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
        lambda answer: _walking(answer, _ROOM_WALK, _ROOM, 1),
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
        lambda answer: _walking(answer, _GREENHOUSE_WALK, _GREENHOUSE, _FAHRENHEIT_RATE),
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
