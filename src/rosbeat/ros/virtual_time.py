"""Nodes as a discrete-event simulation.

Nothing happens in a robot's program except in callbacks, and callbacks are caused: by a timer whose
deadline has come, or by something that another callback did. So time can jump from one deadline to
the next. At each instant one timer runs, then all that follows from it, until nothing is left to
do; then the next timer of that instant, in order of (deadline, creation).

What follows is known without waiting: within one participant Fast DDS hands a message over inside
`publish()`, so when `publish()` has returned, the subscriptions of that topic can take it. What was
stored for late-joining subscriptions is there when the subscription has been made; see
`qos_events.wait_for_stored`.

A callback that waits (`time.sleep`, a service call, a `spin` of its own) suspends its process only.
All callbacks run in greenlets: the one that happens to run the loop of the simulation calls them
directly, which costs nothing. If a callback waits, its greenlet is left where it is, and another
one goes on with the loop. When the wait is over the callback's own greenlet goes on, with the
callback first and the loop afterwards, and the other one stands by.
"""

from __future__ import annotations

import contextvars
import threading
import time
from collections import deque
from collections.abc import Callable, Collection, Coroutine, Iterable
from contextlib import AbstractContextManager
from dataclasses import dataclass
from heapq import heappop, heappush
from inspect import iscoroutine, iscoroutinefunction
from itertools import count
from typing import Any, Protocol

from greenlet import GreenletExit, getcurrent, greenlet
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
from rosbeat.records import WaitRecord
from rosbeat.ros.context import Interrupts
from rosbeat.ros.entities import Entry, NodeState, callback_name
from rosbeat.ros.errors import never_made
from rosbeat.ros.processes import Call, Process, Spin, Wait, is_free
from rosbeat.ros.qos_events import Deadlines
from rosbeat.ros.recording import CallbackLabel, Recorder


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
#: Steps that coroutines and tasks may take at one instant.
MOST_TURNS = 100_000
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


# Callbacks that wait by themselves: `async def` callbacks and tasks.


@dataclass(frozen=True, eq=False)
class Waiting:
    """A coroutine or task that has not ended.

    Attributes:
        task: rclpy's task.
        process: Where it runs; None for one that was created outside of all nodes.
        state: The node that began it, if one did.
        name: What it is called in an error.
        entry: The entity whose callback it is; its callback group is occupied until it ends.
    """

    task: Task
    process: Process | None
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
        """Whether it cannot go on now: its node is paused, or its process is busy.

        rclpy looks at its tasks again when it has handled all that its last look found ready.
        """
        if self.task.executing() or (self.state is not None and not self.state.spinning):
            return True
        process = self.process
        return process is not None and (not process.has_thread() or process.is_in_round())

    def place(self) -> object:
        """Return what it awaits, innermost: another object each time it has got further."""
        inner = self.task._handler
        while (deeper := _awaited_by(inner)) is not None:
            inner = deeper
        return inner


def _awaited_by(waiting: Any) -> Any:  # noqa: ANN401 - a coroutine, a generator, or neither
    awaited = getattr(waiting, "cr_await", None)
    return getattr(waiting, "gi_yieldfrom", None) if awaited is None else awaited


class Coroutines:
    """All coroutines of one executor, in the order in which they began.

    Of each process the newest goes on first, as in rclpy (`_wait_for_ready_callbacks`).

    Args:
        executor: The executor that future results are scheduled on.

    Attributes:
        waiting: Those that have not ended.
    """

    def __init__(self, executor: Executor) -> None:
        self._executor = executor
        self.waiting: list[Waiting] = []
        self._round: deque[Waiting] = deque()

    def add_task(self, task: Task, callback: object, call: Call | None) -> None:
        """Begin a task at the next turn, in the process of the call that has created it."""
        process, state = (call.process, call.state) if call else (None, None)
        self.waiting.append(Waiting(task, process, state, callback_name(callback)))

    def adopt(self, coroutine: Coroutine[Any, Any, Any], entry: Entry) -> Waiting:
        """Keep the coroutine that a callback returned; its group is occupied until it ends."""
        entry.entity.callback_group.beginning_execution(entry.entity)
        task = Task(coroutine, executor=self._executor)
        state = entry.state
        waiting = Waiting(task, state.process, state, entry.label.name, entry)
        self.waiting.append(waiting)
        return waiting

    def step(self, run: Callable[[Waiting], None]) -> bool:
        """Let one of them go on until it waits again; return whether any has got further.

        Each gets its turn before one of them gets another.
        """
        for _ in range(2):
            while self._round:
                if self._one(self._round.popleft(), run):
                    return True
            of_process: dict[int, list[Waiting]] = {}
            for waiting in self.waiting:
                of_process.setdefault(id(waiting.process), []).append(waiting)
            self._round.extend(one for group in of_process.values() for one in reversed(group))
        return False

    def end(self, waiting: Waiting) -> None:
        """Forget one that has ended, and free its callback group."""
        if waiting not in self.waiting:
            return
        self.waiting.remove(waiting)  # the executor holds on to the list
        if waiting.entry is not None:
            waiting.entry.entity.callback_group.ending_execution(waiting.entry.entity)

    def drop_abandoned(self) -> None:
        """Close the coroutines of nodes that have ended."""
        for waiting in [waiting for waiting in self.waiting if waiting.abandoned]:
            waiting.task.cancel()
            self.end(waiting)

    @staticmethod
    def _one(waiting: Waiting, run: Callable[[Waiting], None]) -> bool:
        if waiting.ended or waiting.rests:
            return False
        before = waiting.place()
        run(waiting)
        return waiting.ended or waiting.place() is not before


