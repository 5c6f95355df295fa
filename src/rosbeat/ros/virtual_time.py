"""Nodes as a discrete-event simulation.

Nothing happens in a robot's program except in callbacks, and callbacks are caused: by a timer whose
deadline has come, or by something that another callback did. So time can jump from one deadline to
the next. At each instant one timer runs, then all that follows from it, until nothing is left to
do; then the next timer of that instant, in order of (deadline, creation).

What follows is known without waiting: within one participant Fast DDS hands a message over inside
`publish()`, so when `publish()` has returned, the subscriptions of that topic can take it. What was
stored for late joiners is there when their subscription has been made; see `qos_events`.
"""

from __future__ import annotations

import random
import sys
import threading
import time
from collections import deque
from collections.abc import Callable, Coroutine, Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from heapq import heappop, heappush
from inspect import iscoroutine, iscoroutinefunction
from math import isfinite
from pathlib import Path
from typing import Any, Protocol

from rclpy.client import Client
from rclpy.clock import ClockType, ROSClock
from rclpy.context import Context
from rclpy.event_handler import EventHandler
from rclpy.exceptions import InvalidHandle
from rclpy.executors import Executor, SingleThreadedExecutor, TimeoutException
from rclpy.guard_condition import GuardCondition
from rclpy.impl.implementation_singleton import rclpy_implementation
from rclpy.node import Node
from rclpy.service import Service
from rclpy.subscription import Subscription
from rclpy.task import Task
from rclpy.time import Time
from rclpy.timer import Timer

from rosbeat.errors import EndlessChainError, SessionError
from rosbeat.records import NANOSECONDS
from rosbeat.ros.console import note
from rosbeat.ros.context import Interrupts
from rosbeat.ros.entities import Entry, NodeState, callback_name
from rosbeat.ros.qos_events import Deadlines
from rosbeat.ros.recording import CallbackLabel, Recorder

# Which timer comes next.


class Agenda:
    """The timers of all nodes, ordered by (deadline, order of creation).

    A deadline only ever moves later without the agenda being told (a longer period, say), so an
    entry that is looked at too early is simply put back. A canceled timer waits aside: a reset may
    bring it back. So each step costs the logarithm of the number of timers, not the number.

    An entry may be in the heap several times; only the place at its own `deadline` counts.
    """

    def __init__(self) -> None:
        self._heap: list[tuple[int, int, Entry]] = []
        self._aside: list[Entry] = []

    def add(self, entry: Entry, now: int) -> None:
        """Put a timer in its place; one that cannot fire now goes aside, or away for good."""
        entry.deadline = None
        if entry.state.ended:
            return
        handle = entry.handle
        try:
            with handle:
                if not entry.state.spinning or handle.is_timer_canceled():
                    self._aside.append(entry)
                    return
                wait = handle.time_until_next_call()
        except InvalidHandle:
            return  # destroyed: nobody can bring it back
        entry.deadline = now + max(0, wait)
        heappush(self._heap, (entry.deadline, entry.number, entry))

    def move(self, entry: Entry, now: int) -> None:
        """A timer was reset, so its deadline may have come nearer."""
        if entry.deadline is not None:
            self.add(entry, now)

    def next_deadline(self, now: int) -> int | None:
        """When the next timer is due, in nanoseconds, or None if there is none."""
        if self._aside:
            self._bring_back(now)
        heap = self._heap
        while heap and heap[0][2].deadline != heap[0][0]:
            heappop(heap)  # it was moved
        return heap[0][0] if heap else None

    def pop(self) -> Entry:
        """Take the first timer off the agenda; `next_deadline` has just been asked."""
        entry = heappop(self._heap)[2]
        entry.deadline = None
        return entry

    def rebuild(self, entries: list[Entry], now: int) -> None:
        """Forget everything and begin with these timers."""
        self._heap, self._aside = [], []
        for entry in entries:
            self.add(entry, now)

    def _bring_back(self, now: int) -> None:
        waiting, self._aside = self._aside, []
        for entry in waiting:
            self.add(entry, now)


# Programs that never let time pass.


#: A message that causes a message that causes a message ... this many times, all at one instant.
LONGEST_CHAIN = 1_000
#: Callbacks that may follow from one timer, more than `SUSPICIOUS` steps after it. A circle that
#: doubles its messages at each step never gets deep, since there is ever more to do on the way.
MOST_FOLLOWERS = 100_000
#: Timers that may fire at one instant.
MOST_FIRINGS = 10_000
#: Turns that coroutines and tasks may get at one instant.
MOST_TURNS = 10_000
#: From here on followers are counted: few programs ever come here, so it costs the others nothing.
SUSPICIOUS = 12
_TRAIL = 24


