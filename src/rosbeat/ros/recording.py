"""How nodes are observed without being changed, and what is recorded of them.

Hooks around the methods of rclpy's `Node` tell a session of nodes and of what they make, taps
listen at publishers and clients, the logger of a node at what it logs, and the recorder keeps
all of it.
"""

from __future__ import annotations

import inspect
import os
import sys
from array import array
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cache, partial, wraps
from importlib import import_module
from importlib.util import module_from_spec
from math import isfinite
from operator import attrgetter
from struct import Struct
from threading import Lock
from types import CodeType, FrameType, ModuleType
from typing import TYPE_CHECKING, Any, Protocol

from rclpy.client import Client
from rclpy.clock import Clock
from rclpy.context import Context
from rclpy.duration import Duration
from rclpy.exceptions import InvalidHandle, NotInitializedException
from rclpy.impl import rcutils_logger
from rclpy.impl.implementation_singleton import rclpy_implementation
from rclpy.impl.rcutils_logger import RcutilsLogger
from rclpy.logging import LoggingSeverity
from rclpy.node import Node
from rclpy.publisher import Publisher
from rclpy.qos import (
    DurabilityPolicy,
    HistoryPolicy,
    QoSCompatibility,
    QoSProfile,
    ReliabilityPolicy,
    qos_check_compatible,
)
from rclpy.serialization import deserialize_message, serialize_message
from rclpy.timer import Rate, Timer

from rosbeat.errors import NoSessionError, SessionError
from rosbeat.record_columns import records_of
from rosbeat.records import CallbackRecord, Fault, LogRecord, Sample
from rosbeat.ros.faults import asking, is_message_class
from rosbeat.ros.qos_events import as_written, limit_ns, stretched

if TYPE_CHECKING:
    from rosbeat.ros.launch import Launch


# Messages as plain data, and a cheap way to remember them.
#
# A node may change a message object after publishing it, so what is recorded must be a copy. For a
# message whose fields are all numbers, bools and strings the copy is the tuple of its values, which
# are immutable; that costs a tenth of a microsecond. For any other message it is the serialized
# bytes, which is what crosses the wire.


_FLOAT = Struct("<f")


class _UnsureError(Exception):
    """What the wire makes of a value is not known here."""


def _of(kind: type) -> Callable[[Any], Any]:
    def same(value: Any) -> Any:  # noqa: ANN401
        if type(value) is kind:
            return value
        raise _UnsureError

    return same


def _float32(value: Any) -> float:  # noqa: ANN401
    if type(value) is not float:
        raise _UnsureError
    try:
        rounded: float = _FLOAT.unpack(_FLOAT.pack(value))[0]
    except OverflowError as error:
        raise _UnsureError from error
    return rounded


def _string(value: Any) -> str:  # noqa: ANN401
    # Of other characters, the wire ends at a zero and refuses half of a pair.
    if type(value) is str and value.isascii() and "\0" not in value:
        return value
    raise _UnsureError


def _integer(bits: int, signed: bool) -> Callable[[Any], int]:
    low = -(1 << bits - 1) if signed else 0
    high = low + (1 << bits)

    def within(value: Any) -> int:  # noqa: ANN401
        if type(value) is int and low <= value < high:
            return value
        raise _UnsureError

    return within


def _unsure(_: Any) -> Any:  # noqa: ANN401
    raise _UnsureError


#: What arrives of a value, by the type of its field, where that needs no wire to say it: a hundred
#: times as fast as serializing a message and reading it back.
_ARRIVING: dict[str, Callable[[Any], Any]] = {
    "boolean": _of(bool),
    "octet": _unsure,
    "float": _float32,
    "double": _of(float),
    "string": _string,
    **{f"int{bits}": _integer(bits, signed=True) for bits in (8, 16, 32, 64)},
    **{f"uint{bits}": _integer(bits, signed=False) for bits in (8, 16, 32, 64)},
}


