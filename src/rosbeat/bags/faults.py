"""Define faults of sensors and connections, and inject them into a recording.

Each function returns a fault, which maps messages to messages with that fault. Times are in seconds
of the recording. Random choices come from `seed`, and are the same on every run.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from copy import deepcopy
from dataclasses import dataclass, replace
from math import inf, isfinite, isnan, nan
from random import Random
from typing import Any

from rosbeat.bags.arguments import Run, full_name, known_topic, observation_of
from rosbeat.errors import BagError, called_as
from rosbeat.records import NANOSECONDS, Sample

#: A fault, or any function that a caller writes.
Change = Callable[[Sequence[Sample]], Iterable[Sample]]
#: What a fault does to the messages of one topic: each of them as it is now, or None if it is lost.
_TopicChange = Callable[[Sequence[Sample]], Iterable[Sample | None]]
#: From when (included) to when (not included), in seconds.
Span = tuple[float, float]


@dataclass(frozen=True, repr=False)
class InjectedFault:
    """Represent a fault of a sensor or of its connection, as a function from messages to messages.

    The function is pure: the same messages always give the same result.

    Attributes:
        words: Short description, such as `stuck from 20 s on`.
        topic: Full name of the only affected topic; empty for all topics.
        change: The function that is applied to the messages of one topic.
    """

    words: str
    topic: str
    change: _TopicChange

    def __repr__(self) -> str:
        return f"{self.topic}: {self.words}" if self.topic else self.words

    def __call__(self, samples: Sequence[Sample]) -> tuple[Sample, ...]:
        """Inject the fault into messages, topic by topic; those that are left keep their order."""
        places: dict[str, list[int]] = defaultdict(list)
        for number, one in enumerate(samples):
            places[one.topic].append(number)
        if self.topic and places:
            known_topic(self.topic, places)
        found: list[Sample | None] = list(samples)
        for topic, numbers in places.items():
            if self.topic in ("", topic):
                changed = self.change([samples[number] for number in numbers])
                for number, after in zip(numbers, changed, strict=True):
                    found[number] = after
        return tuple(one for one in found if one is not None)


@called_as("bags.inject(bag, bags.stuck(at=20))")
def inject(source: Run | Iterable[Sample], *faults: Change) -> tuple[Sample, ...]:
    """Break a recording on purpose: the messages with some faults, one after the other.

    Args:
        source: A bag, a session, what it observed, or messages.
        faults: Faults, such as `stuck(at=20)`, or any function from messages to messages.

    Returns:
        New messages; those in `source` stay as they are.

    Raises:
        BagError: If a fault cannot be injected into these messages.
    """
    if isinstance(source, (list, tuple)):
        samples: tuple[Sample, ...] = tuple(source)
    else:
        samples = observation_of(source).samples
    for one in faults:
        if not callable(one):
            raise BagError(
                f"{one!r} is not a fault.",
                "A fault is a function that takes messages and returns messages.",
                "For example, write `faults=[stuck(at=20), dropouts(share=0.1)]`.",
            )
        samples = tuple(one(samples))
    return samples


# Faults.


@called_as("bags.stuck(at=20)")
def stuck(
    at: float = 0, seconds: float | None = None, *, topic: str | None = None
) -> InjectedFault:
    """Simulate a sensor that hangs: from `at` on, it repeats its last reading.

    Args:
        at: When the fault begins, in seconds.
        seconds: How long the fault lasts; None for the rest of the recording.
        topic: The affected topic; by default all topics, each separately.

    Raises:
        BagError: If a time is not a number from 0 up.
    """
    begin, end = _window("stuck", at, seconds)

    def change(samples: Sequence[Sample]) -> Iterator[Sample]:
        last = None
        for one in samples:
            if last is None or not begin <= one.time_ns < end:
                last = one
            yield replace(one, data=last.data)

    return _fault(f"stuck {_when(at, seconds)}", topic, change)


@called_as("bags.drift(rate=0.1)")
def drift(
    rate: float, *, at: float = 0, topic: str | None = None, field: str | None = None
) -> InjectedFault:
    """Simulate a sensor that drifts: from `at` on, the error of its readings grows steadily.

    Args:
        rate: Growth of the error per second, in units of the value.
        at: When the fault begins, in seconds.
        topic: The affected topic; by default all topics.
        field: The affected number in a message, nested fields with dots; None if there is only one.

    Raises:
        BagError: If `rate` is not a finite number, or `at` is not a number from 0 up.
    """
    _check("drift", "rate", rate, low=-inf)
    begin = _ns("drift", "at", at)

    def change(samples: Sequence[Sample]) -> Iterator[Sample]:
        for one in samples:
            yield _added(one, field, rate * max(0, one.time_ns - begin) / NANOSECONDS)

    return _fault(f"drift of {rate:g} a second from {at:g} s on", topic, change)


@called_as("bags.dropouts(share=0.2)")
def dropouts(
    share: float = 0,
    spans: Iterable[Span] = (),
    *,
    seed: int = 0,
    topic: str | None = None,
) -> InjectedFault:
    """Simulate an unreliable connection: some messages never arrive.

    Args:
        share: Probability that a message is lost, from 0 to 1.
        spans: Periods in which all messages are lost, each as (begin, end) in seconds.
        seed: Seed of the random numbers.
        topic: The affected topic; by default all topics.

    Raises:
        BagError: If `share` is not from 0 to 1, or a span is not a pair of ascending times.
    """
    _check("dropouts", "share", share, high=1)
    gaps = [_gap(span) for span in (spans if isinstance(spans, Iterable) else [spans])]

    def change(samples: Sequence[Sample]) -> Iterator[Sample | None]:
        # One topic's random numbers do not depend on the other topics.
        dice = Random(f"{seed}:{samples[0].topic}")
        for one in samples:
            lost = dice.random() < share
            lost = lost or any(begin <= one.time_ns < end for begin, end in gaps)
            yield None if lost else one

    words = [f"{share:.0%} of the messages lost"] if share or not gaps else []
    words += [f"no messages from {a / NANOSECONDS:g} s to {b / NANOSECONDS:g} s" for a, b in gaps]
    return _fault(", ".join(words), topic, change)


@called_as("bags.with_nan(at=20)")
def with_nan(
    at: float = 0,
    seconds: float | None = 0,
    *,
    topic: str | None = None,
    field: str | None = None,
) -> InjectedFault:
    """Simulate a sensor that reports its failure: its value is NaN, "not a number".

    Args:
        at: When the fault begins, in seconds.
        seconds: How long the fault lasts; 0 for only the first message from `at` on; None for the
            rest of the recording.
        topic: The affected topic; by default all topics.
        field: The affected number in a message, nested fields with dots; None if there is only one.

    Raises:
        BagError: If a time is not a number from 0 up.
    """
    is_once = seconds == 0
    begin, end = _window("with_nan", at, None if is_once else seconds)

    def change(samples: Sequence[Sample]) -> Iterator[Sample]:
        count = 0
        for one in samples:
            affected = begin <= one.time_ns < end and not (is_once and count)
            count += affected
            yield _added(one, field, nan) if affected else one

    return _fault(
        f"NaN once at {at:g} s" if is_once else f"NaN {_when(at, seconds)}", topic, change
    )


# How it works.


def _fault(words: str, topic: str | None, change: _TopicChange) -> InjectedFault:
    return InjectedFault(words, full_name(topic) if topic is not None else "", change)


def _when(at: float, seconds: float | None) -> str:
    return f"from {at:g} s on" if seconds is None else f"at {at:g} s for {seconds:g} s"


def _window(call: str, at: float, seconds: float | None) -> tuple[int, float]:
    begin = _ns(call, "at", at)
    return begin, inf if seconds is None else begin + _ns(call, "seconds", seconds)


def _gap(span: object) -> tuple[int, int]:
    if isinstance(span, (tuple, list)) and len(span) == 2:
        begin, end = (_ns("dropouts", "spans", one) for one in span)
        if begin < end:
            return begin, end
    raise _bad_argument("dropouts", f"spans with {span!r}", "pairs of ascending times")


def _ns(call: str, name: str, seconds: float) -> int:
    _check(call, name, seconds)
    return round(seconds * NANOSECONDS)


def _check(call: str, name: str, value: float, low: float = 0, high: float = inf) -> None:
    """Refuse what is no finite number within these limits."""
    is_number = isinstance(value, (int, float)) and not isinstance(value, bool)
    if is_number and isfinite(value) and low <= value <= high:
        return
    limited = f"a number from 0 to {high:g}" if high < inf else "a number of 0 or more"
    wanted = "a finite number" if low == -inf else limited
    raise _bad_argument(call, f"{name}={value!r}", f"{wanted} for `{name}`")


def _bad_argument(call: str, what: str, wanted: str) -> BagError:
    return BagError(
        f"{call} was given {what}.",
        f"The function takes {wanted}.",
        "For example, write `stuck(at=20, seconds=5)`, `drift(rate=0.1)` or `dropouts(share=0.2)`.",
    )


def _added(sample: Sample, field: str | None, amount: float) -> Sample:
    """A copy of a message with something added to one number; an integer stays an integer.

    `field` names the number, nested fields with dots; None if there is only one.
    """
    known = list(_number_fields(sample.data))
    if field not in known and (field is not None or len(known) != 1):
        names = ", ".join(map(repr, known))
        where = f"the field {field!r}" if field else "one number"
        raise BagError(
            f"A message on {sample.topic} does not have {where} to change.",
            f"The fields of this {sample.type_name} that hold numbers are {names}."
            if names
            else f"This {sample.type_name} has no field that holds a number.",
            "Choose a field with `field=...`, or another topic with `topic=...`.",
        )
    *parents, name = (field or known[0]).split(".")
    data = deepcopy(sample.data)
    inner = data
    for parent in parents:
        inner = inner[parent]
    if isinstance(inner[name], int):
        if isnan(amount):
            raise BagError(
                f"Messages on {sample.topic} hold whole numbers, and NaN is not a whole number.",
                "NaN ('not a number') is a value of floating-point types only, and this "
                f"{sample.type_name} has no floating-point field.",
                "Choose a topic with floating-point numbers, or another fault.",
            )
        inner[name] = round(inner[name] + amount)
    else:
        inner[name] += amount
    return replace(sample, data=data)


def _number_fields(data: Mapping[str, Any], prefix: str = "") -> Iterator[str]:
    """Dotted names of all numbers in a message, those in arrays left out."""
    for name, value in data.items():
        if isinstance(value, Mapping):
            yield from _number_fields(value, f"{prefix}{name}.")
        elif isinstance(value, (int, float)) and not isinstance(value, bool):
            yield prefix + name
