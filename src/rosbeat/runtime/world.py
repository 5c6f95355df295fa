"""What one session owns: a context, a clock, an executor, a recorder and nodes."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from contextlib import suppress
from functools import partial
from typing import Any

from rclpy.exceptions import InvalidHandle
from rclpy.node import Node

from rosbeat.errors import SessionError
from rosbeat.records import INFRASTRUCTURE_TOPICS, GraphSnapshot, LogRecord
from rosbeat.runtime.clock import make_clock
from rosbeat.runtime.console import Console, note
from rosbeat.runtime.context import SessionContext
from rosbeat.runtime.direct import TAKERS
from rosbeat.runtime.domains import DomainLease, lease_domain
from rosbeat.runtime.entities import (
    Entry,
    NodeState,
    callback_name,
    full_name,
    period_text,
)
from rosbeat.runtime.faults import fault_of
from rosbeat.runtime.introspection import snapshot
from rosbeat.runtime.live import LiveExecutor
from rosbeat.runtime.logger import SessionLogger
from rosbeat.runtime.messages import Memory, type_name
from rosbeat.runtime.recorder import Recorder
from rosbeat.runtime.taps import PublisherTap, tap_client
from rosbeat.runtime.virtual_time import VirtualTimeExecutor


class World:
    """Everything behind a `Session`.

    It is what the hooks tell of new nodes and entities, and what the executors ask for nodes. It
    never refers to the `Session`, so that a session nobody holds any more is closed at once.

    Args:
        domain_id: The ROS domain to join, or None for a private one.

    Attributes:
        clock: The one clock of all nodes.
        recorder: What happened so far.
        console: Where log lines are printed.
        context: The ROS context.
        virtual: The executor of virtual time; it also keeps the time while nothing runs.
        live: The live executor while the session is live, else None.
        closed: Whether `close` was called.
    """

    def __init__(self, domain_id: int | None = None) -> None:
        self._lease: DomainLease | None = lease_domain() if domain_id is None else None
        self.domain_id = self._lease.domain_id if self._lease else domain_id
        self.clock = make_clock()
        self.recorder = Recorder()
        self.console = Console()
        self.context = SessionContext(self, self.domain_id or 0)
        self.virtual = VirtualTimeExecutor(self.context, self.clock, self.recorder, self)
        self.live: LiveExecutor | None = None
        self.closed = False
        self._live_since = 0
        self._states: dict[Node, NodeState] = {}
        self._entries: dict[Any, Entry] = {}
        self._count = 0
        self._shown_logs = 0
        self._shown_faults = 0
        self.context.install()

    # Time.

    def now(self) -> int:
        """Nanoseconds since the session began."""
        if self.live is None:
            return self.virtual.now
        return self.virtual.now + time.monotonic_ns() - self._live_since

    # Nodes.

    def states(self) -> list[NodeState]:
        """All nodes that have not been destroyed, in order of creation."""
        return list(self._states.values())

    def spinning_nodes(self) -> list[NodeState]:
        """The nodes whose callbacks run, in order of creation."""
        return [state for state in self.states() if state.spinning]

    def named(self, name: str) -> NodeState | None:
        """The node of this full name."""
        return next((state for state in self.states() if state.name == name), None)

    def state_of(self, node: Node) -> NodeState | None:
        """What is known of a node."""
        return self._states.get(node)

    def spin_node(self, state: NodeState) -> None:
        """Run this node's callbacks from now on."""
        state.spinning = True
        state.node.executor = self.live or self.virtual  # type: ignore[union-attr]
        self.virtual.resume(state)

    def rest_node(self, state: NodeState) -> None:
        """Run none of this node's callbacks until `spin_node`; its messages wait in their queues."""
        state.spinning = False
        if self.live is not None:
            self.live.remove_node(state.node)

    def destroy(self, state: NodeState) -> None:
        """Destroy a node, whole or half-made."""
        if state.node is None:
            return
        try:
            state.node.destroy_node()
        except (AttributeError, InvalidHandle):
            # Its constructor stopped half-way, or its own destroy_node did half of it before.
            self.node_ends(state.node)

    def graph(self) -> GraphSnapshot:
        """The graph as it is now."""
        return snapshot(self.states())

    # What the hooks tell.

    def node_begins(self, name: str, namespace: str) -> None:
        """A node is about to be made: one of the same name makes room for it.

        It has to go first: rcl keeps one log publisher for each name and removes it with the first
        node of that name that is destroyed.
        """
        old = self.named(full_name(name, namespace))
        if old is not None:
            self.destroy(old)

    def node_made(self, node: Node) -> None:
        """`Node.__init__` has returned."""
        self.entity_begins(node)

    def entity_begins(self, node: Node) -> None:
        """Give a new node the session's clock, before anything of it reads the time."""
        if "_clock" in node.__dict__ and node._clock is not self.clock:
            node._clock = self.clock
        if node not in self._states:
            name = node.get_fully_qualified_name()
            self._states[node] = NodeState(len(self._states), name, node)

    def entity_made(self, node: Node, kind: str, entity: Any) -> None:  # noqa: ANN401
        """Tap a publisher or client; run the callbacks of whatever has some."""
        state = self._states[node]
        if kind == "publisher":
            self._tap_publisher(state, entity)
            return
        if kind == "client":
            asked = self._sender("service", entity.service_name)
            tap_client(entity, asked, self._wait_for_answer)
        self._watch(state, kind, entity)

    def node_ends(self, node: Node) -> None:
        """A node is about to be destroyed."""
        state = self._states.pop(node, None)
        if state is None:
            return
        state.spinning, state.ended = False, True
        self.virtual.forget(state)
        for entry in state.entries:
            self._entries.pop(entry.entity, None)
        if node.executor is not None:
            node.executor.remove_node(node)

    def logger_of(self, node: Node, original: Any) -> Any:  # noqa: ANN401
        """The logger that the node's code gets."""
        state = self._states.get(node)
        if state is None:
            return original
        if state.logger is None:
            state.logger = SessionLogger(original.name, self._logged, self.clock)
        return state.logger

    def explain_init(self) -> None:
        """The learner called `rclpy.init()`."""
        note("rclpy.init() has nothing to do here: the session has started ROS already.")

    def explain_shutdown(self) -> None:
        """The learner called `rclpy.shutdown()`: in a callback it ends that node."""
        current = self.virtual.current
        if current is None:
            note("rclpy.shutdown() leaves this session open; `ros.close()` ends it.")
            return
        current.spinning, current.ended = False, True
        note(f"{current.name} called rclpy.shutdown() and stops; the other nodes go on.")

    # What the executors tell.

    def callback_ran(self, entity: Any) -> None:  # noqa: ANN401
        """A callback of this entity is about to run, in live mode."""
        entry = self._entries.get(entity)
        if entry is not None:
            entry.calls += 1
            with self.recorder.lock:
                self.recorder.add_callback(self.now(), entry.label.number)

    def entity_raised(self, node: Node | None, entity: Any, error: BaseException) -> None:  # noqa: ANN401
        """An exception left a callback, in live mode."""
        entry = self._entries.get(entity)
        state = entry.state if entry else self._states.get(node)
        self.callback_raised(state, entry.label.name if entry else "a task", error)

    def callback_raised(self, state: NodeState | None, name: str, error: BaseException) -> None:
        """An exception left a callback: record it, end the node, let the others go on."""
        node = state.name if state else "A task"
        self.recorder.faults.append(fault_of(error, self.now(), node, name))
        if state is not None:
            self.rest_node(state)
            state.ended = True
        if self.live is None:
            self.show_news()

    def show_news(self) -> None:
        """Print the log lines and faults that have not been printed yet."""
        logs, faults = self.recorder.logs, self.recorder.faults
        while self._shown_logs < len(logs):
            self.console.log(logs[self._shown_logs])
            self._shown_logs += 1
        while self._shown_faults < len(faults):
            self.console.fault(faults[self._shown_faults])
            self._shown_faults += 1

    # Running.

    def wait_for(self, future: Any, seconds: float | None) -> bool:  # noqa: ANN401
        """Run virtual time until a future is done, at most so many seconds (default one hour)."""
        limit = 3600.0 if seconds is None or seconds < 0 else seconds
        done = future.done
        self.virtual.run_until(self.virtual.now + round(limit * 1e9), done)
        return bool(done())

    def go_live(self) -> None:
        """Run the nodes against the wall clock, in a background thread."""
        self.live = LiveExecutor(self.context, self)
        self._live_since = time.monotonic_ns()
        self.clock.follow_wall()
        for state in self.spinning_nodes():
            state.node.executor = self.live  # type: ignore[union-attr]
        for timer in self._running_timers():
            timer.reset()  # or each would fire at once: the wall clock is decades ahead
        self.live.start()

    def go_virtual(self) -> None:
        """End live mode; virtual time goes on from where the wall clock has come to."""
        if self.live is None:
            return
        self.live.finish()
        self.virtual.now, self.live = self.now(), None
        self.clock.follow_session(self.virtual.now)
        for state in self.spinning_nodes():
            state.node.executor = self.virtual  # type: ignore[union-attr]
        self.virtual.reschedule(self._timer_entries())

    def close(self) -> None:
        """Destroy the nodes, end the context and give the domain id back."""
        if self.closed:
            return
        self.closed = True
        self.go_virtual()
        for state in reversed(self.states()):
            self.destroy(state)
        self.virtual.shutdown()
        self.context.end()
        if self._lease:
            self._lease.release()

    # How it works.

    def _timer_entries(self) -> list[Entry]:
        return [e for state in self.states() for e in state.entries if e.kind == "timer"]

    def _running_timers(self) -> Iterator[Any]:
        for entry in self._timer_entries():
            with suppress(InvalidHandle):  # destroyed by its node
                if not entry.entity.is_canceled():
                    yield entry.entity

    def _watch(self, state: NodeState, kind: str, entity: Any) -> None:  # noqa: ANN401
        name = "" if kind == "timer" else _name_of(kind, entity)
        source = period_text(entity.timer_period_ns) if kind == "timer" else name
        called = "answer" if kind == "client" else callback_name(entity.callback)
        label = self.recorder.label(state.name, kind, called, source)
        self._count += 1
        entry = Entry(self._count, state, kind, entity, name, label, TAKERS.get(kind))
        if kind == "subscription":
            entry.owed = self._owed(name, entity)
        state.entries.append(entry)
        self._entries[entity] = entry
        self.virtual.watch(entry)

    def _owed(self, topic: str, subscription: Any) -> int:  # noqa: ANN401
        qos = subscription.qos_profile
        taps = [tap for state in self.states() for tap in state.taps if tap.topic == topic]
        stored = sum(tap.stored_for(qos) for tap in taps)
        return min(stored, qos.depth or stored)

    def _tap_publisher(self, state: NodeState, publisher: Any) -> None:  # noqa: ANN401
        topic = publisher.topic_name
        memory = Memory(publisher.msg_type)
        happened = self.virtual.sender("subscription", topic)
        if topic in INFRASTRUCTURE_TOPICS:
            quiet = self._sender("subscription", topic)
            state.taps.append(PublisherTap(publisher, memory, lambda _: quiet()))
            return
        kind = type_name(publisher.msg_type)
        channel = self.recorder.channel(topic, kind, state.name, memory)
        heard = partial(self._published, happened, channel.number)
        state.taps.append(PublisherTap(publisher, memory, heard))

    def _published(self, happened: Callable[[], None], channel: int, copy: Any) -> None:  # noqa: ANN401
        if self.live is None:
            self.recorder.add_sample(self.virtual.now, channel, copy)
            happened()
            return
        with self.recorder.lock:
            self.recorder.add_sample(self.now(), channel, copy)

    def _sender(self, kind: str, name: str) -> Callable[[], None]:
        happened = self.virtual.sender(kind, name)

        def sent() -> None:
            if self.live is None:
                happened()

        return sent

    def _logged(self, level: str, name: str, text: str, function: str, line: int) -> None:
        record = LogRecord(self.now(), level, name, text, function, line)
        self.recorder.logs.append(record)
        if self.live is None:
            self.show_news()

    def _wait_for_answer(self, future: Any, timeout_sec: float | None) -> Any:  # noqa: ANN401
        if self.virtual.current is not None or (self.live and self.live.is_this_thread()):
            raise SessionError(
                "A callback waits for a service's answer with `call`.",
                "The answer can only come when this callback has returned, so it waits for ever: a "
                "deadlock, on a real robot too.",
                "Use `call_async` and add a done callback, or make the callback `async def` and "
                "await the future, with the client in a callback group of its own.",
            )
        if self.live is None:
            self.wait_for(future, timeout_sec)
        else:
            self.live.wait_for(future, timeout_sec)
        return future.result()


def _name_of(kind: str, entity: Any) -> str:  # noqa: ANN401
    name: str = entity.topic_name if kind == "subscription" else entity.service_name
    return name
