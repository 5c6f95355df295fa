"""Observe nodes without changing them, and record what happens.

Hooks around the methods of rclpy's `Node` report new nodes and entities to the session. Taps
intercept publishers and clients; `logs` receives the log lines. The recorder stores all of it.
"""

from __future__ import annotations

import inspect
import sys
from array import array
from collections import Counter
from collections.abc import Callable, Iterable, Iterator
from contextlib import suppress
from dataclasses import dataclass, field
from functools import cache, partial, wraps
from importlib import import_module
from importlib.util import module_from_spec
from itertools import takewhile
from operator import attrgetter
from threading import Lock
from time import monotonic
from types import ModuleType
from typing import TYPE_CHECKING, Any, TypeAlias

from rclpy.duration import Duration
from rclpy.event_handler import EventHandler
from rclpy.exceptions import (
    InvalidHandle,
    InvalidTopicNameException,
    NotInitializedException,
)
from rclpy.impl.implementation_singleton import rclpy_implementation
from rclpy.impl.rcutils_logger import RcutilsLogger
from rclpy.node import Node
from rclpy.publisher import Publisher
from rclpy.qos import (
    DurabilityPolicy,
    HistoryPolicy,
    QoSProfile,
    ReliabilityPolicy,
)
from rclpy.serialization import deserialize_message, serialize_message
from rclpy.utilities import get_default_context
from rclpy.validate_node_name import validate_node_name

from rosbeat.errors import NoSessionError, SessionError
from rosbeat.records import CallbackRecord, Fault, LogRecord, Sample
from rosbeat.ros.arguments import node_arguments, ros_arguments
from rosbeat.ros.exception_origin import asking, is_message_class
from rosbeat.ros.qos_events import as_written, fit, is_alive, limit_ns, make_stretched

if TYPE_CHECKING:
    from rosbeat.ros.ports import AllPorts

#: What rclpy hands over without a base class or types: the messages, requests, responses, goals and
#: results of generated classes, and the entities of a node, such as publishers, timers and clients.
Message: TypeAlias = Any
Entity: TypeAlias = Any

# Messages as plain data.
#
# A node may change a message object after publishing it, so what is recorded must be a copy. Of a
# message whose fields are all numbers, bools and strings the copy is their values; of any other one
# it is the serialized bytes, which would cost all of them a quarter more (12.6 us and not 10.0,
# published in bursts) and sixteen times as much to read back (4.5 us and not 0.3).


#: How a field arrives, by its type; of all other types only the wire itself can tell.
_ARRIVING: dict[str, Callable[[Any], Any]] = {
    "boolean": bool,
    "float": lambda value: array("f", (value,))[0],
    "double": float,
    "string": lambda value: value.partition("\0")[0],  # as in C
    **{f"{sign}int{bits}": int for sign in ("", "u") for bits in (8, 16, 32, 64)},
}


def type_name(message_type: type) -> str:
    """Return the type's ROS name, such as `std_msgs/msg/Float32`, from its Python class."""
    package, kind = message_type.__module__.split(".")[:2]
    return f"{package}/{kind}/{message_type.__name__}"


def message_class(type_name: str) -> type:
    """Return the Python class of a message type, such as `std_msgs/msg/Float32`.

    Raises:
        ModuleNotFoundError, AttributeError: If no installed package has it.
    """
    package, kind, name = type_name.split("/")
    found: type = getattr(import_module(f"{package}.{kind}"), name)
    return found


def load_type_support(types: Iterable[str]) -> None:
    """Load the C part of message types, which rclpy does when the first publisher is made."""
    for name in types:
        meta: Any = type(message_class(name))
        meta.__import_type_support__()


