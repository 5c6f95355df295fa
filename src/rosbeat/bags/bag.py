"""Represent a recording on a page."""

from __future__ import annotations

from itertools import zip_longest
from pathlib import Path

from rosbeat.bags import bag_words, reading, refusals
from rosbeat.bags.sources import full_name, place
from rosbeat.errors import called_as
from rosbeat.records import (
    NANOSECONDS,
    Endpoint,
    GraphSnapshot,
    Observation,
    QoS,
    Sample,
)


class Bag:
    """Read a rosbag2 bag: a folder with messages and metadata, or a single data file.

    ::

        bag = Bag("first_run")
        print(bag)
        bag.messages("temperature")

    Times in a recording of a session are in the session's virtual time. In any other recording,
    time 0 is the time of the first message.

    Args:
        folder: The bag's folder, or a single file that ends in `.mcap` or `.db3`.

    Attributes:
        folder: Path of the bag.

    Raises:
        BagError: If there is no bag at that path, or it is damaged.
    """

    @called_as('bags.Bag("first_run")')
    def __init__(self, folder: str | Path) -> None:
        self.folder = place(folder)
        self._contents = reading.contents(self.folder)

    def __repr__(self) -> str:
        return bag_words.describe(self.folder.name, self._contents)

    def __len__(self) -> int:
        return sum(self.counts.values())

    @property
    def storage(self) -> str:
        """Return the storage format: `mcap` or `sqlite3`."""
        return self._contents.storage

    @property
    def topics(self) -> tuple[str, ...]:
        """Return the full names of the topics, in the order in which they were recorded."""
        return tuple(one.name for one in self._contents.topics)

    @property
    def types(self) -> dict[str, str]:
        """Return the message type of each topic."""
        return {one.name: one.type_name for one in self._contents.topics}

    @property
    def counts(self) -> dict[str, int]:
        """Return the number of messages on each topic."""
        return {one.name: one.count for one in self._contents.topics}

    @property
    def qos(self) -> dict[str, tuple[QoS, ...]]:
        """Return the QoS that the publishers of each topic offered, as far as it was recorded."""
        return {one.name: one.qos for one in self._contents.topics}

    @property
    def start(self) -> float:
        """Return when the first message was published, in seconds of the clock that stamped it."""
        return self._contents.first_ns / NANOSECONDS

    @property
    def duration(self) -> float:
        """Return the time from the first message to the last, in seconds."""
        return self._contents.duration_ns / NANOSECONDS

    @property
    def seconds(self) -> float:
        """Return how long to run a session that replays the bag, in seconds.

        This is how long the recorded session ran, or the duration of the recording if that is
        unknown.
        """
        return self._length_ns / NANOSECONDS

    @called_as('bag.messages("temperature")')
    def messages(self, topic: str) -> tuple[Sample, ...]:
        """Return the messages on a topic, in order.

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
        """Return all messages and what is known about the publishers, for pictures and checks.

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
