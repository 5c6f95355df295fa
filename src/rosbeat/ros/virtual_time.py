"""Run nodes as a discrete-event simulation.

A robot's program acts only in callbacks, and every callback has a cause: a timer's deadline has
passed, or another callback did something. Time can therefore jump from one deadline to the next. At
each instant one timer runs, then everything that follows from it, until nothing is left to do; then
the next timer of that instant, in order of (deadline, creation).

The consequences of a callback are known without waiting: within one participant, Fast DDS delivers
a message inside `publish()`. Messages stored for a late-joining subscription have arrived when its
creation returns; see `qos_events.wait_for_stored`.

A callback that waits (`time.sleep`, a service call, its own `spin`) suspends its process only. All
callbacks run in greenlets: the greenlet that runs the simulation's loop calls them directly, which
costs nothing. If a callback waits, its greenlet is suspended, and another one continues the loop.
When the wait is over, the callback's own greenlet resumes the callback and then takes over the
loop, and the other one stands by.
"""

from __future__ import annotations

import contextvars
import threading
import time
from collections import deque
from collections.abc import Callable, Collection, Coroutine
from heapq import heappop, heappush
from inspect import iscoroutine, iscoroutinefunction
from itertools import count
from typing import TYPE_CHECKING, Any

from greenlet import GreenletExit, getcurrent, greenlet
from rclpy.context import Context
from rclpy.exceptions import InvalidHandle
from rclpy.task import Task

from rosbeat.errors import EndlessChainError, SessionError
from rosbeat.records import WaitRecord
from rosbeat.ros.context import Interrupts
from rosbeat.ros.differences import call_timer
from rosbeat.ros.errors import never_made
from rosbeat.ros.processes import Call, Entry, NodeState, Process, Spin, Wait, is_free
from rosbeat.ros.qos_events import Deadlines
from rosbeat.ros.recording import CallbackLabel, Recorder
from rosbeat.ros.wait_set import NOT_OF_CALLBACKS, Coroutines, Waiting, WaitSetExecutor

if TYPE_CHECKING:
    from rosbeat.ros.session_core import SessionCore