def plain(value: Any) -> Any:  # noqa: ANN401 - a field may hold anything a message can
    """Return a message or field value as dicts, lists, numbers and strings.

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
    """Copy messages of one type, and restore them.

    `take` makes the copy, which is small and immutable: a tuple of fields, or the bytes of the
    serialized message.
    """

    def __init__(self, message_type: type) -> None:
        self._type, self.type_name = message_type, type_name(message_type)
        fields = message_type.get_fields_and_field_types()  # type: ignore[attr-defined]  # every message class has it
        flat = bool(fields) and _ARRIVING.keys() >= set(fields.values())
        self._fields = [(name, _ARRIVING[kind]) for name, kind in fields.items() if flat]
        self.take: Callable[[Any], Any] = attrgetter(*fields) if flat else serialize_message

    def plain(self, copy: Any) -> dict[str, Any]:  # noqa: ANN401 - what `take` makes
        """Return the copied message as plain data, with the rounding that the wire does."""
        if isinstance(copy, bytes):
            data: dict[str, Any] = plain(deserialize_message(copy, self._type))
            return data
        if len(self._fields) == 1:  # nearly every message of the course
            ((name, arriving),) = self._fields
            return {name: arriving(copy)}
        fields = zip(self._fields, copy, strict=True)
        return {name: arriving(value) for (name, arriving), value in fields}


# What happened, kept in columns while it happens and read back as records.
#
# A message or a callback costs one number in each of three columns instead of an object of its own:
# 46 bytes for a message of one number (tests/benchmarks/memory.py).


@dataclass(frozen=True)
class Channel:
    """Identify the source of messages: one publisher of one node; see `Sample` for the fields."""

    number: int
    topic: str
    node: str
    memory: Memory


@dataclass(frozen=True)
class CallbackLabel:
    """Hold what all runs of one callback have in common; see `CallbackRecord` for the fields."""

    number: int
    node: str
    kind: str
    name: str
    source: str


@dataclass
class Recorder:
    """Record what happens in one session.

    Columns grow one after the other, so whoever appends from several threads holds `lock`: in live
    mode a node may publish from one thread while its callbacks run in another.

    Attributes:
        began: When the last callback began, by the monotonic clock, in seconds.
    """

    began: float = 0.0

    logs: list[LogRecord] = field(default_factory=list)
    faults: list[Fault] = field(default_factory=list)
    lock: Lock = field(default_factory=Lock)
    _channels: list[Channel] = field(default_factory=list)
    _labels: dict[tuple[str, ...], CallbackLabel] = field(default_factory=dict)
    _sample_times: array[int] = field(default_factory=lambda: array("q"))
    _sample_channels: array[int] = field(default_factory=lambda: array("I"))
    _sample_copies: list[Any] = field(default_factory=list)  # grows last
    _callback_times: array[int] = field(default_factory=lambda: array("q"))
    _callback_labels: array[int] = field(default_factory=lambda: array("I"))

    def channel(self, topic: str, node: str, memory: Memory) -> Channel:
        """Register a publisher."""
        made = Channel(len(self._channels), topic, node, memory)
        self._channels.append(made)
        return made

    def label(self, node: str, kind: str, name: str, source: str) -> CallbackLabel:
        """Register a callback; one of the same name in the same place is the same."""
        made = CallbackLabel(len(self._labels), node, kind, name, source)
        return self._labels.setdefault((node, kind, name, source), made)

    def add_sample(self, channel: int, time_ns: int, copy: Any) -> None:  # noqa: ANN401 - what `Memory.take` makes
        """Record a message that was published on the channel of this number."""
        self._sample_times.append(time_ns)
        self._sample_channels.append(channel)
        self._sample_copies.append(copy)

    def add_callback(self, time_ns: int, label: int) -> None:
        """Record that a callback ran."""
        self._callback_times.append(time_ns)
        self._callback_labels.append(label)
        self.began = monotonic()

    def calls(self) -> int:
        """Return how many callbacks have begun so far."""
        return len(self._callback_times)

    def samples(self, topic: str | None = None) -> Iterator[Sample]:
        """Return messages in order of publishing, of one topic or of all."""
        for k in range(len(self._sample_copies)):
            channel = self._channels[self._sample_channels[k]]
            if topic is None or topic == channel.topic:
                yield self._sample(k, channel)

    def _sample(self, k: int, channel: Channel) -> Sample:
        data = channel.memory.plain(self._sample_copies[k])
        at = self._sample_times[k]
        return Sample(at, channel.topic, channel.memory.type_name, channel.node, data)

    def callbacks(self) -> Iterator[CallbackRecord]:
        """Return runs of callbacks in order."""
        labels = list(self._labels.values())
        rows = zip(self._callback_times, self._callback_labels, strict=False)
        for (at, number), _ in zip(rows, range(len(self._callback_labels)), strict=False):
            label = labels[number]
            yield CallbackRecord(at, label.node, label.kind, label.name, label.source)

    def since(self, mark: int) -> tuple[int, list[tuple[Channel, int, Sample]]]:
        """Return what has come since a mark: for each channel how many messages, and the newest.

        It costs about as much for one message as for a thousand, and another thread may record
        meanwhile.

        Returns:
            The mark for the next call; channel, count and newest message, in order of the newest.
        """
        end = len(self._sample_copies)
        numbers = self._sample_channels[mark:end]
        newest = {number: mark + k for k, number in enumerate(numbers)}
        counts = Counter(numbers)
        found = []
        for number, k in sorted(newest.items(), key=lambda item: item[1]):
            channel = self._channels[number]
            found.append((channel, counts[number], self._sample(k, channel)))
        return end, found

    def mark(self) -> int:
        """Return how many messages have been recorded so far."""
        return len(self._sample_times)

    def times(self, topic: str) -> list[tuple[int, str, int]]:
        """Return a topic's messages: number among all, who published, and when in nanoseconds."""
        nodes = {one.number: one.node for one in self._channels if one.topic == topic}
        columns = zip(self._sample_channels, self._sample_times, strict=False)
        return [(k, nodes[n], at) for k, (n, at) in enumerate(columns) if n in nodes]

    def last_run(self, label: int) -> int:
        """Return when a callback ran last, in nanoseconds; -1 if never."""
        rows = zip(reversed(self._callback_labels), reversed(self._callback_times), strict=False)
        return next((at for number, at in rows if number == label), -1)

    def runs(self, label: int, since_ns: int, until_ns: int) -> int:
        """Return how often a callback has begun from one time on and before another."""
        rows = zip(reversed(self._callback_times), reversed(self._callback_labels), strict=False)
        recent = takewhile(lambda row: row[0] >= since_ns, rows)
        return sum(number == label and at < until_ns for at, number in recent)

    def newest_callback(self) -> CallbackLabel | None:
        """Return the callback that began last."""
        labels = list(self._labels.values())
        return labels[self._callback_labels[-1]] if self._callback_labels else None

    def topics(self) -> set[str]:
        """Return every topic that ever had a publisher."""
        return {channel.topic for channel in self._channels}


