"""Judge what a node did by models: of a right one, and of those that somebody misunderstood.

A wrong answer is a model, too. A judge simulates the right model and each *suspect*, which is a
small model of a misunderstanding, on what the answer was fed. A suspect that does exactly what the
answer did names the mistake. So a new mistake costs three lines, and what no suspect reproduces is
honestly unknown: the first moment at which right and done part is shown, with both values there.

Below stand what the judges of several pages share: the messages on a topic, the beat of a timer,
and what can be said of any function whose result is the answer.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any

from rosbeat.diagnosis.mistakes import UNKNOWN, Diagnosis
from rosbeat.diagnosis.wires import Wire, why_not_published
from rosbeat.exercises.exercise import BLANK, failed, not_attempted
from rosbeat.exercises.scenarios import Report
from rosbeat.records import NANOSECONDS, Observation, Outcome, Sample

#: What was done at each moment: a tuple of values, in order, by a key that sorts, such as
#: nanoseconds or the number of a reading. A moment at which nothing was done has no entry.
Track = Mapping[Any, tuple[Any, ...]]
#: Tells whether two values are the same for a judge.
Same = Callable[[Any, Any], bool]


@dataclass(frozen=True)
class Suspect:
    """A misunderstanding, as a model of the node that somebody with it would write.

    Attributes:
        mistake: Its id, from `diagnosis.mistakes`.
        hint: Where to look, without the answer.
        model: Returns what such a node does, from what it is fed; of the same form as the right
            model's.
    """

    mistake: str
    hint: str
    model: Callable[[Any], Track]


def variants(model: Callable[..., Track], rows: Iterable[Any]) -> tuple[Suspect, ...]:
    """Return suspects that are one model with other options.

    Args:
        model: Does what is right by its defaults.
        rows: A mistake, a hint, and one dict of options or more for each.
    """
    return tuple(
        Suspect(mistake, hint, partial(model, **options))
        for mistake, hint, *many in rows
        for options in many
    )


@dataclass(frozen=True)
class Parting:
    """The first moment at which an answer and the right model part.

    Attributes:
        at: The moment.
        done: What the answer did then; empty for nothing.
        right: What was right then; empty for nothing.
    """

    at: Any
    done: tuple[Any, ...]
    right: tuple[Any, ...]


def equal(one: Any, other: Any) -> bool:  # noqa: ANN401 - values of any message
    """Return whether two values are equal, numbers up to the rounding of a `Float32`."""
    if isinstance(one, float) and isinstance(other, float | int):
        return abs(one - other) <= 1e-3 or (one != one and other != other)
    return bool(one == other)


def agree(one: Track, other: Track, same: Same = equal) -> bool:
    """Return whether two tracks are the same at every moment."""
    return parting(one, other, same) is None


def parting(done: Track, right: Track, same: Same = equal) -> Parting | None:
    """Return the first moment at which two tracks part; None if they never do."""
    for at in sorted({*done, *right}):
        found, wanted = done.get(at, ()), right.get(at, ())
        if len(found) != len(wanted) or not all(map(same, found, wanted)):
            return Parting(at, found, wanted)
    return None


def fitting(
    fed: Any,  # noqa: ANN401 - whatever the models take
    done: Track,
    suspects: Iterable[Suspect],
    same: Same = equal,
) -> list[Suspect]:
    """Return the suspects that do exactly what was done, one for each mistake and hint.

    Args:
        fed: What the answer was fed.
        done: What it did.
        suspects: Those to try, the likely ones first.
        same: Tells whether two values are the same.
    """
    found: dict[tuple[str, str], Suspect] = {}
    for one in suspects:
        if (one.mistake, one.hint) not in found and agree(one.model(fed), done, same):
            found[one.mistake, one.hint] = one
    return list(found.values())


def named(evidence: str, fit: Sequence[Suspect], otherwise: Diagnosis | None = None) -> Diagnosis:
    """Return the diagnosis for what was seen; of two suspects that fit, both are named.

    Args:
        evidence: What was seen.
        fit: The suspects that reproduce it, the likely ones first.
        otherwise: What to say if none does; by default that the mistake is unknown.
    """
    if not fit:
        return otherwise or Diagnosis(
            UNKNOWN, evidence, "Go through your conditions in their order with this reading."
        )
    hints = list(dict.fromkeys(one.hint for one in fit))[:2]
    return Diagnosis(fit[0].mistake, evidence, " Or: ".join(hints))


def spelling(found: str, words: Iterable[str]) -> str:
    """Return a hint if a word differs from one that is right only in capitals or blanks.

    Words are compared exactly as the page writes them.

    Args:
        found: The word that an answer wrote.
        words: The right ones.

    Returns:
        The hint; empty if the word is right, or another one altogether.
    """
    near = {word.strip().casefold(): word for word in words}.get(found.strip().casefold(), found)
    if near == found:
        return ""
    return f"Capitals and blanks count: the page writes {near!r}, and your node {found!r}."


# Messages on a topic.


_SILENT = Diagnosis(
    "new-to-me",
    "Nothing was published on {topic}.",
    "Follow the data: what calls the callback, and does the callback call publish?",
)


def on(observation: Observation, wire: Wire) -> list[Sample]:
    """All messages on a topic, of whatever type, in order."""
    return [sample for sample in observation.samples if sample.topic == wire.topic]


def missing(
    observation: Observation,
    wire: Wire,
    besides: Collection[str] = (),
    otherwise: Diagnosis = _SILENT,
) -> Diagnosis | None:
    """Say why there is too little to judge on a topic.

    Args:
        observation: What the node did.
        wire: Where it should have published, and what.
        besides: Full names of other topics on which it is to publish as well.
        otherwise: What is said of a silence that nothing explains; `{topic}` stands for the name.

    Returns:
        The mistake; None if messages of the right type were published there.
    """
    heard = on(observation, wire)
    if heard and heard[0].type_name != wire.type_name:
        return Diagnosis(
            "type-mismatch",
            f"The messages on {wire.topic} are of type {heard[0].type_name}.",
            f"Both sides of a topic have to agree on the type: here it is {wire.type_name}.",
        )
    if heard:
        return None
    evidence = otherwise.evidence.format(topic=wire.topic)
    unexplained = Diagnosis(otherwise.mistake, evidence, otherwise.hint)
    return why_not_published(observation, wire, besides) or unexplained


# A beat: messages that come one period apart, the first after one period.


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


# A function whose result is the answer.


def before_reading(exercise: str, seen: Report, example: str) -> Outcome | None:
    """What can be said of a report whatever was asked: a blank, an exception, no result; or None.

    Args:
        exercise: The exercise's id.
        seen: The report.
        example: What the check cell should say, such as `check("07a", findings)`.
    """
    if f"'{BLANK}'" in seen.problem and seen.problem.startswith("NameError"):
        return not_attempted(exercise)
    if seen.problem.startswith("Deadline"):
        said = seen.problem.partition(": ")[2]
        hint = "It only has to return what you found."
        return failed(exercise, f"The function does not end: {said}.", hint, "does-not-return")
    if "object is not callable" in seen.problem:
        hint = f"Hand over the function itself, by its name: {example}."
        return failed(exercise, "What was handed over is no function.", hint, "no-function")
    if seen.problem.startswith("NotPlain"):
        said = seen.problem.partition(": ")[2]
        hint = "Give back numbers, texts, lists and dicts only."
        return failed(exercise, f"The result cannot be read: {said}.", hint, "not-plain")
    if seen.problem:
        hint = "What is to be a text stands in quotes; numbers stand without."
        name = "name-error" if seen.problem.startswith("NameError") else "raised"
        return failed(exercise, f"The function raised {seen.problem}.", hint, name)
    if seen.type_name == "NoneType":
        hint = "The function needs a return: print gives back nothing."
        return failed(exercise, "The function gave nothing back.", hint, "returns-nothing")
    return None
