"""The graph: of a session, of the other processes in its domain, and waiting for both."""

from __future__ import annotations

import os
import time
from array import array
from collections import Counter, defaultdict
from collections.abc import Callable, Coroutine, Iterable, Iterator
from contextlib import suppress
from inspect import iscoroutinefunction
from itertools import count
from os import getpid
from pathlib import Path
from threading import Event
from typing import TYPE_CHECKING, Any

from rclpy.context import Context
from rclpy.exceptions import InvalidHandle
from rclpy.node import Node, NodeNameNonExistentError
from rclpy.parameter import Parameter
from rclpy.qos import QoSCompatibility, QoSProfile, qos_check_compatible
from rclpy.subscription import Subscription

from rosbeat.records import (
    INFRASTRUCTURE_TOPICS,
    Endpoint,
    GraphSnapshot,
    QoS,
    TimerRecord,
    is_hidden,
)
from rosbeat.ros.context import show_briefly
from rosbeat.ros.entities import Entry, NodeState, full_name
from rosbeat.ros.errors import nobody_else_here, nodes_did_not_come
from rosbeat.ros.qos_events import limit_ns
from rosbeat.ros.recording import Channel, Memory, Recorder, Unwatched, type_name

if TYPE_CHECKING:
    from rosbeat.ros.world import World


# The graph of a session's nodes.


def qos_of(profile: QoSProfile) -> QoS:
    """A QoS profile as plain data."""
    return QoS(
        profile.reliability.name,
        profile.durability.name,
        profile.history.name,
        profile.depth,
        limit_ns(profile.deadline),
        limit_ns(profile.lifespan),
    )


def snapshot(states: Iterable[NodeState]) -> GraphSnapshot:
    """The graph of these nodes as it is now, destroyed entities left out."""
    alive = [state for state in states if state.node is not None]
    endpoints = (end for state in alive for end in _endpoints(state))
    timers = (timer for state in alive for timer in _timers(state))
    return GraphSnapshot(tuple(state.name for state in alive), tuple(endpoints), tuple(timers))


def _endpoints(state: NodeState) -> Iterator[Endpoint]:
    node = state.node
    assert node is not None
    for publisher in filter(_is_alive, node.publishers):
        yield _publisher(state, publisher)
    for subscription in filter(_is_alive, node.subscriptions):
        yield _subscription(state, subscription)
    for service in node.services:
        yield _service(state, service, "server")
    for client in node.clients:
        yield _service(state, client, "client")
    for action in state.actions:
        if action.exists:
            yield from action.endpoints()


def _is_alive(entity: Any) -> bool:  # noqa: ANN401
    try:
        with entity.handle:
            return True
    except InvalidHandle:
        return False  # destroyed by itself, not by its node


def _publisher(state: NodeState, publisher: Any) -> Endpoint:  # noqa: ANN401
    return Endpoint(
        state.name,
        publisher.topic_name,
        type_name(publisher.msg_type),
        "publisher",
        qos_of(publisher.qos_profile),
        publisher.get_subscription_count(),
    )


def _subscription(state: NodeState, subscription: Any) -> Endpoint:  # noqa: ANN401
    return Endpoint(
        state.name,
        subscription.topic_name,
        type_name(subscription.msg_type),
        "subscription",
        qos_of(subscription.qos_profile),
        subscription.get_publisher_count(),
    )


def _service(state: NodeState, entity: Any, kind: str) -> Endpoint:  # noqa: ANN401
    name = type_name(entity.srv_type)
    return Endpoint(state.name, entity.service_name, name, kind, qos_of(entity.qos_profile))


def _timers(state: NodeState) -> Iterator[TimerRecord]:
    for entry in state.entries:
        if entry.kind.endswith("timer") and (period := _period(entry)) is not None:
            yield TimerRecord(state.name, entry.label.name, period, entry.calls)


def _period(entry: Entry) -> int | None:
    try:
        period: int = entry.entity.timer_period_ns
    except InvalidHandle:
        return None  # destroyed
    return period


# A hidden node, through which a session sees the other processes of its domain.