class ChainGuard:
    """Counts how far each callback is from the timer that began it all.

    A burst of messages is wide but not deep, so it is never mistaken for a circle.

    Attributes:
        depth: Steps from the timer to the callback that is running; 0 for the timer itself.
    """

    def __init__(self) -> None:
        self.depth = 0
        self._firings = 0
        self._followers = 0
        self._trail: deque[str] = deque(maxlen=_TRAIL)

    def instant_ends(self) -> None:
        """Time passes, so whatever happened before is no circle."""
        self._firings = self._followers = 0

    def timer_fires(self, entry: Entry) -> None:
        """A timer begins a chain.

        Raises:
            EndlessChainError: If timers fire without end at one instant (a period of zero).
        """
        self.depth = self._followers = 0
        self._firings += 1
        if self._firings > MOST_FIRINGS:
            self._firings = 0
            raise EndlessChainError(
                f"A timer of {entry.state.name} fired {MOST_FIRINGS} times and no time passed.",
                f"Its period is zero, so `{entry.label.name}` is always due and the clock stands.",
                "Give create_timer a period above zero, in seconds.",
            )

    def inspect(self, entry: Entry) -> None:
        """A callback is about to run more than `SUSPICIOUS` steps after a timer.

        Raises:
            EndlessChainError: If the chain is longer or wider than any that ends.
        """
        self._followers += 1
        if max(self.depth, self._followers) > LONGEST_CHAIN - _TRAIL:
            # Names are worth their time only now.
            self._trail.append(f"{entry.state.name} ({entry.label.source})")
            if self.depth > LONGEST_CHAIN or self._followers > MOST_FOLLOWERS:
                raise self._refusal()

    def turns_without_end(self, names: list[str]) -> EndlessChainError:
        """The error for coroutines and tasks that keep one another busy for ever."""
        return EndlessChainError(
            f"Callbacks wait for each other without end: {', '.join(names)}.",
            "Each gets further whenever another has run, and no time passes meanwhile.",
            "Break the circle: begin each piece of work from a timer.",
        )

    def _refusal(self) -> EndlessChainError:
        names = list(dict.fromkeys(self._trail))
        self.depth = self._followers = 0
        self._trail.clear()
        return EndlessChainError(
            f"Messages go round without end: {' -> '.join([*names, names[0]])}.",
            "Each callback causes the next one, and no time passes between them, so the clock "
            "stands still. On a real robot these nodes would keep a processor core busy for ever.",
            "Break the circle: publish from a timer, or only if something has changed.",
        )


# Callbacks that wait: `async def` callbacks and tasks.


@dataclass(frozen=True, eq=False)
class Waiting:
    """A coroutine or task that has not ended.

    Attributes:
        task: rclpy's task.
        state: The node that began it, if one did.
        name: What it is called in an error.
        entry: The entity whose callback it is; its callback group is busy until it ends.
    """

    task: Task
    state: NodeState | None
    name: str
    entry: Entry | None = None

    @property
    def ended(self) -> bool:
        """Whether it has returned, raised or been canceled."""
        return bool(self.task.done() or self.task.cancelled())

    @property
    def abandoned(self) -> bool:
        """Whether the node that began it has ended."""
        return self.state is not None and self.state.ended and not self.task.executing()

    @property
    def rests(self) -> bool:
        """Whether its node is paused."""
        return self.state is not None and not self.state.spinning

    def place(self) -> object:
        """What it awaits, innermost: another object each time it has got further."""
        inner = self.task._handler
        while (deeper := _awaited_by(inner)) is not None:
            inner = deeper
        return inner


def _awaited_by(waiting: Any) -> Any:  # noqa: ANN401 - a coroutine, a generator, or neither
    awaited = getattr(waiting, "cr_await", None)
    return getattr(waiting, "gi_yieldfrom", None) if awaited is None else awaited