# Message classes that a learner's code has written into.
#
# `msg = Float32` without brackets, and then `msg.data = 25.0`, replaces the field of the class
# itself: from then on `Float32()` raises in every node of the kernel. The class is repaired as soon
# as an exception shows that something is wrong, so that a cell that is put right runs at once.


def repair_message_classes() -> list[str]:
    """Give message classes the fields back that were overwritten; return the classes' names."""
    repaired = []
    # The generated modules are `std_msgs.msg._float32` and the like. A copy: other threads import.
    modules = [module for name, module in sys.modules.copy().items() if ".msg._" in name]
    for kind in (kind for module in modules for kind in _classes_of(module)):
        space = vars(kind)
        fields = space["_fields_and_field_types"]
        broken = [name for name in fields if type(space.get(name)) is not property]
        if broken:
            spec: Any = sys.modules[kind.__module__].__spec__
            fresh = module_from_spec(spec)
            spec.loader.exec_module(fresh)
            for name in broken:
                setattr(kind, name, vars(getattr(fresh, kind.__name__))[name])
            repaired.append(kind.__name__)
    return repaired


@cache
def _classes_of(module: ModuleType) -> tuple[type, ...]:
    kinds = [kind for kind in vars(module).values() if isinstance(kind, type)]
    return tuple(
        kind for kind in kinds if is_message_class(kind) and kind.__module__ == module.__name__
    )


# Listening to what a node sends, at its own publishers and clients.
#
# A recording subscription would cost a second delivery of every message, could not tell who
# published and would show in the graph. A tap is put on the object that the node itself calls.


# Fast DDS hands stored messages to reliable subscriptions only. By its own default, a subscription
# is neither that nor transient-local. A test tries all combinations.
_ASK_FOR_STORED = {DurabilityPolicy.TRANSIENT_LOCAL, DurabilityPolicy.BEST_AVAILABLE}
_ASK_AGAIN = {ReliabilityPolicy.RELIABLE, ReliabilityPolicy.BEST_AVAILABLE}
#: For a call of rclpy's C code, which takes the handle of a duration.
_AT_ONCE = Duration()._duration_handle


def invalid_context(what: str, file: str) -> Exception:
    """Return the error of what uses a context that was shut down, in the words of rcl."""
    error: Exception = rclpy_implementation.RCLError(
        f"{what} context is invalid, at ./src/rcl/{file}:404"
    )
    return error


