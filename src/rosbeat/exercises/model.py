"""Judge what a node did by models: the right model, and models of misunderstandings.

A wrong answer is a model, too. A judge simulates the right model and each *suspect*, which is a
small model of a misunderstanding, on what the answer was fed. A suspect that does exactly what the
answer did names the mistake. So a new mistake costs a row in a table, and what no suspect
reproduces is honestly unknown: the first moment at which the answer differs from the right model is
shown, with both values there. `diagnose` does all of that in one call.

Below it are the parts that the judges of several pages share: the messages on a topic by time, the
words of a status, the beat of a timer, and what can be said of any function whose result is the
answer.
"""

from __future__ import annotations

import re
import struct
from collections import Counter
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any, TypeAlias

from rosbeat.diagnosis.connections import Wire
from rosbeat.diagnosis.exceptions import line_of
from rosbeat.diagnosis.mistakes import MISTAKES, UNKNOWN, Diagnosis, unknown_mistake
from rosbeat.exercises.exercise import BLANK, Verdict, not_attempted
from rosbeat.exercises.scenarios import Report, Value
from rosbeat.records import NANOSECONDS, Fault, Observation, Sample

#: What was done at each moment: a tuple of values, in order, by a key that sorts, such as
#: nanoseconds or the number of a reading. A moment at which nothing was done has no entry.
Track: TypeAlias = Mapping[Any, tuple[Any, ...]]
#: Returns what a node does, from what it is fed.
Model: TypeAlias = Callable[[Any], Track]
#: Tells whether two values are the same for a judge.
Same: TypeAlias = Callable[[Any, Any], bool]


@dataclass(frozen=True)
class Suspect:
    """Hold a misunderstanding, as a model of the node that somebody with it would write.

    Attributes:
        mistake: Its id, from `diagnosis.mistakes`.
        hint: Where to look, without the answer.
        model: Returns what such a node does, from what it is fed; of the same form as the right
            model's.

    Raises:
        ValueError: If there is no such mistake. A learner would be told that the check doesn't
            recognize it, and get its hint all the same.
    """

    mistake: str
    hint: str
    model: Model

    def __post_init__(self) -> None:
        """Refuse a mistake without a name, where it is written."""
        if self.mistake not in MISTAKES:
            raise ValueError(unknown_mistake(self.mistake))


def suspects(*rows: tuple[Any, ...]) -> tuple[Suspect, ...]:
    """Return suspects from rows of a mistake, a hint, and one model or more."""
    return tuple(
        Suspect(mistake, hint, model) for mistake, hint, *models in rows for model in models
    )


def variants(model: Callable[..., Track], rows: Iterable[Any]) -> tuple[Suspect, ...]:
    """Return suspects that are one model with other options.

    Args:
        model: Does what is right by its defaults.
        rows: A mistake, a hint, and one dict of options or more for each.
    """
    return suspects(
        *((*row[:2], *(partial(model, **options) for options in row[2:])) for row in rows)
    )


@dataclass(frozen=True)
class Mismatch:
    """Hold a moment at which an answer and the right model differ.

    Attributes:
        at: The moment.
        done: What the answer did then; empty for nothing.
        right: What was right then; empty for nothing.
    """

    at: Any
    done: tuple[Any, ...]
    right: tuple[Any, ...]


def equal(one: Value, other: Value) -> bool:
    """Return whether two values are equal, numbers up to the rounding of a `Float32`."""
    if isinstance(one, float) and isinstance(other, float | int):
        return abs(one - other) <= 1e-3 or (one != one and other != other)
    return bool(one == other)


def as_float32(value: float) -> float:
    """Return a number as a `Float32` carries it."""
    return float(struct.unpack("f", struct.pack("f", value))[0])


def agree(one: Track, other: Track, same: Same = equal) -> bool:
    """Return whether two tracks are the same at every moment."""
    return first_mismatch(one, other, same) is None


def first_mismatch(done: Track, right: Track, same: Same = equal) -> Mismatch | None:
    """Return the first moment at which two tracks differ; None if they never do."""
    return next(_mismatches(done, right, same), None)


def _mismatches(done: Track, right: Track, same: Same) -> Iterator[Mismatch]:
    if done == right:  # the usual case, and quick to see
        return
    for at in sorted({*done, *right}):
        found, wanted = done.get(at, ()), right.get(at, ())
        if len(found) != len(wanted) or not all(map(same, found, wanted)):
            yield Mismatch(at, found, wanted)


