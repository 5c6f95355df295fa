"""Run nodes as a discrete-event simulation.

A robot's program acts only in callbacks, and every callback has a cause: a timer's deadline has
passed, or another callback did something. Time can therefore jump from one deadline to the next. At
each instant one timer runs, then everything that follows from it, until nothing is left to do; then
the next timer of that instant, in the order in which they were set.

The consequences of a callback are known without waiting: within one participant, Fast DDS delivers
a message inside `publish()`. Messages stored for a late-joining subscription have arrived when its
creation returns; see `qos_events.wait_for_stored`.

The engine takes the work of plain processes directly (`taking`). All other processes run rclpy's
own executors, which wait in a `wait_set` until the engine has something for them. A callback that
waits (`time.sleep`, a service call, its own `spin`) suspends its own thread only (`waits`).
"""

from __future__ import annotations

import contextvars
from asyncio import events
from collections import deque
from collections.abc import Callable
from contextlib import AbstractContextManager, suppress
from inspect import iscoroutine, iscoroutinefunction
from typing import TYPE_CHECKING, Any, cast

from greenlet import getcurrent
from rclpy.event_handler import EventHandler
from rclpy.exceptions import InvalidHandle
from rclpy.executors import MultiThreadedExecutor
from rclpy.impl.implementation_singleton import rclpy_implementation
from rclpy.task import Task

from rosbeat.errors import EndlessChainError
from rosbeat.records import WaitRecord
from rosbeat.ros.context import Interrupts
from rosbeat.ros.differences import (
    HAS_OLDEST_TASK_FIRST,
    KEEPS_TASKS_IN_LIST,
    call_timer,
    tasks_of,
)
from rosbeat.ros.errors import never_made
from rosbeat.ros.executors import NOT_OF_CALLBACKS, Executors, Look, is_plain
from rosbeat.ros.processes import Entry, NodeState, Process
from rosbeat.ros.qos_events import Deadlines
from rosbeat.ros.recording import Recorder
from rosbeat.ros.schedule import SUSPICIOUS, ChainGuard
from rosbeat.ros.waits import _BOARD, Call, Wait

if TYPE_CHECKING:
    from rosbeat.ros.ports import Host

#: Virtual nanoseconds that a cell waits for another node at most, in a call without a limit.
LONGEST_WAIT = 3600 * 1_000_000_000
#: Virtual nanoseconds that a constructor may wait while it is called by a cell.
LONGEST_START = 600 * 1_000_000_000
#: Reasons of waits that are no waits to the one who reads the record of a run.
_GIVES_WAY = ("turn", "poll")
_IDLE = ("spin", *_GIVES_WAY)