def type_name(message_type: type) -> str:
    """The type's ROS name, such as `std_msgs/msg/Float32`, from its Python class."""
    package, kind = message_type.__module__.split(".")[:2]
    return f"{package}/{kind}/{message_type.__name__}"


def plain(value: Any) -> Any:  # noqa: ANN401 - a field may hold anything a message can
    """A message or field value as dicts, lists, numbers and strings.

    Arrays of any kind and byte strings become lists of numbers.
    """
    if hasattr(value, "get_fields_and_field_types"):
        return {name: plain(getattr(value, name)) for name in value.get_fields_and_field_types()}
    if isinstance(value, bool | int | float | str):
        return value
    if hasattr(value, "tolist"):  # NumPy arrays of fixed-size fields, array.array of the others
        return value.tolist()
    return [plain(item) for item in value]


class Memory:
    """Copies messages of one type and gives them back.

    Args:
        message_type: The message class.

    Attributes:
        take: Makes the copy of a message; the copy is opaque, small and immutable.
    """

    def __init__(self, message_type: type) -> None:
        self._type = message_type
        fields = message_type.get_fields_and_field_types()  # type: ignore[attr-defined]
        self._names = list(fields)
        self._flat = bool(fields) and _ARRIVING.keys() >= set(fields.values())
        self._arriving = [_ARRIVING[kind] for kind in fields.values()] if self._flat else []
        self._is_one_float = self._arriving == [_float32]
        # The slots behind the properties (`_data` for `data`) are read ten times as fast.
        slots = [f"_{name}" for name in fields]
        self.take: Callable[[Any], Any] = attrgetter(*slots) if self._flat else serialize_message

    def plain(self, copy: Any) -> dict[str, Any]:  # noqa: ANN401
        """The copied message as plain data, with the rounding that the wire does."""
        if self._flat and not isinstance(copy, Raw):
            try:
                return self._arrived(copy)
            except _UnsureError:
                pass  # the wire itself tells
        wire = copy if isinstance(copy, bytes) and not self._flat else self._serialized(copy)
        data: dict[str, Any] = plain(deserialize_message(wire, self._type))
        return data

    def all_plain(self, copies: Sequence[Any]) -> list[dict[str, Any]]:
        """Many copied messages as plain data."""
        if self._is_one_float and set(map(type, copies)) == {float}:
            name, values = self._names[0], array("f", copies).tolist()
            if all(map(isfinite, values)):  # too large a number becomes none, without a word
                return [{name: value} for value in values]
        return list(map(self.plain, copies))

    def _arrived(self, copy: Any) -> dict[str, Any]:  # noqa: ANN401
        if len(self._names) == 1:  # nearly every message of the course
            return {self._names[0]: self._arriving[0](copy)}
        columns = zip(self._names, self._arriving, copy, strict=True)
        return {name: arriving(value) for name, arriving, value in columns}

    def _serialized(self, copy: Any) -> bytes:  # noqa: ANN401
        if isinstance(copy, Raw):
            return copy.data
        values = copy if len(self._names) > 1 else (copy,)
        message = self._type(**dict(zip(self._names, values, strict=True)))
        wire: bytes = serialize_message(message)
        return wire


class Raw:
    """The copy of a message that was published as serialized bytes."""

    __slots__ = ("data",)

    def __init__(self, data: bytes) -> None:
        self.data = data


def message_class(type_name: str) -> type:
    """The Python class of a message type.

    Args:
        type_name: The type's ROS name, such as `std_msgs/msg/Float32`.

    Raises:
        ModuleNotFoundError, AttributeError: If no installed package has it.
    """
    package, kind, name = type_name.split("/")
    found: type = getattr(import_module(f"{package}.{kind}"), name)
    return found


# What happened, kept in columns while it happens and read back as records.
#
# A message or a callback costs one number in each of three columns instead of an object of its own;
# the objects of `rosbeat.records` are made when somebody asks.


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


