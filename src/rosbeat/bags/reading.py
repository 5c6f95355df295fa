"""Read a rosbag2 bag from any source."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory

from rosbags.interfaces import Connection, ConnectionExtRosbag2
from rosbags.rosbag2 import Reader

from rosbeat.bags import qualities, refusals
from rosbeat.bags.notes import Notes, notes_in
from rosbeat.bags.plain import from_wire
from rosbeat.bags.types import recorded_types
from rosbeat.errors import RosbeatError
from rosbeat.records import QoS, Sample

#: The name of a node that a recording does not tell.
UNKNOWN = "?"
_COMMANDS = frozenset("?#%")


@dataclass(frozen=True)
class Topic:
    """Describe one topic of a recording.

    Attributes:
        name: Full name.
        type_name: The message type.
        count: Number of messages.
        qos: QoS offered by each publisher, as far as it was recorded.
        nodes: Full names of the nodes that published, as far as they were recorded.
    """

    name: str
    type_name: str
    count: int
    qos: tuple[QoS, ...] = ()
    nodes: tuple[str, ...] = ()


@dataclass(frozen=True)
class Contents:
    """Hold the metadata of a recording.

    Attributes:
        storage: `mcap` or `sqlite3`.
        topics: The topics, in the order in which they were recorded.
        first_ns: Stamp of the first message in nanoseconds; 0 without messages.
        duration_ns: Time from the first message to the last, in nanoseconds.
        notes: Notes of a session; None if the recording was not made by rosbeat.
    """

    storage: str
    topics: tuple[Topic, ...]
    first_ns: int
    duration_ns: int
    notes: Notes | None

    @property
    def origin_ns(self) -> int:
        """Return the stamp that counts as time 0: the session's start, else the first message."""
        return 0 if self.notes else self.first_ns


def contents(path: Path) -> Contents:
    """Read what a recording says of itself.

    Raises:
        BagError: If there is none, or it is damaged.
    """
    with _opened(path) as reader:
        notes = notes_in(reader.storage.metadata.custom)
        topics = _topics(reader.connections, notes)
        some = reader.message_count > 0
        first, length = (reader.start_time, reader.duration - 1) if some else (0, 0)
        return Contents(_storage(path), topics, first, length, notes)


def samples(path: Path, found: Contents, wanted: Iterable[str]) -> tuple[Sample, ...]:
    """Read the messages of some topics, in order.

    Raises:
        BagError: If the recording is damaged.
    """
    names = set(wanted)
    with _opened(path) as reader:
        connections = [one for one in reader.connections if one.topic in names]
        if not connections:
            return ()
        store = recorded_types(connections)
        nodes = {one.name: _only(one.nodes) for one in found.topics}
        made = tuple(
            Sample(
                stamp - found.origin_ns,
                one.topic,
                one.msgtype,
                nodes[one.topic],
                from_wire(store, one.msgtype, wire),
            )
            for one, stamp, wire in reader.messages(connections)
        )
        _check_count(len(made), sum(one.msgcount for one in connections))
        return made


def _check_count(found: int, told: int) -> None:
    """Notice messages that were lost; the library leaves out what does not agree with itself."""
    if found != told:
        raise ValueError(f"its metadata lists {told} messages, but the data contains {found}")


@contextmanager
def _opened(path: Path) -> Iterator[Reader]:
    if not path.exists() or (path.is_dir() and not (path / "metadata.yaml").is_file()):
        raise refusals.not_there(path)
    try:
        with _safe(path.absolute()) as safe, Reader(safe) as reader:
            yield reader
    except RosbeatError:
        raise
    except Exception as error:  # a damaged file may make the library stumble anywhere
        raise refusals.damaged(path, error) from error


@contextmanager
def _safe(path: Path) -> Iterator[Path]:
    """The same place by a path without the characters that SQLite takes for commands."""
    if not _COMMANDS.intersection(str(path)):
        yield path
        return
    with TemporaryDirectory(prefix="rosbeat-") as folder:
        link = Path(folder, "bag").with_suffix("" if path.is_dir() else path.suffix)
        link.symlink_to(path)
        yield link


def _storage(path: Path) -> str:
    files = path.iterdir() if path.is_dir() else [path]
    return "mcap" if any(".mcap" in file.suffixes for file in files) else "sqlite3"


def _topics(connections: Iterable[Connection], notes: Notes | None) -> tuple[Topic, ...]:
    topics: dict[str, Topic] = {}
    for one in connections:
        before = topics.get(one.topic, Topic(one.topic, one.msgtype, 0))
        topics[one.topic] = Topic(
            one.topic,
            before.type_name,
            before.count + one.msgcount,
            before.qos + _qos(one),
            notes.publishers.get(one.topic, ()) if notes else (),
        )
    return tuple(topics.values())


def _qos(connection: Connection) -> tuple[QoS, ...]:
    extra = connection.ext
    if not isinstance(extra, ConnectionExtRosbag2):
        return ()
    return tuple(qualities.read(one) for one in extra.offered_qos_profiles)


def _only(nodes: tuple[str, ...]) -> str:
    """The node that published, if there was only one."""
    return nodes[0] if len(nodes) == 1 else UNKNOWN
