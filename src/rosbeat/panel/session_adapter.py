"""Connect the panel to a session: read its state, and carry out clicks.

Nothing else in this folder knows ROS.
"""

from __future__ import annotations

import time
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from math import isfinite
from threading import RLock
from typing import TYPE_CHECKING, Any

from rosbeat.errors import RosbeatError, SessionError
from rosbeat.panel.sampling import NUMERIC_TYPES, News
from rosbeat.records import GraphSnapshot
from rosbeat.ros.errors import no_such_node, session_has_ended, session_is_not_live
from rosbeat.ros.launch import Maker
from rosbeat.ros.session_core import SessionCore
from rosbeat.ros.test_nodes import Injector, TopicFault

if TYPE_CHECKING:
    from rosbeat.ros.processes import NodeState

#: What a fault does to the messages of a topic.
FAULTS = ("none", "dropout", "nan", "offset")
#: The longest callback that the slider offers, in milliseconds.
LONGEST_LOAD = 900.0
#: Seconds after which the graph is looked at anew although no node has changed.
_FRESH = 1.0


class SessionInstruments:
    """Connect the panel to a session: show its state and act on it.

    Every method may be called from any thread. Names of nodes and topics are full names. The
    methods that change something raise `RosbeatError` if they cannot.

    Args:
        core: The session's state. The panel must not hold a reference to the `Session` itself,
            which closes when nothing else refers to it.
    """

    def __init__(self, core: SessionCore) -> None:
        self._core = core
        # Clicks come in whichever thread the kernel has for them.
        self._lock = RLock()
        self._messages = self._logs = self._faults = 0
        self._stopped: dict[str, Maker] = {}
        self._topic_faults: dict[str, TopicFault] = {}
        self._injector: Injector | None = None
        self._graph = GraphSnapshot()
        self._outline: list[Any] = []
        self._looked = 0.0

    # What happens.

    def now_ns(self) -> int:
        """Return the nanoseconds since the session began."""
        return self._core.now()

    def is_live(self) -> bool:
        """Return whether the nodes run against the wall clock."""
        return self._core.live is not None

    def news(self) -> News:
        """Return what happened since this was last asked."""
        recorder = self._core.recorder
        self._messages, found = recorder.since(self._messages)
        logs, faults = recorder.logs[self._logs :], recorder.faults[self._faults :]
        self._logs, self._faults = self._logs + len(logs), self._faults + len(faults)
        arrivals = tuple((count, newest) for _, count, newest in found)
        return News(arrivals, tuple(logs), tuple(faults))

    def graph(self) -> GraphSnapshot:
        """Return the graph; looked at anew when a node has changed, and every second."""
        outline = [
            (one.name, id(one.node), len(_publishers(one)), len(one.entries))
            for one in self._core.nodes.states()
        ]
        if outline != self._outline or time.monotonic() - self._looked > _FRESH:
            self._graph = self._core.graph()
            self._outline, self._looked = outline, time.monotonic()
            with self._lock:
                self._apply_faults()
        return self._graph

    def conditions(self) -> dict[str, str]:
        """Return `running`, `paused`, `stopped`, `ended` or `not added` for every node, by name.

        The panel's own node is not among them.
        """
        states = [one for one in self._core.nodes.states() if one.node is not self._injector]
        found = {state.name: _condition(state) for state in states}
        for name in found:  # the page may have made one anew
            self._stopped.pop(name, None)
        return dict(sorted({**dict.fromkeys(list(self._stopped), "stopped"), **found}.items()))

    # What the panel does.

    def pause(self, node: str) -> None:
        """Run none of a node's callbacks."""
        with self._acting():
            self._core.lives.pause(node)

    def resume(self, node: str) -> None:
        """Run a paused node's callbacks again."""
        with self._acting():
            self._core.lives.resume(node)

    def stop(self, node: str) -> None:
        """Destroy a node, and remember how it was made."""
        with self._acting():
            state = self._core.nodes.find(node)
            self._stopped[state.name] = self._maker(state)
            self._core.lives.destroy(state)

    def start(self, node: str) -> None:
        """Make a stopped or ended node again."""
        with self._acting():
            state = self._core.nodes.named(node)
            maker = self._maker(state) if state else self._stopped.get(node)
            if maker is None:
                raise no_such_node(node, list(self._stopped))
            self._core.lives.restart(node, maker)
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
        """Inject one of the `FAULTS` into what nodes publish on a topic."""
        with self._acting():
            self._numeric_type(topic)
            fault = self._topic_faults.setdefault(topic, TopicFault(topic))
            fault.kind, fault.amount = kind, amount
            self._apply_faults()

    def load(self, milliseconds: float) -> None:
        """Run a callback for so long, once a second; 0 ends that."""
        with self._acting():
            self._injecting().load(milliseconds)

    def release(self) -> None:
        """Take away everything that the panel has added; stopped nodes stay stopped."""
        with self._lock:
            for fault in self._topic_faults.values():
                fault.remove()
            self._topic_faults.clear()
            state = self._core.nodes.state_of(self._injector)
            if state is not None:
                self._core.lives.destroy(state)
            self._injector = None

    # How it works.

    @contextmanager
    def _acting(self) -> Iterator[None]:
        with self._lock:
            if self._core.closed:
                raise session_has_ended()
            if not self.is_live():
                raise session_is_not_live()
            yield

    def _injecting(self) -> Injector:
        """Return the panel's own node, made when it is first needed."""
        if self._core.nodes.state_of(self._injector) is None:
            self._injector = Injector(self._core.context)
            self._core.lives.spin_node(self._core.nodes.member(self._injector))
        assert self._injector is not None
        return self._injector

    def _numeric_type(self, topic: str) -> str:
        for end in self._graph.endpoints:
            if end.name == topic and end.type_name in NUMERIC_TYPES:
                return end.type_name
        raise SessionError(
            f"The panel cannot put a number on {topic}.",
            "Only topics of type Float32 or Float64 are in reach of its sliders.",
            "Choose another topic.",
        )

    def _apply_faults(self) -> None:
        for fault in self._topic_faults.values():
            for state in self._core.nodes.states():
                if state.node is not self._injector:
                    fault.apply(_publishers(state))

    def _maker(self, state: NodeState) -> Maker:
        """Return what made a node; its class, if a node was handed to `ros.add` ready-made."""
        return self._core.makers.get(state.node) or Maker(type(state.node))