#: Mistakes whose names say that something is done too often, or is missing.
_TOO_OFTEN = {"status-repeated", "alert-too-many", "level-too-low"}
_TOO_RARELY = {"alert-missing", "change-missing", "level-missed", "said-once", "one-name-only"}


def _shows(mistake: str, mismatch: Mismatch) -> bool:
    """Return whether a moment is an example of what the mistake's name says."""
    more = len(mismatch.done) - len(mismatch.right)
    if mistake in _TOO_OFTEN:
        return more > 0
    return more < 0 if mistake in _TOO_RARELY else True


def matching(
    fed: Value, done: Track, suspects: Iterable[Suspect], same: Same = equal
) -> list[Suspect]:
    """Return the suspects that do exactly what was done, one for each mistake and hint.

    Args:
        fed: What the answer was fed.
        done: What it did.
        suspects: Those to try, the likely ones first.
        same: Tells whether what was done is what is right. It may allow for what is late, and a
            suspect may be as late as the answer or later, so here it is asked both ways.
    """

    def alike(one: Value, other: Value) -> bool:
        return same(one, other) or same(other, one)

    found: dict[tuple[str, str], Suspect] = {}
    for one in suspects:
        if (one.mistake, one.hint) not in found and agree(done, one.model(fed), alike):
            found[one.mistake, one.hint] = one
    return list(found.values())


def tells_apart(fed: Value, right: Model, suspects: Iterable[Suspect], same: Same = equal) -> bool:
    """Return whether what is fed tells suspects from the right model and from each other.

    Suspects of one mistake need not be told apart: the learner gets both hints.

    Args:
        fed: What an answer is fed.
        right: What is right.
        suspects: The misunderstandings.
        same: Tells whether two values are the same.
    """
    apart: list[tuple[str, Track]] = [("", right(fed))]
    for one in suspects:
        done = one.model(fed)
        if any(agree(done, track, same) and one.mistake != name for name, track in apart):
            return False
        apart.append((one.mistake, done))
    return True


def name_mistake(matches: Sequence[Suspect], otherwise: Diagnosis) -> Diagnosis:
    """Return the diagnosis for what was seen; of two suspects that match, both hints are given.

    A sentence that both hints have is said once.

    Args:
        matches: The suspects that reproduce it, the likely ones first.
        otherwise: What was seen as its evidence, and what to say if no suspect matches.
    """
    if not matches:
        return otherwise
    hints = list(dict.fromkeys(one.hint for one in matches))[:2]
    if len(hints) > 1:
        said, other = (re.split(r"(?<=[.?!]) ", hint) for hint in hints)
        hints = [hints[0], " ".join(sentence for sentence in other if sentence not in said)]
    return Diagnosis(matches[0].mistake, otherwise.evidence, " Or: ".join(filter(None, hints)))


def diagnose(
    fed: Value,
    done: Track,
    right: Track,
    suspects: Iterable[Suspect],
    describe: Callable[[Mismatch], Diagnosis],
    same: Same = equal,
) -> Diagnosis | None:
    """Compare what was done with what was right, and name the mistake by the suspects.

    Args:
        fed: What the answer was fed.
        done: What it did.
        right: What the right model does.
        suspects: Those to try, the likely ones first.
        describe: Describes a mismatch: the first that shows what the mistake is called. Its
            evidence is shown in any case; its mistake and its hint are for an answer that no
            suspect reproduces.
        same: Tells whether two values are the same.

    Returns:
        The mistake; None if there is no mismatch.
    """
    found = list(_mismatches(done, right, same))
    if not found:
        return None
    matches = matching(fed, done, suspects, same)
    # What is shown has to be what it is called: a status that is not kept may first be missing.
    name = matches[0].mistake if matches else UNKNOWN
    shown = next((mismatch for mismatch in found if _shows(name, mismatch)), found[0])
    return name_mistake(matches, describe(shown))


# Messages on a topic, and words.


def samples_on(observation: Observation, wire: Wire) -> list[Sample]:
    """Return all messages on a topic, of whatever type, in order."""
    return [sample for sample in observation.samples if sample.topic == wire.topic]


def grouped(pairs: Iterable[tuple[Value, Value]]) -> dict[Any, tuple[Any, ...]]:
    """Return the values of pairs by their keys, in order, as a track."""
    found: dict[Any, tuple[Any, ...]] = {}
    for key, value in pairs:
        found[key] = (*found.get(key, ()), value)
    return found