class Agenda:
    """Order the timers of all nodes by (deadline, order of creation).

    A deadline only ever moves later without the agenda being notified (a longer period, for
    example), so an entry that is popped too early is simply put back. A canceled timer is set
    aside, because a reset may bring it back. So each step costs the logarithm of the number of
    timers.

    An entry may be in the heap several times; only the position at its own `deadline` counts.
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
        entry.entity.clock.move()
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
        """Put a timer in its place anew after a `reset`, which may have brought it nearer."""
        if entry.deadline is not None:
            self.add(entry, now)

    def next_deadline(self, now: int) -> int | None:
        """Return when the next timer is due, in nanoseconds, or None if there is none."""
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
#: Timers that may fire, and sleepers that may wake, at one instant.
MOST_FIRINGS = 10_000
#: Steps that coroutines and tasks may take at one instant.
MOST_TURNS = 100_000
#: From here on followers are counted: few programs ever come here, so it costs the others nothing.
SUSPICIOUS = 12
_TRAIL = 24


class ChainGuard:
    """Count how far each callback is from the timer that began its chain: its `depth`.

    A burst of messages is wide but not deep, so it is never mistaken for an endless chain.
    """

    def __init__(self) -> None:
        self.depth = 0
        self._firings = self._wakes = 0
        self._followers = 0
        self._trail: deque[str] = deque(maxlen=_TRAIL)

    def instant_ends(self) -> None:
        """Forget the counts of this instant: time passes, so what happened before is no circle."""
        self._firings = self._followers = self._wakes = 0

    def timer_fires(self, entry: Entry) -> None:
        """Begin a chain at a timer.

        Raises:
            EndlessChainError: If the timer keeps firing at one instant, because its period is zero.
        """
        self.depth = self._followers = 0
        self._firings += 1
        if self._firings > MOST_FIRINGS:
            self._firings = 0
            raise EndlessChainError(
                f"A timer of {entry.state.name} fired {MOST_FIRINGS} times while no time passed.",
                f"The timer's period is zero, so `{entry.label.name}` is always due and virtual "
                "time cannot advance.",
                "Give create_timer a period above zero, in seconds.",
            )

    def wakes(self, call: Call) -> None:
        """Check a call that goes on because its time has come.

        Raises:
            EndlessChainError: If calls go on without end at one instant (`spin_once` with a timeout
                of zero in a loop).
        """
        self._wakes += 1
        if self._wakes > MOST_FIRINGS:
            self._wakes = 0
            program = call.process.program
            if program is not None:
                program.kill()  # it would never let the others run
            name = call.node or (program.name if program is not None else "A node")
            raise EndlessChainError(
                f"{call.name} of {name} waited {MOST_FIRINGS} times while no time passed.",
                "The call is in a loop, and each wait ends immediately: either its timeout is "
                "zero, or ROS has been shut down. On a real robot, the loop would keep a "
                "processor core busy forever.",
                "Wait with a timeout above zero, and leave the loop when `rclpy.ok()` is False.",
            )

    def inspect(self, entry: Entry) -> None:
        """Check the length and width of a callback's chain.

        This is called only more than `SUSPICIOUS` steps after a timer.

        Raises:
            EndlessChainError: If the chain is longer or wider than any that ends.
        """
        self._followers += 1
        if max(self.depth, self._followers) > LONGEST_CHAIN - _TRAIL:
            # Names are worth their time only now.
            self._trail.append(f"{entry.state.name} ({entry.label.source})")
            if self.depth > LONGEST_CHAIN or self._followers > MOST_FOLLOWERS:
                names = list(dict.fromkeys(self._trail))
                self.depth = self._followers = 0
                self._trail.clear()
                raise EndlessChainError(
                    "Callbacks trigger each other in an endless loop: "
                    f"{' -> '.join([*names, names[0]])}.",
                    "Each callback triggers the next one, so virtual time cannot advance. On a "
                    "real robot, these nodes would keep a processor core busy forever.",
                    "Break the loop: publish from a timer, or only when a value has changed.",
                )


# The simulation.


#: Virtual nanoseconds that a cell waits for another node at most, in a call without a limit.
LONGEST_WAIT = 3600 * 1_000_000_000
#: Virtual nanoseconds that a constructor may wait while it is called by a cell.
LONGEST_START = 600 * 1_000_000_000
#: How often a callback is told to end that catches even that.
_MOST_EXITS = 100


class VirtualTimeExecutor(WaitSetExecutor):
    """Run the callbacks of all processes in virtual time.

    Timers, subscriptions, services and clients are taken directly; see `WaitSetExecutor` for the
    rest.

    Attributes:
        now: Virtual time in nanoseconds.
        is_live: Whether the session is live, so that the wall clock counts.
        running: Whether `run_until` is active.
        calling: The callback that is running, or ran last; None before the first.
        elsewhere: Work that other threads have queued since the last step, such as the recording of
            a message that they published.
        constructor_waits: Called with nanoseconds and the reason when a constructor waits, instead
            of the wait; None to let virtual time pass. Only scenarios set it.
        thread: The thread in which the nodes run.
    """

    def __init__(self, context: Context, recorder: Recorder, core: SessionCore) -> None:
        self.now = 0
        self.is_live = False
        self.running = False
        # What is running: an entity's callback, and what is known of that call if somebody asked.
        self._entry: Entry | None = None
        self._call_of_entry: Call | None = None
        self.calling: CallbackLabel | None = None
        self.elsewhere: deque[Callable[[], None]] = deque()
        self.deadlines = Deadlines()
        self._waits: list[WaitRecord] = []
        self._suspended: dict[Call, None] = {}
        self.constructor_waits: Callable[[int, str], None] | None = None
        self._core = core
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
        self._due: list[Entry] = []
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
        self._done: Callable[[], object] | None = None
        self._ends_idle = self._closing = False
        # Where tasks run that no code of a node has created.
        self._nowhere = Process()
        super().__init__(context=context)

    # What rclpy calls.

    def create_task(self, callback: Any, *args: Any, **kwargs: Any) -> Task:  # noqa: ANN401 - rclpy's own signature
        """Run a callback or coroutine as soon as what is running has ended."""
        task = Task(callback, args, kwargs, executor=self)
        self._coroutines.add_task(task, callback, self.current)
        return task

    # What the session calls.

    @property
    def has_work(self) -> bool:
        """Return whether callbacks are pending for the next run."""
        return bool(self._ready or self._behind)

    @property
    def in_callback(self) -> bool:
        """Return whether the caller is code of a node: a callback, a constructor or a program."""
        return self.current is not None and threading.get_ident() == self.thread

    @property
    def suspended(self) -> list[Call]:
        """Return the callbacks and programs that wait now, in the order in which they began."""
        return [call for call in self._suspended if call.wait is not None]

    def all_waits(self) -> tuple[WaitRecord, ...]:
        """Return what callbacks have waited for, and what they wait for now, in order of time."""
        now = [
            WaitRecord(call.wait.began_ns, self.now, call.node, call.name, call.wait.reason)
            for call in self.suspended
            if call.wait and not call.spinning and call.wait.began_ns < self.now
        ]
        return tuple(sorted([*self._waits, *now], key=lambda one: one.time_ns))

    def watch(self, entry: Entry) -> None:
        """Run this entity's callback from now on, whenever its node spins."""
        if entry.kind == "timer":
            self._agenda.add(entry, self.now)
        elif entry.take is not None:
            self._listeners.setdefault((entry.kind, entry.name), []).append(entry)
            self._hold(entry)

    def unwatch(self, entry: Entry) -> None:
        """Take nothing from this entity any more."""
        listeners = self._listeners.get((entry.kind, entry.name), [])
        if entry in listeners:
            listeners.remove(entry)
        if entry.state.process.pending.pop(entry, None) is not None:
            entry.state.process.refresh()

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

    def timer_reset(self, entry: Entry) -> None:
        """Note that a timer's `reset` was called."""
        self._agenda.move(entry, self.now)

    def look_anew(self) -> None:
        """Look at everything again: the clock was changed from outside, or a run was broken off."""
        states = self._core.states()
        self._ready.clear()
        self._due.clear()
        self._behind.clear()
        for state in states:
            state.process.due = 0
            state.process.pending.clear()
        self._agenda.rebuild([e for s in states for e in s.entries if e.kind == "timer"], self.now)
        for state in states:
            self.resume(state)
        for call in self.suspended:  # one whose time had come may have been left where it was
            if call.wait is not None and call.wait.until_ns is not None:
                heappush(self._sleeping, (call.wait.until_ns, next(self._order), call.wait))

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
        self._woken.clear()
        self._sleeping.clear()

    # Waiting.

    def sleep(self, seconds: float) -> None:
        """Let virtual time pass for everybody but the caller's process."""
        if seconds > 0:
            self.sleep_until(self.now + max(1, round(seconds * 1e9)))

    def after(self, seconds: float | None) -> int | None:
        """Return the time after so many seconds, in nanoseconds; None for none or below zero."""
        return None if seconds is None or seconds < 0 else self.now + round(seconds * 1e9)

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

        In a cell, or in a constructor that a cell calls, it runs the other nodes until then. See
        `Wait` for the arguments.

        Returns:
            Whether `met` came true; False if the time was up first.

        Raises:
            SessionError: If it can never end.
        """
        if met is not None and met() and not (self.running and self._interrupts.pressed):
            return True
        here, call = getcurrent(), self.current
        if call is not None and (call.broken or self._closing):
            call.broken += 1
            if call.broken > _MOST_EXITS:  # it catches everything: it is left where it is
                if call.process.program is not None:
                    call.process.program.leave()
                here.parent.switch()
            raise GreenletExit
        if here is self._main or not self.running:
            return self._block_main(reason, until, met)
        assert call is not None  # only code of a node runs in another greenlet
        wait = Wait(call, here, reason, self.now, until, met, needs)
        self._suspend(call, wait, spinning)
        try:
            if not (wait.can_end() or self.elsewhere):
                self._core.deadlocked([wait])
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
        """Run callbacks of these nodes, as one of rclpy's `spin` functions does.

        It ends after `most` callbacks, if given, and otherwise as `block` does.

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
                self._core.spin_node(state)
            call.process.refresh()
            self._catch_up(call.process)
            over = met if most is None else lambda: spin.left == 0 or (met is not None and met())
            self.block("spin", until, over, needs=needs, spinning=True)
        finally:
            call.process.spins.remove(spin)
            for state in begun:
                if not state.ended:
                    self._core.pause_node(state)
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
            with self._core.running():  # its `finally` blocks may sleep, too
                _throw(wait.thread, GreenletExit())
            self.current, self.calling = before
        self._forget_call(call)

    def start_main(self, main: Callable[[], None], process: Process) -> None:
        """Begin another greenlet, for the `main` of a program, as soon as virtual time goes on."""

        def run() -> None:
            self.current = call = Call(process)
            try:
                main()
            finally:
                self._forget_call(call)
                self.current = None
                if not call.broken:  # else whoever has ended it goes on
                    getcurrent().parent = self._next_driver()

        self._woken.append(Wait(None, greenlet(run, self._main), "start", self.now))

    def sleep_until(self, until: int) -> None:
        """Wait until a time, in nanoseconds of virtual time."""
        if threading.get_ident() != self.thread:
            time.sleep(max(0, until - self.now) / 1e9)  # a thread of the node's own: in real time
        elif until > self.now:
            if self.constructor_waits is not None and not self.running:
                self.constructor_waits(until - self.now, "sleep")
            else:
                self.block("sleep", until)

    def _block_main(self, reason: str, until: int | None, met: Callable[[], object] | None) -> bool:
        """Run the others until then; the greenlet that waits for the run cannot be suspended."""
        call, label = self.current, self.calling
        latest = self.now + LONGEST_WAIT if until is None else until
        if self.constructor_waits is not None:
            self.run_until(self.now, met)
            if met is None or not met():
                self.constructor_waits(latest - self.now, reason)
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
            self._suspended[call] = None
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
        # First of all: an interrupt may come at any of these lines, and be caught by the call.
        self.current, self.calling = call, call.label or self.calling
        wait.over = True
        if wait in self._looking:
            self._looking.remove(wait)
        if self.now > wait.began_ns and not call.spinning:
            self._waits.append(
                WaitRecord(wait.began_ns, self.now, call.node, call.name, wait.reason)
            )
        call.wait, call.spinning = None, False
        call.process.refresh()
        if call.process.program is not None:
            call.process.program.enter()

    def _resume(self, wait: Wait) -> None:
        """Go on with a call whose wait is over; the greenlet of the caller stands by."""
        wait.thread.parent = self._main
        wait.thread.gr_context = self._variables
        self._idle.append(getcurrent())
        wait.thread.switch()

    def _next_driver(self) -> greenlet:
        """Return a greenlet that goes on with the loop."""
        self._idle = [one for one in self._idle if not one.dead]  # one may have been interrupted
        driver = self._idle.pop() if self._idle else greenlet(self._drive)
        driver.parent = self._main
        driver.gr_context = self._variables
        return driver

    def _enter_thread(self) -> None:
        """Use the calling thread from now on; greenlets cannot change threads."""
        if threading.get_ident() == self.thread:
            return
        if self.running or self.suspended:
            waits = "".join(f", where {one.name} of {one.node} waits" for one in self.suspended[:1])
            raise SessionError(
                f"This session runs in another thread{waits}.",
                "A callback always continues in the thread in which it started.",
                "Call `ros.run` in that thread, or open a separate session for each thread.",
            )
        self.thread = threading.get_ident()
        self._idle.clear()

    # The loop.

    def _drive(self, *_: object) -> None:
        """Run what comes next, for ever; at the end of a run, switch to who has called it."""
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

        Return whether anything comes before the end of the run.
        """
        at = timer = self._agenda.next_deadline(self.now)
        missed = None
        if self.deadlines or self._sleeping:  # few programs have one of these
            while self._sleeping and self._sleeping[0][2].over:
                heappop(self._sleeping)
            missed = self.deadlines.next_due() if self.deadlines else None
            wakes = self._sleeping[0][0] if self._sleeping else None
            at = min((one for one in (timer, missed, wakes) if one is not None), default=None)
        if at is None:
            return self._nothing_left()
        if at > self._end:
            self._advance(max(self._end, self.now))
            return False
        self._advance(at if at > self.now else self.now)
        if timer == at:
            self._fire_timers(at)
        elif missed == at:
            self._ready.append((self.deadlines.pass_next(), 1))
        else:
            wait = heappop(self._sleeping)[2]
            self._woken.append(wait)
            if wait.call is not None:
                self._chain.wakes(wait.call)
        return True

    def _nothing_left(self) -> bool:
        """Report a deadlock for all who wait without a limit, since nothing will ever happen."""
        stuck = [wait for wait in self._looking if wait.is_for_good() and not wait.reported]
        if stuck:
            self._core.deadlocked(stuck)
        if not self._ends_idle:
            self._advance(max(self._end, self.now))
        return False

    def _fire_timers(self, deadline: int) -> None:
        """Fire the timer of an instant; if there are several, the first of them."""
        entry = self._agenda.pop()
        if self._agenda.next_deadline(self.now) != deadline:
            self._fire(entry)
            return
        self._due.append(entry)
        entry.state.process.due += 1
        self._fire_due()

    def _fire_due(self) -> None:
        """Fire the first of the timers of this instant, in order of creation."""
        known = len(self._due)
        while self._agenda.next_deadline(self.now) == self.now:
            self._due.append(self._agenda.pop())
            self._due[-1].state.process.due += 1
        if len(self._due) > known:  # others may have been reset to this instant meanwhile
            self._due.sort(key=lambda entry: entry.number)
        entry = self._due.pop(0)
        process = entry.state.process
        process.due = max(0, process.due - 1)
        self._fire(entry)
        if process.pending and not process.due:
            self._catch_up(process)

    def _advance(self, time_ns: int) -> None:
        if time_ns != self.now:
            self._chain.instant_ends()
            self.now = time_ns

    # What is ready.

    def _hold(self, entry: Entry) -> None:
        """Keep for later what cannot run at once."""
        process = entry.state.process
        if entry not in process.pending:
            process.pending[entry] = self._chain.depth + 1
            process.refresh()
        self._catch_up(process)

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
            progress = bool(waiting) and self._step_coroutine()
            if not progress and self._behind and self._run_one_behind():
                continue
            # After each step of a coroutine, too: other processes take what it has sent.
            asked = (self._changed or self._wait_set_nodes) and self.ask_rclpy()
            if not (asked or progress or ready):
                return
            turns += 1
            if turns > MOST_TURNS:
                raise self._turns_without_end()

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
        may_wait = not state.open or self._coroutines.waiting
        if may_wait and state.spinning and not state.process.can_begin(entry):
            self._hold(entry)  # it is late, and fires when its process is free
            return
        handle = entry.handle
        entry.entity.clock.move()
        try:
            with handle:
                due = state.spinning and handle.is_timer_ready()
                if due:
                    callback = call_timer(entry.entity)
        except InvalidHandle:
            return  # destroyed
        self._agenda.add(entry, self.now)  # before the callback, which may wait for longer
        if due:
            self._chain.timer_fires(entry)
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
        call = program = None
        if not entry.state.open:  # something waits in this process already, such as a `spin`
            call = self._current()
            program = call.process.program
        if program is not None:
            program.enter()
        try:
            result = callback(*arguments)
        except BaseException as error:
            pressed = program is not None and program.interrupt is error  # a simulated Ctrl+C
            if isinstance(error, NOT_OF_CALLBACKS) and not pressed:
                raise
            if not pressed:
                self._interrupts.raise_if_pressed()
            self._raised(call or self._current(), entry.label.name, error)
        else:
            # A plain function that returns a coroutine forgot to await it; so it is in rclpy.
            if result is not None and iscoroutine(result) and iscoroutinefunction(callback):
                self._begin(result, entry)
        finally:
            if program is not None:
                program.leave()
            if call is None:
                call = self._call_of_entry
            self._entry = None
            if call is not None:
                self._end_call(call)

    @property
    def current(self) -> Call | None:
        """Return the code of a node that is running, or None."""
        if self._call_of_entry is None and self._entry is not None:
            # Made only if somebody asks: most callbacks neither wait nor look at this.
            entry = self._entry
            self._call_of_entry = Call(entry.state.process, entry.state, entry, entry.label)
        return self._call_of_entry

    @current.setter
    def current(self, call: Call | None) -> None:
        """Note what is running from now on."""
        self._entry = call.entry if call is not None else None
        self._call_of_entry = call

    def _current(self) -> Call:
        call = self.current
        assert call is not None
        return call

    def _end_call(self, call: Call) -> None:
        self.current = None
        if call.began_ns >= 0:
            self._end_suspended(call)
        call.process.count_down()
        if call.process.program is not None:
            call.process.program.callback_ended()

    def _end_suspended(self, call: Call) -> None:
        """Free the thread and the group of a callback that has waited and has returned."""
        process = call.process
        self._forget_call(call)
        if call.holds_group and call.entry is not None:
            call.entry.entity.callback_group.ending_execution(call.entry.entity)
        self._changed = True
        process.refresh()
        self._catch_up(process)

    def _forget_call(self, call: Call) -> None:
        self._suspended.pop(call, None)
        if call in call.process.calls:
            call.process.calls.remove(call)
            call.process.refresh()

    def _raised(self, call: Call, name: str, error: BaseException) -> None:
        """Hand what a callback raised to the `spin` in which it ran, or to the session."""
        process = call.process
        if isinstance(error, SystemExit) and process.program is not None and process.threads > 1:
            return  # a thread of the executor's pool swallows it (`concurrent.futures`)
        spinner = next((one for one in reversed(process.calls) if one.spinning), None)
        if spinner is not None:
            self.end_wait(spinner, error)
        else:
            self._core.callback_raised(call.state, name, error)

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
        except NOT_OF_CALLBACKS:
            waiting.task.cancel()  # rclpy would take it for running, for ever
            self._coroutines.end(waiting)
            raise
        except BaseException as error:
            waiting.task.cancel()
            self._raised(call, waiting.name, error)
        finally:
            self.current = None
            if call.began_ns >= 0:
                self._end_suspended(call)
            if call.process.program is not None:
                call.process.program.callback_ended()

    def _coroutine_ended(self, waiting: Waiting) -> None:
        self._coroutines.end(waiting)
        error = waiting.task.exception()
        if error is not None:
            call = Call(waiting.process or self._nowhere, waiting.state)
            self._raised(call, waiting.name, error)
        if waiting.process is not None:
            self._catch_up(waiting.process)

    def _turns_without_end(self) -> EndlessChainError:
        names = [f"{w.state.name} ({w.name})" for w in self._coroutines.waiting if w.state]
        names = list(dict.fromkeys(names)) or [s.name for s in self._core.states() if s.spinning]
        return EndlessChainError(
            f"Callbacks wait for each other endlessly: {', '.join(names)}.",
            "Each callback continues whenever another one has run, so virtual time cannot advance.",
            "Break the loop: start each piece of work from a timer.",
        )


def _throw(thread: greenlet, error: BaseException) -> None:
    """End a greenlet by an exception; what its code makes of that is its own affair."""
    if thread.dead:
        return
    try:
        thread.parent = getcurrent()  # which raises if it belongs to another thread
        thread.throw(error)
    except BaseException as raised:  # also what a `finally` block of a learner's raises
        if isinstance(raised, KeyboardInterrupt):
            raise