# What cannot be taken directly: guard conditions and waitables, through rclpy's own wait set.


_TAKEN_DIRECTLY = (Subscription, Timer, Client, Service)


class Host(Protocol):
    """What the executor asks of its session."""

    def states(self) -> list[NodeState]:
        """Return all nodes, in order of creation."""

    def state_of(self, node: Node) -> NodeState | None:
        """Return what is known of a node."""

    def spin_node(self, state: NodeState) -> None:
        """Run this node's callbacks from now on."""

    def pause_node(self, state: NodeState) -> None:
        """Run none of this node's callbacks until `spin_node`."""

    def callback_ran(self, entity: Any, node: Node | None) -> None:  # noqa: ANN401
        """Record that a callback of this entity is about to run."""

    def callback_raised(self, state: NodeState | None, name: str, error: BaseException) -> None:
        """Record an exception that left a callback, and end its process."""

    def deadlocked(self, waits: list[Wait]) -> None:
        """Record that callbacks wait for ever."""

    def running(self) -> AbstractContextManager[None]:
        """Make nodes feel at home while they run in this thread."""


class WaitSetExecutor(SingleThreadedExecutor):
    """rclpy's executor, asked only for what cannot be taken directly.

    One pass costs about a millisecond. It is made for nodes that have guard conditions or waitables
    (actions, say), and once for all nodes after entities were made or destroyed: publishers and
    subscriptions tell of a QoS that does not fit by waitables too, but only then.

    Attributes:
        current: The code of a node that is running, or None.
    """

    _host: Host
    # rclpy's `__del__` asks for it, also if an interrupt has come before it was made.
    _sigint_gc: Any = None

    def __init__(self, **options: Any) -> None:  # noqa: ANN401 - rclpy's own
        self.current: Call | None = None
        self._changed = True
        self._wait_set_nodes: list[Node] = []
        super().__init__(**options)

    def get_nodes(self) -> list[Node]:
        """Return the nodes whose processes have a thread for them, in order of creation.

        rclpy's own answer comes from an unordered set.
        """
        return [
            state.node
            for state in self._host.states()
            if state.spinning and state.process.has_thread()
        ]

    def wake(self) -> None:
        """Note that entities were made or destroyed."""
        self._changed = True
        super().wake()

    def can_execute(self, entity: Any) -> bool:  # noqa: ANN401 - rclpy's own signature
        """Keep from rclpy's wait set what is taken directly."""
        return not isinstance(entity, _TAKEN_DIRECTLY) and bool(super().can_execute(entity))

    def ask_rclpy(self) -> bool:
        """Make one pass of rclpy's own wait set; return whether anything came of it."""
        nodes = self._nodes_for_wait_set()
        progress = False
        self._cb_iter = None  # a pass that was left when a callback waited is over
        while nodes:
            try:
                handler, entity, node = self.wait_for_ready_callbacks(timeout_sec=0, nodes=nodes)
            except TimeoutException:
                break
            self._handle(handler, entity, node)
            progress = progress or handler.done()
            nodes = [node for node in nodes if node in self.get_nodes()]
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
        if state is None:
            return
        call = self.current = Call(state.process, state)
        error: BaseException | None = None
        try:
            handler()
        except SystemExit as stop:
            error = stop
            handler.cancel()
        finally:
            self._end_call(call)
        error = error or handler.exception()
        if error is not None:
            self._raised(call, waitable_name(entity), error)

    def _end_call(self, call: Call) -> None:
        raise NotImplementedError

    def _raised(self, call: Call, name: str, error: BaseException) -> None:
        raise NotImplementedError

    def _nodes_for_wait_set(self) -> list[Node]:
        if not self._changed:
            return self._wait_set_nodes and self._those_that_spin()
        self._changed = False
        nodes = self.get_nodes()
        self._wait_set_nodes = list(_with_waitables(self._host.states()))
        return nodes

    def _those_that_spin(self) -> list[Node]:
        spinning = self.get_nodes()
        return [node for node in self._wait_set_nodes if node in spinning]