class VirtualTime(Executors):
    """Run the callbacks of all processes of a session in virtual time.

    Args:
        recorder: Records callbacks as they begin.
        core: The session.
        start_ns: What clocks show when the session begins, in nanoseconds since 1970.

    Attributes:
        is_live: Whether the session is live, so that the wall clock counts.
        deadlines: The QoS deadlines that the session counts.
        constructor_waits: Called with nanoseconds and the reason when a constructor waits, instead
            of the wait; None to let virtual time pass. Only scenarios set it.
    """

    def __init__(self, recorder: Recorder, core: Host, start_ns: int) -> None:
        super().__init__(recorder, core)
        self.start_ns = start_ns
        self.is_live = False
        self.deadlines = Deadlines()
        self.constructor_waits: Callable[[int, str], None] | None = None
        self._note_callback = recorder.add_callback
        self._waits: list[WaitRecord] = []
        self._chain = ChainGuard()
        self._interrupts = Interrupts()
        self._listeners: dict[tuple[str, str], list[Entry]] = {}
        self._ready: deque[tuple[Entry, int]] = deque()
        # Timers of this instant that have not had their turn; processes that have something
        # pending, or tasks, and may be able to run it.
        self._behind: deque[Process] = deque()
        self._with_tasks: deque[Process] = deque()
        self._end = 0
        self._done: Callable[[], object] | None = None
        self._ends_idle = False

    # What the session calls.

    @property
    def has_work(self) -> bool:
        """Return whether callbacks are pending for the next run."""
        return bool(self._ready or self._behind or self._with_tasks or self._woken)

    def all_waits(self) -> tuple[WaitRecord, ...]:
        """Return what callbacks have waited for, and what they wait for now, in order of time."""
        now = [
            WaitRecord(call.wait.began_ns, self.now, call.node, call.name, call.wait.reason)
            for call in self.suspended
            if call.wait and call.wait.began_ns < self.now and _is_told(call)
        ]
        return tuple(sorted([*self._waits, *now], key=lambda record: record.time_ns))

    def watch(self, entry: Entry) -> None:
        """Run this entity's callback from now on, whenever its node spins."""
        if entry.kind == "timer":
            self.timers[entry.key] = entry.entity
            if entry.state.is_scheduled:
                self.schedule.add_timer(entry, self.now)
        elif entry.take is not None:
            self._listeners.setdefault((entry.kind, entry.name), []).append(entry)
            if entry.kind == "client" and "/_action/" in entry.name:
                self._action_clients.append(entry)
        if not is_plain(entry):
            self.hand_over(entry.state.process)
        elif entry.kind != "timer":
            self._hold(entry)
        self.entities_changed()

    def unwatch(self, entry: Entry) -> None:
        """Take nothing from this entity any more."""
        listeners = self._listeners.get((entry.kind, entry.name), [])
        if entry in listeners:
            listeners.remove(entry)
        if entry in self._action_clients:
            self._action_clients.remove(entry)
        if entry.state.process.pending.pop(entry, None) is not None:
            entry.state.process.refresh()

    def forget(self, state: NodeState) -> None:
        """Drop what a node had that is destroyed, with its callbacks that wait."""
        for entry in state.entries:
            self.unwatch(entry)
        for call in [call for call in state.process.calls if call.state is state]:
            self.break_off(call)
        state.process.forget(state)
        self.entities_changed()

    def resume(self, state: NodeState) -> None:
        """Look at everything that waited for a node that begins to spin."""
        self.entities_changed()
        state.process.refresh()
        for entry in state.entries:
            if entry.take is not None:
                self._hold(entry)  # messages may have arrived while it did not spin

    def sender(self, kind: str, name: str, origin: NodeState | None = None) -> Callable[[], None]:
        """Return a function to call whenever something is sent to the `kind` entities of a name.

        What is sent is a message, a request or an answer, and `kind` is `subscription`, `service`
        or `client`. The process of the `origin` takes it only when its executor has looked anew.
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
        if "/_action/" in name:
            self.hidden_event()

    def timer_reset(self, entry: Entry) -> None:
        """Note that a timer's `reset` was called, which may have brought it nearer."""
        if not getattr(entry.state.node, "keeps_turn", False):
            entry.order = self.next_number()
        if entry.state.process.is_direct:
            if entry.due_ns is not None:
                self.schedule.add_timer(entry, self.now)
        else:
            self.notify(entry.key)

    def look_anew(self) -> None:
        """Look at everything again: the clock was changed from outside, or a run was broken off."""
        states = self._core.nodes.states()
        self._ready.clear()
        self._due.clear()
        self._behind.clear()
        for state in states:
            state.process.due = 0
            state.process.pending.clear()
        timers = [e for s in states for e in s.entries if e.kind == "timer"]
        sleepers = [
            (call.wait, call.wait.until_ns)
            for call in self.suspended  # one whose time had come may have been left where it was
            if call.wait is not None and call.wait.until_ns is not None
        ]
        self.schedule.rebuild(timers, sleepers, self.now)
        for state in states:
            self.resume(state)
        for process in {id(state.process): state.process for state in states}.values():
            if process.executor is not None:
                self._revive(process)

    def run_until(
        self, end: int, done: Callable[[], object] | None = None, *, ends_idle: bool = False
    ) -> None:
        """Advance virtual time to `end`, in nanoseconds; waiting callbacks go on in the next run.

        The run ends as soon as `done` is true; with `ends_idle`, too, as soon as nothing will
        happen any more. Time stays then.

        Raises:
            EndlessChainError: If callbacks cause one another for ever while no time passes.
        """
        self._enter_thread()
        self._end, self._done, self._ends_idle = end, done, ends_idle
        caller, self.current = self.current, None
        # A kernel runs cells in an event loop; a callback on a robot is in none.
        loop = events._get_running_loop()
        events._set_running_loop(None)
        token = _BOARD.set(self)
        self._main, self._variables = getcurrent(), contextvars.copy_context()
        self.hidden_event()  # the cell may have sent something
        self.running = True
        try:
            with self._interrupts:
                self._next_driver().switch()
        except BaseException:
            # An interrupt or an endless chain. It may have come between any two steps, so some
            # timer or message may be noted nowhere.
            self._chain.depth = 0
            self.look_anew()
            self._interrupts.raise_if_pressed()
            raise
        finally:
            self.running = False
            _BOARD.reset(token)
            events._set_running_loop(loop)
            self.current = caller

    # Waiting.

    def sleep(self, seconds: float) -> None:
        """Let virtual time pass for everybody but the caller's thread."""
        if seconds > 0:
            self.sleep_until(self.now + max(1, round(seconds * 1e9)))
        else:
            self.give_way()

    def _block_main(self, wait: Wait) -> None:
        call, label, until, met = self.current, self.calling, wait.until_ns, wait.met
        latest = self.now + LONGEST_WAIT if until is None else until

        def done() -> object:
            return wait.woken or (met is not None and met())

        if self.constructor_waits is not None:
            self.run_until(self.now, done)
            if not done():
                self.constructor_waits(latest - self.now, wait.reason)
        elif call is None:
            self.run_until(latest, done, ends_idle=until is None)
        else:  # a constructor that a cell has called
            call.began_ns = self.now if call.began_ns < 0 else call.began_ns
            limit = min(latest, call.began_ns + LONGEST_START)
            self.run_until(limit, done, ends_idle=until is None)
            if (until is None or self.now < until) and not done():
                raise never_made((self.now - call.began_ns) / 1e9)
        wait.over = True
        self.calling = label

    def _check_that_it_can_end(self, wait: Wait) -> None:
        if not self.elsewhere and not _can_end(wait):
            self._core.reports.deadlocked([wait])

    def _call_begins(self, call: Call) -> None:
        if call.process.program is not None:
            call.process.program.enter()

    def _call_ends(self, call: Call) -> None:
        program = call.process.program
        if program is not None and program.is_entered:
            program.leave()

    def _call_suspended(self, call: Call) -> None:
        process = call.process
        if process.program is not None:
            process.program.leave()
        if call.is_direct and process.busy is None:
            process.busy = call
            entry = call.entry
            if entry is not None and entry.entity.callback_group.can_execute(entry.entity):
                call.holds_group = True
                entry.entity.callback_group.beginning_execution(entry.entity)
            # What was ready together with it keeps its turn.
            ready = [timer for timer in self._due if timer.state.process is process]
            process.begin_round([timer for timer in ready if timer is not entry])
            process.refresh()

    def _call_resumed(self, call: Call, wait: Wait) -> None:
        if self.now > wait.began_ns and wait.reason not in _IDLE and _is_told(call):
            self._waits.append(
                WaitRecord(wait.began_ns, self.now, call.node, call.name, wait.reason)
            )
        if call.process.program is not None:
            call.process.program.enter()

    def _call_forgotten(self, call: Call) -> None:
        process = call.process
        if process.busy is not call:
            return
        process.busy = None
        if call.holds_group and call.entry is not None:
            call.entry.entity.callback_group.ending_execution(call.entry.entity)
        process.refresh()
        self._catch_up(process)
        if process.executor is not None and not process.is_direct:
            self._revive(process)

    def _is_interrupted(self) -> bool:
        return self.running and self._interrupts.pressed

    def _running(self) -> AbstractContextManager[None]:
        return self._core.running()

    def give_way_if_others_can_run(self) -> None:
        """Let others do a step before an executor handles what comes next."""
        if self._ready or self._woken or self._behind or self._with_tasks or self._entities_changed:
            self.give_way()

    # The loop.

    def _drive(self, *_: object) -> None:
        while True:
            self.current = None
            self._drain()
            if self._done is not None and self._done():
                self._end_run()
                continue
            self._interrupts.raise_if_pressed()
            if self.elsewhere:
                self.elsewhere.popleft()()
            elif (self._woken or self._looking) and (wait := self._over()) is not None:
                if wait.call is not None and wait.reason in _GIVES_WAY:
                    self._count_turn(wait.call)
                self._resume(wait)
            elif self._due:
                self._fire_due()
            elif not self._advance_to_next():
                self._end_run()

    def _end_run(self) -> None:
        self._idle.append(getcurrent())
        self._main.switch()

    def _count_turn(self, call: Call) -> None:
        program = call.process.program
        name = call.node or (program.name if program is not None else "A node")
        instant, count = call.turns
        call.turns = (self.now, count + 1 if instant == self.now else 1)
        try:
            self._chain.wakes(name, call.name, call.turns[1])
        except EndlessChainError:
            if program is not None:
                program.kill()  # it would never let the others run
            raise

    def _advance_to_next(self) -> bool:
        """Jump to what comes next: timers and sleepers of an instant, then QoS deadlines.

        Return whether anything comes before the end of the run.
        """
        at = due = self.schedule.next_due(self.now)
        missed = self.deadlines.next_due() if self.deadlines else None
        if missed is not None:  # few programs have one
            at = missed if due is None else min(due, missed)
        if at is None:
            return self._nothing_left()
        if at > self._end:
            self._advance(max(self._end, self.now))
            return False
        self._advance(at if at > self.now else self.now)
        if due == at:
            self._begin_due()
        else:
            self._miss(self.deadlines.pass_next())
        return True

    def _nothing_left(self) -> bool:
        """Report a deadlock for all who wait without a limit, since nothing will ever happen."""
        stuck = [
            call.wait for call in self.suspended
            if call.wait is not None and _is_for_good(call) and not call.wait.reported
        ]  # fmt: skip
        if stuck:
            self._core.reports.deadlocked(stuck)
        if not self._ends_idle:
            self._advance(max(self._end, self.now))
        return False

    def _begin_due(self) -> None:
        """Begin with the first item of an instant."""
        item = self.schedule.pop()
        if isinstance(item, Wait):
            self._woken.append(item)
            return
        if isinstance(item, Look):
            self.hidden_event()
            return
        entry = cast(Entry, item)
        if self.schedule.next_due(self.now) != self.now or not self._is_timer_next():
            self._fire(entry)
            return
        self._due.append(entry)
        entry.state.process.due += 1
        self._fire_due()

    def _fire_due(self) -> None:
        """Fire the first of the timers of this instant, in the order in which they were set."""
        known = len(self._due)
        while self.schedule.next_due(self.now) == self.now and self._is_timer_next():
            timer = cast(Entry, self.schedule.pop())
            self._due.append(timer)
            timer.state.process.due += 1
        if len(self._due) > known:  # others may have been reset to this instant meanwhile
            self._due.sort(key=lambda entry: entry.order)
        entry = self._due.pop(0)
        process = entry.state.process
        process.due = max(0, process.due - 1)
        self._fire(entry)
        if process.pending and not process.due:
            self._catch_up(process)

    def _is_timer_next(self) -> bool:
        return not isinstance(self.schedule.first(), Wait | Look)

    def _miss(self, entry: Entry) -> None:
        """Let the process of a QoS deadline tell its node that it was missed."""
        if entry.state.process.is_direct:
            self._ready.append((entry, 1))
            return
        executor = entry.state.node.executor
        if executor is not None:
            executor.create_task(self._run_event, entry)

    def _run_event(self, entry: Entry) -> None:
        work = entry.take(entry, self) if entry.take is not None else None
        if work is not None:
            self._note_callback(self.now, entry.label_number)
            work[0](*work[1])

    def _advance(self, time_ns: int) -> None:
        if time_ns != self.now:
            self._chain.instant_ends()
            self.now = time_ns

    # What is ready.

    def _hold(self, entry: Entry) -> None:
        """Keep for later what cannot run at once."""
        process = entry.state.process
        if self._waits_by_key:
            self.notify(entry.key)
        if not process.is_direct:
            return
        if entry not in process.pending:
            process.pending[entry] = self._chain.depth + 1
            process.refresh()
        self._catch_up(process)

    def _catch_up(self, process: Process) -> None:
        if process.pending and process not in self._behind:
            self._behind.append(process)
        if process.has_tasks and process not in self._with_tasks:
            self._with_tasks.append(process)

    def task_made(self, process: Process) -> None:
        """Note that a plain process has a task to run when what is running has ended."""
        if not KEEPS_TASKS_IN_LIST:
            self.hand_over(process)
        elif process.is_direct:
            process.has_tasks = True
            self._catch_up(process)

    def _drain(self) -> None:
        """Run everything that plain processes have ready, and all that follows from it."""
        # The hot path: three attribute look-ups here are a tenth of a message's cost.
        ready, chain = self._ready, self._chain
        while True:
            while ready:
                entry, depth = ready.popleft()
                if entry.state.open:
                    chain.depth = depth
                    if depth > SUSPICIOUS:
                        chain.inspect(entry.state.name, entry.label.source)
                    self._take(entry)
                elif entry.state.spinning:
                    chain.depth = depth - 1
                    self._hold(entry)
            chain.depth = 0
            if self._behind and self._run_one_behind():
                continue
            if self._with_tasks and self._run_one_task():
                continue
            if self._entities_changed:
                self._look_for_events()
            elif not ready:
                return

    def _run_one_behind(self) -> bool:
        """Run one callback of a process that could not run it before; return whether one did."""
        behind, kept = self._behind, 0
        while len(behind) > kept:
            process = behind[0]
            if process.due:  # its timers of this instant come first
                behind.rotate(-1)
                kept += 1
                continue
            if process.has_tasks and process.busy is None and not process.is_in_round():
                behind.rotate(-1)  # rclpy runs tasks before it looks at what has come
                kept += 1
                continue
            entry = process.next_ready()
            if entry is None:
                behind.popleft()
                continue
            self._chain.depth = depth = process.pending.pop(entry)
            if depth > SUSPICIOUS:
                self._chain.inspect(entry.state.name, entry.label.source)
            self._run_pending(entry, depth)
            return True
        return False

    def _run_pending(self, entry: Entry, depth: int) -> None:
        process = entry.state.process
        process.is_in_turn = True
        try:
            if entry.kind == "timer":
                self._fire(entry)
            elif self._take(entry) and not entry.state.ended and process.is_direct:
                process.pending.setdefault(entry, depth)  # there may be more
                self._catch_up(process)
        finally:
            process.is_in_turn = False
        process.refresh()

    def _run_one_task(self) -> bool:
        """Run one task of a plain process; return whether one did."""
        tasks = self._with_tasks
        for _ in range(len(tasks)):
            process = tasks.popleft()
            if not process.is_direct or process.is_over or process.busy is not None:
                continue  # `_call_forgotten` looks at it again
            if process.due or process.is_in_round():
                tasks.append(process)
                continue
            executor = process.executor
            assert executor is not None
            executor._tasks[:] = [parts for parts in executor._tasks if not parts[0].done()]
            waiting = tasks_of(executor)
            if not waiting:
                process.has_tasks = False
                self._catch_up(process)
                return True  # what has come meanwhile has its turn now
            task = waiting[0] if HAS_OLDEST_TASK_FIRST else waiting[-1]
            tasks.appendleft(process)
            self._chain.turn(process.states)
            self._run_task(process, task)
            return True
        return False

    def _run_task(self, process: Process, task: Task) -> None:
        if iscoroutine(task._handler) or iscoroutinefunction(task._handler):
            self.hand_over(process)
            return
        call: Call | None = task.__dict__.get("_rosbeat_call")
        if call is None:
            call = Call(process)
        call.is_direct = True
        self.current, self.calling = call, call.label or self.calling
        try:
            task()
            error = task.exception() if task.done() else None
            if error is not None:
                self._raised(call, call.name, error)
        except NOT_OF_CALLBACKS:
            task.cancel()  # rclpy would take it for running, for ever
            raise
        except BaseException as error:
            task.cancel()
            self._raised(call, call.name, error)
        finally:
            self.current = None
            self._end_call(call)

    def _look_for_events(self) -> None:
        """Ask the middleware for events of endpoints: what was made may not fit, say."""
        self._entities_changed = False
        for wait in self._set_waits:
            self.wake(wait)
        handlers = [
            (state, handler)
            for state in self._core.nodes.states()
            if state.process.is_direct and state.spinning
            for handler in state.node.waitables
            if isinstance(handler, EventHandler) and handler.callback_group is not None
        ]
        for state, handler in _events(self._core.context, handlers):
            self._run_event_handler(state, handler)

    def _run_event_handler(self, state: NodeState, handler: EventHandler) -> None:
        executor = state.process.executor
        assert executor is not None

        def tell() -> Any:  # noqa: ANN401 - a coroutine, if the callback makes one
            with suppress(InvalidHandle):
                data = handler.take_data()
                self._core.reports.event_heard(handler, state)
                return handler.callback(data)

        executor.create_task(tell)

    def _fire(self, entry: Entry) -> None:
        state = entry.state
        if not state.process.is_direct:
            return  # it has been handed over meanwhile
        if not state.open and state.spinning and (state.process.busy is not None):
            self._hold(entry)  # it is late, and fires when its process is free
            return
        handle = entry.handle
        entry.entity.clock.move()
        try:
            with handle:
                due = state.spinning and handle.is_timer_ready()
                callback = call_timer(entry.entity) if due else _do_nothing
        except InvalidHandle:
            return  # destroyed
        self.schedule.add_timer(entry, self.now)  # before the callback, which may wait for longer
        if due:
            self._chain.timer_fires(state.name, entry.label.name)
            self._call(entry, callback)

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
        self._entry, self.calling = entry, entry.label
        try:
            result = callback(*arguments)
        except NOT_OF_CALLBACKS:
            raise
        except BaseException as error:
            self._interrupts.raise_if_pressed()
            call = self.current
            assert call is not None
            self._raised(call, entry.label.name, error)
        else:
            # A plain function that returns a coroutine forgot to await it; so it is in rclpy.
            if result is not None and iscoroutine(result) and iscoroutinefunction(callback):
                executor = entry.state.process.executor
                if executor is not None:  # the callback was exchanged after it had been looked at
                    executor.create_task(result)
        finally:
            call = self._call_of_entry
            self._entry = None
            if call is not None:
                self._end_call(call)

    def _end_call(self, call: Call) -> None:
        self.current = None
        if call.began_ns >= 0:
            self._forget_call(call)

    def _raised(self, call: Call, name: str, error: BaseException) -> None:
        """Hand what a callback of a plain process raised to the session."""
        self._core.reports.callback_raised(call.state, name, error)


