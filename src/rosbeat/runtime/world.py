"""What one session owns: a context, a clock, an executor, a recorder and nodes."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from typing import Any, Protocol
from weakref import WeakKeyDictionary

from rclpy.exceptions import InvalidHandle
from rclpy.node import Node

from rosbeat.domains import DomainLease, lease_domain
from rosbeat.records import GraphSnapshot
from rosbeat.runtime.actions import action_of
from rosbeat.runtime.arrivals import Arrivals
from rosbeat.runtime.clock import make_clock
from rosbeat.runtime.console import Console
from rosbeat.runtime.context import SessionContext
from rosbeat.runtime.dozing import run_until
from rosbeat.runtime.entities import Entry, NodeState
from rosbeat.runtime.events import event_source, topic_of
from rosbeat.runtime.faults import fault_of
from rosbeat.runtime.launch import Maker
from rosbeat.runtime.limits import Limits
from rosbeat.runtime.live import LiveExecutor
from rosbeat.runtime.lookout import Lookout
from rosbeat.runtime.message_classes import mend_message_classes
from rosbeat.runtime.outside import with_outside
from rosbeat.runtime.randomness import SeededRandom
from rosbeat.runtime.recorder import Recorder
from rosbeat.runtime.sim_time import show_sim_time
from rosbeat.runtime.virtual_time import VirtualTimeExecutor
from rosbeat.runtime.wait_set import waitable_kind, waitable_name
from rosbeat.runtime.watching import Watching

#: Virtual seconds that a call without a limit of its own waits for another node.
LONGEST_WAIT = 3600.0


class Closable(Protocol):
    """What ends with the session."""

    def close(self) -> None:
        """End."""


class World(Watching):
    """Everything behind a `Session`.

    It is what the hooks tell of new nodes and entities (see `Watching`), and what the executors ask
    for nodes. It never refers to the `Session`, so that a session nobody holds any more is closed
    at once.

    Args:
        seed: Seed of the random numbers that the nodes draw.
        domain_id: The ROS domain to join, or None for a private one.

    Attributes:
        console: Where log lines are printed.
        context: The ROS context.
        lookout: Sees the other processes; None in a private domain, where there are none.
        closed: Whether `close` was called.
        panel: The instrument panel, or None.
        makers: What the session was handed to make each node, and how it was started.
    """

    def __init__(self, seed: int = 0, domain_id: int | None = None) -> None:
        super().__init__()
        mend_message_classes()
        self._lease: DomainLease | None = lease_domain() if domain_id is None else None
        self.domain_id = self._lease.domain_id if self._lease else domain_id
        self.clock = make_clock()
        self.recorder = Recorder()
        self.console = Console()
        self.context = SessionContext(self, self.domain_id or 0)
        self.virtual = VirtualTimeExecutor(self.context, self.clock, self.recorder, self)
        self.live: LiveExecutor | None = None
        self.limits = Limits(self)
        self.closed = False
        self.panel: Closable | None = None
        self.makers: WeakKeyDictionary[Node, Maker] = WeakKeyDictionary()
        self._random = SeededRandom(seed)
        self._live_since = 0
        self._shown_logs = 0
        self._shown_faults = 0
        self._last_graph: GraphSnapshot | None = None
        self.lookout = None if domain_id is None else Lookout(self.context)
        self.arrivals = self.lookout and Arrivals(self.lookout, self.recorder, self.now)
        self.context.install()

    # Time.

    def now(self) -> int:
        """Nanoseconds since the session began."""
        if self.live is None:
            return self.virtual.now
        return self.virtual.now + time.monotonic_ns() - self._live_since

    # Nodes.

    def spin_node(self, state: NodeState) -> None:
        """Run this node's callbacks from now on."""
        state.spinning, state.paused = True, False
        executor = self.live or self.virtual
        state.node.executor = executor  # type: ignore[union-attr]
        executor.wake()
        self.virtual.resume(state)

    def rest_node(self, state: NodeState) -> None:
        """Run none of this node's callbacks until `spin_node`; its messages wait in queues."""
        state.spinning = False
        if self.live is not None:
            self.live.wake()  # it may be waiting for this node

    # What the executors tell.

    def callback_ran(self, entity: Any, node: Node | None) -> None:  # noqa: ANN401
        """A callback of this entity is about to run, in live mode or through rclpy's wait set."""
        entry = self._entries.get(entity)
        state = self.state_of(node)
        if entry is not None:
            entry.calls += 1
            label = entry.label
        elif state is not None:
            kind, name = waitable_kind(entity), waitable_name(entity)
            source = event_source(entity, topic_of(entity, node)) if kind == "event" else ""
            if action_of(entity, state):
                return  # which tells when it knows what it was
            label = self.recorder.label(state.name, kind, name, source)
            self.virtual.calling = label
        else:
            return
        with self.recorder.lock:
            self.recorder.add_callback(self.now(), label.number)

    def entity_raised(self, node: Node | None, entity: Any, error: BaseException) -> None:  # noqa: ANN401
        """An exception left a callback, in live mode."""
        entry = self._entries.get(entity)
        state = entry.state if entry else self.state_of(node)
        name = entry.label.name if entry else "a task" if entity is None else waitable_name(entity)
        self.callback_raised(state, name, error)

    def callback_raised(self, state: NodeState | None, name: str, error: BaseException) -> None:
        """An exception left a callback: record it, end the node, let the others go on."""
        node = state.name if state else "A task"
        self.recorder.faults.append(fault_of(error, self.now(), node, name))
        mend_message_classes()
        if state is not None:
            self.rest_node(state)
            state.ended = True
        if self.live is None:
            self.show_news()

    def heard(self, state: NodeState, kind: str, name: str, source: str) -> None:
        """A callback of an action is about to run."""
        self.virtual.calling = label = self.recorder.label(state.name, kind, name, source)
        with self.recorder.lock:
            self.recorder.add_callback(self.now(), label.number)

    def work_raised(self, state: NodeState, name: str, error: BaseException) -> None:
        """An exception left the work on a goal: record it; rclpy aborts the goal and logs it."""
        fault = fault_of(error, self.now(), state.name, name)
        self.recorder.faults.append(fault)
        self._shown_faults += 1
        self.console.work(fault)

    def show_news(self) -> None:
        """Print the log lines and faults that have not been printed yet."""
        logs = self.recorder.logs
        while self._shown_logs < len(logs):
            self._shown_logs += 1
            self.console.log(logs[self._shown_logs - 1])
        self.show_faults()

    def show_faults(self) -> None:
        """Print the faults that have not been printed yet."""
        faults = self.recorder.faults
        while self._shown_faults < len(faults):
            self._shown_faults += 1
            self.console.fault(faults[self._shown_faults - 1])

    # Running.

    @contextmanager
    def running(self) -> Iterator[None]:
        """While nodes of this session run in this thread, they are at home.

        Their context is rclpy's default, and the random numbers they draw are the session's.
        """
        before = self.context.install()
        try:
            with self._random.lent():
                yield
        finally:
            self.context.uninstall(before)

    def wait_until(self, done: Callable[[], bool], seconds: float | None) -> bool:
        """Run virtual time until `done` is true, at most so many seconds (default one hour)."""
        limit = LONGEST_WAIT if seconds is None or seconds < 0 else seconds
        with self.running():
            run_until(self, self.virtual.now + round(limit * 1e9), done)
        return bool(done())

    def go_live(self) -> None:
        """Run the nodes against the wall clock, in a background thread."""
        self.live = LiveExecutor(self.context, self)
        self.virtual.deadlines.forget()
        self._live_since = time.monotonic_ns()
        self.clock.follow_wall()
        self._change_over(self.live, virtual=False)
        self.live.start()

    def go_virtual(self) -> None:
        """End live mode; virtual time goes on from where the wall clock has come to."""
        if self.live is None:
            return
        self.live.finish()
        self.virtual.now, self.live = self.now(), None
        self.clock.follow_session(self.virtual.now)
        self._change_over(self.virtual, virtual=True)
        self.virtual.look_anew()

    def graph(self) -> GraphSnapshot:
        """The graph as it is now, or as it was when the session ended."""
        if self._last_graph is not None:
            return self._last_graph
        own = super().graph()
        return own if self.lookout is None else with_outside(own, self.lookout)

    def known_topics(self) -> set[str]:
        """Every topic of which it is known what was published."""
        return self.recorder.topics() | (self.arrivals.topics() if self.arrivals else set())

    def hurry(self) -> None:
        """Interrupt was pressed while the nodes run live; a callback that hangs ends, too."""
        if self.live is not None:
            self.live.hurry()

    def close(self) -> None:
        """Destroy the nodes, end the context and give the domain id back."""
        if self.closed:
            return
        if self.panel is not None:
            self.panel.close()
        self.closed = True
        self.go_virtual()
        self._last_graph = self.graph()
        for state in reversed(self.states()):
            self.destroy(state)
        self.destroy_actions()
        if self.lookout is not None:
            self.lookout.destroy_node()
        self.virtual.shutdown()
        self.context.end()
        if self._lease:
            self._lease.release()

    # How it works.

    def _change_over(self, executor: LiveExecutor | VirtualTimeExecutor, virtual: bool) -> None:
        for state in self.states():
            show_sim_time(state.node, virtual)
            if state.spinning:
                state.node.executor = executor  # type: ignore[union-attr]
            for entry in state.entries:
                # Each timer begins a new period: its deadline is a reading of the other clock.
                if entry.kind.endswith("timer"):
                    _restart(entry)


def _restart(entry: Entry) -> None:
    with suppress(InvalidHandle):  # destroyed by its node
        if not entry.entity.is_canceled():
            entry.entity.reset()