#: What stands for the name of a node that has not told it yet; names of nodes arrive about 0.1 s
#: after those of their topics.
UNKNOWN = "_NODE_NAME_UNKNOWN_"
#: How many bytes of an endpoint's address all endpoints of one participant have in common.
_PARTICIPANT = 12
#: Every node of rclpy publishes here, and once only.
_EVERY_NODE = "/parameter_events"
_numbers = count(1)  # only makes names differ


class Lookout(Unwatched, Node):
    """Asks the graph, and does nothing else: no callbacks, no services, no log topic.

    Its name begins with `_`, so `ros2 node list` leaves it out as it does its own nodes. While it
    lives the session takes part in its domain, so discovery begins with the session.

    Args:
        context: The session's context.
    """

    def __init__(self, context: Context) -> None:
        super().__init__(
            f"_rosbeat_{getpid()}_{next(_numbers)}",
            context=context,
            enable_rosout=False,
            start_parameter_services=False,
            parameter_overrides=[Parameter("start_type_description_service", value=False)],
        )
        own = self.get_publishers_info_by_topic(_EVERY_NODE)
        name = self.get_name()
        self._own = next((participant(one) for one in own if one.node_name == name), b"")

    def publishers(self, topic: str) -> list[Any]:
        """Every publisher on a topic, in this process and in others."""
        return list(self.get_publishers_info_by_topic(topic))

    def subscriptions(self, topic: str) -> list[Any]:
        """Every subscription to a topic, in this process and in others."""
        return list(self.get_subscriptions_info_by_topic(topic))

    def is_outside(self, endpoint: Any) -> bool:  # noqa: ANN401 - rclpy's TopicEndpointInfo
        """Whether an endpoint belongs to another process, or to another session of this one."""
        return participant(endpoint) != self._own

    def topics(self) -> list[str]:
        """The topics that anybody uses, sorted."""
        return sorted(name for name, _ in self.get_topic_names_and_types())

    def nodes(self) -> list[str]:
        """Full names of all nodes with names, the session's own included, sorted.

        A node that has left may stay listed for good, without endpoints: if the last news of it
        is looked at after its farewell, the middleware takes it for news of somebody new
        (`GraphCache::update_participant_entities` of rmw_dds_common, which adds whom it does not
        know). So each name counts only as often as there are nodes of that name with endpoints;
        every node of rclpy has one on `/parameter_events`.
        """
        known = self.get_node_names_and_namespaces()
        listed = Counter(full_name(name, space) for name, space in known if name != UNKNOWN)
        return sorted((listed & self._with_endpoints()).elements())

    def _with_endpoints(self) -> Counter[str]:
        """How many nodes of each name have endpoints on topics, as far as that can be told."""
        found: dict[str, set[bytes]] = defaultdict(set)
        for topic in self.topics():
            for one in self.publishers(topic) + self.subscriptions(topic):
                found[owner(one)].add(participant(one))
        of_a_process = Counter(owner(one) for one in self.publishers(_EVERY_NODE))
        return of_a_process | Counter({name: len(homes) for name, homes in found.items()})


def participant(endpoint: Any) -> bytes:  # noqa: ANN401 - rclpy's TopicEndpointInfo
    """The part of an endpoint's address that all endpoints of a context have in common."""
    return bytes(endpoint.endpoint_gid[:_PARTICIPANT])


def owner(endpoint: Any) -> str:  # noqa: ANN401 - rclpy's TopicEndpointInfo
    """Full name of the node that an endpoint belongs to."""
    return full_name(endpoint.node_name, endpoint.node_namespace)


# The graph of the other processes in a domain, as records.


#: Every node logs on this topic, below rclpy: what a session knows of its own nodes leaves it out.
_BELOW_RCLPY = "/rosout"


