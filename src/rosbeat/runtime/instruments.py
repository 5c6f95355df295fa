"""A session's eyes and hands for the instrument panel; see `rosbeat.panel.instruments`."""

from __future__ import annotations

import time
from collections.abc import Iterator
from contextlib import contextmanager
from threading import RLock
from typing import TYPE_CHECKING, Any

import rclpy.utilities
from rclpy.exceptions import InvalidHandle
from rclpy.publisher import Publisher

from rosbeat.errors import SessionError
from rosbeat.panel.instruments import NUMERIC_TYPES, Arrival, News
from rosbeat.records import GraphSnapshot
from rosbeat.runtime import lookups, refusals
from rosbeat.runtime.construction import build_node
from rosbeat.runtime.disturbing import Disturbance
from rosbeat.runtime.entities import NodeState
from rosbeat.runtime.injector import Injector
from rosbeat.runtime.launch import Maker
from rosbeat.runtime.world import World

if TYPE_CHECKING:
    from rosbeat.panel.panel import Panel

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
            state = lookups.find(self._world, node)
            self._world.rest_node(state)
            state.paused = True

    def resume(self, node: str) -> None:
        """Run a paused node's callbacks again."""
        with self._acting():
            state = lookups.find(self._world, node)
            if state.ended:
                raise refusals.node_has_ended(state.name)
            self._world.spin_node(state)

    def stop(self, node: str) -> None:
        """Destroy a node, and remember how it was made."""
        with self._acting():
            state = lookups.find(self._world, node)
            self._stopped[state.name] = self._maker(state)
            self._world.destroy(state)

    def start(self, node: str) -> None:
        """Make a stopped or ended node again."""
        with self._acting():
            state = self._world.named(node)
            maker = self._maker(state) if state else self._stopped.get(node)
            if maker is None:
                raise refusals.no_such_node(node, list(self._stopped))
            self._require_home(node)
            with self._world.starting(maker.start):
                made = build_node(maker.make)
            self._world.makers[made] = maker
            self._world.spin_node(lookups.state_of(self._world, made))
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
                raise refusals.session_has_ended()
            if not self.is_live():
                raise refusals.session_is_not_live()
            yield

    def _injecting(self) -> Injector:
        """The panel's own node, made when it is first needed."""
        if self._world.state_of(self._injector) is None:
            self._injector = Injector(self._world.context)
            self._world.spin_node(lookups.state_of(self._world, self._injector))
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
