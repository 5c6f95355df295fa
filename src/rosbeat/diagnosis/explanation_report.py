"""What was seen on a topic, sentence by sentence."""

from __future__ import annotations

from collections.abc import Iterator

from rosbeat.diagnosis.explanation_elsewhere import private_domains
from rosbeat.diagnosis.explanation_links import Sides
from rosbeat.diagnosis.explanation_parts import (
    comes,
    count,
    listing,
    nodes_of,
    qos_words,
    rate_words,
    seconds,
    short_type,
)
from rosbeat.diagnosis.situation import Beat, Scene
from rosbeat.records import NANOSECONDS, Endpoint


def report(sides: Sides, scene: Scene) -> tuple[str, ...]:
    """Say who is on a topic and what each has done."""
    return tuple(filter(None, _sentences(sides, scene)))


def _sentences(sides: Sides, scene: Scene) -> Iterator[str]:
    for end in sides.publishers:
        beat = scene.beat(end)
        yield f"{end.node} publishes {_what(end)}{_published(beat)}."
    for end in sides.subscriptions:
        beat = scene.beat(end)
        yield f"{end.node} subscribes to {_what(end)}{_heard(beat)}."
    if scene.arriving_hz:
        yield f"Altogether {comes(scene.arriving_hz, 'comes', 'come')} from other processes."
    if sides.missing:
        yield private_domains(scene)


def _what(end: Endpoint) -> str:
    return f"{short_type(end.type_name)} ({qos_words(end.qos)})"


def _published(beat: Beat) -> str:
    if beat.count < 0:
        return ""
    if beat.count == 0:
        return f": nothing in {seconds(beat.seconds)}"
    rate = f", {rate_words(beat.rate_hz)}" if beat.rate_hz else ""
    last = f", the last at {_at(beat.last_ns)}" if beat.last_ns >= 0 else ""
    return f": {count(beat.count, 'message')}{rate}{last}"


def _heard(beat: Beat) -> str:
    if beat.count < 0:
        return ""
    missed = f"; {count(beat.missed, 'message')} had been published before" if beat.missed else ""
    last = f", the last at {_at(beat.last_ns)}" if beat.count and beat.last_ns >= 0 else ""
    ran = f"ran {count(beat.count, 'time')}" if beat.count else "has not run"
    return f": its callback {ran}{last}{missed}"


def _at(time_ns: int) -> str:
    return f"{time_ns / NANOSECONDS:.6g} s"


def arrival(sides: Sides, scene: Scene, rate_hz: float) -> str:
    """Say what arrives and where, if all is well."""
    listeners = nodes_of(sides.subscriptions) or "somebody who is not shown here"
    if rate_hz:
        return f"{comes(rate_hz, 'arrives', 'arrive')} at {listeners}"
    number = sum(scene.beat(end).count for end in sides.publishers if scene.beat(end).count > 0)
    return f"{count(number, 'message')} arrived at {listing([listeners])} so far"
