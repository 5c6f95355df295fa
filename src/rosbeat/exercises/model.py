"""Judge what a node did by models: of a right one, and of those that somebody misunderstood.

A wrong answer is a model, too. A judge simulates the right model and each *suspect*, which is a
small model of a misunderstanding, on what the answer was fed. A suspect that does exactly what the
answer did names the mistake. So a new mistake costs three lines, and what no suspect reproduces is
honestly unknown: the first moment at which right and done part is shown, with both values there.

Below stand what the judges of several pages share: the messages on a topic, the beat of a timer,
and what can be said of any function whose result is the answer.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any

from rosbeat.diagnosis.exceptions import line_of
from rosbeat.diagnosis.mistakes import UNKNOWN, Diagnosis
from rosbeat.diagnosis.wires import Wire, why_not_published
from rosbeat.exercises.exercise import BLANK, failed, not_attempted
from rosbeat.exercises.scenarios import Report
from rosbeat.records import NANOSECONDS, Fault, Observation, Outcome, Sample

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
    if done == right:  # the usual case, and quick to see
        return None
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

    A sentence that both hints have is said once.

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
    if len(hints) > 1:
        said, other = (re.split(r"(?<=[.?!]) ", hint) for hint in hints)
        hints = [hints[0], " ".join(sentence for sentence in other if sentence not in said)]
    return Diagnosis(fit[0].mistake, evidence, " Or: ".join(filter(None, hints)))


def spelling(found: str, words: Iterable[str]) -> str:
    """Return a hint if a word differs from one that is right only in capitals or spaces.

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
    return f"Capitals and spaces count: the page writes {near!r}, and your node {found!r}."


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


def explain_subscription(wire: Wire, fault: Fault) -> Diagnosis | None:
    """Name the mistake of a node that subscribes, and fails, where it is to publish.

    Args:
        wire: Where it is to publish.
        fault: What was raised.
    """
    topic = re.escape(wire.topic.rpartition("/")[2])
    is_here = re.search(rf"[\"'/]{topic}[\"']", fault.code)
    if fault.asked is None or fault.asked.method != "create_subscription" or not is_here:
        return None
    return Diagnosis(
        "no-publisher",
        f"create_subscription makes a node listen to a topic, and this node is to publish on "
        f"{wire.topic}.{line_of(fault)}",
        "Publishing takes no callback. Which method of a node makes a publisher?",
    )


# A beat: messages that come one period apart, the first after one period.


@dataclass(frozen=True)
class _Beat:
    """Hold what was right, what was done, and when it ended, in nanoseconds."""

    right: Track
    done: Track
    end: int


def _ticks(period: int, end: int) -> Track:
    return dict.fromkeys(range(period, end + 1, period), (1,)) if period > 0 else {}


_FEW = {0: "none", 1: "one"}
_COUNT = (
    "What does the first argument of create_timer count: calls per second, or seconds between "
    "two calls?"
)
_BEATS = (
    Suspect(
        "no-timer",
        "The constructor runs once. What calls the method again and again?",
        lambda beat: {0: beat.done.get(0, (1,))},
    ),
    Suspect(
        "gone-quiet",
        "Something ends the beat. Does the callback cancel its timer, or shut ROS down?",
        lambda beat: dict(list(beat.right.items())[: len(beat.done)]),
    ),
    Suspect(
        "wrong-rate",
        "The first tick comes after one period. What publishes while the node is being made?",
        lambda beat: {0: (1,), **beat.right},
    ),
    Suspect(
        "wrong-rate",
        "One for each tick is enough. Does anything publish twice, or are there two timers?",
        lambda beat: dict.fromkeys(beat.right, beat.done.get(min(beat.right), (2,))),
    ),
    Suspect("wrong-rate", _COUNT, lambda beat: _ticks(min(beat.done), beat.end)),
)


def diagnose_wait(observation: Observation, evidence: str) -> Diagnosis | None:
    """Name a callback of the node that waits; waits are recorded, so this needs no model.

    Args:
        observation: What was seen.
        evidence: What has come of the wait.
    """
    own = next((one for one in observation.waits if one.node == observation.subject), None)
    if own is None:
        return None
    seconds = (own.until_ns - own.time_ns) / NANOSECONDS
    return Diagnosis(
        "callback-blocks",
        f"At {own.time:g} s {own.callback} waited for {seconds:g} s. {evidence}",
        "While a callback waits, its node does nothing else: no other callback is called.",
    )


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
    counts = Counter(sample.time_ns for sample in on(observation, wire))
    done = {at: (count,) for at, count in counts.items()}
    end = observation.time_ns
    beat = _Beat(_ticks(round(period * NANOSECONDS), end), done, end)
    part = parting(done, beat.right)
    if part is None:
        return None
    came = _FEW.get(sum(part.done), str(sum(part.done)))
    evidence = (
        f"In {observation.time:g} seconds {len(beat.right)} {what} were due, and "
        f"{counts.total()} came. At {part.at / NANOSECONDS:g} s {came} came, and "
        f"{_FEW[sum(part.right)]} was due."
    )
    waited = diagnose_wait(observation, evidence)
    if waited:
        return waited
    if observation.subject not in observation.graph.nodes:
        hint = "The program around a node destroys it in the end. Which line of the node does so?"
        return Diagnosis("node-ended", f"The node was destroyed. {evidence}", hint)
    return named(evidence, fitting(beat, done, _BEATS), Diagnosis("wrong-rate", evidence, _COUNT))


# A function whose result is the answer.


def before_reading(exercise: str, seen: Report, example: str) -> Outcome | None:
    """Return what can be said of a report whatever was asked: a blank, an exception; or None.

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
