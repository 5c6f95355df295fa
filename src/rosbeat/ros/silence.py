"""Why nothing arrives: what is known around a topic, gathered for an explanation."""

from __future__ import annotations

import os
import signal
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass, replace
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

from rosbeat.diagnosis.explanation import Explanation, explain
from rosbeat.diagnosis.explanation_links import sides_of
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
    StaleBuild,
    rate_of,
)
from rosbeat.domains import PRIVATE_IDS
from rosbeat.errors import CommandError, SessionError
from rosbeat.records import NANOSECONDS, GraphSnapshot, is_hidden
from rosbeat.ros.context import SESSION_ARGUMENTS, show_briefly
from rosbeat.ros.entities import NodeState
from rosbeat.ros.errors import duration_ns
from rosbeat.ros.graph import Lookout, domains_in_use, owner, poll, settle
from rosbeat.ros.recording import Unwatched
from rosbeat.ros.world import World, full_topic

# Listening to other processes: what arrives, and whether their nodes answer.
#
# A node that is spun answers its own parameter service. One that is in the graph and does not
# answer runs no callbacks: it is not spun, or a callback does not return.


#: So many messages say how often they come, if they are not all in one burst; ten of each, if
#: several nodes publish, since nobody knows which is whose.
_ENOUGH, _ENOUGH_OF_EACH, _AT_LEAST = 3, 10, 0.5
#: A node has so many seconds to answer, and no less than so many turns of ours: on a busy machine
#: time passes in which nobody could.
_LISTEN_SECONDS, _TURNS = 2.0, 40
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
        return self._turns <= _TURNS or time.monotonic() - self._since < _LISTEN_SECONDS


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


# Who uses a topic in another ROS domain of this machine.


#: Each takes a part of a second.
_AT_MOST = 10


def others(topic: str, domain_id: int) -> tuple[OtherDomain, ...]:
    """Look for a topic in the other domains in which somebody takes part.

    The private domains of sessions are named and not looked into: nobody shall appear there.

    Args:
        topic: The topic's full name.
        domain_id: The domain that is not another one.
    """
    used = [number for number in domains_in_use() if number != domain_id]
    shared = [number for number in used if number not in PRIVATE_IDS]
    private = [OtherDomain(number, private=True) for number in used if number in PRIVATE_IDS]
    return (*(_look_into(number, topic) for number in shared[:_AT_MOST]), *private)


def _look_into(domain_id: int, topic: str) -> OtherDomain:
    with _visit(domain_id) as lookout:
        settle(lookout, domain_id)
        publishers = {owner(one) for one in lookout.publishers(topic)}
        subscriptions = {owner(one) for one in lookout.subscriptions(topic)}
    return OtherDomain(domain_id, _visible(publishers), _visible(subscriptions))


def _visible(names: set[str]) -> tuple[str, ...]:
    return tuple(sorted(name for name in names if not is_hidden(name)))


@contextmanager
def _visit(domain_id: int) -> Iterator[Lookout]:
    context = Context()
    context.init(SESSION_ARGUMENTS, domain_id=domain_id)
    lookout = Lookout(context)
    try:
        yield lookout
    finally:
        lookout.destroy_node()
        context.try_shutdown()


# What a session can see around a topic, so that it can be explained.


#: A callback that runs for so many seconds of wall time does not return.
_PATIENCE = 1.0
#: A rate is that of so many messages, the newest.
_NEWEST = 100


def explained(world: World, topic: Any, seconds: Any) -> Explanation:  # noqa: ANN401 - unchecked
    """Say why nothing arrives on a topic of a session, or that all is well.

    Args:
        world: The session.
        topic: The topic's name, with or without its slash.
        seconds: How long to listen to other processes at most, in seconds of wall time.

    Raises:
        DurationError: If `seconds` is not a number from 0 up.
        SessionError: If `topic` cannot be the name of a topic.
    """
    name = full_topic("explain", topic)
    span = duration_ns(seconds, "explain(seconds=...)") / 1e9
    try:
        return explain(name, look(world, name, span))
    except KeyboardInterrupt as interrupt:
        show_briefly(interrupt, "you stopped the looking; the session goes on.")
        raise


def look(world: World, topic: str, seconds: float) -> Scene:
    """Look at all that happens around a topic.

    Args:
        world: The session.
        topic: The topic's full name.
        seconds: How long to listen to other processes at most, in seconds of wall time.
    """
    busy = list(_busy(world))
    if world.lookout is not None:
        settle(world.lookout, world.domain_id or 0)
    graph = world.graph()
    heard = listen(world, topic, graph, seconds)
    past = _past(world, topic)
    return Scene(
        graph,
        world.now(),
        (*_publishers(world, topic, past), *_subscriptions(world, topic, past), *heard.beats),
        (*busy, *(_condition(world, state) for state in world.states()), *heard.conditions),
        heard.rate_hz,
        frozenset(state.name for state in world.states()),
        virtual=world.live is None,
        waiting=world.virtual.has_work,
        domain_id=-1 if world.lookout is None else world.domain_id or 0,
        former=tuple(_former(graph, topic, past))[::-1],
        other_domains=_elsewhere(world, topic, graph),
    )


# The nodes of the session.


def _busy(world: World) -> Iterator[Condition]:
    """Whoever holds up the one thread in which all callbacks run live."""
    live = world.live
    if live is None or live.at_work is None:
        return
    work, state = live.at_work, world.state_of(live.current)
    name = world.recorder.newest_callback()
    if poll(lambda: live.at_work is not work, time.monotonic() + _PATIENCE):
        return
    if state is not None and name is not None:
        yield Condition(state.name, BLOCKED, callback=name.name)