# Message classes that a learner's code has written into, made whole again.
#
# `msg = Float32` without brackets, and then `msg.data = 25.0`, replaces the field of the class
# itself. From then on no message of that type can be made in the whole kernel: `Float32()` raises,
# in every node. The class is mended as soon as an exception shows that something is wrong, so that
# a cell that is put right runs at once.


def mend_message_classes() -> list[str]:
    """Give every message class that was written into its fields back.

    Returns:
        The names of the classes that were broken, such as `Float32`.
    """
    broken = _message_fields.changed()
    for (kind, module), fields in broken.items():
        whole = getattr(_loaded_anew(module), kind.__name__)
        for name in fields:
            setattr(kind, name, vars(whole)[name])
    if broken:
        _message_fields.forget()  # the fields are other objects now
    return [kind.__name__ for kind, _ in broken]


class _MessageFields:
    """The fields of all message classes that are loaded, as they were when first looked at.

    A session begins with a look at all of them, so they are listed once, and again when message
    modules have come or gone.
    """

    def __init__(self) -> None:
        self._modules = 0
        self._fields: list[tuple[type, ModuleType, Mapping[str, Any], str, object]] = []

    def changed(self) -> dict[tuple[type, ModuleType], list[str]]:
        """Return the fields that were written into, by class and its module."""
        # The generated modules are `std_msgs.msg._float32` and the like.
        count = sum(".msg._" in name for name in list(sys.modules))
        if count != self._modules:
            self._modules, self._fields = count, list(_fields_of_messages())
        found: dict[tuple[type, ModuleType], list[str]] = {}
        for kind, module, space, name, known in self._fields:
            if space.get(name) is not known:
                found.setdefault((kind, module), []).append(name)
        return found

    def forget(self) -> None:
        """List the fields anew at the next look."""
        self._modules = 0


_message_fields = _MessageFields()


def _fields_of_messages() -> Iterator[tuple[type, ModuleType, Mapping[str, Any], str, object]]:
    modules = [module for name, module in list(sys.modules.items()) if ".msg._" in name]
    for module in modules:
        for kind in _made_in(module):
            space = vars(kind)
            for name in space["_fields_and_field_types"]:
                found = space.get(name)
                # A field that is broken already is none that could be found there again.
                yield kind, module, space, name, found if type(found) is property else object()


@cache
def _made_in(module: ModuleType) -> tuple[type, ...]:
    """The message classes of a generated module, which get no more; looked for once."""
    return tuple(kind for kind in vars(module).values() if _is_made_there(kind, module.__name__))


def _is_made_there(kind: object, module: str) -> bool:
    return (
        isinstance(kind, type)
        and "_fields_and_field_types" in vars(kind)
        and (kind.__module__ == module)
    )


def _loaded_anew(module: ModuleType) -> ModuleType:
    spec = module.__spec__
    if spec is None or spec.loader is None:
        return module
    fresh = module_from_spec(spec)
    spec.loader.exec_module(fresh)
    return fresh


# Listening to what a node sends, at its own publishers and clients.
#
# A recording subscription would cost a second delivery of every message, could not tell who
# published and would show in the graph. A tap is put on the object that the node itself calls.


# Fast DDS hands stored messages to reliable subscriptions only. By its own default, a subscription
# is neither that nor transient-local. A test tries all combinations.
_ASK_FOR_STORED = {DurabilityPolicy.TRANSIENT_LOCAL, DurabilityPolicy.BEST_AVAILABLE}
_ASK_AGAIN = {ReliabilityPolicy.RELIABLE, ReliabilityPolicy.BEST_AVAILABLE}
_AT_ONCE = Duration()._duration_handle


