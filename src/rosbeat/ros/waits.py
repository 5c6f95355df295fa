"""Suspend and resume the code of nodes: each simulated thread is a greenlet.

All greenlets of a session share one thread of the operating system. The greenlet that runs the
session's loop calls callbacks directly, which costs nothing. When a callback waits, its greenlet is
suspended, and another one continues the loop. When the wait is over, the callback's own greenlet
resumes the callback and then takes over the loop, and the other one stands by.

This module knows greenlets and no rclpy; `engine` says what the loop does.
"""

from __future__ import annotations

import contextvars
import logging
from _thread import get_ident
from abc import ABC, abstractmethod
from asyncio import events
from collections import deque
from collections.abc import Callable
from contextlib import AbstractContextManager
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from greenlet import GreenletExit, getcurrent, greenlet

from rosbeat.errors import SessionError
from rosbeat.ros.schedule import Schedule

if TYPE_CHECKING:
    from rosbeat.ros.processes import Entry, NodeState, Process
    from rosbeat.ros.recording import CallbackLabel

#: How often code is told to end that catches even that.
_MOST_EXITS = 100

#: The switchboard whose code runs in this context, if any. A context variable, since two sessions
#: may run in two threads, and a thread of the operating system begins without it.
_BOARD: contextvars.ContextVar[Switchboard | None] = contextvars.ContextVar("board", default=None)


