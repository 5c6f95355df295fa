"""Page 04, write a subscriber: find the state, and pass an alert on."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from rosbeat.checks.verdicts import failed, passed
from rosbeat.exercises.exercise import Exercise
from rosbeat.records import Observation, Outcome
from rosbeat.runtime.scenario import feeder, observe

#: What is fed in, and what it is. A float32 holds each of these numbers exactly.
_FRIDGE = {
    5.0: "Fine",
    9.5: "Warm",
    8.0: "Fine",
    8.25: "Warm",
    2.0: "Fine",
    1.75: "Frost",
    -18.0: "Frost",
}
_ROOM = {22.0: False, 27.5: True, 26.0: False, 26.25: True, 20.0: False, 19.75: True, -5.0: True}
_FLOAT, _STRING = "std_msgs/msg/Float32", "std_msgs/msg/String"
_SENSOR = "/temperature_sensor"
_WORDS = ("Warm", "Frost", "Fine")


def _fed(answer: Any, values: Iterable[float]) -> Observation:  # noqa: ANN401
    readings = list(values)
    sensor = feeder(_SENSOR.strip("/"), "temperature", _FLOAT, readings)
    return observe(answer, len(readings) + 1, others=[sensor])


def _judge_states(observation: Observation) -> Outcome:
    deaf = _deaf("04a", observation)
    if deaf:
        return deaf
    for second, (value, wanted) in enumerate(_FRIDGE.items(), 1):
        said = [log.text for log in observation.logs if log.time == second]
        wrong = _wrong_state(value, wanted, said)
        if wrong:
            return wrong
    return passed("04a", f"All {len(_FRIDGE)} readings got the right state, 8.0 and 2.0 too.")


def _wrong_state(value: float, wanted: str, said: list[str]) -> Outcome | None:
    words = [word for word in _WORDS if any(word.lower() in line.lower() for line in said)]
    if words == [wanted]:
        return None
    if not said:
        evidence = f"A reading of {value:g} arrived and nothing was logged."
        return failed("04a", evidence, "End the callback with self.get_logger().info(...).")
    found = " and ".join(words) or f"none of {', '.join(_WORDS)}"
    return failed(
        "04a", f"For a reading of {value:g} the node said {found}.", _state_hint(value, wanted)
    )


def _state_hint(value: float, wanted: str) -> str:
    if value in (8.0, 2.0):
        return f"Exactly {value:g} is {wanted}: above 8 is Warm, below 2 is Frost."
    return f"It should be {wanted}. Which of your conditions is true for {value:g}?"


def _judge_alarm(observation: Observation) -> Outcome:
    deaf = _deaf("04b", observation)
    if deaf:
        return deaf
    wanted = [second for second, alarming in enumerate(_ROOM.values(), 1) if alarming]
    alerts = [sample for sample in observation.samples if sample.topic == "/alert"]
    if not alerts:
        return failed("04b", *_silent_words(observation))
    if alerts[0].type_name != _STRING:
        return failed(
            "04b",
            f"The alerts are messages of type {alerts[0].type_name}.",
            "An alert is a String: the first argument of create_publisher, and what you publish.",
        )
    times = [sample.time for sample in alerts]
    if times == wanted:
        return passed("04b", f"{len(_ROOM)} readings, {len(times)} alerts: none too many.")
    return failed("04b", *_alarm_words(times, wanted))


def _silent_words(observation: Observation) -> tuple[str, str]:
    topics = {s.topic for s in observation.samples if s.node not in ("", _SENSOR)}
    if topics:
        return (
            f"It published on {', '.join(sorted(topics))}, and nothing on /alert.",
            "The topic is called alert. Topics match letter by letter.",
        )
    if any(end.name == "/alert" for end in observation.graph.endpoints):
        return (
            "Readings were too high and too low, and no alert was published.",
            "Is your condition ever true? No reading is above 26 and below 20 at once.",
        )
    return (
        "Readings were too high and too low, and nothing was published on /alert.",
        "Make a publisher in __init__ and call its publish in the callback.",
    )


def _alarm_words(times: list[float], wanted: list[int]) -> tuple[str, str]:
    values = list(_ROOM)
    extra = [values[int(at) - 1] for at in times if at not in wanted]
    if extra:
        return (
            f"An alert was published for a reading of {extra[0]:g}.",
            "Publish only if the reading is above 26 or below 20; the limits are still fine.",
        )
    missed = [values[at - 1] for at in wanted if at not in times]
    if missed:
        return f"No alert for a reading of {missed[0]:g}.", "Both above 26 and below 20 count."
    return f"{len(times)} alerts for {len(wanted)} readings.", "One alert for each is enough."


def _deaf(exercise: str, observation: Observation) -> Outcome | None:
    calls = [c for c in observation.callbacks if c.source == "/temperature"]
    if calls:
        return None
    return failed(
        exercise,
        "Seven readings were published on /temperature and the node got none.",
        'Does it call create_subscription, with the topic "temperature"?',
    )


EXERCISES = (
    Exercise("04a", lambda answer: _fed(answer, _FRIDGE), _judge_states),
    Exercise("04b", lambda answer: _fed(answer, _ROOM), _judge_alarm),
)