class PublisherTap:
    """Listens to one publisher.

    Args:
        publisher: The publisher; its `publish` is replaced by one that also tells `heard`.
        memory: Copies its messages.
        heard: Called with the copy after each message that was really published.

    Attributes:
        topic: Full topic name.
        count: Messages published so far.
        channel: Where its messages are recorded; None if they are not.
        lifespan_ns: How long it stores a message; 0 without a limit.
    """

    def __init__(self, publisher: Publisher, memory: Memory, heard: Callable[[Any], None]) -> None:
        self.topic: str = publisher.topic_name
        self.count = 0
        self.channel: Channel | None = None
        self._handle = handle = publisher.handle
        self._qos: QoSProfile = publisher.qos_profile
        self._type = publisher.msg_type
        self.lifespan_ns = limit_ns(self._qos.lifespan)
        send, take, message_type = publisher.publish, memory.take, publisher.msg_type
        # What rclpy's own `publish` does for a message; going through it costs a message's tenth.
        send_message = handle.publish

        def publish(msg: Any) -> None:  # noqa: ANN401 - a message of any type, or its bytes
            if isinstance(msg, message_type):
                with handle:
                    send_message(msg)
                copy = take(msg)
            else:
                with asking("publish", msg):
                    if isinstance(msg, bytes):
                        # Bytes that are no message would only fail where they arrive.
                        deserialize_message(msg, message_type)
                    send(msg)  # bytes; or anything else, which rclpy refuses in its own words
                copy = Raw(msg)
            self.count += 1
            heard(copy)

        publish.__qualname__ = send.__qualname__  # for the errors of a call with other arguments
        publisher.publish = publish

        def listen(further: Callable[[], None]) -> None:
            nonlocal heard
            before = heard

            def both(copy: Any) -> None:  # noqa: ANN401
                before(copy)
                further()

            heard = both

        self._listen = listen

    def listen(self, further: Callable[[], None]) -> None:
        """Call this, too, after each message; it costs nothing as long as nobody asks for it."""
        self._listen(further)

    def fits(self, subscription: Any) -> bool:  # noqa: ANN401 - rclpy is untyped
        """Whether a subscription of this topic is connected to this publisher."""
        return self._type is subscription.msg_type and self._offers(subscription.qos_profile)

    @property
    def stored(self) -> int:
        """How many messages are stored at most: some may have expired."""
        depth: int = self._qos.depth
        limited = self._qos.history == HistoryPolicy.KEEP_LAST
        return min(self.count, max(1, depth)) if limited else self.count

    def stores_for(self, qos: QoSProfile) -> bool:
        """Whether a new subscription of this QoS gets stored messages from this publisher."""
        own = self._qos
        if not self.count or own.durability == DurabilityPolicy.VOLATILE:
            return False
        if qos.durability not in _ASK_FOR_STORED or qos.reliability not in _ASK_AGAIN:
            return False
        if own.reliability == ReliabilityPolicy.BEST_EFFORT:
            return False
        return self._is_alive() and self._offers(qos)

    def has_delivered(self) -> bool:
        """Whether each of its subscriptions has all that it is to get, as far as is known now."""
        try:
            with self._handle:
                return bool(self._handle.wait_for_all_acked(_AT_ONCE))
        except InvalidHandle:  # destroyed by another thread: nothing more will come
            return True

    def _offers(self, qos: QoSProfile) -> bool:
        compatible, _ = qos_check_compatible(self._qos, qos)
        return bool(compatible != QoSCompatibility.ERROR)

    def _is_alive(self) -> bool:
        try:
            with self._handle:
                return True
        except InvalidHandle:  # destroyed, and what it had stored with it
            return False


def tap_timer(timer: Timer, moved: Callable[[], None]) -> None:
    """Listen to one timer: `moved` is called after each `reset`, which changes its deadline."""
    original = timer.reset

    def reset() -> None:
        original()
        moved()

    timer.reset = reset


def tap_rate(rate: Rate, sleep: Callable[[Callable[[], None]], None]) -> None:
    """Let `sleep` decide how one rate sleeps; it is given rate's own way."""
    original = rate.sleep
    rate.sleep = lambda: sleep(original)