def _is_told(call: Call) -> bool:
    """Return whether a wait of a call holds something up: a callback, or a program."""
    return not call.idle and (call.label is None or call.label.kind != "thread")


def _is_for_good(call: Call) -> bool:
    """Return whether a call waits without a limit, and not for whatever comes.

    A thread that a program has started may well wait for work for ever, and `main` for a thread.
    """
    if call.wait is None or not call.wait.is_for_good() or not (_is_told(call) or call.entry):
        return False
    return call.entry is not None or call.process.threads == 0


def _do_nothing() -> None:
    """Stand in for the callback of a timer that is not due."""


def _can_end(wait: Wait) -> bool:
    """Return whether a wait may still come true: its process has a thread for what it needs.

    An executor with one thread that waits in a callback takes no answer; nor does another one if
    the answer's callback group is the one that this very callback occupies.
    """
    call = wait.call
    if wait.until_ns is not None or wait.needs is None or call is None or call.idle:
        return True
    process, own = call.process, call.entry
    if process.is_direct:
        return process.busy is not call or process.threads > 0
    group = wait.needs.callback_group
    if own is not None and own.entity.callback_group is group:
        return bool(group.can_execute(wait.needs))
    if process.threads or process.program is not None or process.spinner is None:
        return True
    executor = process.executor
    pool = 1
    if isinstance(executor, MultiThreadedExecutor):
        pool = executor._executor._max_workers
    stuck = [
        other for other in process.calls
        if other.wait is not None and not other.idle
        and other.wait.until_ns is None and other.wait.needs is not None
    ]  # fmt: skip
    return len(stuck) < pool


def _events(
    context: Any,  # noqa: ANN401 - rclpy's context
    handlers: list[tuple[NodeState, EventHandler]],
) -> list[tuple[NodeState, EventHandler]]:
    """Return the event handlers that have something to tell."""
    if not handlers:
        return []
    wait_set = rclpy_implementation.WaitSet(0, 0, 0, 0, 0, len(handlers), context.handle)
    wait_set.clear_entities()
    alive = []
    for state, handler in handlers:
        with suppress(InvalidHandle), handler:
            handler.add_to_wait_set(wait_set)
            alive.append((state, handler))
    wait_set.wait(0)
    ready = []
    for state, handler in alive:
        with suppress(InvalidHandle):
            if handler.is_ready(wait_set):
                ready.append((state, handler))
    return ready
