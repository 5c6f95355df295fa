"""What happened, kept in columns while it happens and read back as records.

A message or a callback costs one number in each of three columns instead of an object of its own;
the objects of `rosbeat.records` are made when somebody asks.
"""

from __future__ import annotations

from array import array
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from threading import Lock
from typing import Any

from rosbeat.record_columns import records_of
from rosbeat.records import CallbackRecord, Fault, LogRecord, Sample
from rosbeat.runtime.messages import Memory

#: Records that are made at a time; whoever wants only the first ones does not pay for all.
_BATCH = 1_000


@dataclass(frozen=True)
class Channel:
    """Where messages come from: one publisher of one node.

    Attributes:
        number: Place in the recorder's list of channels.
        topic: Full topic name.
        type_name: Message type, such as `std_msgs/msg/Float32`.
        node: Full name of the publishing node.
        memory: Copies its messages.
    """

    number: int
    topic: str
    type_name: str
    node: str
    memory: Memory


@dataclass(frozen=True)
class CallbackLabel:
    """What all runs of one callback have in common; see `CallbackRecord` for the fields."""

    number: int
    node: str
    kind: str
    name: str
    source: str


@dataclass
class Recorder:
    """The memory of one session.

    Columns grow one after the other, so whoever appends from several threads holds `lock`: in live
    mode a node may publish from one thread while its callbacks run in another.

    Attributes:
        lock: For use in live mode.
        logs: Log lines so far.
        faults: Exceptions that left a callback so far.
    """

    logs: list[LogRecord] = field(default_factory=list)
    faults: list[Fault] = field(default_factory=list)
    lock: Lock = field(default_factory=Lock)
    _channels: list[Channel] = field(default_factory=list)
    _labels: list[CallbackLabel] = field(default_factory=list)
    _known: dict[tuple[str, ...], CallbackLabel] = field(default_factory=dict)
    _sample_times: array[int] = field(default_factory=lambda: array("q"))
    _sample_channels: array[int] = field(default_factory=lambda: array("I"))
    _sample_copies: list[Any] = field(default_factory=list)
    _callback_times: array[int] = field(default_factory=lambda: array("q"))
    _callback_labels: array[int] = field(default_factory=lambda: array("I"))

    def channel(self, topic: str, type_name: str, node: str, memory: Memory) -> Channel:
        """Register a publisher."""
        made = Channel(len(self._channels), topic, type_name, node, memory)
        self._channels.append(made)
        return made

    def rename(self, channel: Channel, node: str) -> Channel:
        """Put right who publishes there, for what has been recorded, too."""
        made = self._channels[channel.number] = replace(channel, node=node)
        return made

    def label(self, node: str, kind: str, name: str, source: str) -> CallbackLabel:
        """Register a callback; one of the same name in the same place is the same."""
        made = CallbackLabel(len(self._labels), node, kind, name, source)
        known = self._known.setdefault((node, kind, name, source), made)
        if known is made:
            self._labels.append(made)
        return known

    def sampler(self, channel: Channel) -> Callable[[int, Any], None]:
        """A function that remembers a message of one channel: `(time_ns, copy)`.

        What it needs is looked up once, here, and not a hundred thousand times a second.
        """
        add_time, add_copy = self._sample_times.append, self._sample_copies.append
        add_channel, number = self._sample_channels.append, channel.number

        def add(time_ns: int, copy: Any) -> None:  # noqa: ANN401
            add_time(time_ns)
            add_channel(number)
            add_copy(copy)

        return add

    def callback_columns(self) -> tuple[Callable[[int], None], Callable[[int], None]]:
        """What `add_callback` calls, for the executor, to whom each call counts."""
        return self._callback_times.append, self._callback_labels.append

    def add_callback(self, time_ns: int, label: int) -> None:
        """Remember that a callback ran."""
        self._callback_times.append(time_ns)
        self._callback_labels.append(label)

    def samples(self, topic: str | None = None) -> Iterator[Sample]:
        """Messages in order of publishing, of one topic or of all."""
        wanted = {c.number for c in self._channels if topic in (None, c.topic)}
        for part in _parts(len(self._sample_copies)):  # the column that grows last
            numbers = self._sample_channels[part]
            rows = [part.start + k for k, number in enumerate(numbers) if number in wanted]
            if rows:
                yield from self._samples_at(rows)

    def _samples_at(self, rows: list[int]) -> Iterable[Sample]:
        channels = [self._channels[self._sample_channels[k]] for k in rows]
        copies = [self._sample_copies[k] for k in rows]
        return records_of(
            Sample,
            [self._sample_times[k] for k in rows],
            [channel.topic for channel in channels],
            [channel.type_name for channel in channels],
            [channel.node for channel in channels],
            _all_plain(channels, copies),
        )

    @staticmethod
    def _sample(at: int, channel: Channel, copy: Any) -> Sample:  # noqa: ANN401
        data = channel.memory.plain(copy)
        return Sample(at, channel.topic, channel.type_name, channel.node, data)

    def callbacks(self) -> Iterator[CallbackRecord]:
        """Runs of callbacks in order."""
        for part in _parts(len(self._callback_labels)):
            labels = [self._labels[number] for number in self._callback_labels[part]]
            yield from records_of(
                CallbackRecord,
                self._callback_times[part],
                [label.node for label in labels],
                [label.kind for label in labels],
                [label.name for label in labels],
                [label.source for label in labels],
            )

    def since(self, mark: int) -> tuple[int, list[tuple[Channel, int, Sample]]]:
        """What has come since a mark: for each channel how many messages, and the newest.

        It costs about as much for one message as for a thousand, and another thread may record
        meanwhile.

        Returns:
            The mark for the next call; channel, count and newest message, in order of the newest.
        """
        end = len(self._sample_copies)  # the column that grows last
        numbers = self._sample_channels[mark:end]
        newest = {number: mark + k for k, number in enumerate(numbers)}
        counts = Counter(numbers)
        found = [
            (self._channels[number], counts[number], self._sample(*self._row(k)))
            for number, k in sorted(newest.items(), key=lambda item: item[1])
        ]
        return end, found

    def _row(self, k: int) -> tuple[int, Channel, Any]:
        channel = self._channels[self._sample_channels[k]]
        return self._sample_times[k], channel, self._sample_copies[k]

    def mark(self) -> int:
        """How many messages have been recorded so far."""
        return len(self._sample_times)

    def times(self, topic: str) -> list[tuple[int, str, int]]:
        """The messages of a topic: number among all, who published, and when in nanoseconds."""
        nodes = {one.number: one.node for one in self._channels if one.topic == topic}
        columns = zip(self._sample_channels, self._sample_times, strict=False)
        return [(k, nodes[n], at) for k, (n, at) in enumerate(columns) if n in nodes]

    def sent(self, channel: Channel) -> list[int]:
        """When each message of one publisher was published, in nanoseconds, in order."""
        columns = zip(self._sample_channels, self._sample_times, strict=False)
        return [at for number, at in columns if number == channel.number]

    def last_run(self, label: int) -> int:
        """When a callback ran last, in nanoseconds; -1 if never."""
        labels = self._callback_labels
        found = (k for k in range(len(labels) - 1, -1, -1) if labels[k] == label)
        return next((self._callback_times[k] for k in found), -1)

    def newest_callback(self) -> CallbackLabel | None:
        """The callback that began last."""
        return self._labels[self._callback_labels[-1]] if self._callback_labels else None

    def topics(self) -> set[str]:
        """Every topic that ever had a publisher."""
        return {channel.topic for channel in self._channels}


def _parts(count: int) -> Iterator[slice]:
    """So many rows in parts."""
    return (slice(k, min(k + _BATCH, count)) for k in range(0, count, _BATCH))


def _all_plain(channels: Sequence[Channel], copies: Sequence[Any]) -> list[dict[str, Any]]:
    """Messages as plain data: those of each channel together, in the order in which they came."""
    made: list[dict[str, Any]] = [{}] * len(copies)
    for channel in {one.number: one for one in channels}.values():
        places = [k for k, one in enumerate(channels) if one is channel]
        for k, data in zip(
            places, channel.memory.all_plain([copies[k] for k in places]), strict=True
        ):
            made[k] = data
    return made