def track(
    observation: Observation, wire: Wire, read: Callable[[Any], Any] = lambda value: value
) -> dict[float, tuple[Any, ...]]:
    """Return what was published on a topic, by time in seconds.

    Args:
        observation: What was seen.
        wire: The topic.
        read: Returns what counts of a message's value.
    """
    return grouped((one.time, read(one.value)) for one in samples_on(observation, wire))


def numbered(values: Iterable[Any]) -> dict[int, tuple[Any, ...]]:
    """Return a track of one value for each reading, by its number from 1 on."""
    return {number: (value,) for number, value in enumerate(values, 1)}


def status_of(value: float, low: float, high: float) -> str:
    """Return `High` above the upper limit, `Low` below the lower one, and else `Normal`."""
    return "High" if value > high else "Low" if value < low else "Normal"


#: What is wrong with `if value:` as a test for whether there is a value.
ZERO_IS_FALSE = "Python treats 0 as false, so `if value:` doesn't test whether there is a value."
#: The words that `status_of` returns.
STATUSES = ("High", "Low", "Normal")


def diagnose_words(
    observation: Observation, wire: Wire, words: Collection[str]
) -> Diagnosis | None:
    """Find the first string on a topic that is not one of the expected words."""
    for sample in samples_on(observation, wire):
        if sample.value not in words:
            evidence = f"At {sample.time:g} s, {sample.value!r} was published on {wire.topic}."
            hint = f"Each text there is one of these: {', '.join(words)}."
            return Diagnosis("wrong-word", evidence, spelling(str(sample.value), words) or hint)
    return None


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