def with_outside(own: GraphSnapshot, lookout: Lookout) -> GraphSnapshot:
    """A session's graph, completed by the nodes of other processes.

    They come after the session's own, sorted by name, without what is hidden. Timers are nobody's
    business but their own process's. A service's quality of service is not told either; the default
    stands in its place.
    """
    nodes = tuple(sorted(_others(lookout.nodes(), own.nodes)))
    ends = (*_topic_ends(lookout), *_service_ends(lookout, set(nodes) - set(own.nodes)))
    order = {name: rank for rank, name in enumerate(nodes)}
    shown = sorted((end for end in ends if end.node in order), key=lambda end: order[end.node])
    return GraphSnapshot((*own.nodes, *nodes), (*own.endpoints, *shown), own.timers)


def is_settled(lookout: Lookout) -> bool:
    """Whether every endpoint that is known has a node whose name is known."""
    return not any(
        one.node_name == UNKNOWN
        for topic in lookout.topics()
        for one in lookout.publishers(topic) + lookout.subscriptions(topic)
    )


def _others(names: Iterable[str], own: Iterable[str]) -> list[str]:
    """Names that are left when each of the session's own is taken out once."""
    left = Counter(name for name in names if not is_hidden(name)) - Counter(own)
    return list(left.elements())


def _topic_ends(lookout: Lookout) -> Iterator[Endpoint]:
    for topic in lookout.topics():
        if topic == _BELOW_RCLPY or is_hidden(topic):
            continue
        publishers, subscriptions = lookout.publishers(topic), lookout.subscriptions(topic)
        for one in filter(lookout.is_outside, publishers):
            matched = sum(_fits(one, other) for other in subscriptions)
            yield _endpoint(one, topic, "publisher", matched)
        for one in filter(lookout.is_outside, subscriptions):
            matched = sum(_fits(other, one) for other in publishers)
            yield _endpoint(one, topic, "subscription", matched)


def _fits(publisher: Any, subscription: Any) -> bool:  # noqa: ANN401 - rclpy's TopicEndpointInfo
    # The middleware tells a process of its own matches only; but its rule is known.
    fits, _ = qos_check_compatible(publisher.qos_profile, subscription.qos_profile)
    same = publisher.topic_type == subscription.topic_type
    return bool(same and fits != QoSCompatibility.ERROR)


def _endpoint(one: Any, topic: str, kind: str, matched: int) -> Endpoint:  # noqa: ANN401
    return Endpoint(owner(one), topic, one.topic_type, kind, qos_of(one.qos_profile), matched)


def _service_ends(lookout: Lookout, nodes: Iterable[str]) -> Iterator[Endpoint]:
    asks = (
        (lookout.get_service_names_and_types_by_node, "server"),
        (lookout.get_client_names_and_types_by_node, "client"),
    )
    for node in nodes:
        for ask, kind in asks:
            for name, types in _services(ask, node):
                yield Endpoint(node, name, types[0], kind, QoS())


def _services(ask: Callable[[str, str], Any], node: str) -> list[tuple[str, list[str]]]:
    namespace, _, name = node.rpartition("/")
    try:
        found = ask(name, namespace or "/")
    except NodeNameNonExistentError:
        return []  # it has just left
    return [(service, types) for service, types in found if not is_hidden(service)]


# Which ROS domains somebody of this machine takes part in, by the ports that are held.
#
# Each participant of DDS listens on two UDP ports that follow from the domain and from its number
# on the machine: 7400 + 250 * domain + 10 + 2 * number for discovery, and the next one for data
# (RTPS specification, section 9.6.1). So they can be counted before any of them has answered.


_TABLES = ("/proc/net/udp", "/proc/net/udp6")
_OPEN_FILES = Path("/proc/self/fd")
#: Domains whose ports Linux does not hand out by itself.
_DOMAINS = range(102)
#: In the system's table: the local address with its port, and the socket's number.
_ADDRESS, _INODE = 1, 9


def count_participants(domain_id: int, table: str | None = None) -> int:
    """How many participants of this machine are in a domain; 0 where that cannot be known.

    Args:
        domain_id: The domain.
        table: The text of the system's table of UDP sockets, read from the system by default.
    """
    ports = set(_ports(_read() if table is None else table))
    return len(_participants(domain_id, ports))


