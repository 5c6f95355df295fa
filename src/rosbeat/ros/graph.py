"""Show the graph of a session and of other processes in its domain, and wait for nodes."""

from __future__ import annotations

import os
import time
from array import array
from collections import Counter, defaultdict
from collections.abc import Callable, Coroutine, Iterable, Iterator
from contextlib import suppress
from enum import Enum
from functools import partial
from inspect import iscoroutinefunction
from itertools import count, product
from pathlib import Path
from typing import TYPE_CHECKING, Any

from rclpy.context import Context
from rclpy.exceptions import InvalidHandle
from rclpy.node import Node, NodeNameNonExistentError
from rclpy.parameter import Parameter
from rclpy.publisher import Publisher
from rclpy.qos import QoSProfile
from rclpy.subscription import Subscription

from rosbeat.domains import LAST_DOMAIN, SESSION_DOMAINS, participants, udp_ports
from rosbeat.errors import SessionError
from rosbeat.records import (
    INFRASTRUCTURE_TOPICS,
    Endpoint,
    GraphSnapshot,
    QoS,
    TimerRecord,
    is_hidden,
)
from rosbeat.ros.context import show_briefly
from rosbeat.ros.errors import nearest
from rosbeat.ros.processes import NodeState, full_name
from rosbeat.ros.qos_events import fit, limit_ns
from rosbeat.ros.recording import Channel, Memory, Message, Recorder, Unwatched, type_name

if TYPE_CHECKING:
    from rosbeat.ros.ports import Domain


# The graph of a session's own nodes.


def qos_of(profile: QoSProfile) -> QoS:
    """Return a QoS profile as plain data."""
    return QoS(
        profile.reliability.name,
        profile.durability.name,
        profile.history.name,
        int(profile.depth),
        limit_ns(profile.deadline),
        limit_ns(profile.lifespan),
        # A policy is a number as well, so rclpy takes one for a depth.
        profile.depth.name if isinstance(profile.depth, Enum) else "",
    )


def snapshot(states: Iterable[NodeState]) -> GraphSnapshot:
    """Return the graph of these nodes as it is now, without destroyed entities."""
    alive = list(states)
    # Live, one executor runs all nodes; each is taken for a process of its own there, too.
    processes = {id(state.process): state.process for state in alive}
    groups = (tuple(state.name for state in one.states) for one in processes.values())
    return GraphSnapshot(
        tuple(state.name for state in alive),
        tuple(end for state in alive for end in _endpoints(state)),
        tuple(timer for state in alive for timer in _timers(state)),
        tuple(group for group in groups if len(group) > 1),
    )


def _endpoints(state: NodeState) -> Iterator[Endpoint]:
    node, name = state.node, state.name
    topics = (
        ("publisher", node.publishers, "get_subscription_count"),
        ("subscription", node.subscriptions, "get_publisher_count"),
    )
    # An entity can be destroyed on its own, and by another thread while this one looks.
    for kind, entities, count_matched in topics:
        for one in entities:
            with suppress(InvalidHandle):
                type_of, qos = type_name(one.msg_type), qos_of(one.qos_profile)
                matched = getattr(one, count_matched)()
                yield Endpoint(name, one.topic_name, type_of, kind, qos, matched)
    for kind, entities in (("server", node.services), ("client", node.clients)):
        for one in entities:
            with suppress(InvalidHandle):
                type_of, qos = type_name(one.srv_type), qos_of(one.qos_profile)
                yield Endpoint(name, one.service_name, type_of, kind, qos)
    for action in state.actions:
        if action.exists:
            yield from action.endpoints()


def _timers(state: NodeState) -> Iterator[TimerRecord]:
    for entry in state.entries:
        if entry.kind.endswith("timer"):
            with suppress(InvalidHandle):
                period = entry.entity.timer_period_ns
                yield TimerRecord(state.name, entry.label.name, period, entry.calls)


# The other processes of a domain, seen through a hidden node.