class PublisherTap:
    """Listen to one publisher.

    Args:
        publisher: The publisher; its `publish` is wrapped so that it also notifies `heard`.
        memory: Copies its messages.
        heard: Called with the copy after each message that was really published.

    Attributes:
        count: Number of published messages.
        lifespan_ns: How long the publisher stores a message; 0 without a limit.
    """

    def __init__(self, publisher: Publisher, memory: Memory, heard: Callable[[Any], None]) -> None:
        self.topic: str = publisher.topic_name
        self.count = 0
        self._publisher = publisher
        self._handle = publisher.handle
        self._qos: QoSProfile = publisher.qos_profile
        self._type = publisher.msg_type
        self._listeners = listeners = list[Callable[[], None]]()
        self.lifespan_ns = limit_ns(self._qos.lifespan)
        send, take, message_type = publisher.publish, memory.take, publisher.msg_type
        managed = hasattr(publisher, "is_activated")

        def publish(msg: Any) -> None:  # noqa: ANN401 - a message of any type, or its bytes
            if isinstance(msg, message_type):
                send(msg)
                # A publisher of a lifecycle node sends nothing while it is inactive.
                if managed and not publisher.is_activated:
                    return
                copy = take(msg)
            else:
                with asking("publish", msg):
                    if isinstance(msg, bytes):
                        # Bytes that are no message would only fail where they arrive.
                        deserialize_message(msg, message_type)
                    send(msg)  # bytes; or anything else, which rclpy refuses in its own words
                copy = msg
            self.count += 1
            heard(copy)
            for listener in listeners:
                listener()

        publish.__qualname__ = send.__qualname__  # for the errors of a call with other arguments
        publisher.publish = publish

    def close(self) -> None:
        """Refuse further messages, as rclpy does when the publisher's context was shut down."""

        def publish(msg: Any) -> None:  # noqa: ANN401 - a message of any type
            raise invalid_context("Failed to publish: publisher's", "publisher.c")

        self._publisher.publish = publish

    def listen(self, listener: Callable[[], None]) -> None:
        """Call this, too, after each message."""
        self._listeners.append(listener)

    def fits(self, subscription: Any) -> bool:  # noqa: ANN401 - rclpy is untyped
        """Return whether a subscription of this topic is connected to this publisher."""
        return self._type is subscription.msg_type and fit(self._qos, subscription.qos_profile)

    @property
    def stored(self) -> int:
        """Return how many messages are stored at most: some may have expired."""
        depth: int = self._qos.depth
        limited = self._qos.history == HistoryPolicy.KEEP_LAST
        return min(self.count, max(1, depth)) if limited else self.count

    @property
    def stores(self) -> bool:
        """Return whether it stores messages for late-joining subscriptions."""
        return bool(self._qos.durability != DurabilityPolicy.VOLATILE)

    def stores_for(self, qos: QoSProfile) -> bool:
        """Return whether a new subscription of this QoS gets stored messages from here."""
        asks = qos.durability in _ASK_FOR_STORED and qos.reliability in _ASK_AGAIN
        hands_over = self._qos.reliability != ReliabilityPolicy.BEST_EFFORT and self.count > 0
        is_possible = self.stores and asks and hands_over and is_alive(self._handle)
        return is_possible and fit(self._qos, qos)

    def has_delivered(self) -> bool:
        """Return whether all of its subscriptions have acknowledged all that they are to get."""
        try:
            with self._handle:
                return bool(self._handle.wait_for_all_acked(_AT_ONCE))
        except InvalidHandle:  # destroyed by another thread: nothing more will come
            return True


# How a session learns of nodes, without the nodes being changed.
#
# rclpy tells nobody that a node, a publisher or a timer was made. So the methods of `Node` that
# make them are wrapped once, when this module is first imported. A wrapper looks at the node's own
# context: if that belongs to a session, the session is told; if not, the original runs alone.


ENTITY_METHODS = {
    "create_publisher": "publisher",
    "create_subscription": "subscription",
    "create_timer": "timer",
    "create_service": "service",
    "create_client": "client",
    "create_rate": "rate",
}


class Unwatched:
    """Mix this into a node of the session's own, so that its session is not told."""


def core_of(node: Node) -> AllPorts | None:
    """Return the session of a node; None if it is in no session, or not yet a node."""
    if isinstance(node, Unwatched):
        return None
    # Not `node.context`: a class that forgot super().__init__() must fail with rclpy's own error.
    core: AllPorts | None = getattr(node.__dict__.get("_context"), "session_core", None)
    return core