def _condition(world: World, state: NodeState) -> Condition:
    if state.ended:
        faults = [one for one in world.recorder.faults if one.node == state.name]
        return Condition(state.name, ENDED, faults[-1] if faults else None)
    if state.spinning:
        return Condition(state.name, RUNNING)
    return Condition(state.name, PAUSED if state.paused else NOT_ADDED)


@dataclass(frozen=True)
class _Past:
    """The messages of a topic so far: number among all, who published, when in nanoseconds."""

    messages: list[tuple[int, str, int]]

    def of(self, node: str) -> list[int]:
        """When one node published."""
        return [at for _, name, at in self.messages if name == node]

    def before(self, number: int) -> int:
        """How many came before all that have this number or a higher one."""
        return sum(one[0] < number for one in self.messages)


def _past(world: World, topic: str) -> _Past:
    with world.recorder.lock:
        return _Past(world.recorder.times(topic))


def _publishers(world: World, topic: str, past: _Past) -> Iterator[Beat]:
    for state in world.states():
        counts = [tap.count for tap in state.taps if tap.topic == topic]
        if counts:
            times = past.of(state.name)[-min(sum(counts), _NEWEST) :] if sum(counts) else []
            yield Beat(
                state.name,
                "publisher",
                sum(counts),
                times[-1] if times else -1,
                rate_of(times),
                world.now() - state.born_ns,
            )


def _subscriptions(world: World, topic: str, past: _Past) -> Iterator[Beat]:
    for state in world.states():
        entries = [one for one in state.entries if (one.kind, one.name) == ("subscription", topic)]
        if entries:
            missed = past.before(min(one.born for one in entries))
            last = max(world.recorder.last_run(one.label_number) for one in entries)
            yield Beat(
                state.name,
                "subscription",
                sum(one.calls for one in entries),
                last,
                watched_ns=world.now() - state.born_ns,
                missed=missed,
                since=len(past.messages) - missed,
            )


def _former(graph: GraphSnapshot, topic: str, past: _Past) -> Iterator[Former]:
    """Who published before, if nobody does now; the last one last."""
    if graph.on(topic, "publisher"):
        return
    for node in dict.fromkeys(name for _, name, _ in reversed(past.messages)):
        times = past.of(node)
        yield Former(node, len(times), times[-1])


def _elsewhere(world: World, topic: str, graph: GraphSnapshot) -> tuple[OtherDomain, ...]:
    """Other domains, if something is missing here and other processes matter at all."""
    if world.lookout is None and world.live is None:
        return ()
    if not sides_of(topic, graph).missing:
        return ()
    return others(topic, world.domain_id or 0)


# Why nothing arrives, asked in a terminal: the nodes are other processes in its ROS domain.


#: The last domain id that there is (RTPS specification, section 9.6.1).
_LAST_DOMAIN = 232
_CLEAR = "\r\x1b[K"


def explain_domain(
    topic: str,
    domain_id: int | None,
    seconds: float,
    stale_builds: Callable[[str], tuple[StaleBuild, ...]],
) -> Explanation:
    """Say why nothing arrives on a topic in a domain, as a node that comes and goes.

    While it looks, a terminal shows one line on the standard error stream.

    Args:
        topic: The topic's name, with or without its slash.
        domain_id: The domain; None for the terminal's own.
        seconds: How long to listen at most, in seconds of wall time.
        stale_builds: Says of a topic which programs that name it were edited and not built again.

    Raises:
        CommandError: If one of them cannot be used.
    """
    name, span = _checked(topic, seconds)
    domain = _domain(domain_id)
    with _ended_gently(), _progress(f"Looking at {name} in ROS domain {domain} ..."):
        world = World(0, domain)
        try:
            scene = look(world, name, span)
        finally:
            world.close()
    return explain(name, replace(scene, stale_builds=stale_builds(name)))


def _checked(topic: str, seconds: float) -> tuple[str, float]:
    try:
        return full_topic("explain", topic), duration_ns(seconds, "--seconds") / 1e9
    except SessionError as error:
        raise CommandError(error.what, error.means, error.to_try) from None


def _domain(given: int | None) -> int:
    text = os.environ.get("ROS_DOMAIN_ID") or "0"
    asked: Any = given if given is not None else text
    number = int(asked) if str(asked).isdecimal() and str(asked).isascii() else -1
    if 0 <= number <= _LAST_DOMAIN:
        return number
    source = "--domain-id" if given is not None else "ROS_DOMAIN_ID"
    raise CommandError(
        f"{source} is {asked!r}, which is no domain id.",
        f"It says which processes see each other, and is a whole number from 0 to {_LAST_DOMAIN}.",
        "Look at the number of the node's terminal: `echo $ROS_DOMAIN_ID`.",
    )


@contextmanager
def _ended_gently() -> Iterator[None]:
    """Let SIGTERM do what Ctrl+C does: others would see a node that was killed for 20 s."""
    before = signal.signal(signal.SIGTERM, signal.default_int_handler)
    try:
        yield
    finally:
        signal.signal(signal.SIGTERM, before)


@contextmanager
def _progress(text: str) -> Iterator[None]:
    if not sys.stderr.isatty():
        yield
        return
    try:  # an interrupt may come as soon as somebody can read the line
        print(text, end="", file=sys.stderr, flush=True)
        yield
    finally:
        print(_CLEAR, end="", file=sys.stderr, flush=True)
