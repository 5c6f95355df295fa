"""Nodes as a discrete-event simulation.

Nothing happens in a robot's program except in callbacks, and callbacks are caused: by a timer whose
deadline has come, or by something that another callback did. So time can jump from one deadline to
the next. At each instant one timer runs, then all that follows from it, until nothing is left to
do; then the next timer of that instant, in order of (deadline, creation).

What follows is known without waiting: within one participant Fast DDS hands a message over inside
`publish()`, so when `publish()` has returned, the subscriptions of that topic can take it. What was
stored for late joiners is there when their subscription has been made; see `late_joiners`.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Coroutine
from inspect import iscoroutine, iscoroutinefunction
from typing import Any

from rclpy.context import Context
from rclpy.exceptions import InvalidHandle
from rclpy.task import Task

from rosbeat.runtime.agenda import Agenda
from rosbeat.runtime.chains import MOST_TURNS, SUSPICIOUS, ChainGuard
from rosbeat.runtime.clock import SessionClock
from rosbeat.runtime.coroutines import Coroutines, Waiting
from rosbeat.runtime.deadlines import Deadlines
from rosbeat.runtime.entities import Entry, NodeState
from rosbeat.runtime.interrupts import Interrupts
from rosbeat.runtime.recorder import CallbackLabel, Recorder
from rosbeat.runtime.wait_set import Host, WaitSetExecutor


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
        self._note_time, self._note_label = recorder.callback_columns()
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
        self.deadlines.look_anew()
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
        self._note_time(self.now)
        self._note_label(entry.label_number)
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