class Coroutines:
    """All coroutines of one executor, in the order in which they began.

    Args:
        executor: The executor that future results are scheduled on.

    Attributes:
        waiting: Those that have not ended.
    """

    def __init__(self, executor: Executor) -> None:
        self._executor = executor
        self.waiting: list[Waiting] = []
        self._blocked: list[Entry] = []

    def add_task(self, task: Task, callback: object, state: NodeState | None) -> None:
        """Begin a task at the next turn."""
        self.waiting.append(Waiting(task, state, callback_name(callback)))

    def adopt(self, coroutine: Coroutine[Any, Any, Any], entry: Entry) -> Waiting:
        """A callback turned out to be a coroutine; its callback group is busy until it ends."""
        entry.entity.callback_group.beginning_execution(entry.entity)
        task = Task(coroutine, executor=self._executor)
        waiting = Waiting(task, entry.state, entry.label.name, entry)
        self.waiting.append(waiting)
        return waiting

    def is_free(self, entry: Entry) -> bool:
        """Whether the entity's callback group lets it run; if not, it runs when the group is free.

        Callbacks run one at a time, so a group can only be busy while a coroutine waits.
        """
        if not self.waiting or entry.entity.callback_group.can_execute(entry.entity):
            return True
        self._blocked.append(entry)
        return False

    def turn(self, run: Callable[[Waiting], None]) -> bool:
        """Let each one go on until it waits again; say whether any has got further."""
        turns = [self._one(waiting, run) for waiting in list(self.waiting)]
        return any(turns)

    def end(self, waiting: Waiting) -> None:
        """Forget one that has ended, and free its callback group."""
        self.waiting.remove(waiting)  # the executor holds on to the list
        if waiting.entry is not None:
            waiting.entry.entity.callback_group.ending_execution(waiting.entry.entity)

    def drop_abandoned(self) -> None:
        """Close the coroutines of nodes that have ended."""
        for waiting in [waiting for waiting in self.waiting if waiting.abandoned]:
            waiting.task.cancel()
            self.end(waiting)

    def unblock(self) -> list[Entry]:
        """The entities that were held back, once, for another try."""
        blocked, self._blocked = self._blocked, []
        return blocked

    @staticmethod
    def _one(waiting: Waiting, run: Callable[[Waiting], None]) -> bool:
        if waiting.rests or waiting.ended:
            return False
        before = waiting.place()
        run(waiting)
        return waiting.ended or waiting.place() is not before


# What cannot be taken directly: guard conditions and waitables, through rclpy's own wait set.


_TAKEN_DIRECTLY = (Subscription, Timer, Client, Service)


class Host(Protocol):
    """What the executor asks of its session."""

    def states(self) -> list[NodeState]:
        """All nodes, in order of creation."""

    def state_of(self, node: Node) -> NodeState | None:
        """What is known of a node."""

    def callback_ran(self, entity: Any, node: Node | None) -> None:  # noqa: ANN401
        """A callback of this entity is about to run."""

    def callback_raised(self, state: NodeState | None, name: str, error: BaseException) -> None:
        """An exception left a callback."""


class WaitSetExecutor(SingleThreadedExecutor):
    """rclpy's executor, asked only for what cannot be taken directly.

    One pass costs about a millisecond. It is made for nodes that have guard conditions or waitables
    (actions, say), and once for all nodes after entities were made or destroyed: publishers and
    subscriptions tell of a QoS that does not fit by waitables too, but only then.

    Attributes:
        current: The node whose callback is running, or None.
    """

    _host: Host
    # rclpy's `__del__` asks for it, also if an interrupt has come before it was made.
    _sigint_gc: Any = None

    def __init__(self, **options: Any) -> None:  # noqa: ANN401 - rclpy's own
        self.current: NodeState | None = None
        self._changed = True
        self._wait_set_nodes: list[Node] = []
        super().__init__(**options)

    def get_nodes(self) -> list[Node]:
        """The nodes in order of creation; rclpy's own answer comes from an unordered set."""
        return [state.node for state in self._host.states() if state.spinning]

    def wake(self) -> None:
        """Entities were made or destroyed."""
        self._changed = True
        super().wake()

    def can_execute(self, entity: Any) -> bool:  # noqa: ANN401 - rclpy's own signature
        """Keep from rclpy's wait set what is taken directly."""
        return not isinstance(entity, _TAKEN_DIRECTLY) and bool(super().can_execute(entity))

    def ask_rclpy(self) -> bool:
        """One pass of rclpy's own wait set; say whether anything came of it."""
        nodes = self._nodes_for_wait_set()
        progress = False
        self._cb_iter = None  # that of a callback which sleeps: it would hand out that node's, too
        while nodes:
            try:
                handler, entity, node = self.wait_for_ready_callbacks(timeout_sec=0, nodes=nodes)
            except TimeoutException:
                break
            self._handle(handler, entity, node)
            progress = progress or handler.done()
        return progress

    def forget_passes(self) -> None:
        """Let go of a pass that was interrupted."""
        self._cb_iter = None
        # rclpy would take what was interrupted for running, for ever.
        self._tasks[:] = [parts for parts in self._tasks if not parts[0].executing()]

    def _make_handler(self, entity: Any, node: Node, take: Any) -> Task:  # noqa: ANN401
        self._host.callback_ran(entity, node)
        return super()._make_handler(entity, node, take)

    def _handle(self, handler: Task, entity: Any, node: Node) -> None:  # noqa: ANN401
        state = self._host.state_of(node)
        self.current = state
        error: BaseException | None = None
        try:
            handler()
        except SystemExit as stop:
            error = stop
            handler.cancel()
        finally:
            self.current = None
        error = error or handler.exception()
        if error is not None:
            self._host.callback_raised(state, waitable_name(entity), error)

    def _nodes_for_wait_set(self) -> list[Node]:
        if not self._changed:
            return self._wait_set_nodes and self._those_that_spin()
        self._changed = False
        nodes = self.get_nodes()
        self._wait_set_nodes = list(_with_waitables(nodes))
        return nodes

    def _those_that_spin(self) -> list[Node]:
        spinning = self.get_nodes()
        return [node for node in self._wait_set_nodes if node in spinning]


