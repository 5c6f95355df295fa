"""Describe nodes, their entities, and the simulated processes that run their callbacks.

On a robot most nodes are processes of their own, and each process has one executor. A callback that
sleeps or waits blocks its own process only. The unit of the simulation is therefore the process.

Most processes are plain: one executor with one thread, and callbacks of timers, subscriptions,
services and clients. The engine takes the work of these directly (`is_direct`), in the order of
rclpy's executor. All others are run by rclpy's own executors, over `wait_set`.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from rclpy.exceptions import InvalidHandle
from rclpy.node import Node

if TYPE_CHECKING:
    from rclpy.executors import Executor

    from rosbeat.ros.recording import CallbackLabel, PublisherTap
    from rosbeat.ros.simulated_program import SimulatedProgram
    from rosbeat.ros.waits import Call


def full_name(name: str, namespace: str) -> str:
    """Return a node's full name, such as `/room/sensor`."""
    return f"/{namespace.strip('/')}/{name}".replace("//", "/")


def callback_name(callback: Any) -> str:  # noqa: ANN401 - a callback may be any callable
    """Return the name a learner gave to a function, also when it is a lambda or an object."""
    if callback is None:
        return "None"  # the callback of a timer that was given none, or of a rate
    return getattr(callback, "__name__", type(callback).__name__)


#: Why a node has ended, as `Ending.kind` says it.
RAISED, SHUT_DOWN, INTERRUPTED = "raised", "shut down", "interrupted"


@dataclass(frozen=True)
class Ending:
    """Say why the nodes of a process have ended.

    Attributes:
        kind: `RAISED`: a callback raised; `SHUT_DOWN`: it called `rclpy.shutdown()`; `INTERRUPTED`:
            it did not return, and was interrupted.
        node: Full name of the node whose callback it was, one of the process.
        callback: The callback.
        time_ns: When it was, in nanoseconds since the session began.
    """

    kind: str
    node: str
    callback: str
    time_ns: int


@dataclass(eq=False)
class NodeState:
    """Hold the state of one node of a session.

    Attributes:
        number: Order of creation.
        name: Full name.
        spinning: Whether its callbacks run: it was added, has no fault and is not paused.
        born_ns: When it was created, in nanoseconds since the session began.
        open: Whether its callbacks can run at once: it spins, its process is plain, and nothing in
            its process waits.
        paused: Whether the session was told to pause it.
        ended: Whether it raised in a callback or requested a shutdown; this is permanent.
        is_scheduled: Whether the schedule of the engine has its timers.
        ending: Why it has ended, if that is known.
        entries: Its timers, subscriptions, servers and clients, in order of creation.
        taps: The taps on its publishers, in order of creation.
        actions: Its action servers and clients, in order of creation; see `actions`.
    """

    number: int
    name: str
    node: Node
    process: Process
    spinning: bool = False
    born_ns: int = 0
    open: bool = False
    paused: bool = False
    ended: bool = False
    is_scheduled: bool = False
    ending: Ending | None = None
    entries: list[Entry] = field(default_factory=list)
    taps: list[PublisherTap] = field(default_factory=list)
    actions: list[Any] = field(default_factory=list)


@dataclass(eq=False, slots=True)
class Entry:
    """Hold one timer, subscription, server or client, with the data that the engine needs.

    Attributes:
        number: Order of creation over the whole session.
        kind: `timer`, `subscription`, `service`, `client` or `event`.
        entity: The rclpy object; rclpy's entities share no base class.
        name: Full topic or service name; empty for a timer.
        label: The label under which its runs are recorded.
        take: Takes one item that has arrived; a timer has none. See `taking`.
        handle: The entity's handle, cached because the property is slow; None for an event.
        key: Identifies the entity in a wait set.
        calls: How often its callback has run.
        born: Of a subscription: how many messages had been recorded when it was created.
        due_ns, order: Place of a timer in the schedule.
    """

    number: int
    state: NodeState
    kind: str
    entity: Any
    name: str
    label: CallbackLabel
    take: Callable[..., Any] | None = None
    label_number: int = field(init=False)
    handle: Any = field(init=False)
    key: int = field(init=False)
    calls: int = 0
    born: int = 0
    due_ns: int | None = None
    order: int = field(init=False)

    def __post_init__(self) -> None:
        self.label_number = self.label.number
        self.handle = getattr(self.entity, "handle", None)
        self.key = id(self.handle)
        self.order = self.number

    @property
    def is_over(self) -> bool:
        """Return whether a timer is none of the schedule's any more."""
        state = self.state
        return state.ended or not state.process.is_direct

    def remaining_ns(self) -> int | None:
        """Return the nanoseconds until a timer is due; None while it is canceled or not spun."""
        handle, clock = self.handle, self.entity.clock
        clock.move()
        try:
            with handle:
                if not self.state.spinning or handle.is_timer_canceled():
                    return None
                remaining: int = handle.time_until_next_call()
                # Nobody knows when a clock that a program sets will show that time.
                return None if clock.is_driven and remaining > 0 else remaining
        except InvalidHandle:
            return None  # destroyed