def waitable_name(entity: Any) -> str:  # noqa: ANN401 - any of rclpy's
    """Return what a guard condition's or waitable's callback is called."""
    callback = getattr(entity, "callback", None) or entity
    return getattr(callback, "__name__", type(callback).__name__)


def waitable_kind(entity: Any) -> str:  # noqa: ANN401 - any of rclpy's
    """Return what kind of callback it has, as `CallbackRecord` names it."""
    if isinstance(entity, EventHandler):
        return "event"
    return "guard condition" if isinstance(entity, GuardCondition) else "waitable"


def _with_waitables(states: Iterable[NodeState]) -> Iterable[Node]:
    for node in (state.node for state in states if state.spinning and state.node):
        ours = any(not isinstance(waitable, EventHandler) for waitable in node.waitables)
        if ours or any(True for _ in node.guards):
            yield node


# The clock.


_POINT = rclpy_implementation.rcl_time_point_t


class SessionClock(ROSClock):
    """A ROS clock that only its session moves.

    Every node of a session uses this one object, so no node can read a time that another has
    already left. rclpy's time source would set a node's clock from the parameter `use_sim_time`
    and from `/clock` messages; both calls are accepted and change nothing.

    Attributes:
        sleeper: Waits in virtual time until an instant, in nanoseconds; None while the session is
            live.
    """

    sleeper: Callable[[int], None] | None = None

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

    def sleep_until(self, until: Time, context: Context | None = None) -> bool:
        """Sleep until a time of this clock; see rclpy. `sleep_for` calls this, too."""
        if self.sleeper is None:
            return bool(super().sleep_until(until, context))
        self.sleeper(until.nanoseconds)
        return True


def make_clock() -> SessionClock:
    """Return a clock at virtual time zero."""
    # ROSClock's constructor always returns a plain ROSClock, whatever class it is asked for.
    clock = ROSClock()
    clock.__class__ = SessionClock
    clock.follow_session(0)
    made: SessionClock = clock
    return made


# The simulation.