def waitable_name(entity: Any) -> str:  # noqa: ANN401 - any of rclpy's
    """What a guard condition's or waitable's callback is called."""
    callback = getattr(entity, "callback", None) or entity
    return getattr(callback, "__name__", type(callback).__name__)


def waitable_kind(entity: Any) -> str:  # noqa: ANN401 - any of rclpy's
    """What kind of callback it has, as `CallbackRecord` names it."""
    if isinstance(entity, EventHandler):
        return "event"
    return "guard condition" if isinstance(entity, GuardCondition) else "waitable"


def _with_waitables(nodes: Iterable[Node]) -> Iterable[Node]:
    for node in nodes:
        ours = any(not isinstance(waitable, EventHandler) for waitable in node.waitables)
        if ours or any(True for _ in node.guards):
            yield node


# The one clock of a session.


_POINT = rclpy_implementation.rcl_time_point_t


class SessionClock(ROSClock):
    """A ROS clock that only its session moves.

    Every node of a session uses this one object, so no node can read a time that another has
    already left. rclpy's time source would set a node's clock from the parameter `use_sim_time`
    and from `/clock` messages; both calls are accepted and change nothing.
    """

    def set_ros_time_override(self, time: Time) -> None:
        """Accept rclpy's call and keep the session's own time."""

    def _set_ros_time_is_active(self, enabled: bool) -> None:
        """Accept rclpy's call; `follow_session` and `follow_wall` decide."""

    def follow_session(self, time_ns: int) -> None:
        """Show virtual time from now on, beginning at `time_ns`."""
        self.advance(time_ns)
        super()._set_ros_time_is_active(True)

    def follow_wall(self) -> None:
        """Show wall time from now on, as a clock does without `use_sim_time`."""
        super()._set_ros_time_is_active(False)

    def advance(self, time_ns: int) -> None:
        """Move virtual time to `time_ns` nanoseconds."""
        # Once an instant, so without the detour through `Time` and the method of rclpy's clock.
        handle = self.handle
        with handle:
            handle.set_ros_time_override(_POINT(time_ns, ClockType.ROS_TIME))


def make_clock() -> SessionClock:
    """A clock at virtual time zero."""
    # ROSClock's constructor always returns a plain ROSClock, whatever class it is asked for.
    clock = ROSClock()
    clock.__class__ = SessionClock
    clock.follow_session(0)
    made: SessionClock = clock
    return made