def explain_subscription(wire: Wire, fault: Fault) -> Diagnosis | None:
    """Diagnose a node that should publish, and fails because it subscribes instead.

    Args:
        wire: The topic that it should publish on.
        fault: The exception.
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


def diagnose_length(observation: Observation, *seconds: float) -> Diagnosis | None:
    """Say that a run ended at another moment than any that was drawn.

    No node can do that; evidence of another run does.

    Args:
        observation: What was seen; nothing was raised.
        seconds: How long the run may have lasted.
    """
    if observation.time_ns in [round(one * NANOSECONDS) for one in seconds]:
        return None
    due = " or ".join(f"{one:g}" for one in seconds)
    evidence = f"The run ended at {observation.time:g} s, and it was to last {due} s."
    return Diagnosis(UNKNOWN, evidence, "Does your node change what the session records?")


# A beat: messages that come one period apart, the first after one period.


@dataclass(frozen=True)
class _Beat:
    """Hold what was right, what was done, and when it ended, in nanoseconds."""

    right: Track
    done: Track
    end: int


def _ticks(period: int, end: int) -> Track:
    return dict.fromkeys(range(period, end + 1, period), (1,)) if period > 0 else {}


def _together(*tracks: Track) -> Track:
    """Return how many messages come at each moment of several beats."""
    return {at: (sum(sum(track.get(at, ())) for track in tracks),) for at in set().union(*tracks)}


def _with_gaps(beat: _Beat) -> Track:
    """Return the ticks of a beat that were not left out; nothing if it is a slower one, or ends."""
    kept = {at: one for at, one in beat.right.items() if at in beat.done}
    ends = list(kept) == list(beat.right)[: len(kept)]
    return {} if ends or beat.done == _ticks(min(beat.done), beat.end) else kept


def _first_extra(beat: _Beat) -> int:
    """Return the first moment at which more came than was due, or 0."""
    more = (at for at, one in beat.done.items() if one > beat.right.get(at, (0,)))
    return min(more, default=0)


_FEW = {0: "none", 1: "one"}
_COUNT = (
    "What does the first argument of create_timer count: calls per second, or seconds between "
    "two calls?"
)
_BEATS = suspects(
    ("no-timer",
        "The constructor runs once. What calls the method again and again?",
        lambda beat: {0: beat.done.get(0, (1,))}),
    ("gone-quiet",
        "Something ends the messages. Does the callback cancel its timer or shut ROS down? Is a "
        "condition never true again?",
        lambda beat: dict(list(beat.right.items())[: len(beat.done)])),
    ("wrong-rate",
        "The first tick comes after one period. What publishes in the constructor?",
        lambda beat: {0: (1,), **beat.right}),
    ("wrong-rate",
        "One for each tick is enough. Does anything publish twice, or are there two timers?",
        lambda beat: dict.fromkeys(beat.right, beat.done.get(min(beat.right), (2,)))),
    ("made-anew",
        "Each call makes another timer, and a timer repeats by itself. Make it once, in the "
        "constructor.",
        lambda beat: {at: (2**call,) for call, at in enumerate(beat.right)}),
    ("wrong-rate",
        "Two timers publish, each with a period of its own. Where does the other one come from?",
        lambda beat: _together(beat.right, _ticks(_first_extra(beat), beat.end))),
    ("wrong-rate",
        "Several messages come at once, and none in between. One timer with a shorter period, "
        "and one message for each tick, spreads them evenly.",
        lambda beat: (
            dict.fromkeys(_ticks(min(beat.done), beat.end), beat.done[min(beat.done)])
            if beat.done[min(beat.done)] > (1,)
            else {}
        )),
    ("wrong-rate",
        "The timer is right, but some ticks publish nothing. Which condition skips them?",
        _with_gaps),
    ("wrong-rate", _COUNT, lambda beat: _ticks(min(beat.done), beat.end)),
)  # fmt: skip


def diagnose_wait(observation: Observation, evidence: str, least: float = 0.0) -> Diagnosis | None:
    """Find a callback of the node that waits; waits are recorded, so this needs no model.

    Args:
        observation: The observation of the node.
        evidence: What the wait led to, as the evidence of the diagnosis.
        least: The shortest wait that matters, in seconds.
    """
    for one in observation.waits:
        seconds = (one.until_ns - one.time_ns) / NANOSECONDS
        if one.node == observation.subject and seconds >= least:
            return Diagnosis(
                "callback-blocks",
                f"At {one.time:g} s {one.callback} waited for {seconds:g} s. {evidence}",
                "While a callback waits, its node does nothing else: no other callback is called.",
            )
    return None


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
    counts = Counter(sample.time_ns for sample in samples_on(observation, wire))
    done = {at: (count,) for at, count in counts.items()}
    end = observation.time_ns
    beat = _Beat(_ticks(round(period * NANOSECONDS), end), done, end)
    mismatch = first_mismatch(done, beat.right)
    if mismatch is None:
        return None
    came = _FEW.get(sum(mismatch.done), str(sum(mismatch.done)))
    evidence = (
        f"In {observation.time:g} seconds {len(beat.right)} {what} should have been "
        f"published, and {counts.total()} were. At {mismatch.at / NANOSECONDS:g} s it was {came} "
        f"instead of {_FEW[sum(mismatch.right)]}."
    )
    waited = diagnose_wait(observation, evidence)
    if waited:
        return waited
    if observation.subject not in observation.graph.nodes:
        hint = "The program destroys its node at the end. Which line of the node does so earlier?"
        return Diagnosis("node-ended", f"The node was destroyed. {evidence}", hint)
    return name_mistake(matching(beat, done, _BEATS), Diagnosis("wrong-rate", evidence, _COUNT))


# A function whose result is the answer.


def before_reading(seen: Report, example: str) -> Verdict | None:
    """Return what can be said of a report whatever was asked: a blank, an exception; or None.

    Args:
        seen: The report.
        example: What the check cell should say, such as `check("07a", findings)`.
    """
    kind, _, said = seen.problem.partition(": ")
    if kind == "NameError" and f"'{BLANK}'" in said:
        return not_attempted()
    if kind == "Deadline":
        hint = "It only has to return what you found."
        return Diagnosis("does-not-return", f"The function does not end: {said}.", hint)
    if "object is not callable" in said:
        hint = f"Hand over the function itself, by its name: {example}."
        return Diagnosis("no-function", "What was handed over is no function.", hint)
    if kind == "NotPlain":
        hint = "Return only numbers, strings, lists and dictionaries."
        return Diagnosis("not-plain", f"The result cannot be read: {said}.", hint)
    if kind:
        hint = "Write strings in quotes, and numbers without."
        name = "name-error" if kind == "NameError" else "raised"
        return Diagnosis(name, f"The function raised {seen.problem}.", hint)
    if seen.type_name == "NoneType":
        hint = "The function needs a return: print returns nothing."
        return Diagnosis("returns-nothing", "The function returned nothing.", hint)
    return None