class VirtualTimeExecutor(WaitSetExecutor):
    """Runs the callbacks of all processes in virtual time.

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
        nap: What is called, with nanoseconds and the reason, when a constructor waits that a
            scenario calls; None to let virtual time pass.
        thread: The thread in which the nodes run.
    """

    def __init__(
        self, context: Context, clock: SessionClock, recorder: Recorder, host: Host
    ) -> None:
        self.now = 0
        self.running = False
        self.calling: CallbackLabel | None = None
        self.elsewhere: deque[Callable[[], None]] = deque()
        self.deadlines = Deadlines()
        self._waits: list[WaitRecord] = []
        self.nap: Callable[[int, str], None] | None = None
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
        # Timers of this instant that have not had their turn; processes that have something
        # pending and may be able to run it.
        self._due: deque[Entry] = deque()
        self._behind: deque[Process] = deque()
        # Who waits: by the time at which they go on; for something that is looked at again and
        # again; and those whose wait has been ended by somebody.
        self._sleeping: list[tuple[int, int, Wait]] = []
        self._looking: list[Wait] = []
        self._woken: deque[Wait] = deque()
        self._order = count()
        # Greenlets that stand by to run the loop, and the one that waits for the end of the run.
        self._idle: list[greenlet] = []
        self._main: greenlet = getcurrent()
        self.thread = threading.get_ident()
        self._variables = contextvars.copy_context()
        self._end = 0
        self._done: Callable[[], object] = _never
        self._ends_idle = self._closing = False
        # Where tasks run that no code of a node has created.
        self._nowhere = Process()
        super().__init__(context=context)
        clock.sleeper = self.sleep_until

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
        return bool(self._ready or self._behind)

    @property
    def in_callback(self) -> bool:
        """Whether the caller is code of a node: a callback, a constructor or a program."""
        return self.current is not None and threading.get_ident() == self.thread

    @property
    def suspended(self) -> list[Call]:
        """The callbacks, constructors and programs that wait now, in order of creation."""
        found = {id(state.process): state.process for state in self._host.states()}
        return [call for process in found.values() for call in process.calls]

    def all_waits(self) -> tuple[WaitRecord, ...]:
        """Return what callbacks have waited for, and what they wait for now, in order of time."""
        now = [
            WaitRecord(call.wait.began_ns, self.now, call.node, call.name, call.wait.reason)
            for call in self.suspended
            if call.wait is not None and not call.spinning and call.wait.began_ns < self.now
        ]
        return tuple(sorted([*self._waits, *now], key=lambda one: one.time_ns))

    def watch(self, entry: Entry) -> None:
        """Run this entity's callback from now on, whenever its node spins."""
        if entry.kind == "timer":
            self._agenda.add(entry, self.now)
        elif entry.take is not None:
            self._listeners.setdefault((entry.kind, entry.name), []).append(entry)
            self._look_at(entry)

    def unwatch(self, entry: Entry) -> None:
        """Take nothing from this entity any more."""
        listeners = self._listeners.get((entry.kind, entry.name), [])
        if entry in listeners:
            listeners.remove(entry)
        self._settle(entry)

    def forget(self, state: NodeState) -> None:
        """Drop what a node had that is destroyed, with its callbacks that wait."""
        for entry in state.entries:
            self.unwatch(entry)
        for call in [call for call in state.process.calls if call.state is state]:
            self.break_off(call)
        state.process.forget(state)
        self._coroutines.drop_abandoned()

    def resume(self, state: NodeState) -> None:
        """Look at everything that waited for a node that begins to spin."""
        self._changed = True
        state.process.refresh()
        for entry in state.entries:
            if entry.take is not None:
                self._look_at(entry)
        self._catch_up(state.process)

    def sender(self, kind: str, name: str, origin: NodeState | None = None) -> Callable[[], None]:
        """Return a function to call whenever something is sent to the `kind` entities of a name.

        What is sent is a message, a request or an answer; whoever waits for it will take it.

        Args:
            kind: `subscription`, `service` or `client`.
            name: The topic or the service.
            origin: Who sends. Its own process takes nothing before its executor has looked anew.
        """
        listeners = self._listeners.setdefault((kind, name), [])
        ready, chain = self._ready, self._chain

        def happened() -> None:
            for entry in listeners:
                if origin is not None and entry.state.process is origin.process:
                    self._hold(entry)
                else:
                    ready.append((entry, chain.depth + 1))

        return happened

    def happened(self, kind: str, name: str, origin: NodeState | None = None) -> None:
        """Note that something was sent to the `kind` entities of a name; see `sender`."""
        self.sender(kind, name, origin)()

    def timer_reset(self, entry: Entry) -> None:
        """Note that a timer's `reset` was called."""
        self._agenda.move(entry, self.now)

    def look_anew(self) -> None:
        """Look at everything again: the clock was changed from outside, or a run was broken off."""
        states = self._host.states()
        self._ready.clear()
        self._due.clear()
        self._behind.clear()
        for state in states:
            state.process.due = 0
            state.process.pending.clear()
        self._agenda.rebuild([e for s in states for e in s.entries if e.kind == "timer"], self.now)
        for state in states:
            self.resume(state)

    def run_until(
        self, end: int, done: Callable[[], object] | None = None, *, ends_idle: bool = False
    ) -> None:
        """Advance virtual time.

        Callbacks that wait at the end go on in the next run.

        Args:
            end: Until when, in nanoseconds.
            done: The run ends as soon as this is true.
            ends_idle: It ends, too, as soon as nothing will happen any more; time stays then.

        Raises:
            EndlessChainError: If callbacks cause one another for ever while no time passes.
        """
        self._enter_thread()
        self._end, self._done, self._ends_idle = end, done or _never, ends_idle
        caller, self.current = self.current, None
        self._main, self._variables = getcurrent(), contextvars.copy_context()
        self.running = True
        try:
            with self._interrupts:
                self._next_driver().switch()
        except BaseException:
            # An interrupt or an endless chain. It may have come between any two steps, so some
            # timer or message may be noted nowhere.
            self._chain.depth = 0
            self.forget_passes()
            self.look_anew()
            self._interrupts.raise_if_pressed()
            raise
        finally:
            self.running = False
            self.current = caller

    def close(self) -> None:
        """End all callbacks that wait, as the end of a process does, and leave no greenlet."""
        self._closing = True
        for call in self.suspended:
            self.break_off(call)
        for idle in self._idle:
            _throw(idle, GreenletExit())
        self._idle.clear()
        self._looking.clear()
        self._sleeping.clear()
        self._session_clock.sleeper = None

    # Waiting.

    def sleep(self, seconds: float) -> None:
        """Let virtual time pass for everybody but the caller's process."""
        if seconds > 0:
            self.sleep_until(self.now + max(1, round(seconds * 1e9)))

    def after(self, seconds: float | None) -> int | None:
        """Return the time after so many seconds, in nanoseconds; None for none or below zero."""
        return None if seconds is None or seconds < 0 else self.now + round(seconds * 1e9)

    def longest(self) -> int:
        """Return until when a cell waits that sets no limit, in nanoseconds."""
        return self.now + LONGEST_WAIT

    def block(
        self,
        reason: str,
        until: int | None = None,
        met: Callable[[], object] | None = None,
        *,
        needs: Any = None,  # noqa: ANN401 - any entity of rclpy
        spinning: bool = False,
    ) -> bool:
        """Suspend the code of a node that calls this, until a time or until something is true.

        In a cell, and in a constructor that a cell calls, the others run meanwhile until then.

        Args:
            reason: What it waits for, in words.
            until: When it goes on at the latest, in nanoseconds; None for no limit.
            met: Returns whether it has come true.
            needs: The entity of the caller's process whose callback has to run first, if any.
            spinning: Whether the thread of the caller runs other callbacks of its process.

        Returns:
            Whether it came true; False if the time was up first.

        Raises:
            SessionError: If it can never end.
        """
        if met is not None and met():
            return True
        here, call = getcurrent(), self.current
        if call is not None and (call.broken or self._closing):
            call.broken += 1
            if call.broken > _MOST_EXITS:  # it catches everything: it is left where it is
                here.parent.switch()
            raise GreenletExit
        if here is self._main or not self.running:
            return self._block_main(reason, until, met)
        assert call is not None  # only code of a node runs in another greenlet
        wait = Wait(call, here, reason, self.now, until, met, needs)
        self._suspend(call, wait, spinning)
        try:
            if not wait.can_end():
                self._host.deadlocked([wait])
            self._next_driver().switch()
        finally:
            self._unsuspend(call, wait)
        if wait.error is not None:
            raise wait.error
        return bool(met()) if met is not None else True

    def spin(
        self,
        states: Collection[NodeState],
        until: int | None = None,
        met: Callable[[], object] | None = None,
        most: int | None = None,
        needs: Any = None,  # noqa: ANN401 - any entity of rclpy
    ) -> None:
        """Run callbacks of the caller's process, as one of rclpy's `spin` functions does.

        Args:
            states: The nodes that are spun.
            until: When it ends at the latest, in nanoseconds; None for no limit.
            met: It ends as soon as this is true.
            most: How many callbacks run at most; None for any number.
            needs: The entity whose callback has to run before `met` can come true, if it is known.

        Raises:
            Exception: What a callback raises.
            SessionError: If it can never end.
        """
        call = self.current
        assert call is not None
        spin = Spin(states, most)
        begun = [state for state in states if not state.spinning]
        call.process.spins.append(spin)
        try:
            for state in begun:
                self._host.spin_node(state)
            call.process.refresh()
            self._catch_up(call.process)
            over = met if most is None else lambda: spin.left == 0 or (met is not None and met())
            self.block("spin", until, over, needs=needs, spinning=True)
        finally:
            call.process.spins.remove(spin)
            for state in begun:
                if not state.ended:
                    self._host.pause_node(state)
            call.process.refresh()

    def end_wait(self, call: Call, error: BaseException | None = None) -> None:
        """Let a call that waits go on, and raise an exception in it if one is given."""
        wait, spins = call.wait, call.process.spins
        if wait is None or wait.over:
            return
        wait.error = wait.error or error
        if call.spinning and spins:
            spins[-1].left = 0  # no other callback begins before the `spin` has returned
            call.process.refresh()
        self._woken.append(wait)

    def break_off(self, call: Call) -> None:
        """End a call that waits, as the end of its process would: only its `finally` blocks run."""
        wait, call.broken = call.wait, 1
        if wait is not None and not wait.over and wait.thread is not getcurrent():
            before = self.current, self.calling
            wait.over = True
            with self._host.running():  # its `finally` blocks may sleep, too
                _throw(wait.thread, GreenletExit())
            self.current, self.calling = before
        if call in call.process.calls:
            call.process.calls.remove(call)
            call.process.refresh()

    def start_thread(self, main: Callable[[], None], process: Process) -> None:
        """Begin another greenlet, for the `main` of a program, as soon as virtual time goes on."""

        def run() -> None:
            self.current = Call(process)
            try:
                main()
            finally:
                if not self._closing:
                    getcurrent().parent = self._next_driver()

        self._woken.append(Wait(None, greenlet(run, self._main), "start", self.now))

    def sleep_until(self, until: int) -> None:
        """Wait until a time, in nanoseconds of virtual time."""
        if threading.get_ident() != self.thread:
            time.sleep(max(0, until - self.now) / 1e9)  # a thread of the node's own: in real time
        elif until > self.now:
            if self.nap is not None and not self.running:
                self.nap(until - self.now, "sleep")
            else:
                self.block("sleep", until)

    def _block_main(self, reason: str, until: int | None, met: Callable[[], object] | None) -> bool:
        """Run the others until then; the greenlet that waits for the run cannot be suspended."""
        call, label = self.current, self.calling
        latest = self.longest() if until is None else until
        if self.nap is not None:
            self.run_until(self.now, met)
            if met is None or not met():
                self.nap(latest - self.now, reason)
        elif call is None:
            self.run_until(latest, met, ends_idle=until is None)
        else:  # a constructor that a cell has called
            call.began_ns = self.now if call.began_ns < 0 else call.began_ns
            self.run_until(min(latest, call.began_ns + LONGEST_START), met, ends_idle=until is None)
            if (until is None or self.now < until) and not (met is not None and met()):
                raise never_made((self.now - call.began_ns) / 1e9)
        self.calling = label
        return bool(met()) if met is not None else True

    def _suspend(self, call: Call, wait: Wait, spinning: bool) -> None:
        if call.process.program is not None:
            call.process.program.leave()
        call.wait, call.spinning = wait, spinning
        if call.began_ns < 0:
            call.began_ns = self.now
            call.process.calls.append(call)
            if call.entry is not None and is_free(call.entry):
                call.holds_group = True
                entity = call.entry.entity
                entity.callback_group.beginning_execution(entity)
        call.process.refresh()
        if wait.until_ns is not None:
            heappush(self._sleeping, (wait.until_ns, next(self._order), wait))
        if wait.met is not None:
            self._looking.append(wait)
        if spinning:
            self._catch_up(call.process)

    def _unsuspend(self, call: Call, wait: Wait) -> None:
        wait.over = True
        if wait in self._looking:
            self._looking.remove(wait)
        if self.now > wait.began_ns and not call.spinning:
            self._waits.append(
                WaitRecord(wait.began_ns, self.now, call.node, call.name, wait.reason)
            )
        call.wait, call.spinning = None, False
        call.process.refresh()
        self.current, self.calling = call, call.label or self.calling
        if call.process.program is not None:
            call.process.program.enter()

    def _resume(self, wait: Wait) -> None:
        """Go on with a call whose wait is over; the greenlet of the caller stands by."""
        wait.over = True
        wait.thread.parent = self._main
        wait.thread.gr_context = self._variables
        self._idle.append(getcurrent())
        wait.thread.switch()

    def _next_driver(self) -> greenlet:
        """Return a greenlet that goes on with the loop."""
        driver = self._idle.pop() if self._idle else greenlet(self._drive)
        driver.parent = self._main
        driver.gr_context = self._variables
        return driver

    def _enter_thread(self) -> None:
        """Greenlets belong to the thread that has made them."""
        if threading.get_ident() == self.thread:
            return
        if self.suspended:
            call = self.suspended[0]
            raise SessionError(
                f"This session runs in another thread, where {call.name} of {call.node} waits.",
                "A callback that has begun goes on in the thread in which it has begun.",
                "Call `ros.run` in that thread, or open a session for each thread.",
            )
        self.thread = threading.get_ident()
        self._idle.clear()

    # The loop.

    def _drive(self, *_: object) -> None:
        """Run whatever is next, for ever; at the end of a run, hand over to who waits for it."""
        while True:
            self.current = None
            self._drain()
            if self._done():
                self._end_run()
                continue
            self._interrupts.raise_if_pressed()
            if self.elsewhere:
                self._take_from_elsewhere()
                continue
            wait = self._over()
            if wait is not None:
                self._resume(wait)
            elif self._due:
                self._fire_due()
            elif not self._advance_to_next():
                self._end_run()

    def _end_run(self) -> None:
        self._idle.append(getcurrent())
        self._main.switch()

    def _over(self) -> Wait | None:
        """Return a wait that was ended, or whose condition has come true."""
        while self._woken:
            wait = self._woken.popleft()
            if not wait.over:
                return wait
        for wait in self._looking:
            if wait.met is not None and wait.met():
                return wait
        return None

    def _advance_to_next(self) -> bool:
        """Jump to what comes next: timers, then QoS deadlines, then sleepers of an instant.

        Returns:
            Whether anything comes before the end of the run.
        """
        while self._sleeping and self._sleeping[0][2].over:
            heappop(self._sleeping)
        timer = self._agenda.next_deadline(self.now)
        missed = self.deadlines.next_due() if self.deadlines else None
        wakes = self._sleeping[0][0] if self._sleeping else None
        found = [at for at in (timer, missed, wakes) if at is not None]
        if not found:
            return self._nothing_left()
        at = min(found)
        if at > self._end:
            self._advance(max(self._end, self.now))
            return False
        self._advance(max(at, self.now))
        if timer == at:
            self._collect_due(at)
        elif missed == at:
            self._ready.append((self.deadlines.pass_next(), 1))
        else:
            self._woken.append(heappop(self._sleeping)[2])
        return True

    def _nothing_left(self) -> bool:
        """Nothing will ever happen: who waits without a limit waits for ever, and is told."""
        stuck = [wait for wait in self._looking if wait.is_for_good() and not wait.told]
        if stuck:
            self._host.deadlocked(stuck)
        if not self._ends_idle:
            self._advance(max(self._end, self.now))
        return False

    def _collect_due(self, deadline: int) -> None:
        while self._agenda.next_deadline(self.now) == deadline:
            entry = self._agenda.pop()
            entry.state.process.due += 1
            self._due.append(entry)

    def _fire_due(self) -> None:
        entry = self._due.popleft()
        process = entry.state.process
        process.due = max(0, process.due - 1)
        self._fire(entry)
        if process.pending and not process.due:
            self._catch_up(process)

    def _take_from_elsewhere(self) -> None:
        while self.elsewhere:
            self.elsewhere.popleft()()

    def _advance(self, time_ns: int) -> None:
        if time_ns != self.now:
            self._chain.instant_ends()
            self.now = time_ns
            self._session_clock.advance(time_ns)

    # What is ready.

    def _look_at(self, entry: Entry) -> None:
        """Take from an entity as long as there is something: nobody counted what has come."""
        self._hold(entry)

    def _hold(self, entry: Entry) -> None:
        """Keep for later what cannot run at once."""
        process = entry.state.process
        if entry not in process.pending:
            process.pending[entry] = self._chain.depth + 1
            process.refresh()
        self._catch_up(process)

    def _settle(self, entry: Entry) -> None:
        """Note that there is nothing more to take from an entity."""
        process = entry.state.process
        if process.pending.pop(entry, None) is not None:
            process.refresh()

    def _catch_up(self, process: Process) -> None:
        if process.pending and process not in self._behind:
            self._behind.append(process)

    def _drain(self) -> None:
        """Run everything that is ready, and all that follows from it, at this instant."""
        # The hot path: three attribute look-ups here are a tenth of a message's cost.
        ready, chain, waiting = self._ready, self._chain, self._coroutines.waiting
        turns = 0
        while True:
            while ready:
                entry, depth = ready.popleft()
                if entry.state.open and (not waiting or is_free(entry)):
                    chain.depth = depth
                    if depth > SUSPICIOUS:
                        chain.inspect(entry)
                    self._take(entry)
                elif entry.state.spinning:
                    chain.depth = depth - 1
                    self._hold(entry)
            chain.depth = 0
            progress = self._step_coroutine()
            if not progress and self._run_one_behind():
                continue
            # After each step of a coroutine, too: other processes take what it has sent.
            if not (self.ask_rclpy() or progress or ready):
                return
            turns += 1
            if turns > MOST_TURNS:
                raise chain.turns_without_end(self._suspects())

    def _run_one_behind(self) -> bool:
        """Run one callback of a process that could not run it before; return whether one did."""
        behind, kept = self._behind, 0
        while len(behind) > kept:
            process = behind[0]
            if process.due:  # its timers of this instant come first
                behind.rotate(-1)
                kept += 1
                continue
            entry = process.next_ready()
            if entry is None:
                behind.popleft()
                continue
            self._chain.depth = depth = process.pending.pop(entry)
            if depth > SUSPICIOUS:
                self._chain.inspect(entry)
            self._run_pending(entry, depth)
            return True
        return False

    def _run_pending(self, entry: Entry, depth: int) -> None:
        process = entry.state.process
        if entry.kind == "timer":
            self._fire(entry)
        elif self._take(entry) and not entry.state.ended:
            process.pending.setdefault(entry, depth)  # there may be more
            self._catch_up(process)
        process.refresh()

    def _fire(self, entry: Entry) -> None:
        state = entry.state
        if state.spinning and not (
            state.process.can_begin(entry) if self._coroutines.waiting or not state.open else True
        ):
            self._hold(entry)  # it is late, and fires when its process is free
            return
        handle = entry.handle
        try:
            with handle:
                due = state.spinning and handle.is_timer_ready()
                if due:
                    handle.call_timer()
        except InvalidHandle:
            return  # destroyed
        self._agenda.add(entry, self.now)  # before the callback, which may wait for longer
        if due:
            self._chain.timer_fires(entry)
            self._call(entry, entry.entity.callback)

    def _take(self, entry: Entry) -> bool:
        """Take one thing and run the callback; return whether there was something."""
        try:
            work = entry.take(entry, self)  # type: ignore[misc] # only timers have none
        except InvalidHandle:
            self.unwatch(entry)  # destroyed while its message was on the way
            return False
        if work is None:
            return False
        callback, arguments = work
        self._call(entry, callback, arguments)
        return True

    # Calls.

    def _call(
        self, entry: Entry, callback: Callable[..., Any], arguments: tuple[Any, ...] = ()
    ) -> None:
        entry.calls += 1
        self._note_callback(self.now, entry.label_number)
        state = entry.state
        self.current = call = Call(state.process, state, entry, entry.label)
        self.calling = entry.label
        program = state.process.program
        if program is not None:
            program.enter()
        try:
            result = callback(*arguments)
        except (Exception, SystemExit) as error:
            self._interrupts.raise_if_pressed()
            self._raised(call, entry.label.name, error)
        except KeyboardInterrupt as error:
            if program is None or program.interrupt is not error:
                raise
            self._raised(call, entry.label.name, error)
        else:
            # A plain function that returns a coroutine forgot to await it; so it is in rclpy.
            if result is not None and iscoroutine(result) and iscoroutinefunction(callback):
                self._begin(result, entry)
        finally:
            if program is not None:
                program.leave()
            self.current = None
            if call.began_ns >= 0:
                self._end_suspended(call)
            if not state.open:
                state.process.count_down()

    def _end_call(self, call: Call) -> None:
        self.current = None
        if call.began_ns >= 0:
            self._end_suspended(call)
        call.process.count_down()

    def _end_suspended(self, call: Call) -> None:
        """Free the thread and the group of a callback that has waited and has returned."""
        process = call.process
        if call in process.calls:
            process.calls.remove(call)
        if call.holds_group and call.entry is not None:
            call.entry.entity.callback_group.ending_execution(call.entry.entity)
        self._changed = True
        process.refresh()
        self._catch_up(process)
        if process.program is not None:
            process.program.callback_ended()

    def _raised(self, call: Call, name: str, error: BaseException) -> None:
        """Hand what a callback raised to the `spin` in which it ran, or to the session."""
        process = call.process
        if isinstance(error, SystemExit) and process.program is not None and process.threads > 1:
            return  # a thread of the executor's pool swallows it (`concurrent.futures`)
        spinner = next((one for one in reversed(process.calls) if one.spinning), None)
        if spinner is not None:
            self.end_wait(spinner, error)
        else:
            self._host.callback_raised(call.state, name, error)

    def _begin(self, coroutine: Coroutine[Any, Any, Any], entry: Entry) -> None:
        waiting = self._coroutines.adopt(coroutine, entry)
        self._resume_one(waiting)
        if waiting.ended:
            self._coroutine_ended(waiting)

    def _step_coroutine(self) -> bool:
        """Let a waiting coroutine go on; return whether any has got further."""
        if not self._coroutines.waiting:
            return False
        self._coroutines.drop_abandoned()
        further = self._coroutines.step(self._resume_one)
        for waiting in [waiting for waiting in self._coroutines.waiting if waiting.ended]:
            self._coroutine_ended(waiting)
        return further

    def _resume_one(self, waiting: Waiting) -> None:
        label = waiting.entry.label if waiting.entry else None
        if label is None and waiting.state is not None:
            label = self._label(waiting.state.name, "task", waiting.name, "")
        call = Call(waiting.process or self._nowhere, waiting.state, None, label)
        self.current, self.calling = call, label or self.calling
        try:
            waiting.task()
        except SystemExit as error:
            waiting.task.cancel()
            self._raised(call, waiting.name, error)
        except BaseException:
            waiting.task.cancel()  # rclpy would take it for running, for ever
            self._coroutines.end(waiting)
            raise
        finally:
            self.current = None
            if call.began_ns >= 0:
                self._end_suspended(call)

    def _coroutine_ended(self, waiting: Waiting) -> None:
        self._coroutines.end(waiting)
        error = waiting.task.exception()
        if error is not None:
            call = Call(waiting.process or self._nowhere, waiting.state)
            self._raised(call, waiting.name, error)
        if waiting.process is not None:
            self._catch_up(waiting.process)

    def _suspects(self) -> list[str]:
        names = [f"{w.state.name} ({w.name})" for w in self._coroutines.waiting if w.state]
        return list(dict.fromkeys(names)) or [s.name for s in self._host.states() if s.spinning]


#: Virtual nanoseconds that a cell waits for another node at most, in a call without a limit.
LONGEST_WAIT = 3600 * 1_000_000_000
#: Virtual nanoseconds that a constructor may wait while it is called by a cell.
LONGEST_START = 600 * 1_000_000_000


#: How often a callback is told to end that catches even that.
_MOST_EXITS = 100


def _never() -> bool:
    return False


def _throw(thread: greenlet, error: BaseException) -> None:
    """End a greenlet by an exception; what its code makes of that is its own affair."""
    if thread.dead:
        return
    thread.parent = getcurrent()
    try:
        thread.throw(error)
    except BaseException as raised:  # also what a `finally` block of a learner's raises
        if isinstance(raised, KeyboardInterrupt):
            raise
