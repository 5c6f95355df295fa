"""A session's eyes and hands for the instrument panel; see `rosbeat.panel.instruments`."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from functools import partial
from math import nan
from random import Random
from threading import RLock
from typing import TYPE_CHECKING, Any

import rclpy.utilities
from rclpy.context import Context
from rclpy.exceptions import InvalidHandle
from rclpy.node import Node
from rclpy.publisher import Publisher
from rclpy.timer import Timer

from rosbeat.errors import SessionError
from rosbeat.panel.instruments import NUMERIC_TYPES, Arrival, News
from rosbeat.records import GraphSnapshot
from rosbeat.ros.entities import NodeState
from rosbeat.ros.errors import no_such_node, node_has_ended, session_has_ended, session_is_not_live
from rosbeat.ros.launch import Maker, build_node
from rosbeat.ros.recording import message_class
from rosbeat.ros.world import World, find, state_of

if TYPE_CHECKING:
    from rosbeat.panel.panel import Panel


# The node through which the instrument panel publishes and keeps the executor busy.


NAME = "instrument_panel"


class Injector(Node):
    """Publishes numbers on topics, once or every second, and runs a slow callback if asked to.

    It is in the graph like any node, since a subscriber does hear it.

    Args:
        context: The session's context.
    """

    def __init__(self, context: Context) -> None:
        super().__init__(NAME, context=context, start_parameter_services=False)
        self._senders: dict[str, Any] = {}
        self._repeated: dict[str, float] = {}
        self._repeating: Timer | None = None
        self._busy: Timer | None = None
        self._busy_s = 0.0

    def send(self, topic: str, type_name: str, value: float) -> None:
        """Publish one number.

        Args:
            topic: Full name of the topic.
            type_name: Its type, one with a field `data` for a number.
            value: The number.
        """
        kind = message_class(type_name)
        if topic not in self._senders:
            self._senders[topic] = self.create_publisher(kind, topic, 10), kind
        publisher, kind = self._senders[topic]
        publisher.publish(kind(data=value))
        if topic in self._repeated:
            self._repeated[topic] = value

    def repeat(self, topic: str, value: float | None) -> None:
        """Publish a number every second on a topic of which `send` knows the type; None ends it."""
        if value is None:
            self._repeated.pop(topic, None)
        else:
            self._repeated[topic] = value
            self._repeating = self._repeating or self.create_timer(1.0, self._send_again)

    def load(self, milliseconds: float) -> None:
        """Run a callback for so long, once a second; 0 ends that."""
        self._busy_s = milliseconds / 1000
        if self._busy is None:
            self._busy = self.create_timer(1.0, self._work)

    def _send_again(self) -> None:
        for topic, value in list(self._repeated.items()):
            publisher, kind = self._senders[topic]
            publisher.publish(kind(data=value))

    def _work(self) -> None:
        # It holds the executor up as a computation does, and leaves the processor to the page.
        time.sleep(self._busy_s)


# Messages that go wrong on their way: lost, not a number, or off by so much.


class Disturbance:
    """What is wrong with the messages of one topic.

    It sits between a node and its publisher, outside of the recording: what is recorded is what
    really went out.

    Args:
        topic: Full name of the topic.

    Attributes:
        kind: `none`, `dropout`, `nan` or `offset`.
        amount: Of a dropout the share that is lost, in percent; of an offset what is added.
    """

    def __init__(self, topic: str) -> None:
        self.kind, self.amount = "none", 0.0
        self._topic = topic
        # Its own numbers, so that those which the nodes draw stay as they are.
        self._random = Random(0)
        self._before: dict[Publisher, Callable[[Any], None]] = {}

    def reach(self, publishers: Iterable[Publisher]) -> None:
        """Disturb these publishers, too, as far as they are on the topic."""
        for publisher in publishers:
            if publisher.topic_name == self._topic and publisher not in self._before:
                self._before[publisher] = publisher.publish
                publisher.publish = partial(self._publish, publisher.publish)

    def end(self) -> None:
        """Let every publisher publish as before."""
        self.kind = "none"
        for publisher, publish in self._before.items():
            publisher.publish = publish
        self._before.clear()

    def _publish(self, send: Callable[[Any], None], msg: Any) -> None:  # noqa: ANN401
        if self.kind == "dropout" and self._random.uniform(0, 100) < self.amount:
            return
        send(self._changed(msg))

    def _changed(self, msg: Any) -> Any:  # noqa: ANN401
        value = getattr(msg, "data", None)
        if not isinstance(value, float):  # bytes, or what rclpy refuses in its own words
            return msg
        if self.kind == "nan":
            return type(msg)(data=nan)
        return type(msg)(data=value + self.amount) if self.kind == "offset" else msg


#: Seconds after which the graph is looked at anew although no node has changed.
_FRESH = 1.0


def open_panel(world: World) -> Panel:
    """Open the panel of a session, in the place of one that is open."""
    from rosbeat.panel.panel import Panel  # it brings the widgets along, which few pages need

    if world.panel is not None:
        world.panel.close()
    world.panel = made = Panel(SessionInstruments(world))
    return made


class SessionInstruments:
    """What the panel sees of a session and does to it.

    Args:
        world: The session; the panel must not hold the `Session` itself, which ends when nobody
            else does.
    """

    def __init__(self, world: World) -> None:
        self._world = world
        # Clicks come in whichever thread the kernel has for them.
        self._lock = RLock()
        self._messages = self._logs = self._faults = 0
        self._stopped: dict[str, Maker] = {}
        self._disturbed: dict[str, Disturbance] = {}
        self._injector: Injector | None = None
        self._graph = GraphSnapshot()
        self._seen: tuple[Any, ...] = ()
        self._looked = 0.0

    # What happens.

    def now_ns(self) -> int:
        """Nanoseconds since the session began."""
        return self._world.now()

    def is_live(self) -> bool:
        """Whether the nodes run against the wall clock."""
        return self._world.live is not None

    def news(self) -> News:
        """What happened since this was last asked."""
        recorder = self._world.recorder
        self._messages, found = recorder.since(self._messages)
        logs, faults = recorder.logs[self._logs :], recorder.faults[self._faults :]
        self._logs, self._faults = self._logs + len(logs), self._faults + len(faults)
        arrivals = tuple(Arrival(count, newest) for _, count, newest in found)
        return News(arrivals, tuple(logs), tuple(faults))

    def graph(self) -> GraphSnapshot:
        """The nodes and topics; looked at anew when a node has changed, and every second."""
        seen = tuple(map(_outline, self._world.states()))
        if seen != self._seen or time.monotonic() - self._looked > _FRESH:
            try:
                self._graph = self._world.graph()
            except InvalidHandle:  # a node was destroyed meanwhile; the next look sees it gone
                return self._graph
            self._seen, self._looked = seen, time.monotonic()
            with self._lock:
                self._disturb_all()
        return self._graph

    def conditions(self) -> dict[str, str]:
        """For every node: `running`, `paused`, `stopped`, `ended` or `not added`, sorted by name.

        The panel's own node is not among them.
        """
        states = [one for one in self._world.states() if one.node is not self._injector]
        found = {state.name: _condition(state) for state in states}
        for name in found:  # somebody else may have made one anew
            self._stopped.pop(name, None)
        return dict(sorted({**dict.fromkeys(list(self._stopped), "stopped"), **found}.items()))

    # What the panel does.

    def pause(self, node: str) -> None:
        """Run none of a node's callbacks."""
        with self._acting():
            state = find(self._world, node)
            self._world.rest_node(state)
            state.paused = True

    def resume(self, node: str) -> None:
        """Run a paused node's callbacks again."""
        with self._acting():
            state = find(self._world, node)
            if state.ended:
                raise node_has_ended(state.name)
            self._world.spin_node(state)

    def stop(self, node: str) -> None:
        """Destroy a node, and remember how it was made."""
        with self._acting():
            state = find(self._world, node)
            self._stopped[state.name] = self._maker(state)
            self._world.destroy(state)

    def start(self, node: str) -> None:
        """Make a stopped or ended node again."""
        with self._acting():
            state = self._world.named(node)
            maker = self._maker(state) if state else self._stopped.get(node)
            if maker is None:
                raise no_such_node(node, list(self._stopped))
            self._require_home(node)
            with self._world.starting(maker.start):
                made = build_node(maker.make)
            self._world.makers[made] = maker
            self._world.spin_node(state_of(self._world, made))
            self._stopped.pop(node, None)

    def publish(self, topic: str, value: float) -> None:
        """Publish one number."""
        with self._acting():
            self._injecting().send(topic, self._numeric_type(topic), value)

    def repeat(self, topic: str, value: float | None) -> None:
        """Publish a number every second from now on; None ends that."""
        with self._acting():
            if value is not None:
                self._injecting().send(topic, self._numeric_type(topic), value)
            self._injecting().repeat(topic, value)

    def disturb(self, topic: str, kind: str, amount: float) -> None:
        """Let what nodes publish on a topic be wrong."""
        with self._acting():
            self._numeric_type(topic)
            disturbance = self._disturbed.setdefault(topic, Disturbance(topic))
            disturbance.kind, disturbance.amount = kind, amount
            self._disturb_all()

    def load(self, milliseconds: float) -> None:
        """Let a callback run for so long, once a second; 0 ends that."""
        with self._acting():
            self._injecting().load(milliseconds)

    def release(self) -> None:
        """Take away everything that the panel has added; stopped nodes stay stopped."""
        with self._lock:
            for disturbance in self._disturbed.values():
                disturbance.end()
            self._disturbed.clear()
            state = self._world.state_of(self._injector)
            if state is not None:
                self._world.destroy(state)
            self._injector = None

    # How it works.

    @contextmanager
    def _acting(self) -> Iterator[None]:
        with self._lock:
            if self._world.closed:
                raise session_has_ended()
            if not self.is_live():
                raise session_is_not_live()
            yield

    def _injecting(self) -> Injector:
        """The panel's own node, made when it is first needed."""
        if self._world.state_of(self._injector) is None:
            self._injector = Injector(self._world.context)
            self._world.spin_node(state_of(self._world, self._injector))
        assert self._injector is not None
        return self._injector

    def _numeric_type(self, topic: str) -> str:
        ends = [end for end in self._graph.endpoints if end.name == topic]
        kinds = [end.type_name for end in ends if end.type_name in NUMERIC_TYPES]
        if kinds:
            return kinds[0]
        raise SessionError(
            f"The panel cannot put a number on {topic}.",
            "Only topics of type Float32 or Float64 are in reach of its sliders.",
            "Choose another topic.",
        )

    def _disturb_all(self) -> None:
        for disturbance in self._disturbed.values():
            for state in self._world.states():
                if state.node is not None and state.node is not self._injector:
                    disturbance.reach(_publishers(state))

    def _maker(self, state: NodeState) -> Maker:
        """What made a node; its class, if a node was handed to `ros.add` ready-made."""
        assert state.node is not None
        return self._world.makers.get(state.node) or Maker(type(state.node))

    def _require_home(self, node: str) -> None:
        """A node names no context, so it would land in the session that was opened last."""
        if rclpy.utilities.g_default_context is not self._world.context:
            raise SessionError(
                f"{node} cannot be started now.",
                "Another session is open, and a new node would belong to that one.",
                "Close the other session first, or wait until the check that runs has ended.",
            )


def _publishers(state: NodeState) -> list[Publisher]:
    return list(state.node.publishers) if state.node else []


def _condition(state: NodeState) -> str:
    if state.ended or state.spinning:
        return "ended" if state.ended else "running"
    return "paused" if state.paused else "not added"


def _outline(state: NodeState) -> tuple[Any, ...]:
    """What is different when a node's part of the graph is."""
    return state.name, id(state.node), len(_publishers(state)), len(state.entries)
