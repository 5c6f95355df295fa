"""Replay a recording as a node that publishes it again."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import groupby

from rosbeat.bags.arguments import Run, observation_of, topic_types
from rosbeat.bags.bag import UNKNOWN
from rosbeat.bags.faults import Change, inject
from rosbeat.bags.serialization import installed_types, serialized
from rosbeat.errors import BagError, SessionError, called_as
from rosbeat.records import Observation, QoS, Sample
from rosbeat.ros.test_nodes import NodeFactory, PlayedStep, PlayedTopic, player


@called_as("bags.replay(bag)")
def replay(
    source: Run,
    *,
    topics: str | Iterable[str] | None = None,
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

    To publish on other topics, remap them: `ros.add(replay(bag), remappings={...})`. Times count
    from the moment at which the node is added. In virtual time every run is the same.
    Messages that one node published at the same instant are published together, as in one callback.
    Messages of several nodes at the same instant are published one after the other, each followed
    by everything that it triggers.

    Args:
        source: A bag, a session, or an observation.
        topics: Names of the topics to publish on; all by default.
        faults: Faults to inject, in order; their times are those of the recording.
        name: The node's name.

    Returns:
        A function that makes the node, for `Session.add`.

    Raises:
        BagError: If a topic was not recorded, its type is not installed, a message does not fit it,
            or a fault cannot be injected.
    """
    seen = observation_of(source)
    types = topic_types(seen, topics)
    chosen = [one for one in seen.samples if one.topic in types]
    samples = sorted(inject(chosen, *faults), key=lambda one: one.time_ns)
    data = serialized(installed_types(types.values()), samples)
    played = [PlayedTopic(one, types[one], _offer(seen, one)) for one in types]
    try:
        return player(name, played, _steps(samples, data, list(types)))
    except SessionError as error:
        leave_out = f"{error.to_try[:-1]}, or leave the topic out with `topics=[...]`."
        raise BagError(error.what, error.means, leave_out) from error


def _offer(seen: Observation, topic: str) -> QoS:
    return next((end.qos for end in seen.graph.on(topic, "publisher")), QoS())


def _steps(
    samples: Sequence[Sample], data: Sequence[bytes], topics: Sequence[str]
) -> list[PlayedStep]:
    """What is published together: what one known node has published at one instant."""

    def instant(number: int) -> tuple[int, object]:
        one = samples[number]
        return one.time_ns, number if one.node == UNKNOWN else one.node

    return [
        PlayedStep(at, tuple((topics.index(samples[k].topic), data[k]) for k in group))
        for (at, _), group in groupby(range(len(samples)), instant)
    ]
