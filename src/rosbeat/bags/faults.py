"""Define faults of sensors and connections that can be injected into a recording.

Each function returns a fault, which maps messages to messages with that fault. Times are in seconds
of the recording. Random choices come from `seed`, and are the same on every run.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from math import inf, isfinite, nan
from random import Random

from rosbeat.bags import refusals
from rosbeat.bags.injecting import InjectedFault, fault
from rosbeat.bags.numbers import changed
from rosbeat.errors import called_as
from rosbeat.records import NANOSECONDS, Sample

#: From when (included) to when (not included), in seconds.
Span = tuple[float, float]


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

    return fault(f"stuck {_words(at, seconds)}", topic, lambda samples: list(change(samples)))


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
    _check("drift", "rate", rate, low=None)
    begin, _ = _window("drift", at, None)

    def off(one: Sample) -> float:
        return rate * max(0, one.time_ns - begin) / NANOSECONDS

    return fault(
        f"drift of {rate:g} a second {_words(at, None)}",
        topic,
        lambda samples: [changed(one, field, lambda x, one=one: x + off(one)) for one in samples],  # type: ignore[misc]  # mypy sees no type for `one=one`
    )


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
    gaps = [_gap(span) for span in _pairs(spans)]

    def change(samples: Sequence[Sample]) -> list[Sample]:
        dice = _dice(seed, samples)
        kept = [one for one in samples if dice.random() >= share]
        return [one for one in kept if not any(a <= one.time_ns < b for a, b in gaps)]

    words = [f"{share:.0%} of the messages lost"] if share or not gaps else []
    words += [f"no messages from {a / NANOSECONDS:g} s to {b / NANOSECONDS:g} s" for a, b in gaps]
    return fault(", ".join(words), topic, change)


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
    begin, end = _window("with_nan", at, seconds)

    def change(samples: Sequence[Sample]) -> list[Sample]:
        first = next((k for k, one in enumerate(samples) if one.time_ns >= begin), None)
        return [
            changed(one, field, lambda _: nan)
            if begin <= one.time_ns < end or (not seconds and seconds is not None and k == first)
            else one
            for k, one in enumerate(samples)
        ]

    words = f"NaN once at {at:g} s" if seconds == 0 else f"NaN {_words(at, seconds)}"
    return fault(words, topic, change)


@called_as("bags.spikes(share=0.1, size=5)")
def spikes(
    share: float,
    size: float,
    *,
    seed: int = 0,
    topic: str | None = None,
    field: str | None = None,
) -> InjectedFault:
    """Simulate interference: now and then a value is far too high or too low.

    Args:
        share: Probability that a message is affected, from 0 to 1.
        size: Size of the error, in units of the value.
        seed: Seed of the random numbers.
        topic: The affected topic; by default all topics.
        field: The affected number in a message, nested fields with dots; None if there is only one.

    Raises:
        BagError: If `share` is not from 0 to 1, or `size` is not a finite number.
    """
    _check("spikes", "share", share, high=1)
    _check("spikes", "size", size, low=None)

    def change(samples: Sequence[Sample]) -> Iterator[Sample]:
        dice = _dice(seed, samples)
        for one in samples:
            hit, off = dice.random() < share, dice.choice((-size, size))
            yield changed(one, field, lambda x, off=off: x + off) if hit else one  # type: ignore[misc]  # nor for `off=off`

    return fault(
        f"spikes of {size:g} in {share:.0%} of the messages",
        topic,
        lambda samples: list(change(samples)),
    )


@called_as("bags.delayed(seconds=0.5)")
def delayed(
    seconds: float, *, jitter: float = 0, seed: int = 0, topic: str | None = None
) -> InjectedFault:
    """Simulate a slow connection: every message arrives late, optionally with jitter.

    Messages may overtake each other, as they may on a network.

    Args:
        seconds: Minimum delay, in seconds.
        jitter: Maximum additional delay, drawn for each message, in seconds.
        seed: Seed of the random numbers.
        topic: The affected topic; by default all topics.

    Raises:
        BagError: If a time is not a number from 0 up.
    """
    later, more = (_ns("delayed", *one) for one in (("seconds", seconds), ("jitter", jitter)))

    def change(samples: Sequence[Sample]) -> list[Sample]:
        dice = _dice(seed, samples)
        moved = [
            replace(one, time_ns=one.time_ns + later + dice.randint(0, more)) for one in samples
        ]
        return sorted(moved, key=lambda one: one.time_ns)

    words = f"delayed by {seconds:g} s" + (f" and up to {jitter:g} s more" if jitter else "")
    return fault(words, topic, change)


# How it works.


def _dice(seed: int, samples: Sequence[Sample]) -> Random:
    """Random numbers of one topic, which do not depend on the other topics."""
    topic = samples[0].topic if samples else ""
    return Random(f"{seed}:{topic}")


def _window(call: str, at: float, seconds: float | None) -> tuple[int, float]:
    begin = _ns(call, "at", at)
    return begin, inf if seconds is None else begin + _ns(call, "seconds", seconds)


def _pairs(spans: object) -> Iterable[object]:
    return spans if isinstance(spans, Iterable) else [spans]


def _gap(span: object) -> tuple[int, int]:
    if isinstance(span, (tuple, list)) and len(span) == 2:
        begin, end = (_ns("dropouts", "spans", one) for one in span)
        if begin < end:
            return begin, end
    raise refusals.bad_argument("dropouts", f"spans with {span!r}", "pairs of ascending times")


def _ns(call: str, name: str, seconds: float) -> int:
    _check(call, name, seconds)
    return round(seconds * NANOSECONDS)


def _check(
    call: str, name: str, value: object, low: float | None = 0, high: float | None = None
) -> None:
    least, most = -inf if low is None else low, inf if high is None else high
    number = isinstance(value, (int, float)) and not isinstance(value, bool)
    if number and isfinite(value) and least <= value <= most:  # type: ignore[arg-type, operator]  # `number` says that it is one
        return
    reach = f"a number from 0 to {high:g}" if high is not None else "a number of 0 or more"
    wanted = "a finite number" if low is None else reach
    raise refusals.bad_argument(call, f"{name}={value!r}", f"{wanted} for `{name}`")


def _words(at: float, seconds: float | None) -> str:
    return f"from {at:g} s on" if seconds is None else f"at {at:g} s for {seconds:g} s"