#: The name of a node about 0.1 s longer than its topics are known.
_UNKNOWN_NODE = "_NODE_NAME_UNKNOWN_"
#: All endpoints of one participant have so many bytes of their addresses in common.
_PARTICIPANT_BYTES = 12
#: Every node publishes on this topic, with exactly one publisher.
_EVERY_NODE = "/parameter_events"
#: Every participant tells on this topic which endpoints belong to which of its nodes.
_EVERY_PARTICIPANT = "ros_discovery_info"
#: Every node logs on this topic, below rclpy: snapshots of a session's own nodes leave it out.
_LOG_TOPIC = "/rosout"
_LOOK_EVERY = 0.02
#: The graph is stable if so many looks before the last one saw the same: on a busy machine time
#: passes in which no news could have come in.
_SAME_LOOKS = 7
#: A process without the course's discovery settings announces itself each 3 s. If there is no news
#: for longer, whoever is missing has stopped. While there is news, a busy machine is waited for.
_NO_NEWS, _AT_MOST = 4.0, 20.0
_numbers = count(1)  # only makes names differ
_HIDDEN_NAME = "_rosbeat_"


class HiddenNode(Unwatched, Node):
    """Join a domain without services or log topic, hidden like the nodes of `ros2` commands."""

    def __init__(self, context: Context) -> None:
        super().__init__(
            f"{_HIDDEN_NAME}{os.getpid()}_{next(_numbers)}",
            context=context,
            enable_rosout=False,
            start_parameter_services=False,
            parameter_overrides=[Parameter("start_type_description_service", value=False)],
        )


class GraphObserver(HiddenNode):
    """Query the middleware for the graph of a domain, including the nodes of other processes.

    Discovery starts on construction, so a session creates its observer at the beginning.
    """

    def __init__(self, context: Context) -> None:
        super().__init__(context)
        self._domain_id: int = context.get_domain_id()
        own = self.get_publishers_info_by_topic(_EVERY_NODE)
        name = self.get_name()
        self._own = next((_participant(one) for one in own if one.node_name == name), b"")

    def publishers(self, topic: str) -> list[Any]:
        """Return every publisher on a topic, in this process and in others."""
        return list(self.get_publishers_info_by_topic(topic))

    def subscriptions(self, topic: str) -> list[Any]:
        """Return every subscription to a topic, in this process and in others."""
        return list(self.get_subscriptions_info_by_topic(topic))

    def is_outside(self, endpoint: Any) -> bool:  # noqa: ANN401 - rclpy's TopicEndpointInfo
        """Return whether an endpoint belongs to another process, or to another session here."""
        return _participant(endpoint) != self._own

    def topics(self) -> list[str]:
        """Return the topics that anybody uses, sorted."""
        return sorted(name for name, _ in self.get_topic_names_and_types())

    def nodes(self) -> list[str]:
        """Return the full names of all nodes, the session's own included, sorted.

        The middleware's own list of nodes may keep a node that has left: if the last news of it is
        handled after its farewell, it is taken for news of a new node
        (`GraphCache::update_participant_entities` of rmw_dds_common). Such a node has no
        endpoints, so the nodes are counted by the one publisher that each of them has.
        """
        found = self.publishers(_EVERY_NODE)
        return sorted(owner(one) for one in found if one.node_name != _UNKNOWN_NODE)

    def knows_all_names(self) -> bool:
        """Return whether every endpoint that is known has a node whose name is known."""
        ends = (self.publishers(topic) + self.subscriptions(topic) for topic in self.topics())
        return all(one.node_name != _UNKNOWN_NODE for found in ends for one in found)

    def wait_until_stable(self) -> None:
        """Wait until every process of this machine is seen, with its names, and nothing changes.

        It gives up after some seconds without news.
        """
        begin = changed = time.monotonic()
        looks = self.looks()
        while time.monotonic() < min(begin + _AT_MOST, changed + _NO_NEWS):
            same = next(looks)
            changed = changed if same else time.monotonic()
            if same >= _SAME_LOOKS and self._sees_every_process() and self.knows_all_names():
                return
            time.sleep(_LOOK_EVERY)

    def looks(self) -> Iterator[int]:
        """Look at the graph again and again; yield how many looks in a row saw the same before."""
        last, same = None, 0
        while True:
            topics = self.topics()
            counts = [(self.count_publishers(one), self.count_subscribers(one)) for one in topics]
            now = self.nodes(), topics, counts, sorted(self.get_service_names_and_types())
            last, same = now, same + 1 if now == last else 0
            yield same

    def _sees_every_process(self) -> bool:
        publishers = self.get_publishers_info_by_topic(_EVERY_PARTICIPANT, True)
        subscriptions = self.get_subscriptions_info_by_topic(_EVERY_PARTICIPANT, True)
        seen = set(map(_participant, publishers))
        known_both_ways = seen == set(map(_participant, subscriptions))
        return known_both_ways and len(seen) >= count_participants(self._domain_id)


