"""A recording, as a page has it in hand."""

from __future__ import annotations

from itertools import zip_longest
from pathlib import Path

from rosbeat.bags import bag_words, reading, refusals
from rosbeat.bags.sources import full_name, place
from rosbeat.records import (
    NANOSECONDS,
    Endpoint,
    GraphSnapshot,
    Observation,
    QoS,
    Sample,
)


class Bag:
    """A rosbag2 bag: a folder with messages and what is known of them, or one file of data.

    ::

        bag = Bag("first_run")
        print(bag)
        bag.messages("temperature")

    What a session recorded has the session's virtual time. In any other recording the time of the
    first message counts as 0.

    Args:
        folder: The bag's folder, or a single file that ends in `.mcap` or `.db3`.

    Attributes:
        folder: Where it is.

    Raises:
        BagError: If there is no bag, or it is damaged.
    """

    def __init__(self, folder: str | Path) -> None:
        self.folder = place(folder)
        self._contents = reading.contents(self.folder)

    def __repr__(self) -> str:
        return bag_words.describe(self.folder.name, self._contents)

    def __len__(self) -> int:
        return sum(self.counts.values())

    @property
    def storage(self) -> str:
        """How the messages are stored: `mcap` or `sqlite3`."""
        return self._contents.storage

    @property
    def topics(self) -> tuple[str, ...]:
        """Full names of the topics, in the order in which they were recorded."""
        return tuple(one.name for one in self._contents.topics)

    @property
    def types(self) -> dict[str, str]:
        """The message type of each topic."""
        return {one.name: one.type_name for one in self._contents.topics}

    @property
    def counts(self) -> dict[str, int]:
        """How many messages there are on each topic."""
        return {one.name: one.count for one in self._contents.topics}

    @property
    def qos(self) -> dict[str, tuple[QoS, ...]]:
        """The quality of service that the publishers of each topic offered, if it was recorded."""
        return {one.name: one.qos for one in self._contents.topics}

    @property
    def start(self) -> float:
        """When the first message was published, in seconds of the clock that stamped it."""
        return self._contents.first_ns / NANOSECONDS

    @property
    def duration(self) -> float:
        """Seconds from the first message to the last."""
        return self._contents.duration_ns / NANOSECONDS

    @property
    def seconds(self) -> float:
        """How long to run a session that replays it, in seconds.

        That is as long as the session ran which was recorded, else as long as the recording lasts.
        """
        return self._length_ns / NANOSECONDS

    def messages(self, topic: str) -> tuple[Sample, ...]:
        """The messages on a topic, in order.

        Args:
            topic: The topic's name; `temperature` and `/temperature` are the same.

        Raises:
            BagError: If there is no such topic, or the bag is damaged.
        """
        name = full_name(topic)
        if name not in self.topics:
            raise refusals.unknown_topic(name, self.topics)
        return reading.samples(self.folder, self._contents, [name])

    def observation(self) -> Observation:
        """All messages, and what is known of the publishers, as pictures and checks take it.

        Raises:
            BagError: If the bag is damaged.
        """
        notes = self._contents.notes
        samples = reading.samples(self.folder, self._contents, self.topics)
        return Observation(
            self._length_ns, notes.seed if notes else 0, samples, graph=self._graph()
        )

    @property
    def _length_ns(self) -> int:
        notes = self._contents.notes
        return notes.length_ns if notes else self._contents.duration_ns

    def _graph(self) -> GraphSnapshot:
        ends = tuple(end for one in self._contents.topics for end in _publishers(one))
        nodes = dict.fromkeys(end.node for end in ends if end.node != reading.UNKNOWN)
        return GraphSnapshot(tuple(nodes), ends)


def _publishers(topic: reading.Topic) -> list[Endpoint]:
    pairs = zip_longest(topic.nodes, topic.qos)
    return [
        Endpoint(node or reading.UNKNOWN, topic.name, topic.type_name, "publisher", qos or QoS())
        for node, qos in pairs
    ] or [Endpoint(reading.UNKNOWN, topic.name, topic.type_name, "publisher", QoS())]
