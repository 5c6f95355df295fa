"""Listening to other processes: what arrives, and whether their nodes answer.

A node that is spun answers its own parameter service. One that is in the graph and does not answer
runs no callbacks: it is not spun, or a callback does not return.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from importlib import import_module
from os import getpid
from typing import Any

from rcl_interfaces.srv import GetParameters
from rclpy.context import Context
from rclpy.executors import SingleThreadedExecutor
from rclpy.impl.implementation_singleton import rclpy_implementation
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.qos import QoSProfile, ReliabilityPolicy

from rosbeat.diagnosis.situation import RUNNING, SILENT, Beat, Condition, rate_of
from rosbeat.records import NANOSECONDS, GraphSnapshot, is_hidden
from rosbeat.runtime.hooks import Unwatched
from rosbeat.runtime.lookout import Lookout, owner
from rosbeat.runtime.world import World

#: So many messages say how often they come, if they are not all in one burst; ten of each, if
#: several nodes publish, since nobody knows which is whose.
_ENOUGH, _ENOUGH_OF_EACH, _AT_LEAST = 3, 10, 0.5
#: A node has so many seconds to answer, and no less than so many turns of ours: on a busy machine
#: time passes in which nobody could.
_PATIENCE, _TURNS = 2.0, 40
_TURN = 0.02
#: Seconds after which a question is asked again.
_ASK_AGAIN = 0.4
_QUEUE = 1000


@dataclass(frozen=True)
class Heard:
    """What came from other processes.

    Attributes:
        beats: The publishers there, as far as it is known who published what.
        conditions: Their nodes.
        rate_hz: Messages a second that cannot be told apart; 0 if there are none.
    """

    beats: tuple[Beat, ...] = ()
    conditions: tuple[Condition, ...] = ()
    rate_hz: float = 0.0


def listen(world: World, topic: str, graph: GraphSnapshot, seconds: float) -> Heard:
    """Listen to the other processes on a topic, if the session is in a domain with others.

    Args:
        world: The session.
        topic: The topic's full name.
        graph: The graph.
        seconds: How long to listen at most, in seconds of wall time.
    """
    lookout = world.lookout
    if lookout is None:
        return Heard()
    publishers = [one for one in lookout.publishers(topic) if _counts(one, lookout)]
    listeners = [one for one in lookout.subscriptions(topic) if _counts(one, lookout)]
    names = dict.fromkeys(owner(one) for one in (*publishers, *listeners))
    with _visitor(world) as (node, turn):
        asked = [one for one in names if _has_parameters(one, graph)]
        questions = [_Question(node, one) for one in asked]
        ear = _ear(world, node, topic, publishers, seconds)
        _run(turn, ear, questions)
    found = [owner(one) for one in publishers]
    return Heard(tuple(ear.beats(found)), tuple(q.condition() for q in questions),
                 ear.rate() if len(found) > 1 else 0.0)  # fmt: skip


def _counts(endpoint: Any, lookout: Lookout) -> bool:  # noqa: ANN401 - rclpy's TopicEndpointInfo
    return lookout.is_outside(endpoint) and not is_hidden(owner(endpoint))


def _has_parameters(node: str, graph: GraphSnapshot) -> bool:
    return bool(graph.on(f"{node}/get_parameters", "server"))


class _Visitor(Unwatched, Node):
    """A hidden node that comes and goes: it asks and listens."""

    def __init__(self, context: Context) -> None:
        super().__init__(
            f"_rosbeat_{getpid()}_ear",
            context=context,
            enable_rosout=False,
            start_parameter_services=False,
            parameter_overrides=[Parameter("start_type_description_service", value=False)],
        )


@contextmanager
def _visitor(world: World) -> Iterator[tuple[Node, Callable[[], None]]]:
    """A node in the session's context, and what lets its callbacks run for a turn."""
    node = _Visitor(world.context)
    executor = SingleThreadedExecutor(context=world.context)
    executor.add_node(node)
    try:
        yield node, lambda: executor.spin_once(timeout_sec=_TURN)
    finally:
        executor.shutdown()
        node.destroy_node()


def _run(turn: Callable[[], None], ear: _Ear, questions: list[_Question]) -> None:
    """Listen first: a callback that does not return may only begin meanwhile."""
    while ear.waits():
        turn()
    while sum(one.waits() for one in questions):  # not `any`: all are asked at once
        turn()