def is_of_course(name: str) -> bool:
    """Return whether a node is one of rosbeat's hidden ones, or has no name yet."""
    return name.startswith(f"/{_HIDDEN_NAME}") or name.endswith(_UNKNOWN_NODE)


def owner(endpoint: Any) -> str:  # noqa: ANN401 - rclpy's TopicEndpointInfo
    """Return the full name of the node that an endpoint belongs to."""
    return full_name(endpoint.node_name, endpoint.node_namespace)


def _participant(endpoint: Any) -> bytes:  # noqa: ANN401 - rclpy's TopicEndpointInfo
    """Return the part of an endpoint's address that all endpoints of a context share."""
    return bytes(endpoint.endpoint_gid[:_PARTICIPANT_BYTES])


def with_other_processes(own: GraphSnapshot, observer: GraphObserver) -> GraphSnapshot:
    """Return a session's graph, completed by the nodes of other processes.

    They come after the session's own, sorted by name, without what is hidden. The middleware tells
    neither their timers nor the QoS of their services; the default stands in its place.
    """
    shown = Counter(name for name in observer.nodes() if not is_hidden(name))
    others = sorted((shown - Counter(own.nodes)).elements())
    found = [*_topic_endpoints(observer), *_services(observer, set(others) - set(own.nodes))]
    ends = sorted((end for end in found if end.node in others), key=lambda end: end.node)
    endpoints = (*own.endpoints, *ends)
    return GraphSnapshot((*own.nodes, *others), endpoints, own.timers, own.processes)


def _topic_endpoints(observer: GraphObserver) -> Iterator[Endpoint]:
    for topic in observer.topics():
        if topic != _LOG_TOPIC and not is_hidden(topic):
            yield from outside_endpoints(observer, topic)


def outside_endpoints(observer: GraphObserver, topic: str) -> Iterator[Endpoint]:
    """Return the endpoints of a topic that belong to other processes, hidden nodes included."""
    publishers, subscriptions = observer.publishers(topic), observer.subscriptions(topic)
    matches = Counter[int]()
    for one, other in product(publishers, subscriptions):
        # The middleware tells a process of its own matches only; but its rule is known.
        if one.topic_type == other.topic_type and fit(one.qos_profile, other.qos_profile):
            matches.update((id(one), id(other)))
    for kind, ends in (("publisher", publishers), ("subscription", subscriptions)):
        for end in filter(observer.is_outside, ends):
            qos, matched = qos_of(end.qos_profile), matches[id(end)]
            yield Endpoint(owner(end), topic, end.topic_type, kind, qos, matched)


def _services(observer: GraphObserver, nodes: Iterable[str]) -> Iterator[Endpoint]:
    servers = observer.get_service_names_and_types_by_node
    clients = observer.get_client_names_and_types_by_node
    for node in nodes:
        namespace, _, name = node.rpartition("/")
        for ask, kind in ((servers, "server"), (clients, "client")):
            with suppress(NodeNameNonExistentError):  # it has just left
                for service, types in ask(name, namespace or "/"):
                    if not is_hidden(service):
                        yield Endpoint(node, service, types[0], kind, QoS())


