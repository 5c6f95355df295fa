"""Gather the facts about a topic that `rosbeat.diagnosis` needs to explain it."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from functools import partial
from typing import Any

from rcl_interfaces.srv import GetParameters
from rclpy.context import Context
from rclpy.executors import SingleThreadedExecutor
from rclpy.impl.implementation_singleton import rclpy_implementation
from rclpy.node import Node
from rclpy.qos import QoSProfile, ReliabilityPolicy

from rosbeat.diagnosis.topic_snapshot import (
    BLOCKED,
    ENDED,
    NOT_ADDED,
    PAUSED,
    RUNNING,
    SILENT,
    Beat,
    Condition,
    OtherDomain,
    Scene,
    rate_of,
)
from rosbeat.domains import PRIVATE_IDS, SESSION_DOMAINS
from rosbeat.records import NANOSECONDS, GraphSnapshot, is_hidden
from rosbeat.ros.context import SESSION_ARGUMENTS
from rosbeat.ros.graph import GraphObserver, HiddenNode, domains_in_use, owner, poll
from rosbeat.ros.processes import NodeState
from rosbeat.ros.recording import message_class
from rosbeat.ros.session_core import SessionCore

#: A live callback that runs for so many seconds of wall time blocks the others.
_BLOCKING_SECONDS = 1.0
#: A rate is that of so many messages, the newest.
_NEWEST = 100


def inspect_topic(core: SessionCore, topic: str, seconds: float) -> Scene:
    """Return all that is known around a topic.

    In a domain with other processes, a hidden node listens to them, for so many seconds of wall
    time at most, and asks their nodes whether they run.
    """
    blocked = _blocked(core)
    observer = core.graph_observer
    if observer is not None:
        observer.wait_until_stable()
    graph = core.graph()
    external = _External() if observer is None else _listen(core, observer, topic, graph, seconds)
    with core.recorder.lock:
        messages = core.recorder.times(topic)
    states = core.states()
    other_domains, private_sessions = _elsewhere(core, topic, graph)
    return Scene(
        graph,
        core.now(),
        (
            *_publishers(core, topic, messages),
            *_subscriptions(core, topic, messages),
            *external.beats,
        ),
        (*blocked, *(_condition(core, state) for state in states), *external.conditions),
        external.rate_hz,
        frozenset(state.name for state in states),
        virtual=core.live is None,
        waiting=core.virtual.has_work,
        domain_id=-1 if observer is None else core.domain_id or 0,
        other_domains=other_domains,
        private_sessions=private_sessions,
    )


# The nodes of the session.


def _blocked(core: SessionCore) -> list[Condition]:
    """Return the node that holds up the one thread in which all live callbacks run, if any."""
    live = core.live
    if live is None or live.task is None:
        return []
    work, state = live.task, core.state_of(live.current)
    callback = core.recorder.newest_callback()
    if poll(lambda: live.task is not work, time.monotonic() + _BLOCKING_SECONDS):
        return []
    if state is None or callback is None:
        return []
    return [Condition(state.name, BLOCKED, callback=callback.name)]


def _condition(core: SessionCore, state: NodeState) -> Condition:
    if state.ended:
        faults = [one for one in core.recorder.faults if one.node == state.name]
        return Condition(state.name, ENDED, faults[-1] if faults else None)
    for call in state.process.calls:
        if call.wait is not None and call.wait.reported:  # as a deadlock
            return Condition(state.name, BLOCKED, callback=call.name)
    if state.spinning:
        return Condition(state.name, RUNNING)
    return Condition(state.name, PAUSED if state.paused else NOT_ADDED)


#: Messages of a topic: number among all of the session, who published, when in nanoseconds.
_Messages = list[tuple[int, str, int]]


def _publishers(core: SessionCore, topic: str, messages: _Messages) -> Iterator[Beat]:
    for state in core.states():
        counts = [tap.count for tap in state.taps if tap.topic == topic]
        if counts:
            number = sum(counts)
            # Of a node of this name that was replaced there may be more.
            times = [at for _, node, at in messages if node == state.name]
            times = times[-min(number, _NEWEST) :] if number else []
            last, watched = times[-1] if times else -1, core.now() - state.born_ns
            yield Beat(state.name, "publisher", number, last, rate_of(times), watched)


def _subscriptions(core: SessionCore, topic: str, messages: _Messages) -> Iterator[Beat]:
    for state in core.states():
        entries = [one for one in state.entries if (one.kind, one.name) == ("subscription", topic)]
        if entries:
            first = min(one.born for one in entries)
            missed = sum(number < first for number, _, _ in messages)
            yield Beat(
                state.name,
                "subscription",
                sum(one.calls for one in entries),
                max(core.recorder.last_run(one.label_number) for one in entries),
                watched_ns=core.now() - state.born_ns,
                missed=missed,
                since=len(messages) - missed,
            )


# The nodes of other processes: what arrives from them, and whether they answer.
#
# A node that is spun answers its own parameter service. One that is in the graph and does not
# answer runs no callbacks: it is not spun, or a callback does not return.


#: So many messages tell their rate, if they are not all in one burst; ten of each, if several nodes
#: publish, since it cannot be told which is whose.
_ENOUGH, _ENOUGH_OF_EACH, _AT_LEAST_SECONDS = 3, 10, 0.5
#: Others have so many seconds to react, and no less than so many turns of the executor: on a busy
#: machine time passes in which they could not.
_REACTION_SECONDS, _REACTION_TURNS = 2.0, 40
_TURN = 0.02
#: Seconds after which a request is sent again: an answer can be lost while the graph changes, as it
#: does just after another process was killed.
_RESEND = 0.4
_QUEUE = 1000

#: Runs the callbacks of a node for a turn.
_Spin = Callable[[], None]


@dataclass(frozen=True)
class _External:
    """What is known of other processes; the rate is that of messages which cannot be told apart."""

    beats: tuple[Beat, ...] = ()
    conditions: tuple[Condition, ...] = ()
    rate_hz: float = 0.0


def _listen(
    core: SessionCore, observer: GraphObserver, topic: str, graph: GraphSnapshot, seconds: float
) -> _External:
    def outside(endpoints: list[Any]) -> list[Any]:
        found = filter(observer.is_outside, endpoints)
        return [one for one in found if not is_hidden(owner(one))]

    publishers = outside(observer.publishers(topic))
    names = [owner(one) for one in publishers]
    both = dict.fromkeys([*names, *map(owner, outside(observer.subscriptions(topic)))])
    asked = [one for one in both if graph.on(f"{one}/get_parameters", "server")]
    stamps: tuple[int, ...] = ()
    span: float | None = None
    with _temporary_node(core.context) as (node, spin):
        services = {
            one: node.create_client(GetParameters, f"{one}/get_parameters") for one in asked
        }
        # Listen first: a callback that does not return may only begin meanwhile.
        if publishers and seconds:
            stamps, span = _receive(core, node, topic, publishers, seconds, spin)
        silent = _silent(services, spin)
    rate = rate_of(sorted(stamps))
    conditions = tuple(Condition(one, SILENT if one in silent else RUNNING) for one in asked)
    if span is None or (stamps and len(names) > 1):
        return _External((), conditions, rate)
    beat = partial(Beat, rate_hz=rate, watched_ns=round(span * NANOSECONDS))
    return _External(tuple(beat(one, "publisher", len(stamps)) for one in names), conditions)


@contextmanager
def _temporary_node(context: Context) -> Iterator[tuple[Node, _Spin]]:
    """Make a hidden node for a while, and what spins it."""
    node = HiddenNode(context)
    executor = SingleThreadedExecutor(context=context)
    executor.add_node(node)
    try:
        yield node, lambda: executor.spin_once(timeout_sec=_TURN)
    finally:
        executor.shutdown()
        node.destroy_node()


def _spin_until(spin: _Spin, done: Callable[[], object]) -> None:
    """Spin until something is true, or others have had time enough to react."""
    begin, turns = time.monotonic(), 0
    while not done():
        if turns >= _REACTION_TURNS and time.monotonic() - begin >= _REACTION_SECONDS:
            return
        spin()
        turns += 1


def _receive(
    core: SessionCore, node: Node, topic: str, publishers: list[Any], seconds: float, spin: _Spin
) -> tuple[tuple[int, ...], float | None]:
    """Return when each message was sent, and for how many seconds it listened.

    The latter is None if it could not be connected.
    """
    external = core.external_messages
    stamps: list[int] = []

    def arrived(_: bytes, info: dict[str, int]) -> None:
        if external is None or not external.is_own(topic, info):
            stamps.append(info["source_timestamp"])

    # Best effort and volatile fits whatever a publisher offers.
    qos = QoSProfile(depth=_QUEUE, reliability=ReliabilityPolicy.BEST_EFFORT)
    try:
        kind = message_class(publishers[0].topic_type)
        subscription = node.create_subscription(kind, topic, arrived, qos, raw=True)
    except (ImportError, AttributeError, ValueError, rclpy_implementation.RCLError):
        return (), None  # the type is unknown here, or this process knows another under the name
    _spin_until(spin, subscription.get_publisher_count)
    if not subscription.get_publisher_count():
        return (), None
    enough = _ENOUGH if len(publishers) < 2 else _ENOUGH_OF_EACH * len(publishers)
    begin, span = time.monotonic(), 0.0
    while span < seconds and not (span >= _AT_LEAST_SECONDS and len(stamps) >= enough):
        spin()
        span = time.monotonic() - begin
    return tuple(stamps), min(span, seconds)


def _silent(services: Mapping[str, Any], spin: _Spin) -> set[str]:
    """Ask nodes for none of their parameters, and return those that do not answer.

    A node that cannot be asked is believed to run. `services` has a client of each node's.
    """
    _spin_until(spin, lambda: all(one.service_is_ready() for one in services.values()))
    answers: dict[str, list[Any]] = {
        name: [] for name, one in services.items() if one.service_is_ready()
    }
    sent = -_RESEND

    def waiting() -> list[str]:
        return [name for name, found in answers.items() if not any(one.done() for one in found)]

    def all_have_answered() -> bool:
        nonlocal sent
        if time.monotonic() - sent >= _RESEND:
            sent = time.monotonic()
            for name in waiting():
                answers[name].append(services[name].call_async(GetParameters.Request()))
        return not waiting()

    _spin_until(spin, all_have_answered)
    return set(waiting())


# Who uses the topic in another ROS domain of this machine.


#: To look into one takes a part of a second.
_MOST_DOMAINS = 10


def _elsewhere(
    core: SessionCore, topic: str, graph: GraphSnapshot
) -> tuple[tuple[OtherDomain, ...], bool]:
    """Look into other domains, if a side is missing here and other processes matter at all.

    Domains of checks and builds are left alone: no node shall appear there. Private sessions cannot
    be looked into.

    Returns:
        The other domains, and whether other processes have private sessions.
    """
    publishers = graph.on(topic, "publisher")
    heard = graph.on(topic, "subscription") or any(end.matched > 0 for end in publishers)
    is_alone = core.graph_observer is None and core.live is None
    if is_alone or (publishers and heard):
        return (), False
    used = domains_in_use()
    apart = {core.domain_id, *PRIVATE_IDS, *SESSION_DOMAINS}
    shared = [number for number in used if number not in apart]
    found = tuple(_look_into(number, topic) for number in shared[:_MOST_DOMAINS])
    return found, any(number in SESSION_DOMAINS for number in used)


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
    return tuple(sorted({name for name in map(owner, endpoints) if not is_hidden(name)}))
