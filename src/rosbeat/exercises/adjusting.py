"""A monitor whose limits are changed while it runs: by a service, or by parameters.

It is fed readings, and asked for new limits between them. What it answers says whether it has
understood; what it publishes on `/status` afterwards says what it has kept. Pure functions.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from rosbeat.diagnosis.mistakes import Diagnosis
from rosbeat.diagnosis.wires import Wire, why_not_heard, why_not_published
from rosbeat.exercises.page_12_scenarios import FLOAT, Request
from rosbeat.records import Observation, Reply

TEMPERATURE = Wire("/temperature", FLOAT)
STATUS = Wire("/status", "std_msgs/msg/String")
_NEVER = float("-inf")


@dataclass(frozen=True)
class Limits:
    """What a monitor judges by; below `low` is Low, above `high` is High."""

    high: float
    low: float = _NEVER

    def status(self, reading: float) -> str:
        """The word for a reading; of a NaN as a limit nothing is known, as in Python."""
        return "High" if reading > self.high else "Low" if reading < self.low else "Normal"

    def changed(self, values: dict[str, float]) -> Limits:
        """These limits with some others in their places."""
        return Limits(values.get("high", self.high), values.get("low", self.low))


@dataclass(frozen=True)
class Phase:
    """One request, and what is fed after it.

    Attributes:
        values: The limits that are asked for; empty before the first request.
        good: Whether they make sense.
        readings: What is fed until the next request.
        limits: What holds then.
        before: What held before.
    """

    values: dict[str, float]
    good: bool
    readings: tuple[float, ...]
    limits: Limits
    before: Limits

    @property
    def asked(self) -> str:
        """The request in words."""
        return " and ".join(f"{name} = {value:g}" for name, value in self.values.items())


def phases(
    start: Limits, requests: Sequence[Request], sensible: Callable[[Limits], bool]
) -> tuple[Phase, ...]:
    """Work out which limits hold when.

    Args:
        start: Those of the beginning.
        requests: What is asked for, and what is fed afterwards.
        sensible: Whether limits make sense.
    """
    found, limits = [], start
    for values, readings in requests:
        asked = limits.changed(values)
        good = sensible(asked)
        after = asked if good else limits
        found.append(Phase(values, good, readings, after, limits))
        limits = after
    return tuple(found)


def deaf_or_dumb(observation: Observation) -> Diagnosis | None:
    """Why no reading was heard, or nothing said about any; None if all is well."""
    if not any(call.source == TEMPERATURE.topic for call in observation.callbacks):
        return why_not_heard(observation, TEMPERATURE) or Diagnosis(
            "no-subscription",
            "Readings were published on /temperature, and the node got none.",
            "The subscription was part of what you were given.",
        )
    if any(one.topic == STATUS.topic for one in observation.samples):
        return None
    return why_not_published(observation, STATUS) or Diagnosis(
        "never-published",
        "Readings arrived, and nothing was published on /status.",
        "The status of each reading was part of what you were given.",
    )


def words_of(observation: Observation, all_phases: Sequence[Phase]) -> list[list[str]]:
    """What was said on `/status` about each phase's readings; `-` for nothing or too much."""
    said: dict[float, list[str]] = {}
    for sample in observation.samples:
        if sample.topic == STATUS.topic:
            said.setdefault(sample.time, []).append(str(sample.value).strip())
    found, second = [], 0
    for phase in all_phases:
        words = []
        for _ in phase.readings:
            second += 1
            here = said.get(float(second), [])
            words.append(here[0] if len(here) == 1 else "-")
        found.append(words)
    return found


def wrong_at_first(phase: Phase, words: list[str]) -> Diagnosis | None:
    """What is wrong before anything was asked for."""
    for reading, word in zip(phase.readings, words, strict=True):
        wanted = phase.limits.status(reading)
        if word != wanted:
            found = "nothing, or more than one thing" if word == "-" else word
            at_limit = reading in (phase.limits.high, phase.limits.low)
            return Diagnosis(
                "boundary" if at_limit else "wrong-state",
                f"For a reading of {reading:g}, before any change, the node said {found}.",
                f"It should be {wanted}: above high is High"
                f"{', below low is Low' if phase.limits.low != _NEVER else ''}, else Normal.",
            )
    return None


def kept(phase: Phase, words: list[str]) -> str:
    """What a phase's words show: `as wanted`, `as asked`, `as before`, or `otherwise`."""
    if words == _said(phase.limits, phase):
        return "as wanted"
    if words == _said(phase.before.changed(phase.values), phase):
        return "as asked"
    return "as before" if words == _said(phase.before, phase) else "otherwise"


def _said(limits: Limits, phase: Phase) -> list[str]:
    return [limits.status(reading) for reading in phase.readings]


def replies_to(observation: Observation, word: str, name: str) -> dict[int, Reply]:
    """The answers to the requests, by the number of the request, from 1."""
    found = (one for one in observation.replies if (one.word, one.name) == (word, name))
    return {one.number: one for one in found}