def domains_in_use(table: str | None = None, own: Iterable[str] | None = None) -> list[int]:
    """The domains in which a process other than this one takes part, ascending.

    Args:
        table: The text of the system's table of UDP sockets, read from the system by default.
        own: Numbers of sockets that do not count, by default those of this process.
    """
    skipped = _own_sockets() if own is None else frozenset(own)
    ports = set(_ports(_read() if table is None else table, skipped))
    return [number for number in _DOMAINS if _participants(number, ports)]


def _participants(domain_id: int, ports: set[int]) -> list[int]:
    first = 7400 + 250 * domain_id + 10
    # Both ports: another program may hold one of them by chance.
    return [port for port in range(first, first + 240, 2) if {port, port + 1} <= ports]


def _ports(table: str, skipped: frozenset[str] = frozenset()) -> list[int]:
    rows = [line.split() for line in table.splitlines()]
    return [
        int(row[_ADDRESS].rpartition(":")[2], 16)
        for row in rows
        if len(row) > _INODE and row[0][:1].isdigit() and row[_INODE] not in skipped
    ]


def _read() -> str:
    text = ""
    for name in _TABLES:
        with suppress(OSError):
            text += Path(name).read_text(encoding="ascii")
    return text


def _own_sockets() -> frozenset[str]:
    found = set()
    with suppress(OSError):
        for one in _OPEN_FILES.iterdir():
            with suppress(OSError):  # closed meanwhile
                target = os.readlink(one)
                if target.startswith("socket:["):
                    found.add(target[len("socket:[") : -1])
    return frozenset(found)


# Waiting until the graph of a domain can be believed.


#: Every participant says on this topic which endpoints belong to which of its nodes.
_EVERYBODY = "ros_discovery_info"
_LOOK_EVERY = 0.02
#: The graph is believed if it was the same so many times in a row. Not a time: on a busy machine
#: time passes in which no news could have come in.
_SAME_LOOKS = 8
#: A process without the course's discovery settings announces itself each 3 s. If there is no news
#: for longer, whoever is missing has stopped. While there is news, a busy machine is waited for.
_NO_NEWS = 4.0
_AT_MOST = 20.0


def settle(lookout: Lookout, domain_id: int) -> bool:
    """Wait until every process of this machine is seen, with its names, and nothing changes.

    Args:
        lookout: Who sees.
        domain_id: The domain that it is in.

    Returns:
        Whether that came; False if some seconds without news came first.
    """
    begin = since = time.monotonic()
    last, same = None, 0
    while time.monotonic() - begin < _AT_MOST and time.monotonic() - since < _NO_NEWS:
        now = _look(lookout)
        if now != last:
            last, since, same = now, time.monotonic(), 0
        same += 1
        if same >= _SAME_LOOKS and _is_complete(lookout, domain_id):
            return True
        time.sleep(_LOOK_EVERY)
    return False


def _look(lookout: Lookout) -> object:
    counts = [
        (topic, lookout.count_publishers(topic), lookout.count_subscribers(topic))
        for topic in lookout.topics()
    ]
    return lookout.nodes(), counts, sorted(lookout.get_service_names_and_types())


def _is_complete(lookout: Lookout, domain_id: int) -> bool:
    publishers = lookout.get_publishers_info_by_topic(_EVERYBODY, True)
    subscriptions = lookout.get_subscriptions_info_by_topic(_EVERYBODY, True)
    seen, heard = set(map(participant, publishers)), set(map(participant, subscriptions))
    return seen == heard and len(seen) >= count_participants(domain_id) and is_settled(lookout)


# Waiting in a cell, with a deadline, for something that happens elsewhere.


_POLL_EVERY = 0.05
#: The graph is believed when it has not changed for so many seconds.
_QUIET = 0.2


