"""Gathers what is known around a topic, so that `rosbeat.diagnosis` can explain it."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from typing import Any

from rcl_interfaces.srv import GetParameters
from rclpy.context import Context
from rclpy.executors import SingleThreadedExecutor
from rclpy.impl.implementation_singleton import rclpy_implementation
from rclpy.node import Node
from rclpy.qos import QoSProfile, ReliabilityPolicy

from rosbeat.diagnosis.situation import (
    BLOCKED,
    ENDED,
    NOT_ADDED,
    PAUSED,
    RUNNING,
    SILENT,
    Beat,
    Condition,
    Former,
    OtherDomain,
    Scene,
    rate_of,
)
from rosbeat.domains import PRIVATE_IDS
from rosbeat.records import NANOSECONDS, GraphSnapshot, is_hidden
from rosbeat.ros.context import SESSION_ARGUMENTS
from rosbeat.ros.entities import NodeState
from rosbeat.ros.graph import GraphObserver, HiddenNode, domains_in_use, owner, poll
from rosbeat.ros.recording import message_class
from rosbeat.ros.world import World

#: A live callback that runs for so many seconds of wall time blocks the others.
_BLOCKING_SECONDS = 1.0
#: A rate is that of so many messages, the newest.
_NEWEST = 100


def inspect_topic(world: World, topic: str, seconds: float) -> Scene:
    """Return all that is known around a topic.

    It takes no time in a private domain. In a domain with other processes, a hidden node listens to
    them for a while and asks their nodes whether they run.

    Args:
        world: The session.
        topic: The topic's full name.
        seconds: How long to listen to other processes at most, in seconds of wall time.
    """
    blocked = _blocked(world)
    observer = world.graph_observer
    if observer is not None:
        observer.wait_until_stable()
    graph = world.graph()
    external = _External() if observer is None else _listen(world, observer, topic, graph, seconds)
    messages = _Messages(world, topic)
    states = world.states()
    return Scene(
        graph,
        world.now(),
        (*_publishers(world, messages), *_subscriptions(world, messages), *external.beats),
        (*blocked, *(_condition(world, state) for state in states), *external.conditions),
        external.rate_hz,
        frozenset(state.name for state in states),
        virtual=world.live is None,
        waiting=world.virtual.has_work,
        domain_id=-1 if observer is None else world.domain_id or 0,
        former=_former(graph, messages),
        other_domains=_other_domains(world, topic, graph),
    )


# The nodes of the session.


def _blocked(world: World) -> list[Condition]:
    """Return the node that holds up the one thread in which all live callbacks run, if any."""
    live = world.live
    if live is None or live.at_work is None:
        return []
    work, state = live.at_work, world.state_of(live.current)
    callback = world.recorder.newest_callback()
    if poll(lambda: live.at_work is not work, time.monotonic() + _BLOCKING_SECONDS):
        return []
    if state is None or callback is None:
        return []
    return [Condition(state.name, BLOCKED, callback=callback.name)]


def _condition(world: World, state: NodeState) -> Condition:
    if state.ended:
        faults = [one for one in world.recorder.faults if one.node == state.name]
        return Condition(state.name, ENDED, faults[-1] if faults else None)
    if state.spinning:
        return Condition(state.name, RUNNING)
    return Condition(state.name, PAUSED if state.paused else NOT_ADDED)


class _Messages:
    """The messages of a topic so far.

    Args:
        world: The session.
        topic: The topic's full name.

    Attributes:
        topic: As above.
        nodes: Who has published, in order of their last messages.
    """

    def __init__(self, world: World, topic: str) -> None:
        self.topic = topic
        with world.recorder.lock:
            self._all = world.recorder.times(topic)
        last = {node: number for number, node, _ in self._all}
        self.nodes = sorted(last, key=lambda node: last[node])

    def __len__(self) -> int:
        return len(self._all)

    def times_of(self, node: str) -> list[int]:
        """Return when one node published, in nanoseconds since the session began."""
        return [at for _, name, at in self._all if name == node]

    def before(self, number: int) -> int:
        """Return how many came before the message of this number among all of the session."""
        return sum(one[0] < number for one in self._all)


def _publishers(world: World, messages: _Messages) -> Iterator[Beat]:
    for state in world.states():
        counts = [tap.count for tap in state.taps if tap.topic == messages.topic]
        if counts:
            number = sum(counts)
            # Of a node of this name that was replaced there may be more.
            times = messages.times_of(state.name)[-min(number, _NEWEST) :] if number else []
            last, watched = times[-1] if times else -1, world.now() - state.born_ns
            yield Beat(state.name, "publisher", number, last, rate_of(times), watched)


def _subscriptions(world: World, messages: _Messages) -> Iterator[Beat]:
    wanted = "subscription", messages.topic
    for state in world.states():
        entries = [one for one in state.entries if (one.kind, one.name) == wanted]
        if entries:
            missed = messages.before(min(one.born for one in entries))
            yield Beat(
                state.name,
                "subscription",
                sum(one.calls for one in entries),
                max(world.recorder.last_run(one.label_number) for one in entries),
                watched_ns=world.now() - state.born_ns,
                missed=missed,
                since=len(messages) - missed,
            )


def _former(graph: GraphSnapshot, messages: _Messages) -> tuple[Former, ...]:
    """Return who published before, if nobody does now."""
    if graph.on(messages.topic, "publisher"):
        return ()
    times = {node: messages.times_of(node) for node in messages.nodes}
    return tuple(Former(node, len(found), found[-1]) for node, found in times.items())


# The nodes of other processes: what arrives from them, and whether they answer.
#
# A node that is spun answers its own parameter service. One that is in the graph and does not
# answer runs no callbacks: it is not spun, or a callback does not return.


#: So many messages tell their rate, if they are not all in one burst; ten of each, if several nodes
#: publish, since it cannot be told which is whose.
_ENOUGH, _ENOUGH_OF_EACH, _AT_LEAST_SECONDS = 3, 10, 0.5
#: A node has so many seconds to answer, and no less than so many turns of the executor: on a busy
#: machine time passes in which it could not.
_ANSWER_SECONDS, _ANSWER_TURNS = 2.0, 40
_TURN = 0.02
#: Seconds after which a request is sent again.
_RESEND = 0.4
_QUEUE = 1000


@dataclass(frozen=True)
class _External:
    """What is known of other processes.

    Attributes:
        beats: The publishers there, as far as it is known which published what.
        conditions: Their nodes.
        rate_hz: Messages a second that cannot be told apart; 0 if there are none.
    """

    beats: tuple[Beat, ...] = ()
    conditions: tuple[Condition, ...] = ()
    rate_hz: float = 0.0


def _listen(
    world: World, observer: GraphObserver, topic: str, graph: GraphSnapshot, seconds: float
) -> _External:
    def outside(endpoints: list[Any]) -> list[Any]:
        found = filter(observer.is_outside, endpoints)
        return [one for one in found if not is_hidden(owner(one))]

    publishers = outside(observer.publishers(topic))
    names = [owner(one) for one in publishers]
    both = dict.fromkeys([*names, *map(owner, outside(observer.subscriptions(topic)))])
    with _temporary_node(world.context) as (node, spin):
        asked = [one for one in both if graph.on(f"{one}/get_parameters", "server")]
        requests = [_Request(node, one) for one in asked]
        listener = _Listener(seconds, len(publishers))
        if publishers and seconds:
            listener.subscribe(node, world, topic, publishers[0].topic_type)
        # Listen first: a callback that does not return may only begin meanwhile.
        while listener.is_waiting():
            spin()
        while sum(one.is_waiting() for one in requests):  # not `any`: all are asked at once
            spin()
    conditions = tuple(one.condition() for one in requests)
    rate = listener.rate() if len(names) > 1 else 0.0
    return _External(tuple(listener.beats(names)), conditions, rate)


@contextmanager
def _temporary_node(context: Context) -> Iterator[tuple[Node, Callable[[], None]]]:
    """Make a hidden node for a while, and what runs its callbacks for a turn."""
    node = HiddenNode(context)
    executor = SingleThreadedExecutor(context=context)
    executor.add_node(node)
    try:
        yield node, lambda: executor.spin_once(timeout_sec=_TURN)
    finally:
        executor.shutdown()
        node.destroy_node()


class _Patience:
    """Counts seconds and turns until both are used up."""

    def __init__(self) -> None:
        self._since, self._turns = time.monotonic(), 0

    def lasts(self) -> bool:
        """Count another turn; return whether it is worth taking."""
        self._turns += 1
        return self._turns <= _ANSWER_TURNS or time.monotonic() - self._since < _ANSWER_SECONDS


class _Request:
    """Asks a node for none of its parameters: whatever it answers, it runs.

    Args:
        client_node: The node that asks.
        node: Full name of the node that is asked.
    """

    def __init__(self, client_node: Node, node: str) -> None:
        self._node = node
        self._client = client_node.create_client(GetParameters, f"{node}/get_parameters")
        self._futures: list[Any] = []
        self._sent = 0.0
        self._patience: _Patience | None = None

    def is_waiting(self) -> bool:
        """Send the request when the node can be asked; return whether an answer may still come.

        It is sent again and again: an answer can be lost while the graph changes, as it does just
        after another process was killed.
        """
        now = time.monotonic()
        if self._client.service_is_ready() and now - self._sent > _RESEND:
            self._patience = self._patience if self._futures else None
            self._futures.append(self._client.call_async(GetParameters.Request()))
            self._sent = now
        self._patience = self._patience or _Patience()
        return not self._is_answered() and self._patience.lasts()

    def _is_answered(self) -> bool:
        return any(one.done() for one in self._futures)

    def condition(self) -> Condition:
        """Return how the node does; one that could not be asked is believed to run."""
        silent = self._futures and not self._is_answered()
        return Condition(self._node, SILENT if silent else RUNNING)


class _Listener:
    """Notes when messages of other processes on a topic were sent.

    Args:
        seconds: How long to listen at most, once it is connected.
        publishers: How many there are.
    """

    def __init__(self, seconds: float, publishers: int) -> None:
        self._seconds = seconds
        self._enough = _ENOUGH if publishers < 2 else _ENOUGH_OF_EACH * publishers
        self._subscription: Any = None
        self._stamps: list[int] = []
        self._connected: float | None = None
        self._patience = _Patience()

    def subscribe(self, node: Node, world: World, topic: str, type_name: str) -> None:
        """Begin to listen; best effort and volatile fits whatever a publisher offers."""
        external = world.external_messages

        def arrived(_: bytes, info: dict[str, int]) -> None:
            if external is None or not external.is_own(topic, info):
                self._stamps.append(info["source_timestamp"])

        qos = QoSProfile(depth=_QUEUE, reliability=ReliabilityPolicy.BEST_EFFORT)
        # The type may be unknown here, or this process knows another one under the topic's name.
        with suppress(ImportError, AttributeError, ValueError, rclpy_implementation.RCLError):
            kind = message_class(type_name)
            self._subscription = node.create_subscription(kind, topic, arrived, qos, raw=True)

    def is_waiting(self) -> bool:
        """Return whether more messages may come."""
        if self._subscription is None:
            return False
        if self._connected is None:
            if not self._subscription.get_publisher_count():
                return self._patience.lasts()
            self._connected = time.monotonic()
        span = self._span()
        enough = span >= _AT_LEAST_SECONDS and len(self._stamps) >= self._enough
        return span < self._seconds and not enough

    def _span(self) -> float:
        """Return for how long it has been connected, in seconds."""
        since = 0.0 if self._connected is None else time.monotonic() - self._connected
        return min(since, self._seconds)

    def rate(self) -> float:
        """Return the messages a second, by the clocks of their senders."""
        return rate_of(sorted(self._stamps))

    def beats(self, publishers: list[str]) -> Iterator[Beat]:
        """Return the heartbeats of these nodes; of several it cannot be told which published."""
        number = len(self._stamps)
        if self._connected is None or (number and len(publishers) > 1):
            return
        for node in publishers:
            span = round(self._span() * NANOSECONDS)
            yield Beat(node, "publisher", number, rate_hz=self.rate(), watched_ns=span)


# Who uses the topic in another ROS domain of this machine.


#: Each takes a part of a second.
_MOST_DOMAINS = 10


def _other_domains(world: World, topic: str, graph: GraphSnapshot) -> tuple[OtherDomain, ...]:
    """Look into other domains, if a side is missing here and other processes matter at all.

    The private domains of sessions are named and not looked into: no node shall appear there.
    """
    publishers = graph.on(topic, "publisher")
    heard = graph.on(topic, "subscription") or any(end.matched > 0 for end in publishers)
    is_alone = world.graph_observer is None and world.live is None
    if is_alone or (publishers and heard):
        return ()
    used = [number for number in domains_in_use() if number != (world.domain_id or 0)]
    shared = [number for number in used if number not in PRIVATE_IDS]
    private = [OtherDomain(number, private=True) for number in used if number in PRIVATE_IDS]
    return (*(_look_into(number, topic) for number in shared[:_MOST_DOMAINS]), *private)


def _look_into(domain_id: int, topic: str) -> OtherDomain:
    context = Context()
    context.init(SESSION_ARGUMENTS, domain_id=domain_id)
    observer = GraphObserver(context)
    try:
        observer.wait_until_stable()
        publishers, subscriptions = observer.publishers(topic), observer.subscriptions(topic)
        return OtherDomain(domain_id, _visible_owners(publishers), _visible_owners(subscriptions))
    finally:
        observer.destroy_node()
        context.try_shutdown()


def _visible_owners(endpoints: list[Any]) -> tuple[str, ...]:
    names = {owner(one) for one in endpoints}
    return tuple(sorted(name for name in names if not is_hidden(name)))
