"""Let rclpy's own executors run processes that are more than plain, in virtual time.

An executor waits in a `wait_set`. Here is what wakes it again: a message or an answer, a timer or a
timeout, a guard condition, an event of an endpoint, or a waitable such as an action, of whose
events nobody but itself knows. Here, too, is which processes are plain, and how one is handed over.
"""

from __future__ import annotations

from _thread import get_ident
from abc import abstractmethod
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from inspect import iscoroutinefunction
from typing import TYPE_CHECKING, Any
from weakref import WeakSet, WeakValueDictionary

from greenlet import GreenletExit
from rclpy.event_handler import EventHandler
from rclpy.executors import MultiThreadedExecutor, await_or_execute
from rclpy.node import Node
from rclpy.timer import Timer

from rosbeat.ros.differences import forget_executing
from rosbeat.ros.isolation import DeadlinePassed
from rosbeat.ros.processes import Entry, Process
from rosbeat.ros.recording import CallbackLabel, Recorder
from rosbeat.ros.taking import has_known_group, take_message
from rosbeat.ros.waits import Call, Switchboard, Wait

if TYPE_CHECKING:
    from rosbeat.ros.ports import Host
    from rosbeat.ros.processes import NodeState
    from rosbeat.ros.wait_set import VirtualWaitSet

#: A loop that looks at the clock or at its queues again and again lets so much time pass, in
#: nanoseconds, after so many looks at one instant: on a robot, each look takes time.
POLL_NS, MOST_POLLS, MOST_READS = 1_000_000, 3, 1_000
#: The most that a loop lets pass from one look to the next while it finds nothing.
LONGEST_POLL_NS = 20_000_000

#: What ends more than the callback in which it is raised.
NOT_OF_CALLBACKS = (KeyboardInterrupt, GreenletExit, DeadlinePassed)


@dataclass(eq=False, slots=True)
class Look:
    """Be due when executors have to look at their waitables."""

    order: int
    due_ns: int | None = None