def watch_birth(original: Callable[..., None]) -> Callable[..., None]:
    """Wrap `Node.__init__`, so that the node starts as its session says, which hears of it."""

    @wraps(original)
    def init(node: Node, *args: Any, **kwargs: Any) -> None:  # noqa: ANN401 - passed on
        context: Any = kwargs.get("context") or get_default_context()
        core: AllPorts | None = getattr(context, "session_core", None)
        name = kwargs.get("node_name", args[0] if args else None)
        with asking("Node.__init__", node, *args, **kwargs):
            if core is None or not isinstance(name, str) or isinstance(node, Unwatched):
                _make_alone(partial(original, node, *args, **kwargs))
                return
            # For a wrong name rclpy raises the same, and warns on stderr of a failed cleanup.
            validate_node_name(name)
            # Of what a command line says, a node may refuse all but the logging.
            is_told = kwargs.get("use_global_arguments", True)
            start = core.start
            of_process = ros_arguments(start.arguments()) if is_told else []
            if hasattr(context, "home") and context.ok():  # a program's: see `ProgramContext`
                kwargs["context"] = context.home
                of_process += context.ros_arguments if is_told else []
                if not context.publishes_logs:
                    kwargs["enable_rosout"] = False
            kwargs["cli_args"] = node_arguments(kwargs.get("cli_args") or (), of_process) or None
            new_name, new_namespace = (start.name, start.namespace) if is_told else ("", "")
            core.node_begins(new_name or name, new_namespace or kwargs.get("namespace") or "/")
            with core.context.making_node():
                original(node, *args, **kwargs)
        if context is not kwargs.get("context", context):
            node._context = context  # whose `ok` and `on_shutdown` are the program's own
        core.node_made(node)

    return init


def _make_alone(make: Callable[[], None]) -> None:
    try:
        make()
    except NotInitializedException:
        if not in_kernel():
            raise
        raise NoSessionError(
            "A node was created, but no session is open.",
            "A node needs ROS to be running. Opening a session starts ROS, and closing the session "
            "ends it.",
            "Open a session with `Session()`, or call `rclpy.init()` first, as a program "
            "does. Where a class is asked for, pass the class itself, without parentheses.",
        ) from None


def in_kernel() -> bool:
    """Return whether this process is a Jupyter kernel."""
    return "ipykernel.kernelapp" in sys.modules


def watch_entity(original: Callable[..., Any], kind: str) -> Callable[..., Any]:
    """Wrap a `Node.create_...`, so that the session watches what it makes, of this kind."""
    signature = inspect.signature(original)

    @wraps(original)
    def create(node: Node, *args: Any, **kwargs: Any) -> Entity:  # noqa: ANN401 - passed on
        core = core_of(node)
        with asking(original.__name__, *args, **kwargs):
            if core is None:
                return original(node, *args, **kwargs)
            if not node._context.ok() and node._context is not core.context:
                raise invalid_context(f"Failed to create {kind}: rcl node's", "node.c")
            _refuse_a_message(original.__name__, kwargs.get("msg_type", args[0] if args else None))
            core.entity_begins(node)
            full = ""
            if kind in ("publisher", "subscription"):
                bound = signature.bind_partial(node, *args, **kwargs).arguments
                channel = _channel_of_type(
                    node, core, kind, bound.get("msg_type"), bound.get("topic")
                )
                if channel is not None:
                    full, bound["topic"] = channel
                    args, kwargs = (), {key: bound[key] for key in bound if key != "self"}
                    kwargs.update(kwargs.pop("kwargs", {}))
            if core.counts_limits:
                entity = make_stretched(partial(original, node), kind, args, kwargs)
            else:
                entity = original(node, *args, **kwargs)
            if full:
                _renamed(entity, full)
        core.entity_made(node, kind, entity)
        return entity

    return create


def _refuse_a_message(call: str, kind: object) -> None:
    """Refuse a message in the place of its class: rclpy takes it, and fails at the first use."""
    if not isinstance(kind, type) and is_message_class(type(kind)):
        name = type(kind).__name__
        raise SessionError(
            f"{call} was given a message of type {name} instead of the class {name}.",
            "rclpy does not detect this here, but fails when the node sends its first message.",
            "Pass the class itself, without parentheses: this line does not send a message.",
        )