def tap_client(
    client: Client,
    check: Callable[[], None],
    asked: Callable[[], None],
    wait_for: Callable[[Any, float | None], Any],
) -> None:
    """Listen to one service client.

    Args:
        client: The client; its `call_async` and `call` are replaced.
        check: Called before `call` begins; raises where it would wait for ever.
        asked: Called after each request.
        wait_for: Runs the nodes until a future is done and returns its result; used by `call`,
            which would otherwise wait for an answer that nobody is running to give.
    """
    send = client.call_async

    def call_async(request: Any) -> Any:  # noqa: ANN401
        future = send(request)
        asked()
        return future

    def call(request: Any, timeout_sec: float | None = None) -> Any:  # noqa: ANN401
        check()
        return wait_for(call_async(request), timeout_sec)

    client.call_async = call_async
    client.call = call


# The logger that a node of a session gets.
#
# rclpy hands each log line to rcl, which prints it and publishes it on `/rosout`. rcl keeps one
# `/rosout` publisher for each logger name *in the whole process*: a second node of the same name,
# in whatever session, logs through the first one's publisher, and falls silent when that is
# destroyed (rcl, logging_rosout.c). A session that listened on `/rosout` would hear its neighbours,
# so lines are taken one step earlier, from the node's own logger, and go on to `/rosout` as ever.


#: level, logger name, text, function, line
Listener = Callable[[str, str, str, str, int], None]

_THIS_FILE = os.path.realpath(__file__)
_OWN_FILES = (_THIS_FILE, os.path.realpath(rcutils_logger.__file__))

# rclpy names the caller of a log line by skipping the files in this list; ours is one of them.
rcutils_logger._internal_callers.append(_THIS_FILE)


def _caller() -> FrameType:
    frame = sys._getframe(2)
    while frame.f_back and frame.f_code.co_filename in _OWN_FILES:
        frame = frame.f_back
    return frame


class SessionLogger(RcutilsLogger):
    """A logger that also tells its session.

    The first call from each place goes through rclpy, which checks it and remembers the place.
    Later calls from there with the same level and no filter are handed to rcl directly, with the
    same arguments: rclpy would look its caller up in the source files each time, which takes
    twenty times as long as all the rest (measured: 230 of 240 microseconds).

    Args:
        name: The logger's name.
        listener: Called with every line that was really logged.
        clock: The session's clock; `throttle_duration_sec` counts its seconds.
    """

    def __init__(self, name: str, listener: Listener, clock: Clock) -> None:
        super().__init__(name)
        self._listener = listener
        self._clock = clock
        self._places: dict[tuple[CodeType, int], LoggingSeverity] = {}

    def get_child(self, name: str) -> SessionLogger:
        """A logger below this one, heard by the same session."""
        child = super().get_child(name)
        made = SessionLogger(child.name, self._listener, self._clock)
        # rclpy removes the child's /rosout publisher by this pair of names.
        made.logger_sublogger_namepair = child.logger_sublogger_namepair
        child.logger_sublogger_namepair = None
        return made

    def log(self, message: str, severity: LoggingSeverity, **options: Any) -> bool:  # noqa: ANN401
        """Log a line; see `rclpy`. Returns whether it was logged."""
        frame = _caller()
        place = (frame.f_code, frame.f_lasti)
        known = not options and self._places.get(place) == severity
        if not (self._repeat(message, severity, frame) if known else self._first(
            message, severity, frame, options
        )):  # fmt: skip
            return False
        self._places[place] = severity
        level, name = LoggingSeverity(severity).name, str(options.get("name", self.name))
        self._listener(level, name, str(message), frame.f_code.co_name, frame.f_lineno)
        return True

    def _first(
        self, message: str, severity: LoggingSeverity, frame: FrameType, options: dict[str, Any]
    ) -> bool:
        if "throttle_duration_sec" in options:
            options.setdefault("throttle_time_source_type", self._clock)
        # rclpy looks for its caller's module, and would ask each of a thousand: a cell has none.
        module = str(frame.f_globals.get("__name__", ""))
        inspect.modulesbyfile.setdefault(frame.f_code.co_filename, module)
        return bool(super().log(message, severity, **options))

    def _repeat(self, message: str, severity: LoggingSeverity, frame: FrameType) -> bool:
        if not self.is_enabled_for(severity):
            return False
        code = frame.f_code
        rclpy_implementation.rclpy_logging_rcutils_log(
            severity, self.name, message, code.co_name, code.co_filename, frame.f_lineno
        )
        return True