@dataclass(eq=False, slots=True)
class Call:
    """Represent running code of a node: a callback, a constructor, a thread, or a `main`.

    Attributes:
        process: The simulated process in which it runs.
        state: The node whose callback it is; None for a constructor, a thread or a `main`.
        entry: The entity whose callback it is, if there is one.
        label: The label under which it is recorded, if there is one.
        began_ns: When it first began to wait, in nanoseconds; -1 if it never has.
        idle: Whether it waits for whatever comes, in a `spin` or as a thread of a pool.
        wait: The current wait, if there is one.
        holds_group: Whether it occupies its callback group by our account and not by rclpy's.
        is_direct: Whether the engine has taken its work, and not an executor of rclpy.
        broken: How often it was told to end from outside; above 0, it must not wait again.
        hint: What its next wait is for, and the entity of its own process that has to run first.
        ident: The number of its simulated thread; 0 for the main thread of a process.
        polled: When it last looked at its queues without waiting, and how often at that instant.
        reads: The same of the clocks of Python.
        turns: When it has last let others go first, and how often at that instant.
        abandon: Called in place of its first step, if its process ends before that.
        changes: How many changes of entities there were when it last looked for events.
        pause_ns: How much time it has let pass since its last look that found nothing.
    """

    process: Process
    state: NodeState | None = None
    entry: Entry | None = None
    label: CallbackLabel | None = None
    began_ns: int = -1
    idle: bool = False
    wait: Wait | None = None
    holds_group: bool = False
    is_direct: bool = False
    broken: int = 0
    hint: tuple[str, Any] | None = None
    ident: int = 0
    polled: tuple[int, int] = (-1, 0)
    reads: tuple[int, int] = (-1, 0)
    turns: tuple[int, int] = (-1, 0)
    pause_ns: int = 0
    abandon: Callable[[], None] | None = None
    changes: int = -1

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
        call: The call; None before the first step of a greenlet.
        thread: The greenlet that resumes when the wait is over.
        reason: Short description of the condition: `sleep`, or `a response from /add`.
        began_ns: When the wait began, in nanoseconds of virtual time.
        until_ns: When the wait times out; None without a limit.
        met: Returns whether the condition holds; None if only time or `wake` ends the wait.
        needs: The entity of the same process whose callback has to run first, if there is one.
        woken: Whether it was ended by `wake`, and not by time.
        over: Whether the call has gone on.
        error: The exception to raise in the call when it resumes.
        reported: Whether the wait was reported as a deadlock.
        due_ns, order: Its place in the schedule.
        has_waitables: Whether it is an executor's, with waitables such as actions.
        variables: The context that the loop had when the wait began.
    """

    call: Call | None
    thread: greenlet
    reason: str
    began_ns: int
    until_ns: int | None = None
    met: Callable[[], object] | None = None
    needs: Any = None
    woken: bool = False
    over: bool = False
    error: BaseException | None = None
    reported: bool = False
    due_ns: int | None = None
    order: int = 0
    has_waitables: bool = False
    variables: contextvars.Context | None = None

    def is_for_good(self) -> bool:
        """Return whether nothing but an event of the simulation can end it.

        The `spin` of a program waits for whatever comes, and is not meant; that of a callback is.
        """
        call = self.call
        return self.until_ns is None and call is not None and not (call.idle and call.entry is None)


def board_here() -> Switchboard | None:
    """Return the switchboard whose simulated code calls this, or None outside of all."""
    board = _BOARD.get()
    return board if board is not None and board.in_callback else None


class Switchboard(ABC):
    """Suspend and resume the greenlets of one session; what comes next, the engine adds.

    Attributes:
        now: Virtual time in nanoseconds since the session began.
        running: Whether the loop is active.
        schedule: What is due at which time.
        calling: The callback that is running, or ran last; None before the first.
        elsewhere: Work that other threads of the operating system have queued since the last step,
            such as the recording of a message that they published.
        thread: The thread of the operating system in which the nodes run.
    """

    def __init__(self, next_number: Callable[[], int]) -> None:
        self.now = 0
        self.running = False
        self.schedule = Schedule()
        self.calling: CallbackLabel | None = None
        self.elsewhere: deque[Callable[[], None]] = deque()
        self.thread = get_ident()
        self.next_number = next_number
        # What is running: an entity's callback, and what is known of that call if somebody asked.
        self._entry: Entry | None = None
        self._call_of_entry: Call | None = None
        self._suspended: dict[Call, None] = {}
        # Waits that somebody has ended, and those whose condition is looked at again and again.
        self._woken: deque[Wait] = deque()
        self._looking: list[Wait] = []
        # Greenlets that stand by to run the loop, and the one that waits for the end of the run.
        self._idle: list[greenlet] = []
        self._main: greenlet = getcurrent()
        self._variables = contextvars.copy_context()
        self._closing = False

    # What is running.

    @property
    def in_callback(self) -> bool:
        """Return whether the caller is code of a node: a callback, a constructor or a program."""
        return self.current is not None and get_ident() == self.thread

    @property
    def current(self) -> Call | None:
        """Return the code of a node that is running, or None."""
        if self._call_of_entry is None and self._entry is not None:
            # Made only if somebody asks: most callbacks neither wait nor look at this.
            entry = self._entry
            call = Call(entry.state.process, entry.state, entry, entry.label)
            call.is_direct = True
            self._call_of_entry = call
        return self._call_of_entry

    @current.setter
    def current(self, call: Call | None) -> None:
        """Note what is running from now on."""
        self._entry = call.entry if call is not None else None
        self._call_of_entry = call

    @property
    def suspended(self) -> list[Call]:
        """Return the calls that wait now, in the order in which they began."""
        return [call for call in self._suspended if call.wait is not None]

    # Waiting.

    def sleep_until(self, until_ns: int) -> None:
        """Suspend the caller until a time, in nanoseconds of virtual time."""
        if until_ns > self.now:
            self.block("sleep", until_ns)

    def after(self, seconds: float | None) -> int | None:
        """Return the time after so many seconds, in nanoseconds; None for none or below zero."""
        return None if seconds is None or seconds < 0 else self.now + round(seconds * 1e9)

    def block(
        self,
        reason: str,
        until_ns: int | None = None,
        met: Callable[[], object] | None = None,
        *,
        needs: Any = None,  # noqa: ANN401 - any entity of rclpy
        idle: bool = False,
        order: int = 0,
        prepare: Callable[[Wait], None] | None = None,
    ) -> bool:
        """Suspend the code of a node that calls this, until a time or until something is true.

        In a cell, or in a constructor that a cell calls, the other nodes run until then. See `Wait`
        for the arguments; `prepare` is called with the wait before it begins.

        Returns:
            Whether `met` came true or, without it, whether it was woken; False if time was up.

        Raises:
            SessionError: If it can never end.
        """
        if met is not None and met() and not self._is_interrupted():
            return True
        here, call = getcurrent(), self.current
        if call is not None and (call.broken or call.process.is_over or self._closing):
            self._exit(here, call)
        if call is not None and call.hint is not None:
            (reason, needs), call.hint = call.hint, None
        wait = Wait(call, here, reason, self.now, until_ns, met, needs)
        wait.order = order or self.next_number()
        if prepare is not None:
            prepare(wait)
        if here is self._main or not self.running:
            self._block_main(wait)
        else:
            assert call is not None  # only code of a node runs in another greenlet
            self._switch_away(call, wait, idle)
        if wait.error is not None:
            raise wait.error
        return bool(met()) if met is not None else wait.woken

    def give_way(self, reason: str = "turn") -> None:
        """Let everybody else who can run do a step first."""
        if getcurrent() is not self._main and self.running:
            self.block(reason, idle=True, prepare=self.wake)

    def wake(self, wait: Wait) -> None:
        """End a wait, from any thread."""
        if get_ident() != self.thread:
            self.elsewhere.append(lambda: self.wake(wait))
        elif not wait.woken and not wait.over:
            wait.woken = True
            self._woken.append(wait)

    def end_wait(self, call: Call, error: BaseException | None = None) -> None:
        """Let a call that waits go on, and raise an exception in it if one is given."""
        wait = call.wait
        if wait is not None and not wait.over:
            wait.error = wait.error or error
            self.wake(wait)

    def break_off(self, call: Call) -> None:
        """End a call that waits, as the end of its process would: only its `finally` blocks run."""
        wait, call.broken = call.wait, 1
        if wait is not None and not wait.over and wait.thread is not getcurrent():
            before = self.current, self.calling
            wait.over = True
            if call.abandon is not None and not wait.thread and not wait.thread.dead:
                call.abandon()
            # A pool of threads would log what ends its threads, as if a task of theirs had raised.
            pools = logging.getLogger("concurrent.futures")
            pools.disabled, was_disabled = True, pools.disabled
            try:
                with self._running():  # its `finally` blocks may sleep, too
                    _throw(wait.thread, GreenletExit())
            finally:
                pools.disabled = was_disabled
            self.current, self.calling = before
        self._forget_call(call)

    def start_greenlet(self, call: Call, run: Callable[[], None]) -> None:
        """Begin another greenlet as soon as virtual time goes on."""

        def begin() -> None:
            self.current, call.wait = call, None
            self._call_begins(call)
            try:
                run()
            finally:
                self._call_ends(call)
                self._forget_call(call)
                self.current = None
                # Whoever has ended it goes on, if it was ended; so does who collects it as garbage.
                if not call.broken and self.running:
                    getcurrent().parent = self._next_driver()

        wait = Wait(call, greenlet(begin, self._main), "start", self.now)
        call.wait, call.idle = wait, True
        call.process.calls.append(call)
        self._suspended[call] = None
        self._woken.append(wait)

    def close(self) -> None:
        """End all calls that wait, as the end of a process does, and leave no greenlet."""
        self._closing = True
        for call in self.suspended:
            self.break_off(call)
        for standby in self._idle:
            _throw(standby, GreenletExit())
        self._idle.clear()
        self._looking.clear()
        self._woken.clear()

    # What the engine has to add.

    @abstractmethod
    def thread_label(self, creator: Call, name: str) -> CallbackLabel:
        """Return the label of a thread that code of a node starts."""

    @abstractmethod
    def _drive(self, *_: object) -> None:
        """Run what comes next, for ever; at the end of a run, switch to who has called it."""

    @abstractmethod
    def _block_main(self, wait: Wait) -> None:
        """Run the others until then; the greenlet that waits for the run cannot be suspended."""

    @abstractmethod
    def _running(self) -> AbstractContextManager[None]:
        """Prepare the thread for running code of nodes."""

    @abstractmethod
    def _is_interrupted(self) -> bool:
        """Return whether somebody has asked for an end of what is running."""

    # What it may add.

    def _check_that_it_can_end(self, wait: Wait) -> None:  # noqa: B027 - nothing, unless it is added
        """Report a wait that never ends."""

    def _call_begins(self, call: Call) -> None:  # noqa: B027 - the same
        """Note that a greenlet begins."""

    def _call_ends(self, call: Call) -> None:  # noqa: B027 - the same
        """Note that a greenlet ends."""

    def _call_suspended(self, call: Call) -> None:  # noqa: B027 - the same
        """Note that a call begins to wait."""

    def _call_resumed(self, call: Call, wait: Wait) -> None:  # noqa: B027 - the same
        """Note that a call goes on."""

    def _call_forgotten(self, call: Call) -> None:  # noqa: B027 - the same
        """Note that a call has ended."""

    # How it works.

    def _switch_away(self, call: Call, wait: Wait, idle: bool) -> None:
        call.wait, call.idle = wait, idle
        if call.began_ns < 0:
            call.began_ns = self.now
            self._suspended[call] = None
            if call not in call.process.calls:
                call.process.calls.append(call)
        wait.variables = self._variables
        self._call_suspended(call)
        if wait.until_ns is not None:
            self.schedule.add(wait, wait.until_ns)
        if wait.met is not None:
            self._looking.append(wait)
        loop = events._get_running_loop()
        if loop is not None:
            events._set_running_loop(None)
        try:
            self._check_that_it_can_end(wait)
            self._next_driver().switch()
        finally:
            # First of all: an interrupt may come at any of these lines, and be caught by the call.
            self.current, self.calling = call, call.label or self.calling
            wait.over = True
            wait.due_ns = None
            if wait in self._looking:
                self._looking.remove(wait)
            call.wait, call.idle = None, False
            if loop is not None:
                events._set_running_loop(loop)
            self._call_resumed(call, wait)

    def _exit(self, here: greenlet, call: Call) -> None:
        call.broken += 1
        if call.broken > _MOST_EXITS:  # it catches everything: it is left where it is
            self._call_suspended(call)
            here.parent.switch()
        raise GreenletExit

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

    def _resume(self, wait: Wait) -> None:
        """Go on with a call whose wait is over; the greenlet of the caller stands by."""
        thread, wait.over = wait.thread, True
        thread.parent = self._main
        # What it prints belongs to the cell of now, whose identity is a context variable. Code that
        # runs in a context of its own, as asyncio's does, must find that one again.
        if thread.gr_context is None or thread.gr_context is wait.variables:
            thread.gr_context = self._variables
        self._idle.append(getcurrent())
        thread.switch()

    def _next_driver(self) -> greenlet:
        """Return a greenlet that goes on with the loop."""
        self._idle = [standby for standby in self._idle if not standby.dead]
        driver = self._idle.pop() if self._idle else greenlet(self._drive)
        driver.parent = self._main
        driver.gr_context = self._variables
        return driver

    def _forget_call(self, call: Call) -> None:
        self._suspended.pop(call, None)
        if call in call.process.calls:
            call.process.calls.remove(call)
        self._call_forgotten(call)

    def _enter_thread(self) -> None:
        """Use the calling thread from now on; greenlets cannot change threads."""
        if get_ident() == self.thread:
            return
        if self.running or self.suspended:
            waits = "".join(
                f", where {call.name} of {call.node} waits" for call in self.suspended[:1]
            )
            raise SessionError(
                f"This session runs in another thread{waits}.",
                "A callback always continues in the thread in which it started.",
                "Call `ros.run` in that thread, or open a separate session for each thread.",
            )
        self.thread = get_ident()
        self._idle.clear()


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