def poll(
    done: Callable[[], object], deadline: float | None, meanwhile: Callable[[], object] = bool
) -> bool:
    """Wait until something is true.

    Args:
        done: Asked again and again.
        deadline: When to give up, on `time.monotonic`'s clock; None for never.
        meanwhile: Called before each question.

    Returns:
        Whether it came true.
    """
    pulse = Event()  # nobody sets it: it is a sleep that an Interrupt ends at once
    while True:
        meanwhile()
        if done():
            return True
        left = _POLL_EVERY if deadline is None else deadline - time.monotonic()
        if left <= 0:
            return False
        pulse.wait(min(_POLL_EVERY, left))


def wait_live(world: World, done: Callable[[], object], seconds: float | None) -> bool:
    """Wait while a session is live, and print what its nodes say.

    Args:
        world: The session.
        done: Asked again and again.
        seconds: How long at most, in seconds of wall time; None for ever.

    Returns:
        Whether it came true.
    """
    deadline = None if seconds is None else time.monotonic() + seconds
    world.console.begin()
    try:
        return poll(done, deadline, world.show_news)
    except KeyboardInterrupt as interrupt:
        show_briefly(interrupt, "you stopped waiting; the session is still live.")
        world.hurry()
        raise
    finally:
        world.show_news()
        world.console.end()


def wait_for_nodes(world: World, names: list[str], seconds: float) -> None:
    """Wait until nodes of these full names are in the graph, with all that belongs to them.

    Raises:
        SessionError: If the domain is private, or they do not come.
    """
    if world.lookout is None:
        raise nobody_else_here()
    look = _Look(world, world.lookout, names)
    try:
        poll(look.is_enough, time.monotonic() + seconds)
    except KeyboardInterrupt as interrupt:
        show_briefly(interrupt, "you stopped waiting; the session goes on.")
        raise
    missing = [name for name in names if name not in look.graph.nodes]
    if missing:
        raise nodes_did_not_come(missing, look.graph.nodes, seconds, world.domain_id or 0)


class _Look:
    """The graph as it was last seen, and since when it has been so."""

    def __init__(self, world: World, lookout: Lookout, names: list[str]) -> None:
        self._world, self._lookout, self._names = world, lookout, names
        self._since = time.monotonic()
        self.graph = GraphSnapshot()

    def is_enough(self) -> bool:
        """Look again; say whether all are there and nothing has changed for a moment.

        A node's name, its publishers and its subscriptions come one after the other.
        """
        before, self.graph = self.graph, self._world.graph()
        if self.graph.nodes != before.nodes or self.graph.endpoints != before.endpoints:
            self._since = time.monotonic()
        here = set(self._names) <= set(self.graph.nodes)
        return here and time.monotonic() - self._since >= _QUIET and is_settled(self._lookout)


# Messages that other processes publish, recorded when a node of the session gets them.
#
# What arrives says when it was published and as the publisher's how-manieth, but neither by whom
# nor whether that was this session. So the session's own publishers note when they published what;
# what is not among these came from outside. Who it was is known if only one node outside publishes
# there.


#: Who published, as long as nobody can say.
NOBODY = "?"
#: Fast DDS keeps times in fractions of a second that are no whole nanoseconds.
_SLACK_NS = 1_000


class Departures:
    """When one publisher of the session published each of its messages.

    Args:
        publisher: The publisher; its `publish` is replaced by one that also notes the time.
    """

    def __init__(self, publisher: Any) -> None:  # noqa: ANN401 - rclpy is untyped
        self._begins, self._ends = array("q"), array("q")
        self._send = publisher.publish
        publisher.publish = self._publish

    def _publish(self, msg: Any) -> None:  # noqa: ANN401 - a message of any type, or its bytes
        # Noted before it goes out: another thread may take it before `publish` has returned.
        begins, ends = self._begins, self._ends
        begins.append(time.time_ns())
        try:
            self._send(msg)
        except BaseException:
            begins.pop()
            raise
        ends.append(time.time_ns())

    def sent(self, number: int, time_ns: int) -> bool:
        """Whether the message of this number, counted from 1, was published at this time."""
        if not 0 < number <= len(self._begins):
            return False
        begin = self._begins[number - 1]
        end = self._ends[number - 1] if number <= len(self._ends) else time.time_ns()
        return begin - _SLACK_NS <= time_ns <= end + _SLACK_NS