# Which ROS domains have participants on this machine, by the ports that are bound.


def count_participants(domain_id: int) -> int:
    """Return how many participants of this machine are in a domain, by the ports that are bound."""
    return len(participants(domain_id, udp_ports()))


def domains_in_use() -> list[int]:
    """Return the domains in which another process of this user takes part, ascending.

    On a server, somebody else's nodes are nobody's business.
    """
    bound, user = udp_ports(ignored=_own_sockets()), os.geteuid()
    numbers = (*range(LAST_DOMAIN + 1), *SESSION_DOMAINS)
    return [number for number in numbers if user in participants(number, bound)]


def _own_sockets() -> set[str]:
    found = set()
    with suppress(OSError):
        for link in Path("/proc/self/fd").iterdir():
            with suppress(OSError):  # closed meanwhile
                kind, _, inode = os.readlink(link).partition(":")
                found |= {inode.strip("[]")} if kind == "socket" else set()
    return found


# Waiting in a cell, with a deadline, for something that happens elsewhere.

_POLL_EVERY = 0.02
#: So many polls without a change: 0.2 s, on a machine that is not busy.
_SAME_POLLS = 10


def poll(done: Callable[[], object], deadline: float | None) -> bool:
    """Wait until `done` is true, or until a time on `time.monotonic`'s clock; return whether."""
    while not done():
        left = _POLL_EVERY if deadline is None else deadline - time.monotonic()
        if left <= 0:
            return False
        time.sleep(min(_POLL_EVERY, left))
    return True


def wait_for_nodes(core: Domain, names: list[str], seconds: float) -> None:
    """Wait until nodes of these full names are in the graph, with all that belongs to them.

    Raises:
        SessionError: If the session is private, or they do not come.
    """
    observer = core.graph_observer
    if observer is None:
        raise SessionError(
            "This session cannot see nodes of other processes.",
            "A session is private: no other process hears it, and it hears none.",
            "Join the domain of your terminals: "
            '`Session(domain_id=int(os.environ["ROS_DOMAIN_ID"]))`.',
        )
    wanted, looks = set(names), observer.looks()

    def are_there() -> bool:
        # A node's name, its publishers and its subscriptions come one after the other.
        unchanged = next(looks) >= _SAME_POLLS
        return unchanged and wanted <= set(core.graph().nodes) and observer.knows_all_names()

    try:
        poll(are_there, time.monotonic() + seconds)
    except KeyboardInterrupt as interrupt:
        show_briefly(interrupt, "you stopped waiting; the session keeps running.")
        raise
    seen = core.graph().nodes
    missing = [name for name in names if name not in seen]
    if missing:
        others = [name for name in seen if name not in missing]
        raise SessionError(
            f"{', '.join(missing)} {'is' if len(missing) == 1 else 'are'} not in the graph after "
            f"{seconds:g} s.",
            f"In domain {core.domain_id} the session sees: {', '.join(seen) or 'no node at all'}.",
            nearest(
                missing[0],
                others,
                "Start the node in a terminal, and check that it keeps running. Both sides need "
                "the same ROS_DOMAIN_ID.",
            ),
        )


# Messages that other processes publish, recorded when a node of the session gets them.
#
# A message tells when it was published and its number among the publisher's messages, and not by
# whom. So the session's own publishers note when they published what; all else came from another
# process. Its node is known if only one node outside publishes there.

#: The publishing node, as long as it cannot be told.
_UNKNOWN_PUBLISHER = "?"


class PublicationLog:
    """Record when a publisher of the session published each of its messages."""

    def __init__(self, publisher: Any) -> None:  # noqa: ANN401 - rclpy is untyped
        self._begins, self._ends = begins, ends = array("q"), array("q")
        send = publisher.publish

        def publish(msg: Any) -> None:  # noqa: ANN401 - a message of any type, or its bytes
            # Noted before it goes out: another thread may take it before `publish` has returned.
            begins.append(time.time_ns())
            try:
                send(msg)
            except BaseException:
                begins.pop()
                raise
            ends.append(time.time_ns())

        publisher.publish = publish

    def has(self, number: int, time_ns: int) -> bool:
        """Return whether the message of this number, from 1 on, was published at this time."""
        if not 0 < number <= len(self._begins) or time_ns < self._begins[number - 1]:
            return False
        return number > len(self._ends) or time_ns <= self._ends[number - 1]


