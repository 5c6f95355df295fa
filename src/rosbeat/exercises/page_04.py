"""Page 04, write a subscriber: find the state, pass an alert on, a calm monitor alone."""

from __future__ import annotations

import re

from rosbeat.diagnosis.mistakes import Diagnosis
from rosbeat.diagnosis.wires import Wire, why_not_heard
from rosbeat.exercises.calm import judge_calm
from rosbeat.exercises.exercise import Exercise, failed_by, passed
from rosbeat.exercises.model import missing, on
from rosbeat.exercises.page_04_scenarios import CALM, FLOAT, FRIDGE, ROOM, SCENARIOS, TOPIC
from rosbeat.records import Observation, Outcome

_TEMPERATURE, _ALERT = Wire(TOPIC, FLOAT), Wire("/alert", "std_msgs/msg/String")
_WORDS = ("Warm", "Frost", "Fine")


def _state_of(value: float) -> str:
    """What a fridge of this temperature is."""
    return "Warm" if value > 8.0 else "Frost" if value < 2.0 else "Fine"


def _is_alarming(value: float) -> bool:
    """Whether a room of this temperature wants an alert."""
    return value > 26.0 or value < 20.0


def _judge_states(observation: Observation) -> Outcome:
    deaf = _deaf(observation, len(FRIDGE))
    if deaf:
        return failed_by("04a", deaf)
    for second, value in enumerate(FRIDGE, 1):
        said = [log.text for log in observation.logs if log.time == second]
        wrong = _wrong_state(value, _state_of(value), said)
        if wrong:
            return failed_by("04a", wrong)
    return passed("04a", f"All {len(FRIDGE)} readings got the right state, 8.0 and 2.0 too.")


def _wrong_state(value: float, wanted: str, said: list[str]) -> Diagnosis | None:
    text = "\n".join(said)
    words = [word for word in _WORDS if re.search(rf"(?i)\b{word}\b", text)]
    if words == [wanted]:
        return None
    if not said:
        evidence = f"A reading of {value:g} arrived and nothing was logged."
        return Diagnosis(
            "nothing-logged", evidence, "End the callback with self.get_logger().info(...)."
        )
    found = " and ".join(words) or f"none of {', '.join(_WORDS)}"
    evidence = f"For a reading of {value:g} the node said {found}."
    if not words:
        hint = "The three words are Warm, Frost and Fine. Compare them letter by letter."
        return Diagnosis("wrong-word", evidence, hint)
    if value in (8.0, 2.0) and len(words) == 1:
        hint = f"Exactly {value:g} is {wanted}: above 8 is Warm, below 2 is Frost."
        return Diagnosis("boundary", evidence, hint)
    hint = f"It should be {wanted}. Which of your conditions is true for {value:g}?"
    return Diagnosis("wrong-state", evidence, hint)


def _judge_alarm(observation: Observation) -> Outcome:
    found = _deaf(observation, len(ROOM)) or _silent(observation)
    if found:
        return failed_by("04b", found)
    wanted = [second for second, value in enumerate(ROOM, 1) if _is_alarming(value)]
    times = [sample.time for sample in on(observation, _ALERT)]
    if times == wanted:
        return passed("04b", f"{len(ROOM)} readings, {len(times)} alerts: none too many.")
    return failed_by("04b", _alarms(times, wanted))


def _silent(observation: Observation) -> Diagnosis | None:
    made = any(end.name == _ALERT.topic for end in observation.graph.endpoints)
    if made and not on(observation, _ALERT):
        return Diagnosis(
            "never-published",
            "Readings were too high and too low, and no alert was published.",
            "Is your condition ever true? No reading is above 26 and below 20 at once. And is "
            "there a publish behind it?",
        )
    return missing(observation, _ALERT, otherwise=_NO_ALERTS)


_NO_ALERTS = Diagnosis(
    "no-publisher",
    "Readings were too high and too low, and nothing was published on /alert.",
    "Make a publisher in __init__ and call its publish in the callback.",
)


def _alarms(times: list[float], wanted: list[int]) -> Diagnosis:
    stray = [at for at in times if at not in range(1, len(ROOM) + 1)]
    if stray:
        return Diagnosis(
            "alert-too-many",
            f"An alert was published at {stray[0]:g} s, and no reading came then.",
            "Publish in the callback of the subscription: it runs when a reading comes.",
        )
    extra = [ROOM[round(at) - 1] for at in times if at not in wanted]
    if extra:
        return Diagnosis(
            "boundary" if extra[0] in (26.0, 20.0) else "alert-too-many",
            f"An alert was published for a reading of {extra[0]:g}.",
            "Publish only if the reading is above 26 or below 20; the limits are still fine.",
        )
    missed = [ROOM[at - 1] for at in wanted if at not in times]
    if missed:
        evidence = f"No alert for a reading of {missed[0]:g}."
        return Diagnosis("alert-missing", evidence, "Both above 26 and below 20 count.")
    evidence = f"{len(times)} alerts for {len(wanted)} readings."
    return Diagnosis("alert-too-many", evidence, "One alert for each is enough.")


def _deaf(observation: Observation, count: int) -> Diagnosis | None:
    """Why no reading was heard, or None if some were."""
    calls = [c for c in observation.callbacks if c.source == _TEMPERATURE.topic]
    if calls:
        return None
    return why_not_heard(observation, _TEMPERATURE) or Diagnosis(
        "new-to-me",
        f"{count} readings were published on /temperature and the node got none.",
        'Does it call create_subscription, with the topic "temperature"?',
    )


def _judge_monitor(observation: Observation) -> Outcome:
    deaf = _deaf(observation, len(CALM))
    return failed_by("04c", deaf) if deaf else judge_calm("04c", observation, CALM)


EXERCISES = (
    Exercise(
        "04a",
        SCENARIOS["04a"],
        _judge_states,
        "watch a fridge",
        1,
        (
            "The monitor of this page decides between three words, too. Compare the limits.",
            "if, elif and else are tried from top to bottom. > and < leave the limit itself out.",
        ),
    ),
    Exercise(
        "04b",
        SCENARIOS["04b"],
        _judge_alarm,
        "raise the alarm",
        2,
        (
            "The publisher is made once, in __init__, like the sensor's; the message type and the "
            "topic are others.",
            "One reading is enough for an alert if it is too high or if it is too low: join the "
            "two conditions with `or`.",
            "A String is made like a Float32, with text in its field data.",
        ),
    ),
    Exercise(
        "04c",
        SCENARIOS["04c"],
        _judge_monitor,
        "a calm monitor, alone",
        4,
        (
            "Do one thing after the other and check in between: first the mean, then the status.",
            "Keep the readings in a list. readings[-5:] are the last five of it, or all if there "
            "are fewer.",
            "The status needs a memory: self.status. Find the new one from the reading and from "
            "the old one, and publish it only if they differ.",
            "Ask for High and for Low first: they do not depend on what was before. Then ask "
            "whether a High or a Low has come back far enough.",
        ),
    ),
)
