"""Listen to the nodes of other processes, in the session's domain and in others."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any

from rcl_interfaces.srv import GetParameters
from rclpy.context import Context
from rclpy.executors import SingleThreadedExecutor
from rclpy.impl.implementation_singleton import rclpy_implementation
from rclpy.node import Node
from rclpy.qos import QoSProfile, ReliabilityPolicy

from rosbeat.records import GraphSnapshot, is_hidden
from rosbeat.ros.context import SESSION_ARGUMENTS
from rosbeat.ros.graph import GraphObserver, HiddenNode, is_of_course, owner
from rosbeat.ros.recording import message_class
from rosbeat.ros.session_core import SessionCore

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
class Heard:
    """Hold what was heard of a topic from other processes.

    Attributes:
        publishers: Full names of the nodes that publish there, one for each publisher.
        stamps_ns: When each message that arrived was sent, ascending.
        span: For how many seconds it listened; None if it did not, or could not be connected.
        asked: The nodes on the topic that were asked whether they run.
        silent: Those of them that did not answer.
    """

    publishers: tuple[str, ...] = ()
    stamps_ns: tuple[int, ...] = ()
    span: float | None = None
    asked: tuple[str, ...] = ()
    silent: frozenset[str] = frozenset()


def listen(
    core: SessionCore, observer: GraphObserver, topic: str, graph: GraphSnapshot, seconds: float
) -> Heard:
    """Listen to other processes for so many seconds of wall time, and ask their nodes.

    Args:
        core: The state of the session, which has joined a domain.
        observer: What sees the other processes.
        topic: Full name of the topic.
        graph: The graph; it says which nodes can be asked.
        seconds: How long to listen at most.
    """

    def outside(endpoints: list[Any]) -> list[Any]:
        found = filter(observer.is_outside, endpoints)
        return [end for end in found if not is_of_course(owner(end))]

    publishers = outside(observer.publishers(topic))
    names = tuple(owner(end) for end in publishers)
    both = dict.fromkeys([*names, *map(owner, outside(observer.subscriptions(topic)))])
    asked = tuple(name for name in both if graph.on(f"{name}/get_parameters", "server"))
    stamps: tuple[int, ...] = ()
    span: float | None = None
    with _temporary_node(core.context) as (node, spin):
        services = {
            name: node.create_client(GetParameters, f"{name}/get_parameters") for name in asked
        }
        # Listen first: a callback that does not return may only begin meanwhile.
        if publishers and seconds:
            stamps, span = _receive(core, node, topic, publishers, seconds, spin)
        silent = _silent(services, spin)
    return Heard(names, tuple(sorted(stamps)), span, asked, frozenset(silent))


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


# Other ROS domains of this machine.


def look_into(domain_id: int, topic: str) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """Return which nodes of another domain publish on a topic, and which subscribe to it."""
    context = Context()
    context.init(SESSION_ARGUMENTS, domain_id=domain_id)
    observer = GraphObserver(context)
    try:
        observer.wait_until_stable()
        publishers, subscriptions = observer.publishers(topic), observer.subscriptions(topic)
        return _visible_owners(publishers), _visible_owners(subscriptions)
    finally:
        observer.destroy_node()
        context.try_shutdown()


def _visible_owners(endpoints: list[Any]) -> tuple[str, ...]:
    return tuple(sorted({name for name in map(owner, endpoints) if not is_hidden(name)}))
