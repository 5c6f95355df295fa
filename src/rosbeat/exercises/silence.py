"""Silence is news: what a watchdog said while readings came, stopped and came again.

Pure functions from an observation to an outcome.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

from rosbeat.diagnosis.mistakes import UNKNOWN, Diagnosis
from rosbeat.diagnosis.wires import Wire, why_not_heard, why_not_published
from rosbeat.exercises import page_08_scenarios as page_08
from rosbeat.exercises.exercise import failed_by, passed
from rosbeat.exercises.page_08_scenarios import LIMIT
from rosbeat.records import NANOSECONDS, Endpoint, Observation, Outcome

TEMPERATURE = Wire(page_08.TEMPERATURE, page_08.FLOAT)
HEALTH = Wire("/health", "std_msgs/msg/String")
LOST, BACK = "lost", "back"
#: How late a node may be that looks at a clock now and then, in seconds.
_LATE = 0.45
_Word = tuple[float, str]


def judge_silence(exercise: str, observation: Observation, times: Sequence[float]) -> Outcome:
    """Judge a watchdog.

    Args:
        exercise: The exercise's id.
        observation: What it did.
        times: When readings came, in seconds; silence lasts to the end of the observation.
    """
    wrong = _deaf(observation, times)
    said = [one for one in observation.samples if one.topic == HEALTH.topic]
    wrong = wrong or (None if said else _silent(observation))
    if not wrong and said[0].type_name != HEALTH.type_name:
        wrong = Diagnosis(
            "type-mismatch",
            f"The messages on /health are of type {said[0].type_name}.",
            "The two words are sent as a String.",
        )
    words = [(one.time, str(one.value)) for one in said]
    news = _news(times, observation.time)
    wrong = wrong or _compared(observation, words, news, times)
    if wrong:
        return failed_by(exercise, wrong)
    silences = sum(word == LOST for _, word in news)
    return passed(
        exercise,
        f"{len(times)} readings, {silences} silences: {LOST!r} once in each of them, and {BACK!r} "
        "once after each that ended.",
    )


def _news(times: Sequence[float], end: float) -> list[_Word]:
    """When which word is due."""
    found: list[_Word] = []
    for before, after in pairwise([*times, end]):
        if after - before > LIMIT:
            found += [(before + LIMIT, LOST), (after, BACK)]
    return found[:-1] if found and found[-1] == (end, BACK) else found


def _deaf(observation: Observation, times: Sequence[float]) -> Diagnosis | None:
    heard = any(
        (one.node, one.source, one.kind) == (observation.subject, TEMPERATURE.topic, "subscription")
        for one in observation.callbacks
    )
    if heard:
        return None
    return why_not_heard(observation, TEMPERATURE) or Diagnosis(
        UNKNOWN,
        f"{len(times)} readings were published on /temperature, and the node got none.",
        "Is it connected? Compare what it asks for with what the sensor offers.",
    )


# Nothing was said.


def _silent(observation: Observation) -> Diagnosis:
    return _unmeasured(observation) or (
        why_not_published(observation, HEALTH)
        or Diagnosis(
            "never-published",
            "Readings stopped coming, and nothing was published on /health.",
            "Does the callback of the event come to the line that publishes?",
        )
    )


def _unmeasured(observation: Observation) -> Diagnosis | None:
    """Why the node did not notice that readings stopped, if that can be seen."""
    mine = [end for end in observation.graph.endpoints if end.node == observation.subject]
    called = any(
        one.node == observation.subject and one.kind in ("event", "timer")
        for one in observation.callbacks
    )
    if called:
        return None
    asking = [end for end in mine if end.kind == "subscription" and end.qos.deadline_ns]
    if asking and asking[0].qos.deadline_ns > LIMIT * NANOSECONDS:
        return Diagnosis(
            "wrong-deadline",
            f"The subscription has a deadline of {_seconds(asking[0])}.",
            f"{LOST!r} is due when nothing has come for {LIMIT:g} s.",
        )
    if asking:
        return Diagnosis(
            "deadline-unheard",
            f"The subscription has a deadline of {_seconds(asking[0])}. It was missed, and nobody "
            "was told.",
            "create_subscription takes event_callbacks: what is called if the deadline is missed?",
        )
    offering = [end for end in mine if end.kind == "publisher" and end.qos.deadline_ns]
    if offering:
        return Diagnosis(
            "deadline-wrong-side",
            f"The publisher on {offering[0].name} has a deadline, and the subscription to "
            "/temperature has none.",
            "Readings are what is waited for. Which end of the node gets them?",
        )
    return Diagnosis(
        "no-deadline",
        "Readings stopped coming, and nothing in the node measures how long: its subscription has "
        "no deadline.",
        "A deadline is a part of the QoS that the subscription asks for.",
    )


def _seconds(end: Endpoint) -> str:
    return f"{end.qos.deadline_ns / NANOSECONDS:g} s"


# Something was said.


def _compared(
    observation: Observation,
    words: Sequence[_Word],
    news: Sequence[_Word],
    times: Sequence[float],
) -> Diagnosis | None:
    return (
        _strange(words)
        or _begins(words)
        or _repeated(words)
        or _late(observation, words, news, times)
        or _counted(words, news)
    )


def _strange(words: Sequence[_Word]) -> Diagnosis | None:
    strange = next(((at, word) for at, word in words if word not in (LOST, BACK)), None)
    if strange is None:
        return None
    return Diagnosis(
        "wrong-word",
        f"At {strange[0]:g} s the node said {strange[1]!r}.",
        f"The two words are {LOST!r} and {BACK!r}. Compare them letter by letter.",
    )


def _begins(words: Sequence[_Word]) -> Diagnosis | None:
    if not words or words[0][1] == LOST:
        return None
    return Diagnosis(
        "wrong-start",
        f"The first word was {BACK!r}, at {words[0][0]:g} s, and nothing had been lost.",
        f"Only what was lost can be back. What does the node know before its first {LOST!r}?",
    )


def _repeated(words: Sequence[_Word]) -> Diagnosis | None:
    for (before, word), (at, again) in pairwise(words):
        if again == word:
            why = (
                "The event comes again in each further period of silence."
                if word == LOST
                else "One reading after the silence is news, the next is not."
            )
            return Diagnosis(
                "status-repeated",
                f"The node said {word!r} at {before:g} s, and again at {at:g} s.",
                f"{why} The node has to remember what it has said.",
            )
    return None


def _late(
    observation: Observation,
    words: Sequence[_Word],
    news: Sequence[_Word],
    times: Sequence[float],
) -> Diagnosis | None:
    """The first word that came at another time than it should."""
    for (at, word), (due, wanted) in zip(words, news, strict=False):
        if word != wanted:
            continue
        if due - 1e-6 <= at <= due + _LATE and not (word == LOST and _asks_for_more(observation)):
            continue
        return _off(observation, at, times) if word == LOST else _not_at_once(at, due)
    return None


def _asks_for_more(observation: Observation) -> bool:
    """Whether a deadline that is too long is all that measures; a clock may look now and then."""
    mine = [one for one in observation.callbacks if one.node == observation.subject]
    asked = [
        end.qos.deadline_ns
        for end in observation.graph.on(TEMPERATURE.topic, "subscription")
        if end.node == observation.subject and end.qos.deadline_ns
    ]
    timers = any(one.kind == "timer" for one in mine)
    return not timers and bool(asked) and min(asked) > LIMIT * NANOSECONDS


def _off(observation: Observation, at: float, times: Sequence[float]) -> Diagnosis:
    last = max((time for time in times if time <= at), default=0.0)
    asking = [
        end
        for end in observation.graph.on(TEMPERATURE.topic, "subscription")
        if end.node == observation.subject and end.qos.deadline_ns
        if abs(end.qos.deadline_ns / NANOSECONDS - (at - last)) < _LATE
    ]
    begins = " What measures that has to begin again with each reading."
    early = begins if at - last < LIMIT else ""
    said = f" Its deadline is {_seconds(asking[0])}." if asking else ""
    return Diagnosis(
        "wrong-deadline",
        f"The last reading before had come at {last:g} s, and the node said {LOST!r} at {at:g} s: "
        f"{at - last:g} s later.{said}",
        f"{LOST!r} is due when nothing has come for {LIMIT:g} s.{early}",
    )


def _not_at_once(at: float, due: float) -> Diagnosis:
    return Diagnosis(
        "wrong-rate",
        f"A reading came again at {due:g} s, and the node said {BACK!r} at {at:g} s.",
        "The first reading after the silence brings the news. Which callback is called then?",
    )


def _counted(words: Sequence[_Word], news: Sequence[_Word]) -> Diagnosis | None:
    if len(words) == len(news):
        return None
    if len(words) > len(news):
        at, word = words[len(news)]
        evidence = f"At {at:g} s the node said {word!r}, and there was no reason."
        return Diagnosis("alert-too-many", evidence, "When does each of your callbacks run?")
    due, word = news[len(words)]
    what = "nothing had come for 2 s" if word == LOST else "a reading came again"
    return Diagnosis(
        "change-missing",
        f"At {due:g} s {what}, and the node did not say {word!r}.",
        "It has to notice each silence, and the end of each. What does it remember?",
    )