class VirtualTimeExecutor(WaitSetExecutor):
    """Runs callbacks in virtual time.

    Timers, subscriptions, services and clients are taken directly; see `WaitSetExecutor` for the
    rest.

    Args:
        context: The session's context.
        clock: The session's clock.
        recorder: Told of every callback.
        host: The session.

    Attributes:
        now: Virtual time in nanoseconds.
        running: Whether `run_until` is at work.
        calling: The callback that is running, or ran last; None before the first.
        elsewhere: What threads of the nodes' own have published since the last step.
        deadlines: How long publishers and subscriptions may stay without a message.
    """

    def __init__(
        self, context: Context, clock: SessionClock, recorder: Recorder, host: Host
    ) -> None:
        self.now = 0
        self.running = False
        self.calling: CallbackLabel | None = None
        self.elsewhere: deque[Callable[[], None]] = deque()
        self.deadlines = Deadlines()
        # Not `_clock`: rclpy's executor has a steady clock of that name.
        self._session_clock, self._host = clock, host
        self._note_callback = recorder.add_callback
        self._label = recorder.label
        self._agenda = Agenda()
        self._chain = ChainGuard()
        self._interrupts = Interrupts()
        self._coroutines = Coroutines(self)
        self._listeners: dict[tuple[str, str], list[Entry]] = {}
        self._ready: deque[tuple[Entry, int]] = deque()
        super().__init__(context=context)

    # What rclpy calls.

    def create_task(self, callback: Any, *args: Any, **kwargs: Any) -> Task:  # noqa: ANN401
        """Run a callback or coroutine as soon as what is running has ended."""
        task = Task(callback, args, kwargs, executor=self)
        self._coroutines.add_task(task, callback, self.current)
        return task

    # What the session calls.

    @property
    def has_work(self) -> bool:
        """Whether callbacks wait for the next run."""
        return bool(self._ready)

    def watch(self, entry: Entry) -> None:
        """Run this entity's callback from now on, whenever its node spins."""
        if entry.kind == "timer":
            self._agenda.add(entry, self.now)
        elif entry.take is not None:
            self._listeners.setdefault((entry.kind, entry.name), []).append(entry)
            self._look_at(entry)

    def forget(self, state: NodeState) -> None:
        """A node is destroyed: drop what it had."""
        for entry in state.entries:
            self._drop(entry)
        self._coroutines.drop_abandoned()

    def resume(self, state: NodeState) -> None:
        """A node begins to spin: look at everything that waited for it meanwhile."""
        self._changed = True
        for entry in state.entries:
            if entry.take is not None:
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

    def timer_reset(self, entry: Entry) -> None:
        """A timer's `reset` was called."""
        self._agenda.move(entry, self.now)

    def look_anew(self) -> None:
        """Look at everything again: the clock was changed from outside, or a run was broken off."""
        states = self._host.states()
        self._agenda.rebuild([e for s in states for e in s.entries if e.kind == "timer"], self.now)
        self._ready.clear()
        for state in states:
            self.resume(state)

    def run_until(self, end: int, done: Callable[[], bool] | None = None) -> None:
        """Advance virtual time to `end`, in nanoseconds, or until `done` is true.

        Raises:
            EndlessChainError: If callbacks cause one another for ever while no time passes.
        """
        self.running = True
        try:
            with self._interrupts:
                self._run(end, done)
        except BaseException:
            # An interrupt or an endless chain. It may have come between any two steps, so some
            # timer or message may be noted nowhere.
            self._chain.depth = 0
            self.forget_passes()
            self.look_anew()
            self._interrupts.insist()
            raise
        finally:
            self.running = False

    def run_nested(self, end: int) -> None:
        """The same for a callback that sleeps until then: its node must not spin meanwhile."""
        self._run(end, None)

    # How it works.

    def _run(self, end: int, done: Callable[[], bool] | None) -> None:
        self._drain()
        while not (done and done()):
            self._interrupts.insist()
            if self.elsewhere:
                self._take_from_elsewhere()
            deadline = self._agenda.next_deadline(self.now)
            if self.deadlines and self._miss_one(deadline, end):
                continue
            if deadline is None or deadline > end:
                self._advance(max(end, self.now))  # a callback may have slept
                return
            self._step(deadline)

    def _miss_one(self, timer: int | None, end: int) -> bool:
        """Let a deadline for messages pass, if one does before the next timer, and say so."""
        due = self.deadlines.next_due()
        if due is None or due > end or (timer is not None and due >= timer):
            return False
        self._advance(max(due, self.now))
        self._ready.append((self.deadlines.pass_next(), 1))
        self._drain()
        return True

    def _take_from_elsewhere(self) -> None:
        while self.elsewhere:
            self.elsewhere.popleft()()
        self._drain()

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
        handle = entry.handle
        try:
            with handle:
                due = entry.state.spinning and handle.is_timer_ready()
                if due:
                    handle.call_timer()
        except InvalidHandle:
            return  # destroyed
        if due:
            self._chain.timer_fires(entry)
            self._call(entry, entry.entity.callback)
        self._agenda.add(entry, self.now)

    def _drain(self) -> None:
        # The hot path: three attribute look-ups here are a tenth of a message's cost.
        ready, chain, waiting = self._ready, self._chain, self._coroutines.waiting
        turns = 0
        while True:
            while ready:
                entry, depth = ready.popleft()
                if entry.state.spinning and (not waiting or self._coroutines.is_free(entry)):
                    chain.depth = depth
                    if depth > SUSPICIOUS:
                        chain.inspect(entry)
                    self._take(entry)
            chain.depth = 0
            if not (self._resume_coroutines() or self.ask_rclpy() or ready):
                return
            turns += 1
            if turns > MOST_TURNS:
                raise chain.turns_without_end(self._suspects())

    def _take(self, entry: Entry) -> None:
        try:
            work = entry.take(entry, self)  # type: ignore[misc] # only timers have none
        except InvalidHandle:
            self._drop(entry)  # destroyed while its message was on the way
            return
        if work is None:
            entry.backlog = False
            return
        if entry.backlog:
            self._ready.appendleft((entry, self._chain.depth))
        callback, arguments = work
        self._call(entry, callback, arguments)

    def _call(
        self, entry: Entry, callback: Callable[..., Any], arguments: tuple[Any, ...] = ()
    ) -> None:
        entry.calls += 1
        self._note_callback(self.now, entry.label_number)
        self.current, self.calling = entry.state, entry.label
        try:
            result = callback(*arguments)
        except (Exception, SystemExit) as error:
            self._interrupts.insist()
            self._host.callback_raised(entry.state, entry.label.name, error)
        else:
            # A plain function that returns a coroutine forgot to await it; so it is in rclpy.
            if result is not None and iscoroutine(result) and iscoroutinefunction(callback):
                self._begin(result, entry)
        finally:
            self.current = None

    def _begin(self, coroutine: Coroutine[Any, Any, Any], entry: Entry) -> None:
        waiting = self._coroutines.adopt(coroutine, entry)
        self._resume_one(waiting)
        if waiting.ended:
            self._end(waiting)

    def _resume_coroutines(self) -> bool:
        """Give every waiting coroutine a turn; say whether anything came of it."""
        if not self._coroutines.waiting:
            return False
        self._coroutines.drop_abandoned()
        further = self._coroutines.turn(self._resume_one)
        for waiting in [waiting for waiting in self._coroutines.waiting if waiting.ended]:
            self._end(waiting)
        return further

    def _resume_one(self, waiting: Waiting) -> None:
        self.current = waiting.state
        if waiting.entry is not None:
            self.calling = waiting.entry.label
        elif waiting.state is not None:
            self.calling = self._label(waiting.state.name, "task", waiting.name, "")
        try:
            waiting.task()
        except SystemExit as error:
            waiting.task.cancel()
            self._host.callback_raised(waiting.state, waiting.name, error)
        except BaseException:
            waiting.task.cancel()  # rclpy would take it for running, for ever
            self._coroutines.end(waiting)
            raise
        finally:
            self.current = None

    def _end(self, waiting: Waiting) -> None:
        self._coroutines.end(waiting)
        error = waiting.task.exception()
        if error is not None:
            self._host.callback_raised(waiting.state, waiting.name, error)
        for entry in self._coroutines.unblock():
            if entry.kind == "timer":
                self._agenda.add(entry, self.now)
            else:
                self._ready.append((entry, self._chain.depth))

    def _suspects(self) -> list[str]:
        names = [f"{w.state.name} ({w.name})" for w in self._coroutines.waiting if w.state]
        return list(dict.fromkeys(names)) or [s.name for s in self._host.states() if s.spinning]