def _channel_of_type(
    node: Node, core: AllPorts, kind: str, msg_type: object, topic: object
) -> tuple[str, str] | None:
    """Return the full name of a topic that exists with another type, and the name of a channel.

    On a robot, two processes may use one topic with two types: both run, and are not connected.
    The nodes of a session share a participant, which knows one type for each topic. So each further
    type gets a channel of its own, whose hidden name nobody sees.

    Raises:
        RCLError: If a node of the same process uses the topic with another type, as on a robot; on
            a page also if any other node does. The middleware would refuse it as well, and rcl
            would then fail to clean up: it prints ten lines on file descriptor 2.
    """
    if not (isinstance(msg_type, type) and is_message_class(msg_type) and isinstance(topic, str)):
        return None  # rclpy says so itself
    try:
        full = node.resolve_topic_name(topic)
    except (InvalidTopicNameException, rclpy_implementation.RCLError):
        return None  # rclpy says so itself, with the name
    own = core.nodes.state_of(node)
    is_separate = core.has_separate_types
    for state in core.nodes.states():
        if is_separate and own is not None and state.process is not own.process:
            continue
        for end in (*state.node.publishers, *state.node.subscriptions):
            with suppress(InvalidHandle):  # destroyed, and not by its node
                if end.topic_name == full and end.msg_type is not msg_type:
                    raise _second_type(kind, full, msg_type)
    if not is_separate or core.topic_types.setdefault(full, msg_type) is msg_type:
        return None
    return full, f"{full}/_{type_name(msg_type).replace('/', '_')}"


def _second_type(kind: str, topic: str, msg_type: type) -> Exception:
    package = msg_type.__module__.partition(".")[0]
    error: Exception = rclpy_implementation.RCLError(
        f"Failed to create {kind}: create_{kind}() called for existing "
        f"topic name rt{topic} with incompatible type "
        f"{package}::msg::dds_::{msg_type.__name__}_"
    )
    return error


def _renamed(endpoint: Any, topic: str) -> Any:  # noqa: ANN401 - a publisher or a subscription
    """Let an endpoint say that it is one of a topic, whatever its channel is called."""
    kind = type(endpoint)
    endpoint.__class__ = type(kind.__name__, (kind,), {"topic_name": property(lambda _: topic)})
    return endpoint


def watch_end(original: Callable[[Node], None]) -> Callable[[Node], None]:
    """Wrap `Node.destroy_node`, so that the session forgets the node first."""

    @wraps(original)
    def destroy_node(node: Node) -> None:
        core = core_of(node)
        if core is not None:
            core.node_ends(node)
        original(node)

    return destroy_node


def watch_logger(original: Callable[[Node], RcutilsLogger]) -> Callable[[Node], RcutilsLogger]:
    """Wrap `Node.get_logger`, so that the session hears of the node's lines."""

    @wraps(original)
    def get_logger(node: Node) -> RcutilsLogger:
        core = core_of(node)
        return original(node) if core is None else core.logger_of(node, original(node))

    return get_logger


def show_as_written(original: Callable[..., list[Any]]) -> Callable[..., list[Any]]:
    """Wrap what lists endpoints, so that it shows the QoS that a program has written."""

    @wraps(original)
    def get_info_by_topic(node: Node, *args: Any, **kwargs: Any) -> list[Any]:  # noqa: ANN401 - passed on
        infos = original(node, *args, **kwargs)
        return infos if core_of(node) is None else as_written(infos)

    return get_info_by_topic


def watch_guards(original: Callable[..., Any]) -> Callable[..., Any]:
    """Wrap `Node.create_guard_condition`, so that rclpy's own executor runs the node."""

    @wraps(original)
    def create_guard_condition(node: Node, *args: Any, **kwargs: Any) -> Any:  # noqa: ANN401 - passed on
        made = original(node, *args, **kwargs)
        core = core_of(node)
        if core is not None:
            core.waitable_made(node)
        return made

    return create_guard_condition


def watch_waitables(original: Callable[..., None]) -> Callable[..., None]:
    """Wrap `Node.add_waitable`, so that rclpy's own executor runs the node."""

    @wraps(original)
    def add_waitable(node: Node, added: Any) -> None:  # noqa: ANN401 - any waitable
        original(node, added)
        core = core_of(node)
        if core is not None and not isinstance(added, EventHandler):
            core.waitable_made(node)

    return add_waitable
