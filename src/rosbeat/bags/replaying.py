"""Replay a recording as a node that publishes it again."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from itertools import groupby
from math import isfinite

from rosbeat.bags.bag import UNKNOWN
from rosbeat.bags.faults import Change, inject
from rosbeat.bags.inputs import Run, full_name, known_topic, observation_of, topic_types
from rosbeat.bags.serialization import installed_types, serialized
from rosbeat.errors import BagError, called_as
from rosbeat.records import Observation, QoS, Sample
from rosbeat.ros.test_nodes import NodeFactory, PlayedStep, PlayedTopic, player


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
        raise BagError(
            f"speed={speed!r} cannot be used.",
            "The speed is a number above 0: 2 replays twice as fast, 0.5 half as fast.",
            "Leave the speed out to replay at the original speed.",
        )
    seen = observation_of(source)
    types, known = topic_types(seen, topics), topic_types(seen)
    names = {known_topic(old, known): full_name(new) for old, new in (remap or {}).items()}
    chosen = [one for one in seen.samples if one.topic in types]
    samples = sorted(inject(chosen, *faults), key=lambda one: one.time_ns)
    data = serialized(installed_types(types.values()), samples)
    played = [PlayedTopic(names.get(one, one), types[one], _offer(seen, one)) for one in types]
    return player(name, played, _steps(samples, data, list(types), speed))


def _offer(seen: Observation, topic: str) -> QoS:
    return next((end.qos for end in seen.graph.on(topic, "publisher")), QoS())


def _steps(
    samples: Sequence[Sample], data: Sequence[bytes], topics: Sequence[str], speed: float
) -> list[PlayedStep]:
    """What is published together: what one known node has published at one instant."""

    def instant(number: int) -> tuple[int, object]:
        one = samples[number]
        return one.time_ns, number if one.node == UNKNOWN else one.node

    return [
        PlayedStep(
            round(at / speed), tuple((topics.index(samples[k].topic), data[k]) for k in group)
        )
        for (at, _), group in groupby(range(len(samples)), instant)
    ]