class Executors(Switchboard):
    """Wake rclpy's own executors, and hand processes over to them.

    Args:
        recorder: Records callbacks as they begin.
        core: The session.

    Attributes:
        timers: The timers whose clocks show virtual time, by their key in a wait set.
        clocks: All clocks that show virtual time.
    """

    def __init__(self, recorder: Recorder, core: Host) -> None:
        super().__init__(core.next_number)
        self.timers: WeakValueDictionary[int, Timer] = WeakValueDictionary()
        self.clocks: WeakSet[Any] = WeakSet()
        self._core, self._recorder = core, recorder
        # Executors that wait: all, and by the key of what wakes them.
        self._set_waits: list[Wait] = []
        self._waits_by_key: dict[int, list[Wait]] = {}
        # Ordinary clients of the services that an action is made of: nobody tells of an answer.
        self._action_clients: list[Entry] = []
        # Timers of this instant that have not had their turn.
        self._due: list[Entry] = []
        self._entities_changed = False
        self._changes = 0

    # What wakes an executor.

    def notify(self, key: int) -> None:
        """Wake the executors that wait for the entity of this key."""
        for wait in list(self._waits_by_key.get(key, ())):
            self.wake(wait)

    def hidden_event(self) -> None:
        """Let executors look at their waitables, such as actions: something may have come.

        A waitable has sockets of its own, of which nobody but itself knows.
        """
        for wait in self._set_waits:
            if wait.has_waitables:
                self.wake(wait)
        for client in self._action_clients:
            self._hold(client)

    def look_at(self, time_ns: int) -> None:
        """Let executors look at their waitables at a time, in nanoseconds of virtual time."""
        self.schedule.add(Look(self.next_number()), time_ns)

    def clock_set(self) -> None:
        """Note that a program has set a clock, on which timers may be due now."""
        for wait in self._set_waits:
            self.wake(wait)

    def entities_changed(self) -> None:
        """Note that entities were made or destroyed: their peers may have events to tell."""
        self._entities_changed = True
        self._changes += 1

    # Where an executor waits, or only looks.

    def wait_in_set(self, wait_set: VirtualWaitSet, timeout_ns: int) -> None:
        """Suspend an executor until something of its wait set may be ready, or time is up."""
        until, order = wait_set.next_timer(self.now)
        if timeout_ns > 0:
            until = min(self.now + timeout_ns, self.now + timeout_ns if until is None else until)
        keys = wait_set.keys()
        waits: list[Wait] = []

        def prepare(wait: Wait) -> None:
            waits.append(wait)
            wait.has_waitables = wait_set.has_waitables
            self._set_waits.append(wait)
            for key in keys:
                self._waits_by_key.setdefault(key, []).append(wait)

        try:
            self.block("spin", until, idle=True, order=order, prepare=prepare)
        finally:
            for wait in waits:
                self._set_waits.remove(wait)
                for key in keys:
                    self._waits_by_key[key].remove(wait)
                    if not self._waits_by_key[key]:
                        del self._waits_by_key[key]

    def has_new_events(self) -> bool:
        """Return whether endpoints may have events that the executor here has not looked for.

        The middleware tells of them when entities are made or destroyed, and not in a wait set's
        lists of what is ready.
        """
        call = self.current
        if call is None or call.changes == self._changes:
            return False
        call.changes = self._changes
        return True

    def polled(self, next_ns: int | None = None) -> None:
        """Note that code of a node looked at its queues without waiting, and found nothing.

        A loop of such looks lets time pass: on a robot, each of them takes a moment. The longer
        nothing comes, the more.

        Args:
            next_ns: When the next of its own timers is due, in nanoseconds.
        """
        call = self.current
        if call is None:
            return
        instant, count = call.polled
        call.polled = (self.now, count + 1 if instant == self.now else 1)
        if count < MOST_POLLS or instant != self.now:
            self.give_way("poll")
            return
        call.pause_ns = min(max(POLL_NS, 2 * call.pause_ns), LONGEST_POLL_NS)
        times = [self.now + call.pause_ns, next_ns, self.schedule.next_due(self.now)]
        until = min(time for time in times if time is not None and time > self.now)
        self.block("poll", until, idle=True)
        call.polled = (self.now, MOST_POLLS)

    def found(self) -> None:
        """Note that code of a node looked at its queues and found something."""
        call = self.current
        if call is not None:
            call.polled, call.pause_ns = (-1, 0), 0

    def clock_read(self) -> None:
        """Note that code of a node has read a clock of Python; a loop of that lets time pass."""
        call = self.current if get_ident() == self.thread else None
        if call is None:
            return
        instant, count = call.reads
        call.reads = (self.now, count + 1 if instant == self.now else 1)
        if count >= MOST_READS and instant == self.now:
            self.block("poll", self.now + POLL_NS, idle=True)

    # What an executor tells.

    @property
    def threads(self) -> int:
        """Return how many threads a `MultiThreadedExecutor()` has."""
        return self._core.threads

    def observe(
        self,
        entity: Any,  # noqa: ANN401 - any of rclpy's
        node: Node,
        take: Callable[..., Any],
    ) -> tuple[Call, Callable[..., Any]]:
        """Return a call for the callback of an entity, and a `take` that records that it runs."""
        core, state = self._core, self._core.nodes.state_of(node)
        entry = core.nodes.entry_of(entity)
        process = state.process if state is not None else Process()
        call = Call(process, state, entry, entry.label if entry is not None else None)
        if entry is not None and entry.kind == "subscription" and _is_taken_by_us(entry):
            take = partial(_take_by_us, entry, self)

        def taking(entity: Any) -> Any:  # noqa: ANN401 - rclpy's own
            work = take(entity)
            if work is not None:
                core.reports.callback_ran(entity, node)
                self.calling = call.label = call.label or self.calling
            return work

        return call, taking

    def thread_label(self, creator: Call, name: str) -> CallbackLabel:
        """Return the label of a thread that code of a node starts."""
        return self._recorder.label(creator.node, "thread", name, "")

    def task_label(self, creator: Call, name: str) -> CallbackLabel:
        """Return the label of a task, which appears in errors."""
        return self._recorder.label(creator.node, "task", name, "")

    def end_step(self, call: Call, caller: Call) -> None:
        """Note that a task has ended or waits, and that its executor goes on."""
        if call.began_ns >= 0:
            self._forget_call(call)
            call.began_ns = -1
        if call.process.actions:
            self.hidden_event()
        self.current = caller

    def entry_of(self, timer: Timer | None) -> Entry | None:
        """Return what is known of a timer; None for one of an executor's own."""
        return None if timer is None else self._core.nodes.entry_of(timer)

    def entry_of_key(self, key: int) -> Entry | None:
        """Return the entity of a key, if it is one of the session's."""
        return self._core.nodes.entry_of_key(key)

    # Which processes executors run.

    def spin_process(self, process: Process) -> None:
        """Begin to run the nodes of a process that has no program."""
        executor = process.executor
        assert executor is not None
        entries = [entry for state in process.states for entry in state.entries]
        is_plain_process = (
            not isinstance(executor, MultiThreadedExecutor)
            and not process.actions
            and all(map(_is_plain_node, process.states))
            and all(map(is_plain, entries))
        )
        if is_plain_process and not process.is_handed_over:
            process.is_direct = True
            process.refresh()
            for state in process.states:
                if not state.is_scheduled:
                    state.is_scheduled = True
                    for entry in state.entries:
                        if entry.kind == "timer":
                            self.schedule.add_timer(entry, self.now)
        else:
            self.hand_over(process)
            self._revive(process)

    def hand_over(self, process: Process) -> None:
        """Let rclpy's own executor run a process from now on."""
        if process.is_handed_over:
            return
        process.is_handed_over = True
        process.is_direct = False
        process.pending.clear()
        process.due = 0
        self._due = [entry for entry in self._due if entry.state.process is not process]
        process.refresh()
        if process.executor is not None:
            self._revive(process)

    def _revive(self, process: Process) -> None:
        """Begin the thread in which an executor spins, unless there is one."""
        executor = process.executor
        if process.is_direct or process.is_over or process.spinner is not None or executor is None:
            return
        executor._cb_iter = None  # a round that an interrupt has left
        forget_executing(executor)
        call = process.spinner = Call(process)
        call.label = self._recorder.label("", "thread", "spin", "")

        def spin() -> None:
            try:
                if process.busy is not None:  # its one thread is in a callback
                    self.block("spin", None, lambda: process.busy is None, idle=True)
                executor.spin()
            except NOT_OF_CALLBACKS:
                raise
            except BaseException as error:
                failure, process.failure = process.failure, None
                state, name = None, "spin"  # what no callback has raised
                if failure is not None and failure[0] is error:
                    state, name = failure[1].state, failure[1].name
                self._core.reports.callback_raised(state or process.states[0], name, error)
            finally:
                process.spinner = None

        self.start_greenlet(call, spin)

    @abstractmethod
    def _hold(self, entry: Entry) -> None:
        """Keep for later what cannot run at once."""


#: What an executor asks a node for.
_ASKED = ("subscriptions", "timers", "clients", "services", "guards", "waitables")


def is_plain(entry: Entry) -> bool:
    """Return whether the engine may take the work of an entity directly."""
    callback = getattr(entry.entity, "callback", None)
    return not iscoroutinefunction(callback) and (
        entry.kind == "event" or has_known_group(entry.entity)
    )


def _is_plain_node(state: NodeState) -> bool:
    """Return whether an executor finds nothing in a node but what the engine can take directly."""
    node = state.node
    if any(getattr(type(node), name) is not getattr(Node, name) for name in _ASKED):
        return False  # its class has a method of that name, say: rclpy says what comes of that
    own = any(not isinstance(waitable, EventHandler) for waitable in node.waitables)
    return not own and not any(True for _ in node.guards)


def _is_taken_by_us(entry: Entry) -> bool:
    return entry.take is not take_message or entry.handle is not entry.entity.handle


def _take_by_us(entry: Entry, engine: Executors, _: object) -> Callable[[], Any] | None:
    """Take a message of which a part is counted or kept by the session; see `qos_events`."""
    work = entry.take(entry, engine) if entry.take is not None else None
    return None if work is None else partial(await_or_execute, work[0], *work[1])