def _publishers(state: NodeState) -> list[Any]:
    return list(state.node.publishers)


def _condition(state: NodeState) -> str:
    if state.ended or state.spinning:
        return "ended" if state.ended else "running"
    return "paused" if state.paused else "not added"


# Clicks.


def carry_out(order: Mapping[str, Any], instruments: SessionInstruments) -> str:
    """Do what the browser asked for.

    Args:
        order: `do` names what; the rest depends on it.
        instruments: The session.

    Returns:
        Empty, or what the person who clicked should read.
    """
    try:
        _act(order, instruments)
    except RosbeatError as error:
        return " ".join(filter(None, (error.what, error.to_try)))
    return ""


def _act(order: Mapping[str, Any], instruments: SessionInstruments) -> None:
    match order:
        case {"do": "pause" | "resume" | "stop" | "start" as action, "node": str(node)}:
            getattr(instruments, action)(node)
        case {"do": "publish", "topic": str(topic), "value": value} if _is_finite(value):
            instruments.publish(topic, float(value))
        case {"do": "repeat", "topic": str(topic), "on": True, "value": value} if _is_finite(value):
            instruments.repeat(topic, float(value))
        case {"do": "repeat", "topic": str(topic), "on": False}:
            instruments.repeat(topic, None)
        case {"do": "disturb", "topic": str(topic), "kind": kind, "amount": amount} if (
            kind in FAULTS and _is_finite(amount)
        ):
            instruments.disturb(topic, kind, float(amount))
        case {"do": "load", "milliseconds": length} if _is_finite(length):
            instruments.load(max(0.0, min(LONGEST_LOAD, float(length))))
        case _:
            raise SessionError(
                f"The panel does not understand {dict(order)!r}.",
                "It comes from a page that was opened with another version of the course.",
                "Reload the page in the browser, and run the cell again.",
            )


def _is_finite(value: object) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool) and isfinite(value)