# How a session learns of nodes, without the nodes being changed.
#
# rclpy offers no place to be told that a node, a publisher or a timer was made. The methods of
# `Node` that make them are therefore wrapped once, when this module is first imported. A wrapper
# looks at the node's own context: if that belongs to a session, the session's watcher is told; if
# not, the original runs and nothing else happens. Nothing is kept here, so there is nothing to
# share.


ENTITY_METHODS = {
    "create_publisher": "publisher",
    "create_subscription": "subscription",
    "create_timer": "timer",
    "create_service": "service",
    "create_client": "client",
    "create_rate": "rate",
}


class Watcher(Protocol):
    """What a session does when its nodes change."""

    start: Launch

    @property
    def counts_limits(self) -> bool:
        """Whether the session, and not the middleware, counts deadlines and lifespans."""

    def node_begins(self, name: str, namespace: str) -> None:
        """A node of this name is about to be made."""

    def node_made(self, node: Node) -> None:
        """`Node.__init__` has returned."""

    def entity_begins(self, node: Node) -> None:
        """The node is about to make an entity."""

    def entity_made(self, node: Node, kind: str, entity: Any) -> None:  # noqa: ANN401
        """The node has made an entity of that kind."""

    def action_made(
        self,
        node: Node,
        kind: str,
        entity: Any,  # noqa: ANN401
        name: str,
        options: dict[str, Any],
    ) -> None:
        """The node has made an action server or client; see `actions`."""

    def node_ends(self, node: Node) -> None:
        """The node is about to be destroyed."""

    def logger_of(self, node: Node, original: Any) -> Any:  # noqa: ANN401
        """The logger that the node's code gets."""

    def explain_init(self) -> None:
        """The learner called `rclpy.init()`."""

    def explain_shutdown(self) -> None:
        """The learner called `rclpy.shutdown()`."""


class Unwatched:
    """Mixed into a node that is part of the session itself, so that its watcher is not told."""


def watcher_of(node: Node) -> Watcher | None:
    """The watcher of a node's session, or None if it is in no session or not yet a node."""
    if isinstance(node, Unwatched):
        return None
    # Not `node.context`: a class that forgot super().__init__() must fail with rclpy's own error.
    return getattr(node.__dict__.get("_context"), "watcher", None)


def _watch_birth(original: Callable[..., None]) -> Callable[..., None]:
    @wraps(original)
    def init(node: Node, *args: Any, **kwargs: Any) -> None:  # noqa: ANN401
        context: Any = kwargs.get("context") or _default_context()
        watcher = getattr(context, "watcher", None)
        name = kwargs.get("node_name", args[0] if args else None)
        with asking("Node.__init__", node, *args, **kwargs):
            if watcher is None or not isinstance(name, str) or isinstance(node, Unwatched):
                _make_alone(partial(original, node, *args, **kwargs))
                return
            start, said = watcher.start, list(kwargs.get("cli_args") or ())
            if hasattr(context, "home") and context.ok():  # a program's: see `ProgramContext`
                kwargs["context"] = context.home
                said += context.ros_arguments
            kwargs["cli_args"] = [*said, *start.arguments()] or None
            namespace = start.namespace or kwargs.get("namespace") or "/"
            watcher.node_begins(start.name or name, namespace)
            original(node, *args, **kwargs)
        watcher.node_made(node)

    return init