class ExternalMessages:
    """Record the messages that come from other processes."""

    def __init__(self, observer: GraphObserver, recorder: Recorder, now: Callable[[], int]) -> None:
        self._observer, self._recorder, self._now = observer, recorder, now
        self._own: defaultdict[str, list[PublicationLog]] = defaultdict(list)
        self._known: set[tuple[str, int, int]] = set()
        self._channels: dict[tuple[str, str], Channel] = {}
        self._last: dict[str, str] = {}  # by topic: who published last
        self._memories: dict[str, Memory] = {}

    def watch_publisher(self, publisher: Publisher) -> None:
        """Recognize what this publisher of the session sends."""
        self._own[publisher.topic_name].append(PublicationLog(publisher))

    def watch_subscription(self, subscription: Subscription) -> None:
        """Record what arrives here from other processes, before the callback runs."""
        topic = subscription.topic_name
        if topic not in INFRASTRUCTURE_TOPICS:
            self._memories[topic] = Memory(subscription.msg_type)
            arrived = partial(self._record, topic)
            subscription.callback = _with_message_info(subscription, arrived)

    def topics(self) -> set[str]:
        """Return every topic on which a message from another process would be recorded."""
        return set(self._memories)

    def is_own(self, topic: str, info: dict[str, int]) -> bool:
        """Return whether a message that came on a topic was published by this session."""
        number, sent = info["publication_sequence_number"], info["source_timestamp"]
        return any(own.has(number, sent) for own in self._own[topic])

    def _record(self, topic: str, message: Message, info: dict[str, int]) -> None:
        if self.is_own(topic, info):
            return
        key = topic, info["publication_sequence_number"], info["source_timestamp"]
        with self._recorder.lock:
            if key in self._known:
                return  # another node of the session got it first
            self._known.add(key)
            copy = message if isinstance(message, bytes) else self._memories[topic].take(message)
            self._recorder.add_sample(self._channel(topic).number, self._now(), copy)

    def _channel(self, topic: str) -> Channel:
        outside = filter(self._observer.is_outside, self._observer.publishers(topic))
        # The name of a node comes some 0.1 s after its publisher, which may have left by now.
        names = {owner(one) for one in outside} or {self._last.get(topic, _UNKNOWN_PUBLISHER)}
        is_known = len(names) == 1 and not any(name.endswith(_UNKNOWN_NODE) for name in names)
        self._last[topic] = name = names.pop() if is_known else _UNKNOWN_PUBLISHER
        if (topic, name) not in self._channels:
            made = self._recorder.channel(topic, name, self._memories[topic])
            self._channels[topic, name] = made
        return self._channels[topic, name]


def _with_message_info(
    subscription: Subscription, arrived: Callable[[Any, dict[str, int]], None]
) -> Callable[..., Any]:
    """Return a callback that is given each message's info, and calls `arrived` first."""
    original = subscription.callback
    # rclpy looks once at what a callback takes, and keeps the answer in this attribute.
    wants_info = subscription._callback_type is Subscription.CallbackType.WithMessageInfo

    def call(message: Message, info: dict[str, int]) -> Any:  # noqa: ANN401 - the learner's callback's result
        arrived(message, info)
        return original(message, info) if wants_info else original(message)

    # Executors await what a coroutine function returns, and nothing else.
    async def call_later(message: Message, info: dict[str, int]) -> Any:  # noqa: ANN401 - the same
        coroutine: Coroutine[Any, Any, Any] = call(message, info)
        return await coroutine

    return call_later if iscoroutinefunction(original) else call