@dataclass(frozen=True)
class Answer:
    """What came back for one request.

    Attributes:
        said: Whether it was accepted; None if there was no answer.
        reason: What was said about it.
    """

    said: bool | None
    reason: str = ""


def judge_answers(
    all_phases: Sequence[Phase], answers: Sequence[Answer], words: Sequence[list[str]]
) -> Diagnosis | None:
    """Compare what was answered and what was kept with what makes sense.

    Args:
        all_phases: The first without a request, and those with one.
        answers: One for each request.
        words: What was said about the readings of each phase.
    """
    asked = list(zip(all_phases[1:], answers, words[1:], strict=True))
    for phase, answer, said in asked:
        wrong = _wrong(phase, answer, kept(phase, said))
        if wrong:
            return _dumb(asked) or wrong
    return None


def _dumb(asked: Sequence[tuple[Phase, Answer, list[str]]]) -> Diagnosis | None:
    """A node that does what it should, and says no to everything."""
    works = all(kept(phase, said) == "as wanted" for phase, _, said in asked)
    if not works or any(answer.said for _, answer, _ in asked):
        return None
    return Diagnosis(
        "response-not-filled",
        "Good values are used from then on, and every response says that they were refused.",
        "A field that nobody fills holds False. Where does the client read that you accepted?",
    )


def _wrong(phase: Phase, answer: Answer, effect: str) -> Diagnosis | None:
    if phase.good and not answer.said:
        return _refused(phase, answer)
    if not phase.good and answer.said:
        return _nonsense(phase, effect)
    if effect != "as wanted":
        return _other_effect(phase, effect)
    if not phase.good and not answer.reason.strip():
        return Diagnosis(
            "reason-missing",
            f"{phase.asked} was refused, and no reason was given.",
            "Who is refused wants to know why: there is a field for a text.",
        )
    if phase.good and answer.reason.strip():
        return Diagnosis(
            "reason-too-many",
            f"{phase.asked} was accepted, with the text {answer.reason!r}, as for a refusal.",
            "Give a reason only if you refuse; the field is empty by itself.",
        )
    return None


def _refused(phase: Phase, answer: Answer) -> Diagnosis:
    said = f", because: {answer.reason!r}" if answer.reason else ""
    if len(phase.values) > 1:
        return Diagnosis(
            "validated-one-by-one",
            f"{phase.asked}, at once, was refused{said}. Together they make sense.",
            "Both new values are in the list. Which of your comparisons still uses an old one?",
        )
    return Diagnosis(
        "good-value-refused",
        f"{phase.asked} was refused{said}. It makes sense.",
        "Which of your conditions is true for this value? Are the limits themselves fine?",
    )


def _nonsense(phase: Phase, effect: str) -> Diagnosis:
    (value, *_) = phase.values.values()
    if value != value:
        return Diagnosis(
            "nan-accepted",
            "NaN, which is no number, was accepted.",
            "Every comparison with NaN is False, so a test for what is bad lets it pass. How does "
            "a test for what is good read?",
        )
    if phase.before.low != _NEVER:
        return _unseen(phase)
    lost = "" if effect == "as asked" else " (It was not used afterwards, and still that is a lie.)"
    return Diagnosis(
        "nonsense-accepted",
        f"{phase.asked} was accepted.{lost}",
        "It makes no sense here. Which of your conditions should have caught it, and does the "
        "answer say so?",
    )


def _unseen(phase: Phase) -> Diagnosis:
    """Limits of which one depends on the other: the comparison may not see the new one."""
    limits = phase.before.changed(phase.values)
    return Diagnosis(
        "nonsense-accepted",
        f"{phase.asked} was accepted. That makes low = {limits.low:g} and high = {limits.high:g}.",
        "Print what you compare, just before you compare it: does it hold these two numbers? If "
        "so, look at the comparison; if not, at how a new value gets there, under which name.",
    )


def _other_effect(phase: Phase, effect: str) -> Diagnosis:
    example = next(
        (one for one in phase.readings
         if phase.before.changed(phase.values).status(one) != phase.before.status(one)),
        phase.readings[0],
    )  # fmt: skip
    if phase.good and effect == "otherwise":
        return Diagnosis(
            "other-limits",
            f"{phase.asked} was accepted, and the readings after it, "
            f"{', '.join(f'{one:g}' for one in phase.readings)}, were judged by other limits.",
            "What is kept has to be exactly what was asked for. Is it changed on the way?",
        )
    if phase.good:
        return Diagnosis(
            "accepted-and-lost",
            f"{phase.asked} was accepted, and the readings after it were judged as if it had not "
            f"been; one was {example:g}.",
            "Where do you keep the new value, and from where does the callback take it?",
        )
    if effect == "as asked":
        return Diagnosis(
            "refused-and-kept",
            f"{phase.asked} was refused, and used all the same: the reading {example:g} shows it.",
            "Look first, keep afterwards: what is refused must not change anything.",
        )
    return Diagnosis(
        "refused-and-kept",
        f"{phase.asked} was refused, and yet the limits are others afterwards.",
        "What is refused must not change anything. Which line runs on both ways?",
    )
