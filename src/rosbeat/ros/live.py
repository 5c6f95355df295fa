"""Run nodes against the wall clock, in one background thread."""

from __future__ import annotations

import ctypes
import time
from collections.abc import Callable, Coroutine
from contextlib import suppress
from functools import partial
from threading import Event, Thread, current_thread
from typing import TYPE_CHECKING, Any

from rclpy.context import Context
from rclpy.exceptions import InvalidHandle
from rclpy.executors import (
    ConditionReachedException,
    ExternalShutdownException,
    ShutdownException,
    SingleThreadedExecutor,
    await_or_execute,
)
from rclpy.node import Node
from rclpy.task import Future, Task

from rosbeat.ros.differences import call_soon, tasks_of
from rosbeat.ros.processes import Entry
from rosbeat.ros.taking import take_message

if TYPE_CHECKING:
    from rosbeat.ros.ports import Host
    from rosbeat.ros.recording import Entity

#: Seconds that a callback may still take when live mode ends; then it is broken off.
_STOP_TIMEOUT = 2.0
#: The same when the learner presses Interrupt.
_INTERRUPT_TIMEOUT = 0.1


class BrokenOff(BaseException):
    """Signal to a callback that does not return that it has been asked to end."""

    def __str__(self) -> str:
        return "it did not return, so it was interrupted"


class LiveExecutor(SingleThreadedExecutor):
    """Run rclpy's own single-threaded executor under supervision.

    rclpy re-raises what a callback raises, which would end the thread and silence every node. Here
    the session is notified and the node that raised is removed, and the other nodes continue.
    `current` is the node whose callback is running, and `task` its task.
    """

    def __init__(self, context: Context, core: Host) -> None:
        self.current: Node | None = None
        self.task: Task | None = None
        self._core = core
        self._stopping = Event()
        super().__init__(context=context)
        self._thread = Thread(target=self.spin, name="rosbeat live", daemon=True)

    def get_nodes(self) -> list[Node]:
        """Return the nodes in order of creation; rclpy's own answer comes from an unordered set."""
        mine = self._nodes
        return [one.node for one in self._core.nodes.states() if one.spinning and one.node in mine]

    def start(self) -> None:
        """Begin to run callbacks."""
        for state in self._core.nodes.states():
            for entry in state.entries if state.spinning else ():
                self._run_taken_messages(entry)
        self._thread.start()

    def _run_taken_messages(self, entry: Entry) -> None:
        """Make tasks of messages that are in no queue any more; see `qos_events.TakenEarly`."""

        def take(_: object) -> Callable[[], Coroutine[Any, Any, None]] | None:
            work = take_message(entry, None)
            return None if work is None else partial(await_or_execute, work[0], *work[1])

        if entry.kind == "subscription" and entry.handle is not entry.entity.handle:
            for _ in range(len(entry.handle)):
                call_soon(self, self._make_handler(entry.entity, entry.state.node, take))

    def is_this_thread(self) -> bool:
        """Return whether the caller is a callback of this executor."""
        return current_thread() is self._thread

    def wait_for(self, future: Future, seconds: float | None) -> None:
        """Wait in another thread until a future is done, at most so many seconds."""
        arrived = Event()
        future.add_done_callback(lambda _: arrived.set())
        arrived.wait(None if seconds is None or seconds < 0 else seconds)

    def finish(self) -> None:
        """Stop running callbacks and wait until the thread has ended.

        Without the wait the interpreter may be gone while the thread is still inside rclpy, which
        aborts the process. `Executor.shutdown` alone would pull the guard condition from under a
        callback that is just being begun.
        """
        self._stopping.set()
        self.wake()
        self._thread.join(_STOP_TIMEOUT)
        if self._thread.is_alive():
            self._break_off()
            self._thread.join(_STOP_TIMEOUT)
        for task in tasks_of(self):
            with suppress(ValueError):  # it does not wait but runs, in a call that nobody can end
                task.cancel()  # a coroutine that still waits; this frees its callback group
        self.shutdown()

    @property
    def is_stuck(self) -> bool:
        """Return whether a callback still runs although `finish` has broken it off."""
        return self._stopping.is_set() and self._thread.is_alive()

    def interrupt(self) -> None:
        """Break off the callback that is running now, unless it returns at once.

        An endless loop in a callback leaves other threads so little time that even showing the
        interrupt would take seconds.
        """
        running, deadline = self.task, time.monotonic() + _INTERRUPT_TIMEOUT
        while running is not None and self.task is running:
            if time.monotonic() > deadline:
                self._break_off()
                return
            time.sleep(0.001)

    def spin(self) -> None:
        """Run callbacks until `finish`."""
        while True:
            try:
                self._run_one()
            except BrokenOff:
                self._cb_iter = None  # it came just after the callback had returned
            except (ConditionReachedException, ShutdownException, ExternalShutdownException):
                return

    def _make_handler(self, entity: Entity, node: Node, take: Callable[..., Any]) -> Task:
        self._core.reports.callback_ran(entity, node)
        return super()._make_handler(entity, node, take)

    def _run_one(self) -> None:
        try:
            handler, entity, node = self.wait_for_ready_callbacks(condition=self._stopping.is_set)
        except InvalidHandle:  # another thread destroyed an entity while rclpy gathered them
            self._cb_iter = None
            return
        error: BaseException | None = None
        self.current, self.task = node, handler
        try:
            handler()
        except BaseException as stop:  # SystemExit would end the thread unheard
            error = stop
            handler.cancel()
        finally:
            self.current = self.task = None
        error = error or handler.exception()
        if error is not None:
            self._core.reports.entity_raised(node, entity, error)

    def _break_off(self) -> None:
        # Nothing else ends Python code in another thread: a signal is handled in the main thread
        # only. It cannot end a sleep in C, which then goes on by itself, in a daemon thread.
        number = ctypes.c_ulong(self._thread.ident or 0)
        ctypes.pythonapi.PyThreadState_SetAsyncExc(number, ctypes.py_object(BrokenOff))
