"""Page 03, write a publisher: another sensor's beat, and a walk between two limits."""

from __future__ import annotations

from itertools import pairwise
from typing import Any

from rosbeat.checks.verdicts import failed, passed
from rosbeat.exercises.exercise import Exercise
from rosbeat.records import NANOSECONDS, Observation, Outcome, Sample
from rosbeat.runtime.scenario import observe

_SECONDS = 5
_PERIOD = NANOSECONDS // 2
#: Long enough for a walk of such steps to meet both limits again and again.
_TWO_HOURS = 7200.0
_STEP = 0.3
_LIMITS = (18.0, 28.0)
_FLOAT = "std_msgs/msg/Float32"


def _five_seconds(answer: Any) -> Observation:  # noqa: ANN401
    return observe(answer, _SECONDS)


def _judge_beat(observation: Observation) -> Outcome:
    heard = _on(observation, "/humidity")
    if not heard:
        return _nothing("03a", observation, "humidity")
    if heard[0].type_name != _FLOAT:
        return failed(
            "03a",
            f"The messages on /humidity are of type {heard[0].type_name}.",
            f"Publisher and subscriber must agree on the type: here it is {_FLOAT}.",
        )
    beats = _SECONDS * NANOSECONDS // _PERIOD
    if [sample.time_ns for sample in heard] != [n * _PERIOD for n in range(1, beats + 1)]:
        return failed(
            "03a",
            f"In {_SECONDS} seconds {len(heard)} readings appeared, the first at "
            f"{heard[0].time:g} s.",
            "Two a second are wanted. The first argument of create_timer is the time between two "
            "calls, in seconds.",
        )
    return _judge_depth(observation, len(heard))


def _judge_depth(observation: Observation, count: int) -> Outcome:
    depth = observation.graph.on("/humidity", "publisher")[0].qos.depth
    if depth == 5:
        return passed("03a", f"{count} readings in {_SECONDS} seconds on /humidity.")
    return failed(
        "03a",
        f"The beat is right, and the publisher's queue depth is {depth}.",
        "A depth of 5 is wanted: it is the third argument of create_publisher.",
    )


def _two_hours(answer: Any) -> Observation:  # noqa: ANN401
    return observe(answer, _TWO_HOURS, seed=3)


def _judge_walk(observation: Observation) -> Outcome:
    values = [float(sample.value) for sample in _on(observation, "/temperature")]
    if len(values) < 2:
        return _nothing("03b", observation, "temperature")
    evidence = (
        f"In two hours the temperature went from {min(values):.2f} to {max(values):.2f} degrees, "
        f"in steps of at most {_widest(values):.2f}."
    )
    hint = _walk_hint(values)
    return failed("03b", evidence, hint) if hint else passed("03b", evidence)


def _walk_hint(values: list[float]) -> str:
    """What is wrong with the walk, or an empty text."""
    low, high, widest = min(values), max(values), _widest(values)
    if widest == 0 and low in _LIMITS:
        return f"It stays at {low:g} from the first reading on. Are min and max swapped?"
    if widest == 0:
        return "It never changes. Each call must add a random number to self.temperature."
    if values == sorted(values):
        return "It only rises. A step may go down, too."
    if widest > _STEP + 1e-5:  # room for rounding to 32 bits
        return "A step is too wide. random.uniform(a, b) gives a number between a and b."
    if widest < 0.8 * _STEP:
        return f"The steps are small. They may reach {_STEP} degrees, up and down."
    return _limit_hint(low, high)


def _widest(values: list[float]) -> float:
    return max(abs(b - a) for a, b in pairwise(values))


def _limit_hint(low: float, high: float) -> str:
    if high > 28.0:
        return "It got above 28. min(28.0, self.temperature) cuts off what is higher."
    if low < 18.0:
        return "It got below 18. max(18.0, ...) cuts off what is lower."
    if low > 18.3 or high < 27.7:
        return "It stays inside narrower limits than 18 and 28. Look at the two numbers."
    return ""


def _on(observation: Observation, topic: str) -> list[Sample]:
    return [sample for sample in observation.samples if sample.topic == topic]


def _nothing(exercise: str, observation: Observation, topic: str) -> Outcome:
    if observation.samples:
        return failed(
            exercise,
            f"It published on {observation.samples[0].topic}, and too little on /{topic}.",
            f'The topic is called "{topic}". Topics match letter by letter.',
        )
    timers = [timer for timer in observation.graph.timers if timer.calls]
    return failed(
        exercise,
        f"Nothing was published on /{topic}.",
        "The timer fires; does its callback call publish?"
        if timers
        else "Nothing calls the callback. create_timer(period, callback) does, once a period.",
    )


EXERCISES = (
    Exercise("03a", _five_seconds, _judge_beat),
    Exercise("03b", _two_hours, _judge_walk),
)
