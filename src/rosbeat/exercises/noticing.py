"""A monitor that notices that nobody speaks any more, and that somebody speaks again.

Pure functions from what it said to an outcome.
"""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from dataclasses import dataclass

from rosbeat.diagnosis.mistakes import Diagnosis
from rosbeat.diagnosis.wires import Wire, why_not_heard, why_not_published
from rosbeat.exercises import page_09_scenarios as page_09
from rosbeat.exercises.exercise import failed_by, passed
from rosbeat.records import Observation, Outcome

READING = Wire(page_09.TEMPERATURE, page_09.FLOAT)
STATUS = Wire("/status", "std_msgs/msg/String")
LOST, BACK = "lost", "back"
#: Seconds without a reading after which a sensor is lost, and how late that may be said.
SILENCE, LATE = 3.0, 1.0
_ROOM = 0.05


@dataclass(frozen=True)
class _Word:
    at: float
    text: str


def judge_noticing(exercise: str, observation: Observation, readings: Sequence[float]) -> Outcome:
    """Judge a monitor that says `lost` and `back`.

    Args:
        exercise: The exercise's id.
        observation: What it did.
        readings: When readings came, in seconds. Between two of them are clearly less than three
            seconds, or more than five.
    """
    wrong = _mute(observation) or _first(_words(observation), readings)
    wrong = wrong or _walk(_words(observation), _silences(readings))
    if wrong:
        return failed_by(exercise, wrong)
    silences = len(_silences(readings))
    return passed(
        exercise,
        f"{len(readings)} readings, {silences} silences: each was noticed once, and its end too.",
    )


def _words(observation: Observation) -> list[_Word]:
    return [
        _Word(one.time, str(one.value).strip().lower())
        for one in observation.samples
        if (one.topic, one.node) == (STATUS.topic, observation.subject)
    ]


def _silences(readings: Sequence[float]) -> list[tuple[float, float]]:
    """The last reading before each silence, and the first one after it."""
    pairs = itertools.pairwise(readings)
    return [(last, first) for last, first in pairs if first - last > SILENCE]


def _mute(observation: Observation) -> Diagnosis | None:
    """A node that hears nothing, or cannot say anything."""
    heard = any(
        (one.node, one.source) == (observation.subject, READING.topic)
        for one in observation.callbacks
    )
    if not heard:
        return why_not_heard(observation, READING) or Diagnosis(
            "no-subscription",
            "Readings were published on /temperature, and the node got none.",
            "What listens to them, and under which name?",
        )
    said = [one for one in observation.samples if one.topic == STATUS.topic]
    if said and said[0].type_name != STATUS.type_name:
        return Diagnosis(
            "type-mismatch",
            f"The messages on /status are of type {said[0].type_name}.",
            "A status is a text: both sides of a topic must agree on its type.",
        )
    silent = None if said else why_not_published(observation, STATUS)
    return silent if silent and silent.mistake != "never-published" else None


def _first(words: Sequence[_Word], readings: Sequence[float]) -> Diagnosis | None:
    """A wrong word, or one that comes before there was anything to lose."""
    for word in words:
        if word.text not in (LOST, BACK):
            evidence = f"On /status appeared {word.text!r}, at {word.at:g} s."
            hint = "The status is one word, lost or back, and nothing else."
            return Diagnosis("wrong-word", evidence, hint)
    if words and words[0].text == LOST and words[0].at < readings[0]:
        return Diagnosis(
            "lost-before-found",
            f"It said lost at {words[0].at:g} s, and the first reading came at {readings[0]:g} s.",
            "What was never there cannot be lost: how does the node know that it has heard one?",
        )
    return None


def _walk(words: Sequence[_Word], silences: Sequence[tuple[float, float]]) -> Diagnosis | None:
    """Compare what was said with what was to be said, one after the other."""
    left = list(words)
    for last, first in silences:
        wrong = _lost(left, last, first) or _back(left, last, first)
        if wrong:
            return wrong
        del left[:2]
    return _more(left[0], len(silences)) if left else None


def _lost(left: Sequence[_Word], last: float, first: float) -> Diagnosis | None:
    said = left[0] if left else None
    silence = f"No reading came from {last:g} s to {first:g} s"
    if said is None or said.at > first + LATE + _ROOM:
        hint = (
            "A message cannot tell that there is none. What else calls the node, again and again, "
            "and by which clock does it count? A session's time is the node's own clock."
        )
        return Diagnosis("silence-unnoticed", f"{silence}, and nobody said lost.", hint)
    if said.text == BACK:
        evidence = f"It said back at {said.at:g} s, and the sensor was not lost then."
        return Diagnosis("back-too-often", evidence, "Back is the end of lost, and only of that.")
    if said.at < last + SILENCE - _ROOM:
        return Diagnosis(
            "noticed-early",
            f"It said lost at {said.at:g} s. The silences before that were shorter than "
            f"{SILENCE:g} s.",
            f"Count from the last reading, and wait for {SILENCE:g} s of silence.",
        )
    return _too_late(said, silence, last, first)


def _too_late(said: _Word, silence: str, last: float, first: float) -> Diagnosis | None:
    if said.at >= first - _ROOM:
        return Diagnosis(
            "noticed-afterwards",
            f"{silence}. It said lost at {said.at:g} s, when the silence was over.",
            "The callback of a subscription runs when a message comes. Who looks when none comes?",
        )
    if said.at > last + SILENCE + LATE + _ROOM:
        return Diagnosis(
            "noticed-late",
            f"{silence}. It said lost at {said.at:g} s, {said.at - last:g} s after the last one.",
            f"After {SILENCE:g} s, and at most {LATE:g} s later: how often does the node look?",
        )
    return None


def _back(left: Sequence[_Word], last: float, first: float) -> Diagnosis | None:
    said = left[1] if len(left) > 1 else None
    if said is not None and said.text == LOST and said.at < first + LATE:
        evidence = f"It said lost at {left[0].at:g} s, and again at {said.at:g} s."
        hint = "Once is enough: what does the node have to remember?"
        return Diagnosis("status-repeated", evidence, hint)
    if said is None or said.text == LOST:
        evidence = f"A reading came at {first:g} s, after a silence, and nobody said back."
        return Diagnosis("back-missing", evidence, "A reading that ends a silence is news.")
    if said.at < first - _ROOM:
        evidence = f"It said back at {said.at:g} s, and no reading came before {first:g} s."
        return Diagnosis("back-too-often", evidence, "Only a reading brings a sensor back.")
    if said.at > first + LATE + _ROOM:
        evidence = f"A reading came at {first:g} s, and it said back at {said.at:g} s."
        return Diagnosis("noticed-late", evidence, "The reading itself is the news.")
    return None


def _more(word: _Word, silences: int) -> Diagnosis:
    """A word for which there was no reason left."""
    if word.text == BACK:
        evidence = f"It said back at {word.at:g} s, and the sensor was not lost then."
        return Diagnosis("back-too-often", evidence, "Back is the end of lost, and only of that.")
    evidence = f"It said lost at {word.at:g} s; the last of {silences} silences was over."
    hint = f"Count from the last reading, and wait for {SILENCE:g} s of silence."
    return Diagnosis("noticed-early", evidence, hint)