class _Patience:
    """Counts seconds and turns until both are used up."""

    def __init__(self) -> None:
        self._since, self._turns = time.monotonic(), 0

    def lasts(self) -> bool:
        """Whether it is worth another turn."""
        self._turns += 1
        return self._turns <= _TURNS or time.monotonic() - self._since < _PATIENCE


class _Question:
    """Asks a node for none of its parameters: whatever it answers, it runs.

    Args:
        visitor: Who asks.
        node: Full name of the node that is asked.
    """

    def __init__(self, visitor: Node, node: str) -> None:
        self._node = node
        self._client = visitor.create_client(GetParameters, f"{node}/get_parameters")
        self._futures: list[Any] = []
        self._asked = 0.0
        self._patience: _Patience | None = None

    def waits(self) -> bool:
        """Ask as soon as the node can be asked; whether an answer may still come.

        It is asked again and again: an answer can be lost while the graph changes, as it does just
        after another process was killed.
        """
        now = time.monotonic()
        if self._client.service_is_ready() and now - self._asked > _ASK_AGAIN:
            self._patience = self._patience if self._futures else None
            self._futures.append(self._client.call_async(GetParameters.Request()))
            self._asked = now
        self._patience = self._patience or _Patience()
        return not self._answered() and self._patience.lasts()

    def _answered(self) -> bool:
        return any(one.done() for one in self._futures)

    def condition(self) -> Condition:
        """How the node does; one that could not be asked is believed to run."""
        silent = self._futures and not self._answered()
        return Condition(self._node, SILENT if silent else RUNNING)


class _Ear:
    """Hears what comes from outside on a topic, and forgets what it was.

    Args:
        visitor: Who listens.
        seconds: How long to listen at most, once it is connected.
        publishers: How many there are.
    """

    def __init__(self, visitor: Node, seconds: float, publishers: int) -> None:
        self._visitor, self._seconds = visitor, seconds
        self._enough = _ENOUGH if publishers < 2 else _ENOUGH_OF_EACH * publishers
        self._subscription: Any = None
        self._stamps: list[int] = []
        self._connected: float | None = None
        self._patience = _Patience()

    def open(self, kind: type, topic: str, is_own: Callable[[dict[str, int]], bool]) -> None:
        """Begin to listen; best effort and volatile fits whatever a publisher offers."""

        def arrived(_: bytes, info: dict[str, int]) -> None:
            if not is_own(info):
                self._stamps.append(info["source_timestamp"])

        qos = QoSProfile(depth=_QUEUE, reliability=ReliabilityPolicy.BEST_EFFORT)
        # Refused if this process knows another type under this name; then nobody listens.
        with suppress(rclpy_implementation.RCLError):
            self._subscription = self._visitor.create_subscription(
                kind, topic, arrived, qos, raw=True
            )

    def waits(self) -> bool:
        """Whether there may be more to hear."""
        if self._subscription is None:
            return False
        if self._connected is None:
            if not self._subscription.get_publisher_count():
                return self._patience.lasts()
            self._connected = time.monotonic()
        span = self.span()
        return span < self._seconds and not (
            span >= _AT_LEAST and len(self._stamps) >= self._enough
        )

    def span(self) -> float:
        """For how long it has been connected, in seconds."""
        since = 0.0 if self._connected is None else time.monotonic() - self._connected
        return min(since, self._seconds)

    def rate(self) -> float:
        """Messages a second, by the clocks of those who sent them."""
        return rate_of(sorted(self._stamps))

    def beats(self, publishers: list[str]) -> Iterator[Beat]:
        """The heartbeats of these nodes; of several who publish, nobody knows which it was."""
        number = len(self._stamps)
        if self._connected is None or (number and len(publishers) > 1):
            return
        for node in publishers:
            span = round(self.span() * NANOSECONDS)
            yield Beat(node, "publisher", number, rate_hz=self.rate(), watched_ns=span)


def _ear(world: World, visitor: Node, topic: str, publishers: list[Any], seconds: float) -> _Ear:
    ear = _Ear(visitor, seconds, len(publishers))
    kind = _message_class(publishers[0].topic_type) if publishers and seconds else None
    arrivals = world.arrivals
    if kind is not None and arrivals is not None:
        ear.open(kind, topic, lambda info: arrivals.is_own(topic, info))
    return ear


def _message_class(name: str) -> type | None:
    """The class of a type such as `std_msgs/msg/Float32`; None if it is not known here."""
    module, _, message = name.rpartition("/")
    try:
        found = getattr(import_module(module.replace("/", ".")), message, None)
    except (ImportError, ValueError):
        return None
    return found if isinstance(found, type) else None
