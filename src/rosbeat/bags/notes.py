"""Store additional facts in our own bags: the session's length, its seed, and the publishers.

rosbag2 provides `custom_data` in metadata.yaml for such notes, with a text for each name. A bag
without them was made by another tool, and is equally valid.
"""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from typing import Any

from rosbeat.records import Observation

_LENGTH, _SEED, _NODES = "rosbeat.session_ns", "rosbeat.seed", "rosbeat.publishers"


@dataclass(frozen=True)
class Notes:
    """Hold the notes that rosbeat adds to a bag.

    Attributes:
        length_ns: How long the session had run, in nanoseconds.
        seed: Seed of the session's random numbers.
        publishers: Full names of the nodes that published, for each topic.
    """

    length_ns: int
    seed: int = 0
    publishers: Mapping[str, tuple[str, ...]] = field(default_factory=dict)


def notes_of(seen: Observation, topics: Iterable[str]) -> dict[str, Any]:
    """Return the notes on an observation, as the `custom_data` of a bag."""
    nodes = {topic: dict.fromkeys(end.node for end in seen.graph.on(topic, "publisher"))
             for topic in topics}  # fmt: skip
    for one in seen.samples:
        if one.topic in nodes:
            nodes[one.topic][one.node] = None
    publishers = {topic: list(names) for topic, names in nodes.items()}
    return {_LENGTH: seen.time_ns, _SEED: seen.seed, _NODES: publishers}


def notes_in(custom: Mapping[str, str] | None) -> Notes | None:
    """Return the notes in a bag's metadata, or None if there are none or they are incomplete."""
    try:
        length, seed, nodes = (json.loads((custom or {})[key]) for key in (_LENGTH, _SEED, _NODES))
        publishers = {str(topic): tuple(map(str, names)) for topic, names in nodes.items()}
        return Notes(int(length), int(seed), publishers)
    except (KeyError, TypeError, ValueError, AttributeError):
        return None