# `time.sleep` in virtual time.
#
# A node that sleeps in a callback is a process that does nothing else meanwhile: its messages wait
# in their queues, its timers are late, and the other nodes go on. So while nodes run in virtual
# time, a sleep of their thread lets virtual time pass for the others, and no real time. Threads of
# their own, and code of rosbeat, sleep as ever. Who goes on meanwhile: see below.


_OWN = str(Path(__file__).parents[1])


@contextmanager
def virtual_sleep(
    nap: Callable[[float], object], clock: SessionClock, code: Iterable[object]
) -> Iterator[None]:
    """Let `time.sleep` of this thread, and `sleep_for` of the clock, call `nap` with the seconds.

    Args:
        nap: Lets virtual time pass.
        clock: The session's clock.
        code: Classes and functions; `from time import sleep` may stand in their modules.
    """
    real, home = time.sleep, threading.get_ident()

    def sleep(seconds: Any) -> None:  # noqa: ANN401 - unchecked
        own = sys._getframe(1).f_code.co_filename.startswith(_OWN)
        if own or threading.get_ident() != home or not _is_span(seconds):
            real(seconds)
        else:
            nap(float(seconds))

    def sleep_until(until: Any, context: object = None) -> bool:  # noqa: ANN401 - rclpy's
        nap(max(0, until.nanoseconds - clock.now().nanoseconds) / 1e9)
        return True

    with _in_place_of(real, sleep, [vars(time), *_namespaces(code)]):
        clock.sleep_until = sleep_until
        try:
            yield
        finally:
            del clock.sleep_until


