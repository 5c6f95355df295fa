"""Replay a recording as a node that publishes it again."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from itertools import groupby
from math import isfinite

from rosbeat.bags import refusals
from rosbeat.bags.injecting import Change, inject
from rosbeat.bags.reading import UNKNOWN
from rosbeat.bags.sources import Run, chosen, full_name, observed, types_of
from rosbeat.bags.types import installed_types
from rosbeat.bags.writing import wires
from rosbeat.errors import called_as
from rosbeat.records import Observation, QoS, Sample
from rosbeat.ros.playback import NodeFactory, PlayedStep, PlayedTopic, player


@called_as("bags.replay(bag)")
def replay(
    source: Run,
    *,
    speed: float = 1,
    topics: str | Iterable[str] | None = None,
    remap: Mapping[str, str] | None = None,
    faults: Iterable[Change] = (),
    name: str = "replay",
) -> NodeFactory:
    """Return a factory for a node that replays a recording, each message at its recorded time.

    ::

        bag = Bag("first_run")
        with Session() as ros:
            ros.add(replay(bag, topics="temperature"))
            ros.add(TemperatureMonitor)
            ros.run(bag.seconds)

    Times count from the moment at which the node is added. In virtual time every run is the same.
    Messages that one node published at the same instant are published together, as in one callback.
    Messages of several nodes at the same instant are published one after the other, each followed
    by everything that it triggers.

    Args:
        source: A bag, a session, or an observation.
        speed: Factor by which to speed up; `ros.run(bag.seconds / speed)` then runs all of it.
        topics: Names of the topics to publish on; all by default.
        remap: New names for topics: `{"temperature": "old/temperature"}`.
        faults: Faults to inject, in order; their times are those of the recording.
        name: The node's name.

    Returns:
        A function that makes the node, for `Session.add`.

    Raises:
        BagError: If a topic was not recorded, its type is not installed, a message does not fit it,
            `speed` is not a number above 0, or a fault cannot be injected.
    """
    if not isinstance(speed, (int, float)) or not isfinite(speed) or speed <= 0:
        raise refusals.no_number(speed)
    seen = observed(source)
    types, names = types_of(seen, topics), _renamed(seen, remap)
    samples = sorted(inject(chosen(seen, types), *faults), key=lambda one: one.time_ns)
    made = wires(installed_types(types.values()), samples)
    played = [PlayedTopic(names.get(one, one), types[one], _offer(seen, one)) for one in types]
    return player(name, played, _steps(samples, made, list(types), speed))


def _renamed(seen: Observation, remap: Mapping[str, str] | None) -> dict[str, str]:
    known = types_of(seen)
    names = {full_name(old): full_name(new) for old, new in (remap or {}).items()}
    for old in names:
        if old not in known:
            raise refusals.unknown_topic(old, known)
    return names


def _offer(seen: Observation, topic: str) -> QoS:
    return next((end.qos for end in seen.graph.on(topic, "publisher")), QoS())


def _steps(
    samples: Sequence[Sample], made: Sequence[bytes], topics: Sequence[str], speed: float
) -> list[PlayedStep]:
    """What is published together: what one known node has published at one instant."""
    places = {topic: number for number, topic in enumerate(topics)}

    def step_of(item: tuple[int, tuple[Sample, bytes]]) -> tuple[int, str]:
        number, (sample, _) = item
        return sample.time_ns, f"?{number}" if sample.node == UNKNOWN else sample.node

    pairs = enumerate(zip(samples, made, strict=True))
    return [
        PlayedStep(round(at / speed), tuple((places[one.topic], wire) for _, (one, wire) in group))
        for (at, _), group in groupby(pairs, step_of)
    ]
