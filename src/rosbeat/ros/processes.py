"""Simulate processes: nodes, one executor, and the callbacks that have not returned yet.

On a robot most nodes are processes of their own, and each process has one executor. A callback that
sleeps or waits blocks its own process only. The unit of the simulation is therefore the process:
its nodes, the number of threads of its executor, and the callbacks that have started but not yet
returned.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Collection
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from greenlet import greenlet

from rosbeat.ros.entities import Entry, NodeState
from rosbeat.ros.recording import CallbackLabel

if TYPE_CHECKING:
    from rosbeat.ros.simulated_program import SimulatedProgram

#: The order in which rclpy's executor takes what is ready in a node (`_wait_for_ready_callbacks`).
_RANK = {"event": 0, "timer": 1, "subscription": 2, "client": 3, "service": 4}


@dataclass(eq=False, slots=True)
class Spin:
    """Represent one call of a `spin` function, during which callbacks of its process run.

    It spins `states`, or all nodes of the process, and `left` more callbacks may begin, or any
    number if it is None.
    """

    states: Collection[NodeState] | None = None
    left: int | None = None


class Process:
    """Simulate an operating-system process: nodes, and the one executor that runs their callbacks.

    Args:
        threads: 1 for rclpy's `SingleThreadedExecutor`, more for a `MultiThreadedExecutor`.
        program: The program that runs in the process; without one its nodes spin from the
            beginning, as in the `main` of most programs.

    Attributes:
        spins: The active calls of `spin`, innermost last. Callbacks run only during such a call.
        calls: Callbacks that have begun and are waiting, in the order in which they began.
        pending: Entities that are ready but could not run at once: timers that are due, and
            entities whose queues may hold something.
        due: How many of its timers are due at this instant and have not run yet.
    """

    def __init__(self, threads: int = 1, program: SimulatedProgram | None = None) -> None:
        self.threads, self.program = threads, program
        self.states: list[NodeState] = []
        self.spins: list[Spin] = [] if program else [Spin()]
        self.calls: list[Call] = []
        self.pending: dict[Entry, int] = {}
        self.due = 0
        self._round: deque[Entry] = deque()

    def adopt(self, state: NodeState) -> None:
        """Let a node that was made elsewhere run here from now on."""
        if state.process is not self:
            state.process.states.remove(state)
            state.process.refresh()
            state.process = self
            self.states.append(state)

    def refresh(self) -> None:
        """Note for each node whether its callbacks can run at once, which is the common case."""
        idle = bool(self.spins) and not self.calls and not self.pending
        spin = self.spins[-1] if idle else None
        for state in self.states:
            state.open = (
                spin is not None
                and spin.left is None
                and state.spinning
                and (spin.states is None or state in spin.states)
            )

    def has_thread(self) -> bool:
        """Return whether a thread of the executor is free, and may begin another callback."""
        if not self.spins or self.spins[-1].left == 0:
            return False
        return sum(not call.spinning for call in self.calls) < self.threads

    def can_begin(self, entry: Entry) -> bool:
        """Return whether the callback of this entity can run now."""
        return self.has_thread() and self._is_spun(entry) and is_free(entry)

    def next_ready(self) -> Entry | None:
        """Return what the executor would take next, in the order of rclpy's wait set.

        rclpy looks at everything, then handles what was ready: node by node, timers first, one
        message of each subscription. Only then it looks again.
        """
        if not self.has_thread():
            return None
        while self._round:
            entry = self._round.popleft()
            if entry in self.pending and self._is_spun(entry) and is_free(entry):
                return entry
        ready = [entry for entry in self.pending if self._is_spun(entry) and is_free(entry)]
        self._round = deque(sorted(ready, key=_place))
        return self._round.popleft() if self._round else None

    def is_in_round(self) -> bool:
        """Return whether something that the last look found ready has not had its turn."""
        return any(entry in self.pending for entry in self._round)

    def count_down(self) -> None:
        """Note that a callback has ended: `spin_once` waits for one."""
        if self.spins and self.spins[-1].left:
            self.spins[-1].left -= 1

    def forget(self, state: NodeState) -> None:
        """Drop a node that is destroyed."""
        self.states.remove(state)
        for entry in state.entries:
            self.pending.pop(entry, None)
        self.refresh()

    def _is_spun(self, entry: Entry) -> bool:
        states = self.spins[-1].states if self.spins else ()
        return entry.state.spinning and (states is None or entry.state in states)


def is_free(entry: Entry) -> bool:
    """Return whether the callback group of an entity lets its callback run."""
    return bool(entry.entity.callback_group.can_execute(entry.entity))


def _place(entry: Entry) -> tuple[int, int, int]:
    return entry.state.number, _RANK[entry.kind], entry.number


@dataclass(eq=False, slots=True)
class Call:
    """Represent running code of a node: a callback, a constructor, or the `main` of a program.

    Attributes:
        state: The node whose callback it is; None for a constructor or a `main`.
        entry: The entity whose callback it is, if there is one.
        began_ns: When it first began to wait, in nanoseconds; -1 if it never has.
        spinning: Whether it waits in a `spin`, so that its thread runs other callbacks.
        wait: The current wait, if there is one.
        holds_group: Whether it occupies its callback group.
        broken: How often it was told to end from outside; above 0, it must not wait again.
    """

    process: Process
    state: NodeState | None = None
    entry: Entry | None = None
    label: CallbackLabel | None = None
    began_ns: int = -1
    spinning: bool = False
    wait: Wait | None = None
    holds_group: bool = False
    broken: int = 0

    @property
    def node(self) -> str:
        """Return the full name of the node whose code runs, or of the first node of its process."""
        states = self.process.states
        return self.state.name if self.state else states[0].name if states else ""

    @property
    def name(self) -> str:
        """Return the name of the function, such as `publish_temperature`."""
        if self.label is not None:
            return self.label.name
        return "main" if self.process.program else "__init__"


@dataclass(eq=False, slots=True)
class Wait:
    """Describe the condition that a call waits for.

    Attributes:
        thread: The greenlet that resumes when the wait is over.
        reason: Short description of the condition: `sleep`, or `an answer from /add`.
        began_ns: When the wait began, in nanoseconds of virtual time.
        until_ns: When the wait times out; None without a limit.
        met: Returns whether the condition holds; None if only time or `end_wait` ends the wait.
        needs: The entity of the same process whose callback has to run first, if there is one.
        error: The exception to raise in the call when it resumes.
        reported: Whether the wait was reported as a deadlock.
    """

    call: Call | None
    thread: greenlet
    reason: str
    began_ns: int
    until_ns: int | None = None
    met: Callable[[], object] | None = None
    needs: Any = None
    over: bool = False
    error: BaseException | None = None
    reported: bool = False

    def is_for_good(self) -> bool:
        """Return whether nothing but an event of the simulation can end it.

        The `spin` of a program waits for whatever comes, and is not meant.
        """
        spins = self.call is not None and self.call.spinning and self.call.entry is None
        return self.until_ns is None and not spins

    def can_end(self) -> bool:
        """Return whether it may still come true: its process has a thread for what it needs.

        A single-threaded executor that waits in a callback takes no answer; nor does another one
        if the answer's callback group is the one that this very callback occupies.
        """
        if self.until_ns is not None or self.needs is None or self.call is None:
            return True
        process, own = self.call.process, self.call.entry
        if not process.spins:
            return False
        group = self.needs.callback_group
        if self.call.holds_group and own is not None and own.entity.callback_group is group:
            return bool(group.can_execute(self.needs))
        if self.call.spinning:
            return True
        busy = [call for call in process.calls if not call.spinning]
        waits = [call.wait for call in busy]
        # Of those that wait without a limit for this very process none will free a thread.
        stuck = [one for one in waits if one and one.until_ns is None and one.needs is not None]
        return len(busy) < process.threads or len(stuck) < len(busy)