@contextmanager
def _in_place_of(old: object, new: object, namespaces: list[dict[str, Any]]) -> Iterator[None]:
    found = [(names, key) for names in namespaces for key, one in names.items() if one is old]
    for names, key in found:
        names[key] = new
    try:
        yield
    finally:
        for names, key in found:
            if names.get(key) is new:
                names[key] = old


def _is_span(seconds: object) -> bool:
    return isinstance(seconds, int | float) and isfinite(seconds) and seconds >= 0


def _namespaces(code: Iterable[object]) -> list[dict[str, Any]]:
    """The global names that functions see, and those of classes and what they inherit from."""
    parts: list[object] = []
    for one in code:
        bases = one.__mro__ if isinstance(one, type) else ()
        parts += [one, *(part for base in bases for part in vars(base).values())]
    found = {id(names): names for part in parts if (names := getattr(part, "__globals__", None))}
    return list(found.values())


# Callbacks that sleep: virtual time passes for the other nodes, and no real time.
#
# On a page and in a check alike, a node that sleeps in a callback is a process that does nothing
# else meanwhile. Its callback goes on where it was, in the one thread that there is, so the others
# run within its call of `time.sleep`. What follows from that: a run ends no sooner than the
# callbacks that it has begun, and begins no other of their nodes then; and of two nodes that sleep
# at once, the one that fell asleep first cannot wake before the other.


#: Virtual seconds that a callback may sleep on when a run is over.
LONGEST = 3600


class Sleepers(Protocol):
    """What is asked of a session's world."""

    clock: SessionClock
    virtual: VirtualTimeExecutor

    def states(self) -> list[NodeState]:
        """All nodes, in order of creation."""

    def spin_node(self, state: NodeState) -> None:
        """Run this node's callbacks from now on."""

    def rest_node(self, state: NodeState) -> None:
        """Run none of this node's callbacks until `spin_node`."""


@contextmanager
def resting(world: Sleepers, state: NodeState) -> Iterator[None]:
    """Run none of a node's callbacks in this block: it sleeps in one of them.

    One that is paused meanwhile does not wake with the end of its sleep.
    """
    virtual = world.virtual
    calling, virtual.current = virtual.calling, None
    world.rest_node(state)
    state.asleep += 1
    try:
        yield
    finally:
        state.asleep -= 1
        if not (state.asleep or state.ended or state.paused):
            world.spin_node(state)
        virtual.current, virtual.calling = state, calling


def run_until(world: Sleepers, end: int, done: Callable[[], bool] | None = None) -> None:
    """Run nodes; a sleep in a callback takes virtual time.

    Args:
        world: The session's world. Where a check runs its nodes, it has seen to sleeps itself.
        end: When the run is to end, in nanoseconds; a callback that sleeps longer prolongs it.
        done: The run ends as soon as this is true.

    Raises:
        EndlessChainError: If callbacks cause one another for ever while no time passes.
    """
    if "sleep_until" in vars(world.clock):
        world.virtual.run_until(end, done)
        return
    doze = _Doze(world, end)
    try:
        with virtual_sleep(doze.nap, world.clock, _code_of(world)):
            world.virtual.run_until(end, done)
    finally:
        doze.let_go()
    if doze.last and world.virtual.now > end:
        note(f"{doze.last} slept beyond the end of this run, which so went on until {_now(world)}.")


class _Doze:
    def __init__(self, world: Sleepers, end: int) -> None:
        self.last = ""
        self._world, self._end = world, end
        self._latest = end + LONGEST * NANOSECONDS
        self._held: list[NodeState] = []

    def nap(self, seconds: float) -> None:
        """Sleep; outside of callbacks, as in the constructor of a node, it takes real time."""
        virtual = self._world.virtual
        state = virtual.current
        if state is None:
            time.sleep(seconds)
            return
        until = virtual.now + round(seconds * NANOSECONDS)
        with resting(self._world, state):
            virtual.run_nested(min(until, self._latest))
        if until > self._latest:
            raise _sleeps_on(state.name)
        self.last = state.name
        if virtual.now > self._end and state not in self._held:
            # What waits for it waits for the next run: else a node that sleeps longer than its
            # messages are apart would never come to an end.
            self._world.rest_node(state)
            self._held.append(state)
        if virtual.now > until:
            note(f"{state.name} woke late, at {_now(self._world)}, after one that slept longer.")

    def let_go(self) -> None:
        """The run is over: nodes that overslept its end may go on in the next."""
        for state in self._held:
            if state.node is not None and not (state.ended or state.paused):
                self._world.spin_node(state)


