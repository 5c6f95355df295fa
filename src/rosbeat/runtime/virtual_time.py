"""Nodes as a discrete-event simulation.

Nothing happens in a robot's program except in callbacks, and callbacks are caused: by a timer whose
deadline has come, or by something that another callback did. So time can jump from one deadline to
the next. At each instant one timer runs, then all that follows from it, until nothing is left to
do; then the next timer of that instant, in order of (deadline, creation).

What follows is known without waiting: within one participant Fast DDS hands a message over inside
`publish()`, so when `publish()` has returned, the subscriptions of that topic can take it.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Callable
from inspect import iscoroutine
from typing import Any, Protocol

from rclpy.client import Client
from rclpy.context import Context
from rclpy.event_handler import EventHandler
from rclpy.exceptions import InvalidHandle
from rclpy.executors import SingleThreadedExecutor, TimeoutException
from rclpy.node import Node
from rclpy.service import Service
from rclpy.subscription import Subscription
from rclpy.task import Task
from rclpy.timer import Timer

from rosbeat.runtime.agenda import Agenda
from rosbeat.runtime.chains import SUSPICIOUS, ChainGuard
from rosbeat.runtime.clock import SessionClock
from rosbeat.runtime.coroutines import Coroutines, Waiting
from rosbeat.runtime.entities import Entry, NodeState
from rosbeat.runtime.recorder import Recorder

_TAKEN_DIRECTLY = (Subscription, Timer, Client, Service)


class Host(Protocol):
    """What the executor asks of its session."""

    def spinning_nodes(self) -> list[NodeState]:
        """The nodes whose callbacks run, in order of creation."""

    def callback_raised(self, state: NodeState | None, name: str, error: BaseException) -> None:
        """An exception left a callback."""


class VirtualTimeExecutor(SingleThreadedExecutor):
    """Runs callbacks in virtual time.

    Timers, subscriptions, services and clients are taken directly. Guard conditions and waitables
    (actions, QoS events) go through rclpy's own wait set, which costs about a millisecond a pass
    and is therefore asked only for nodes that have them, and after entities were made or destroyed.

    Args:
        context: The session's context.
        clock: The session's clock.
        recorder: Told of every callback.
        host: The session.

    Attributes:
        now: Virtual time in nanoseconds.
        current: The node whose callback is running, or None.
    """

    def __init__(
        self, context: Context, clock: SessionClock, recorder: Recorder, host: Host
    ) -> None:
        self.now = 0
        self.current: NodeState | None = None
        # Not `_clock`: rclpy's executor has a steady clock of that name.
        self._session_clock, self._record, self._host = clock, recorder.add_callback, host
        self._agenda = Agenda()
        self._chain = ChainGuard()
        self._coroutines = Coroutines(self)
        self._listeners: dict[tuple[str, str], list[Entry]] = {}
        self._ready: deque[tuple[Entry, int]] = deque()
        self._changed = True
        self._wait_set_nodes: list[Node] = []
        super().__init__(context=context)

    # What rclpy calls.

    def get_nodes(self) -> list[Node]:
        """The nodes in order of creation; rclpy's own answer comes from an unordered set."""
        return [state.node for state in self._host.spinning_nodes()]

    def wake(self) -> None:
        """Entities were made or destroyed."""
        self._changed = True
        super().wake()

    def create_task(self, callback: Any, *args: Any, **kwargs: Any) -> Task:  # noqa: ANN401
        """Run a callback or coroutine as soon as what is running has ended."""
        return self._coroutines.add_task(callback, args, kwargs, self.current)

    def can_execute(self, entity: Any) -> bool:  # noqa: ANN401 - rclpy's own signature
        """Keep from rclpy's wait set what is taken directly."""
        return not isinstance(entity, _TAKEN_DIRECTLY) and bool(super().can_execute(entity))

    # What the session calls.

    def watch(self, entry: Entry) -> None:
        """Run this entity's callback from now on, whenever its node spins."""
        if entry.kind == "timer":
            self._agenda.add(entry, self.now)
        else:
            self._listeners.setdefault((entry.kind, entry.name), []).append(entry)
            self._look_at(entry)

    def forget(self, state: NodeState) -> None:
        """A node is destroyed: drop what it had."""
        for entry in state.entries:
            self._drop(entry)

    def resume(self, state: NodeState) -> None:
        """A node begins to spin: look at everything that waited for it meanwhile."""
        self._changed = True
        for entry in state.entries:
            if entry.kind != "timer":
                self._look_at(entry)

    def sender(self, kind: str, name: str) -> Callable[[], None]:
        """A function to call whenever something is sent to the `kind` entities called `name`.

        What is sent is a message, a request or an answer; whoever waits for it will take it.
        """
        listeners = self._listeners.setdefault((kind, name), [])
        ready, chain = self._ready, self._chain

        def happened() -> None:
            for entry in listeners:
                ready.append((entry, chain.depth + 1))

        return happened

    def happened(self, kind: str, name: str) -> None:
        """Something was sent to the `kind` entities called `name`."""
        self.sender(kind, name)()

    def reschedule(self, timers: list[Entry]) -> None:
        """Read every timer's deadline anew, after the clock was changed from outside."""
        self._agenda.rebuild(timers, self.now)

    def run_until(self, end: int, done: Callable[[], bool] | None = None) -> None:
        """Advance virtual time to `end`, in nanoseconds, or until `done` is true.

        Raises:
            EndlessChainError: If callbacks cause one another for ever while no time passes.
        """
        try:
            self._drain()
            while not (done and done()):
                deadline = self._agenda.next_deadline(self.now)
                if deadline is None or deadline > end:
                    self._advance(end)
                    return
                self._step(deadline)
        except BaseException:
            # An interrupt or an endless chain. What is ready stays ready, for the next run, but
            # counts from there.
            self._chain.depth = 0
            waiting = [(entry, 0) for entry, _ in self._ready]
            self._ready.clear()
            self._ready.extend(waiting)
            raise

    # How it works.

    def _drop(self, entry: Entry) -> None:
        listeners = self._listeners.get((entry.kind, entry.name), [])
        if entry in listeners:
            listeners.remove(entry)

    def _look_at(self, entry: Entry) -> None:
        entry.backlog = True
        self._ready.append((entry, self._chain.depth + 1))

    def _step(self, deadline: int) -> None:
        self._advance(deadline)
        self._fire(self._agenda.pop())
        self._drain()

    def _advance(self, time_ns: int) -> None:
        if time_ns != self.now:
            self._chain.instant_ends()
            self.now = time_ns
            self._session_clock.advance(time_ns)

    def _fire(self, entry: Entry) -> None:
        if not self._coroutines.is_free(entry):
            return  # back on the agenda when its callback group is free
        timer = entry.entity
        handle = timer.handle
        try:
            with handle:
                due = entry.state.spinning and handle.is_timer_ready()
                if due:
                    handle.call_timer()
        except InvalidHandle:
            return  # destroyed
        if due:
            self._chain.timer_fires(entry)
            self._call(entry, timer.callback)
        self._agenda.add(entry, self.now)

    def _drain(self) -> None:
        # The hot path: three attribute look-ups here are a tenth of a message's cost.
        ready, chain, waiting = self._ready, self._chain, self._coroutines.waiting
        while True:
            while ready:
                entry, depth = ready.popleft()
                if entry.state.spinning and (not waiting or self._coroutines.is_free(entry)):
                    chain.depth = depth
                    if depth > SUSPICIOUS:
                        chain.inspect(entry)
                    self._take(entry)
            chain.depth = 0
            if not (self._resume_coroutines() or self._ask_rclpy()):
                return

    def _take(self, entry: Entry) -> None:
        try:
            work = entry.take(entry, self)
        except InvalidHandle:
            self._drop(entry)  # destroyed while its message was on the way
            return
        if work is None:
            entry.backlog = False
            return
        if entry.backlog or entry.owed:
            self._ready.appendleft((entry, self._chain.depth))
        self._call(entry, work[0], work[1])

    def _call(
        self, entry: Entry, callback: Callable[..., Any], arguments: tuple[Any, ...] = ()
    ) -> None:
        entry.calls += 1
        self._record(self.now, entry.label.number)
        self.current = entry.state
        try:
            result = callback(*arguments)
        except (Exception, SystemExit) as error:
            self._host.callback_raised(entry.state, entry.label.name, error)
        else:
            if result is not None and iscoroutine(result):
                self._coroutines.adopt(result, entry)
        finally:
            self.current = None

    def _resume_coroutines(self) -> bool:
        """Give every waiting coroutine a turn; say whether anything came of it."""
        if not self._coroutines.waiting:
            return False
        ended = self._coroutines.turn(self._resume_one)
        for waiting in ended:
            error = waiting.task.exception()
            if error is not None:
                self._host.callback_raised(waiting.state, waiting.name, error)
        if ended:
            self._unblock()
        return bool(ended or self._ready)

    def _unblock(self) -> None:
        for entry in self._coroutines.unblock():
            if entry.kind == "timer":
                self._agenda.add(entry, self.now)
            else:
                self._ready.append((entry, 0))

    def _resume_one(self, waiting: Waiting) -> None:
        self.current = waiting.state
        waiting.task()
        self.current = None

    def _ask_rclpy(self) -> bool:
        """One pass of rclpy's own wait set; say whether anything came of it."""
        nodes = self._nodes_for_wait_set()
        progress = False
        while nodes:
            try:
                handler, _, node = self.wait_for_ready_callbacks(timeout_sec=0, nodes=nodes)
            except TimeoutException:
                break
            handler()
            progress = progress or handler.done()
            self._check(handler, node)
        return progress

    def _nodes_for_wait_set(self) -> list[Node]:
        if not self._changed:
            return self._wait_set_nodes
        self._changed = False
        nodes = self.get_nodes()
        self._wait_set_nodes = [node for node in nodes if _needs_wait_set(node)]
        return nodes

    def _check(self, handler: Task, node: Node) -> None:
        error = handler.exception()
        if error is not None:
            state = next((s for s in self._host.spinning_nodes() if s.node is node), None)
            self._host.callback_raised(state, "a waitable", error)


def _needs_wait_set(node: Node) -> bool:
    # Every publisher and subscription has event handlers; they can only fire after a change.
    return any(True for _ in node.guards) or any(
        not isinstance(waitable, EventHandler) for waitable in node.waitables
    )