class Arrivals:
    """Records what comes from outside of a session.

    Args:
        lookout: Knows who publishes.
        recorder: Where messages are remembered.
        now: Nanoseconds since the session began.
    """

    def __init__(self, lookout: Lookout, recorder: Recorder, now: Callable[[], int]) -> None:
        self._lookout, self._recorder, self._now = lookout, recorder, now
        self._own: dict[str, list[Departures]] = {}
        self._known: set[tuple[str, int, int]] = set()
        self._channels: dict[tuple[str, frozenset[bytes]], Channel] = {}
        self._last: dict[str, Channel] = {}
        self._types: dict[str, type] = {}

    def watch_publisher(self, publisher: Any) -> None:  # noqa: ANN401
        """Recognize what this publisher of the session sends."""
        self._own.setdefault(publisher.topic_name, []).append(Departures(publisher))

    def watch_subscription(self, subscription: Subscription) -> None:
        """Record what arrives here from outside, before the callback runs."""
        topic = subscription.topic_name
        if topic in INFRASTRUCTURE_TOPICS:
            return
        memory = Memory(subscription.msg_type)
        self._types[topic] = subscription.msg_type

        def arrived(message: Any, info: dict[str, int]) -> None:  # noqa: ANN401
            self._arrived(topic, memory, message, info)

        subscription.callback = _listening(subscription, arrived)

    def topics(self) -> set[str]:
        """Every topic on which something from outside would have been recorded."""
        return set(self._types)

    def is_own(self, topic: str, info: dict[str, int]) -> bool:
        """Whether a message that came on a topic was published by this session."""
        number, sent = info["publication_sequence_number"], info["source_timestamp"]
        return any(own.sent(number, sent) for own in self._own.get(topic, ()))

    def _arrived(self, topic: str, memory: Memory, message: Any, info: dict[str, int]) -> None:  # noqa: ANN401
        number, sent = info["publication_sequence_number"], info["source_timestamp"]
        if self.is_own(topic, info):
            return
        with self._recorder.lock:
            if (topic, number, sent) in self._known:
                return  # another node of the session got it first
            self._known.add((topic, number, sent))
            channel = self._channel(topic, memory)
            copy = message if isinstance(message, bytes) else memory.take(message)
            self._recorder.add_sample(channel.number, self._now(), copy)

    def _channel(self, topic: str, memory: Memory) -> Channel:
        outside = list(filter(self._lookout.is_outside, self._lookout.publishers(topic)))
        if not outside and topic in self._last:
            return self._last[topic]  # whoever sent it has left
        key = topic, frozenset(bytes(one.endpoint_gid) for one in outside)
        name = _only_owner(outside)
        channel = self._channels.get(key)
        if channel is None:
            channel = self._recorder.channel(topic, type_name(self._types[topic]), name, memory)
        elif channel.node != name:
            channel = self._recorder.rename(channel, name)
        self._channels[key] = self._last[topic] = channel
        return channel


def _only_owner(publishers: list[Any]) -> str:
    names = {owner(one) for one in publishers}
    if len(names) != 1 or publishers[0].node_name == UNKNOWN:
        return NOBODY
    return names.pop()


def _listening(
    subscription: Subscription, arrived: Callable[[Any, dict[str, int]], None]
) -> Callable[..., Any]:
    """A callback that tells `arrived` first and then does what the subscription's own does.

    It asks for the message's information, which both executors hand to whoever takes it.
    """
    original = subscription.callback
    wants_info = subscription._callback_type is Subscription.CallbackType.WithMessageInfo

    def call(message: Any, info: dict[str, int]) -> Any:  # noqa: ANN401
        arrived(message, info)
        return original(message, info) if wants_info else original(message)

    # Executors await what a coroutine function returns, and nothing else.
    async def call_later(message: Any, info: dict[str, int]) -> Any:  # noqa: ANN401
        coroutine: Coroutine[Any, Any, Any] = call(message, info)
        return await coroutine

    return call_later if iscoroutinefunction(original) else call