def _make_alone(make: Callable[[], None]) -> None:
    try:
        make()
    except NotInitializedException:
        if not in_kernel():
            raise
        raise NoSessionError(
            "A node was made, and no session is open.",
            "A node needs ROS to be running. On a page a session starts it, and the last session "
            "has been closed.",
            "Run the cell with `Session()` again; or call `rclpy.init()` first, as a program does. "
            "In a check, hand over the class itself, without brackets.",
        ) from None


def in_kernel() -> bool:
    """Whether this process is a Jupyter kernel."""
    return "ipykernel.kernelapp" in sys.modules


def _default_context() -> Context:
    from rclpy.utilities import get_default_context

    return get_default_context()


def _watch_entity(original: Callable[..., Any], kind: str) -> Callable[..., Any]:
    @wraps(original)
    def create(node: Node, *args: Any, **kwargs: Any) -> Any:  # noqa: ANN401
        watcher = watcher_of(node)
        with asking(original.__name__, *args, **kwargs):
            if watcher is None:
                return original(node, *args, **kwargs)
            _refuse_a_message(original.__name__, kwargs.get("msg_type", args[0] if args else None))
            watcher.entity_begins(node)
            if watcher.counts_limits:
                with stretched(kind, args, kwargs) as (longer, named):
                    entity = original(node, *longer, **named)
            else:
                entity = original(node, *args, **kwargs)
        watcher.entity_made(node, kind, entity)
        return entity

    return create


def _refuse_a_message(call: str, kind: object) -> None:
    """A message in the place of its class: rclpy takes it, and fails at the first use."""
    if not isinstance(kind, type) and is_message_class(type(kind)):
        name = type(kind).__name__
        raise SessionError(
            f"{call} was given a message of type {name}, and not the class {name}.",
            "rclpy notices nothing yet, and fails when the first message is to be sent.",
            "Hand over the class itself: nothing is sent at this line.",
        )


def _watch_end(original: Callable[[Node], None]) -> Callable[[Node], None]:
    @wraps(original)
    def destroy_node(node: Node) -> None:
        watcher = watcher_of(node)
        if watcher is not None:
            watcher.node_ends(node)
        original(node)

    return destroy_node


def _watch_logger(original: Callable[[Node], Any]) -> Callable[[Node], Any]:
    @wraps(original)
    def get_logger(node: Node) -> Any:  # noqa: ANN401
        watcher = watcher_of(node)
        return original(node) if watcher is None else watcher.logger_of(node, original(node))

    return get_logger


def _watch_infos(original: Callable[..., list[Any]]) -> Callable[..., list[Any]]:
    @wraps(original)
    def infos(node: Node, *args: Any, **kwargs: Any) -> list[Any]:  # noqa: ANN401
        told = original(node, *args, **kwargs)
        return told if watcher_of(node) is None else as_written(told)

    return infos


def _install() -> None:
    Node.__init__ = _watch_birth(Node.__init__)
    Node.destroy_node = _watch_end(Node.destroy_node)
    Node.get_logger = _watch_logger(Node.get_logger)
    Node._get_info_by_topic = _watch_infos(Node._get_info_by_topic)
    for method, kind in ENTITY_METHODS.items():
        setattr(Node, method, _watch_entity(getattr(Node, method), kind))


_install()  # at import, so exactly once in a process


# The C part of message types, loaded ahead of the first node that needs it.


def load_type_support(types: Iterable[str]) -> None:
    """Load the C part of message types, which rclpy does when the first publisher is made.

    Args:
        types: Names such as `std_msgs/msg/Float32`.
    """
    for name in types:
        meta: Any = type(message_class(name))
        meta.__import_type_support__()