#: The order in which rclpy's executor takes what is ready in a node (`_wait_for_ready_callbacks`).
_RANK = {"event": 0, "timer": 1, "subscription": 2, "client": 3, "service": 4}


class Process:
    """Simulate an operating-system process: its nodes, its threads and its executors.

    Args:
        pool_size: Threads of its executor: 1 for rclpy's `SingleThreadedExecutor`, more for a
            `MultiThreadedExecutor`.
        program: The program that runs in the process. Without one its nodes are spun from the
            beginning, as in the `main` of most programs.

    Attributes:
        executor: The executor that spins its nodes, if it has no program that makes one.
        global_executor: The executor of `rclpy.spin` in this process, made when it is first needed.
        is_direct: Whether the engine takes its work directly.
        is_handed_over: Whether rclpy's own executor runs it, for good.
        spinner: The thread in which that executor spins, if the process has no program.
        busy: The callback that the engine has begun and that waits, if there is one.
        calls: Calls that have begun and have waited, in the order in which they began.
        pending: Entities that are ready but could not run at once: timers that are due, and
            entities whose queues may hold something.
        due: How many of its timers are due at this instant and have not run yet.
        has_tasks: Whether its executor may have tasks to run, while the engine takes its work.
        is_in_turn: Whether the callback that runs has its turn in such a round.
        is_over: Whether it has ended, so that none of its code goes on.
        threads: How many threads of its own have begun and not ended.
        running: Those threads; see `threads`.
        failure: What a callback raised last, and the call, until an executor hands it on.
    """

    def __init__(self, pool_size: int = 1, program: SimulatedProgram | None = None) -> None:
        self.pool_size, self.program = pool_size, program
        self.states: list[NodeState] = []
        self.executor: Executor | None = None
        self.global_executor: Executor | None = None
        self.is_direct = self.is_handed_over = False
        self.spinner: Call | None = None
        self.has_tasks = False
        self.busy: Call | None = None
        self.calls: list[Call] = []
        self.pending: dict[Entry, int] = {}
        self.due = 0
        self.is_over = False
        self.threads = 0
        self.running: list[Any] = []
        self.failure: tuple[BaseException, Call] | None = None
        self.is_in_turn = False
        self._round: deque[Entry] = deque()

    @property
    def actions(self) -> bool:
        """Return whether one of its nodes has an action server or client."""
        return any(state.actions for state in self.states)

    def adopt(self, state: NodeState) -> None:
        """Let a node that was made elsewhere run here from now on."""
        if state.process is not self:
            state.process.states.remove(state)
            state.process.refresh()
            state.process = self
            self.states.append(state)

    def refresh(self) -> None:
        """Note for each node whether its callbacks can run at once, which is the common case."""
        idle = self.is_direct and self.busy is None and not self.pending
        for state in self.states:
            state.open = idle and state.spinning

    def begin_round(self, ready: list[Entry]) -> None:
        """Note what was ready together with a callback that begins to wait.

        rclpy looks at everything, then handles what was ready, and only then looks again. A
        callback that has its turn in a round is in the middle of one already.
        """
        if not self.is_in_turn:
            self._round = deque(sorted(ready, key=_place))

    def next_ready(self) -> Entry | None:
        """Return what the executor would take next, in the order of rclpy's wait set.

        rclpy looks at everything, then handles what was ready: node by node, timers first, one
        message of each subscription. Only then it looks again.
        """
        if self.busy is not None or not self.is_direct:
            return None
        while self._round:
            entry = self._round.popleft()
            if entry in self.pending and entry.state.spinning:
                return entry
        ready = [entry for entry in self.pending if entry.state.spinning]
        self._round = deque(sorted(ready, key=_place))
        return self._round.popleft() if self._round else None

    def has_thread(self) -> bool:
        """Return whether one of its executors has a thread that may begin another callback."""
        if self.is_direct:
            return self.busy is None
        waiting = [call for call in self.calls if call.wait is not None]
        held = [call for call in waiting if not call.idle and call.entry is not None]
        if self.program is None and len(held) >= self.pool_size:
            return False
        return any(call.idle and call.wait and call.wait.reason == "spin" for call in waiting)

    def is_in_round(self) -> bool:
        """Return whether something that the last look found ready has not had its turn."""
        return any(entry in self.pending for entry in self._round)

    def forget(self, state: NodeState) -> None:
        """Drop a node that is destroyed."""
        self.states.remove(state)
        for entry in state.entries:
            self.pending.pop(entry, None)
        self.refresh()


def is_free(entry: Entry) -> bool:
    """Return whether the callback group of an entity lets its callback run."""
    return bool(entry.entity.callback_group.can_execute(entry.entity))


def _place(entry: Entry) -> tuple[int, int, int]:
    return entry.state.number, _RANK[entry.kind], entry.number
