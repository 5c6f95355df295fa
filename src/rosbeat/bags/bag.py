"""Read a rosbag2 bag from any source, and represent it on a page."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from datetime import datetime, timezone
from itertools import zip_longest
from pathlib import Path
from tempfile import TemporaryDirectory

from rosbags.interfaces import ConnectionExtRosbag2, Qos, QosTime
from rosbags.rosbag2 import Reader

from rosbeat.bags.arguments import known_topic, path_of, reason
from rosbeat.bags.serialization import from_bytes, recorded_types
from rosbeat.errors import BagError, RosbeatError, called_as
from rosbeat.records import NANOSECONDS, Endpoint, GraphSnapshot, Observation, QoS, Sample

#: The name of a node that a recording does not tell.
UNKNOWN = "?"
#: What our own bags tell in addition, as JSON in the `custom_data` of metadata.yaml: how long the
#: session had run, its seed, and the nodes that published, by topic.
SESSION_NS, SEED, PUBLISHERS = "rosbeat.session_ns", "rosbeat.seed", "rosbeat.publishers"
_STORAGE_NAMES = {"mcap": "MCAP", "sqlite3": "SQLite"}
#: From so many seconds on, sixty years, nobody has meant a limit: the middleware rounds "no limit"
#: to what it can express, in some versions to 68 years.
_NO_LIMIT = 60 * 365 * 24 * 3600


@dataclass(frozen=True)
class _Topic:
    """One topic of a recording; `qos` and `nodes` tell of its publishers what was recorded."""

    name: str
    type_name: str
    count: int = 0
    qos: tuple[QoS, ...] = ()
    nodes: tuple[str, ...] = ()


@dataclass(frozen=True)
class _SessionFacts:
    """What only a recording of a session tells; see `SESSION_NS`."""

    length_ns: int
    seed: int
    publishers: Mapping[str, tuple[str, ...]]


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
        self.folder = path_of(folder)
        with _opened(self.folder) as reader:
            self._session = _session_facts(reader.storage.metadata.custom)
            self._topics = _topics(reader, self._session)
            has_messages = reader.message_count > 0
            self._first_ns = reader.start_time if has_messages else 0
            self._duration_ns = reader.duration - 1 if has_messages else 0
        files = self.folder.iterdir() if self.folder.is_dir() else [self.folder]
        self._storage = "mcap" if any(".mcap" in file.suffixes for file in files) else "sqlite3"

    def __repr__(self) -> str:
        head = (
            f"Recording {self.folder.name}, stored as {_STORAGE_NAMES[self._storage]}: "
            f"{_count(len(self), 'message')} on {_count(len(self._topics), 'topic')}."
        )
        return "\n".join([head, self._time_words(), *map(_topic_words, self._topics.values())])

    def __len__(self) -> int:
        return sum(self.counts.values())

    @property
    def storage(self) -> str:
        """Return the storage format: `mcap` or `sqlite3`."""
        return self._storage

    @property
    def topics(self) -> tuple[str, ...]:
        """Return the full names of the topics, in the order in which they were recorded."""
        return tuple(self._topics)

    @property
    def types(self) -> dict[str, str]:
        """Return the message type of each topic."""
        return {name: one.type_name for name, one in self._topics.items()}

    @property
    def counts(self) -> dict[str, int]:
        """Return the number of messages on each topic."""
        return {name: one.count for name, one in self._topics.items()}

    @property
    def qos(self) -> dict[str, tuple[QoS, ...]]:
        """Return the QoS that the publishers of each topic offered, as far as it was recorded."""
        return {name: one.qos for name, one in self._topics.items()}

    @property
    def start(self) -> float:
        """Return when the first message was published, in seconds of the clock that stamped it."""
        return self._first_ns / NANOSECONDS

    @property
    def duration(self) -> float:
        """Return the time from the first message to the last, in seconds."""
        return self._duration_ns / NANOSECONDS

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
        return self._samples(known_topic(topic, self.topics))

    def observation(self) -> Observation:
        """Return all messages and what is known about the publishers, for pictures and checks.

        Raises:
            BagError: If the bag is damaged.
        """
        ends = tuple(end for one in self._topics.values() for end in _publishers(one))
        nodes = dict.fromkeys(end.node for end in ends if end.node != UNKNOWN)
        graph = GraphSnapshot(tuple(nodes), ends)
        seed = self._session.seed if self._session else 0
        return Observation(self._length_ns, seed, self._samples(*self.topics), graph=graph)

    @property
    def _length_ns(self) -> int:
        return self._session.length_ns if self._session else self._duration_ns

    def _samples(self, *topics: str) -> tuple[Sample, ...]:
        origin_ns = 0 if self._session else self._first_ns
        with _opened(self.folder) as reader:
            connections = [one for one in reader.connections if one.topic in topics]
            if not connections:
                return ()
            store = recorded_types(connections)
            samples = tuple(
                Sample(
                    stamp - origin_ns,
                    one.topic,
                    one.msgtype,
                    _only(self._topics[one.topic].nodes),
                    from_bytes(store, one.msgtype, data),
                )
                for one, stamp, data in reader.messages(connections)
            )
            # The library leaves out messages whose metadata contradicts itself.
            told, found = sum(one.msgcount for one in connections), len(samples)
            if found != told:
                raise ValueError(
                    f"its metadata lists {told} messages, but the data contains {found}"
                )
            return samples

    def _time_words(self) -> str:
        first, last = self._first_ns, self._first_ns + self._duration_ns
        if self._session:
            ran = f"The session ran for {_seconds(self._session.length_ns)} of virtual time"
            if not len(self):
                return f"{ran}."
            span = f"at {_seconds(first)}"
            if first != last:
                span = f"from {_seconds(first)} to {_seconds(last)}"
            return f"{ran} and published messages {span}."
        if not len(self):
            return "It has no timestamps."
        began = datetime.fromtimestamp(first // NANOSECONDS, timezone.utc)
        lasts = _seconds(self._duration_ns)
        return f"It lasts {lasts} and begins at {began:%Y-%m-%d %H:%M:%S} UTC."


# Files.


@contextmanager
def _opened(path: Path) -> Iterator[Reader]:
    if not path.exists() or (path.is_dir() and not (path / "metadata.yaml").is_file()):
        raise BagError(
            f"There is no recording at {path}.",
            "A recording is a folder that contains metadata.yaml and the data, or a single file "
            "that ends in .mcap or .db3.",
            "Check the name and the current folder, or record first.",
        )
    try:
        with TemporaryDirectory(prefix="rosbeat-") as folder:
            # SQLite takes some characters of a path for commands; a link has none of them.
            link = Path(folder, "bag").with_suffix("" if path.is_dir() else path.suffix)
            link.symlink_to(path.absolute())
            with Reader(link) as reader:
                yield reader
    except RosbeatError:
        raise
    except Exception as error:  # a damaged file may make the library stumble anywhere
        raise BagError(
            f"The recording at {path} cannot be read: {reason(error)}.",
            "The recording is damaged, incomplete, or in an unknown format. Nothing was changed.",
            "If you have a copy, use that; if the recording was interrupted, record again.",
        ) from error


def _session_facts(custom: Mapping[str, str] | None) -> _SessionFacts | None:
    """What our own bags tell; None if it is not there, or was edited."""
    try:
        keys = (SESSION_NS, SEED, PUBLISHERS)
        length, seed, nodes = (json.loads((custom or {})[key]) for key in keys)
        publishers = {str(topic): tuple(map(str, names)) for topic, names in nodes.items()}
        return _SessionFacts(int(length), int(seed), publishers)
    except (KeyError, TypeError, ValueError, AttributeError):
        return None


def _topics(reader: Reader, session: _SessionFacts | None) -> dict[str, _Topic]:
    topics: dict[str, _Topic] = {}
    for one in reader.connections:
        before = topics.get(one.topic, _Topic(one.topic, one.msgtype))
        offered = one.ext.offered_qos_profiles if isinstance(one.ext, ConnectionExtRosbag2) else ()
        topics[one.topic] = _Topic(
            one.topic,
            before.type_name,
            before.count + one.msgcount,
            (*before.qos, *map(_qos, offered)),
            session.publishers.get(one.topic, ()) if session else (),
        )
    return topics


def _qos(qos: Qos) -> QoS:
    return QoS(
        qos.reliability.name,
        qos.durability.name,
        qos.history.name,
        qos.depth,
        _limit_ns(qos.deadline),
        _limit_ns(qos.lifespan),
    )


def _limit_ns(time: QosTime) -> int:
    return 0 if time.sec >= _NO_LIMIT else time.sec * NANOSECONDS + time.nsec


def _only(nodes: tuple[str, ...]) -> str:
    """The node that published, if there was only one."""
    return nodes[0] if len(nodes) == 1 else UNKNOWN


def _publishers(topic: _Topic) -> Iterator[Endpoint]:
    known = list(zip_longest(topic.nodes, topic.qos)) or [(None, None)]
    for node, qos in known:
        yield Endpoint(node or UNKNOWN, topic.name, topic.type_name, "publisher", qos or QoS())


# Words.


def _topic_words(topic: _Topic) -> str:
    said = f"  {topic.name}: {_count(topic.count, 'message')} of type {topic.type_name}"
    said += f" from {' and '.join(topic.nodes)}" if topic.nodes else ""
    offers = dict.fromkeys(map(_qos_words, topic.qos))
    return f"{said} ({'; '.join(offers)})" if offers else said


def _qos_words(qos: QoS) -> str:
    kept = f"keep last {qos.depth}" if qos.history == "KEEP_LAST" else qos.history
    return ", ".join([qos.reliability, qos.durability, kept]).lower().replace("_", " ")


def _count(number: int, noun: str) -> str:
    return f"{number or 'no'} {noun if number == 1 else noun + 's'}"


def _seconds(time_ns: int) -> str:
    return f"{time_ns / NANOSECONDS:.9f}".rstrip("0").rstrip(".") + " s"
