"""Compare two runs, message by message on one topic. Pure functions on records.

Messages are paired by their times. What has no partner in the second run is missing there; what
has none in the first is extra.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from math import inf, isfinite, isnan, nan
from typing import Any, Protocol, runtime_checkable

from rosbeat.errors import BagError, called_as
from rosbeat.records import NANOSECONDS, Observation, Sample, Timed

#: What kinds of differences there are.
MISSING, EXTRA, VALUE = "missing", "extra", "value"


@runtime_checkable
class Observer(Protocol):
    """Define the interface of objects with an observation, such as a session or a bag."""

    def observation(self) -> Observation:
        """Return what has been observed so far."""
        ...


#: Whatever can be compared.
Run = Observation | Observer | Sequence[Sample]


@dataclass(frozen=True)
class Difference(Timed):
    """Describe one difference between two runs.

    Attributes:
        time_ns: Time in the first run, or in the second for an extra message, in nanoseconds.
        kind: `missing`, `extra` or `value`.
        amount: Distance between two values, in units of the value; infinite if one is infinite; NaN
            if it is undefined, as for strings, NaN and lists of different lengths; 0 for other
            kinds.
    """

    time_ns: int
    kind: str
    amount: float = 0.0


@dataclass(frozen=True, repr=False)
class Comparison:
    """Compare the messages of two runs on one topic; a cell displays the result as text.

    Attributes:
        topic: Full name of the topic.
        names: Names of the two runs.
        pairs: Messages that are in both runs, from the first run and from the second.
        missing: Messages that are only in the first run.
        extra: Messages that are only in the second run.
    """

    topic: str
    names: tuple[str, str]
    pairs: tuple[tuple[Sample, Sample], ...] = ()
    missing: tuple[Sample, ...] = ()
    extra: tuple[Sample, ...] = ()

    def __repr__(self) -> str:
        return _words(self)

    @property
    def counts(self) -> tuple[int, int]:
        """Return the number of messages in each of the two runs."""
        return len(self.pairs) + len(self.missing), len(self.pairs) + len(self.extra)

    @property
    def differences(self) -> tuple[Difference, ...]:
        """Return all differences, in order of time."""
        apart = ((one.time_ns, distance(one.data, other.data)) for one, other in self.pairs)
        found = [Difference(at, VALUE, amount) for at, amount in apart if amount != 0]
        found += [Difference(one.time_ns, MISSING) for one in self.missing]
        found += [Difference(one.time_ns, EXTRA) for one in self.extra]
        return tuple(sorted(found, key=lambda one: one.time_ns))

    @property
    def is_same(self) -> bool:
        """Return whether both runs have the same messages at the same times."""
        return not self.differences

    @property
    def first(self) -> Difference | None:
        """Return the first difference; None if there is none."""
        return next(iter(self.differences), None)

    @property
    def largest(self) -> Difference | None:
        """Return the first of the largest measurable value differences; None if there is none."""
        found = (one for one in self.differences if one.kind == VALUE and not isnan(one.amount))
        return max(found, key=lambda one: one.amount, default=None)


@called_as('bags.compare(one, other, "temperature")')
def compare(
    one: Run,
    other: Run,
    topic: str,
    *,
    within: float = 0.0,
    names: tuple[str, str] = ("the first run", "the second run"),
) -> Comparison:
    """Compare two runs on one topic.

    Args:
        one: A bag, a session, what it observed, or messages.
        other: The same of the second run.
        topic: The topic's name; `temperature` and `/temperature` are the same.
        within: How far the times of a pair may be apart, in seconds.
        names: What the two runs are called.

    Returns:
        The comparison.

    Raises:
        BagError: If these are no runs, neither has the topic, or `within` is not a number from 0
            up.
    """
    runs = [_run(source) for source in (one, other)]
    name = _name(topic, {known for _, topics in runs for known in topics})
    slack = _slack(within)
    left, right = ([s for s in samples if s.topic == name] for samples, _ in runs)
    pairs, missing, extra = _paired(left, right, slack)
    return Comparison(name, (str(names[0]), str(names[1])), pairs, missing, extra)


def distance(one: Any, other: Any) -> float:  # noqa: ANN401 - whatever a message may hold
    """Return the largest difference between two values, 0 if they are the same.

    NaN equals NaN here. The distance of values that differ and cannot be subtracted is NaN.
    """
    if isinstance(one, Mapping) and isinstance(other, Mapping) and one.keys() == other.keys():
        return _largest(distance(one[name], other[name]) for name in one)
    if isinstance(one, (list, tuple)) and isinstance(other, (list, tuple)):
        same = len(one) == len(other)
        return _largest(map(distance, one, other)) if same else nan
    if _is_number(one) and _is_number(other):
        return 0.0 if one == other or (isnan(one) and isnan(other)) else abs(one - other)
    return 0.0 if one == other else nan


# How it works.


def _largest(distances: Iterable[float]) -> float:
    """The largest; one that cannot be measured counts only if there is no other."""
    found = [one for one in distances if one != 0]
    return max((one for one in found if not isnan(one)), default=nan if found else 0.0)


def _is_number(value: object) -> bool:
    return isinstance(value, (int, float)) and not isinstance(value, bool)


def _run(source: object) -> tuple[Sequence[Sample], set[str]]:
    """The messages of a run, and the topics that it had."""
    if isinstance(source, Observer) and not isinstance(source, type):
        source = source.observation()
    if isinstance(source, Observation):
        return source.samples, {one.topic for one in source.samples} | set(source.graph.topics())
    if isinstance(source, (list, tuple)) and all(isinstance(one, Sample) for one in source):
        return source, {one.topic for one in source}
    raise BagError(
        f"{type(source).__name__!r} is not a run.",
        "A run is a recording, a session, a session's observation, or a list of messages.",
        'For example, write `compare(bag, ros, "temperature")`.',
    )


def _name(topic: object, known: set[str]) -> str:
    name = f"/{topic.lstrip('/')}" if isinstance(topic, str) else ""
    if name in known:
        return name
    raise BagError(
        f"Neither run has a topic {topic!r}.",
        f"They have {', '.join(sorted(known))}." if known else "Nothing was published in either.",
        "Choose a topic that one of them has.",
    )


def _slack(within: object) -> int:
    if isinstance(within, (int, float)) and isfinite(within) and within >= 0:
        return round(within * NANOSECONDS)
    raise BagError(
        f"within={within!r} cannot be used.",
        "It says how far the times of two messages may be apart, in seconds: a number from 0 up.",
        "Leave it out to pair messages of exactly the same time.",
    )


def _paired(
    left: Sequence[Sample], right: Sequence[Sample], slack: int
) -> tuple[tuple[tuple[Sample, Sample], ...], tuple[Sample, ...], tuple[Sample, ...]]:
    pairs, missing, extra = [], [], []
    i = j = 0
    while i < len(left) or j < len(right):
        gap = _gap(left, right, i, j)
        if abs(gap) <= slack:
            pairs.append((left[i], right[j]))
        elif gap < 0:
            missing.append(left[i])
        else:
            extra.append(right[j])
        i, j = i + (gap <= slack), j + (gap >= -slack)
    return tuple(pairs), tuple(missing), tuple(extra)


def _gap(left: Sequence[Sample], right: Sequence[Sample], i: int, j: int) -> float:
    """Nanoseconds from the second run's next message to the first's; infinite at an end."""
    if i == len(left):
        return inf
    return -inf if j == len(right) else left[i].time_ns - right[j].time_ns


# Words.


def _words(found: Comparison) -> str:
    one, other = found.names
    counts = found.counts
    if found.is_same:
        same = f"the same {_count(counts[0], 'message')}" if counts[0] else "no messages"
        return f"{found.topic}: {one} and {other} have {same}."
    said = [f"{found.topic}: {_count(counts[0], 'message')} in {one}, {counts[1]} in {other}."]
    if found.missing:
        said.append(f"{_are(len(found.missing))} missing in {other}.")
    if found.extra:
        said.append(f"{_are(len(found.extra))} only in {other}, not in {one}.")
    number = sum(difference.kind == VALUE for difference in found.differences)
    if number:
        verb = "differs" if number == 1 else "differ"
        largest = found.largest
        most = f", by {largest.amount:.4g} at most, at {_at(largest)}" if largest else ""
        said.append(f"{number} of the {len(found.pairs)} that both have {verb}{most}.")
    elif found.pairs:
        said.append(f"The {len(found.pairs)} that both have are the same.")
    if len(found.differences) > 1:
        said.append(f"The first difference is at {_at(found.differences[0])}.")
    return " ".join(said)


def _are(number: int) -> str:
    return f"{number} is" if number == 1 else f"{number} are"


def _at(one: Difference) -> str:
    return f"{one.time_ns / NANOSECONDS:.9f}".rstrip("0").rstrip(".") + " s"


def _count(number: int, noun: str) -> str:
    return f"{number or 'no'} {noun if number == 1 else noun + 's'}"