def _code_of(world: Sleepers) -> list[object]:
    """Classes and functions whose modules may have a `sleep` of their own."""
    found: list[object] = []
    for state in world.states():
        found += [type(state.node), *(getattr(e.entity, "callback", None) for e in state.entries)]
    return found


def _now(world: Sleepers) -> str:
    return f"{world.virtual.now / NANOSECONDS:g} s"


def _sleeps_on(name: str) -> SessionError:
    return SessionError(
        f"A callback of {name} does not wake up.",
        f"It sleeps on {LONGEST} s after the end of the run. A node runs one callback at a time, "
        "so this one does nothing else any more.",
        "To wait for something, return, and let a timer call you again.",
    )


# Random numbers that belong to one session.
#
# A node draws from Python's global generator (`random.uniform`) or NumPy's. Each session keeps
# states of its own and lends them to the process only while its nodes run, so that the same seed
# gives the same numbers whatever else draws in between.


#: The generator behind the functions of `random`: `random.uniform` is a method of it.
_SHARED: random.Random = random.uniform.__self__  # type: ignore[attr-defined]
#: The same function again, and not an equal one: nothing is different after a session.
_PLAIN = random.random


def _numpy_random() -> Any:  # noqa: ANN401 - a module
    # Only a node that imported NumPy can draw from it; importing it here would cost 0.1 s.
    return getattr(sys.modules.get("numpy"), "random", None)


def tilt(exponent: float) -> None:
    """Tilt the numbers that the functions of `random` draw, until the session's run ends.

    They are what would have been drawn, between 0 and 1, raised to a power; so they keep their
    range, and only their mean moves, to 1 / (1 + exponent).

    Args:
        exponent: 1 for no tilt, less for higher numbers, more for lower ones; above 0.
    """
    _straighten()
    if exponent == 1.0:
        return
    plain = _SHARED.random

    def tilted() -> float:
        return float(plain() ** exponent)

    # `uniform` and `gauss` ask the first, `choice` and `randint` the second.
    vars(_SHARED).update(random=tilted, _randbelow=lambda n: int(n * tilted()))
    random.random = tilted


def _straighten() -> None:
    for name in ("random", "_randbelow"):
        vars(_SHARED).pop(name, None)
    random.random = _PLAIN


class SeededRandom:
    """The random state of one session.

    Args:
        seed: The seed, 0 or more. NumPy takes it modulo 2**32.
    """

    def __init__(self, seed: int) -> None:
        self._seed = seed
        self._state = random.Random(seed).getstate()
        self._numpy_state: Any = None
        self._is_lent = False

    @contextmanager
    def lent(self) -> Iterator[None]:
        """Put this session's states in place of the process's, and back at the end.

        Within another `lent` of the same session it does nothing: a constructor may call a service.
        """
        if self._is_lent:
            yield
            return
        self._is_lent = True
        try:
            with self._exchanged():
                yield
        finally:
            self._is_lent = False

    @contextmanager
    def _exchanged(self) -> Iterator[None]:
        outer, numpy = _SHARED.getstate(), _numpy_random()
        outer_numpy = numpy.get_state() if numpy else None
        _SHARED.setstate(self._state)
        if numpy:
            self._enter_numpy(numpy)
        try:
            yield
        finally:
            _straighten()
            self._state = _SHARED.getstate()
            _SHARED.setstate(outer)
            self._leave_numpy(outer_numpy)

    def _enter_numpy(self, numpy: Any) -> None:  # noqa: ANN401
        if self._numpy_state is None:
            numpy.seed(self._seed % 2**32)
        else:
            numpy.set_state(self._numpy_state)

    def _leave_numpy(self, outer: Any) -> None:  # noqa: ANN401
        # NumPy may have been imported meanwhile; then there is no outer state to put back.
        numpy = _numpy_random()
        if numpy:
            self._numpy_state = numpy.get_state()
            if outer is not None:
                numpy.set_state(outer)
