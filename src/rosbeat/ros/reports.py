"""Record what callbacks do and which faults they end with, and print what is new."""

from __future__ import annotations

import sys
import time
from collections.abc import Sequence
from traceback import walk_tb
from types import FrameType
from typing import TYPE_CHECKING

from greenlet import getcurrent
from rclpy.node import Node

from rosbeat.records import Fault
from rosbeat.ros.actions import action_of
from rosbeat.ros.errors import deadlock, note
from rosbeat.ros.exception_origin import fault_of, is_learners, line_of
from rosbeat.ros.live import BrokenOff
from rosbeat.ros.processes import INTERRUPTED, RAISED, Ending, NodeState
from rosbeat.ros.recording import Entity, repair_message_classes
from rosbeat.ros.wait_set import waitable_label, waitable_name
from rosbeat.ros.waits import Wait

if TYPE_CHECKING:
    from rosbeat.ros.session_core import SessionCore

#: Seconds after which an interrupt is meant for the callback that it hits.
_ENDLESS = 1.0


class Reports:
    """Record and print what comes of the callbacks of a session.

    Args:
        core: The session, whose recorder and console it fills.
    """

    def __init__(self, core: SessionCore) -> None:
        self._core, self._recorder, self._console = core, core.recorder, core.console
        self._shown_logs = self._shown_faults = 0

    # What runs.

    def callback_ran(self, entity: Entity, node: Node | None) -> None:
        """Record a callback that is about to run, live or through rclpy's wait set."""
        entry, state = self._core.nodes.entry_of(entity), self._core.nodes.state_of(node)
        if entry is not None:
            entry.calls += 1
            with self._recorder.lock:
                self._recorder.add_callback(self._core.now(), entry.label_number)
        # An action tells by itself, as soon as it knows what it was.
        elif state is not None and not action_of(entity, state):
            self.heard(state, *waitable_label(entity, state.node))

    def event_heard(self, handler: Entity, state: NodeState) -> None:
        """Record the callback of a QoS event that is about to run."""
        self.heard(state, *waitable_label(handler, state.node))

    def heard(self, state: NodeState, kind: str, name: str, source: str) -> None:
        """Record a callback of an action or another waitable that is about to run."""
        self._core.virtual.calling = label = self._recorder.label(state.name, kind, name, source)
        with self._recorder.lock:
            self._recorder.add_callback(self._core.now(), label.number)

    # What went wrong, or will never end.

    def entity_raised(self, node: Node | None, entity: Entity, error: BaseException) -> None:
        """Record an exception that left a callback, in live mode."""
        entry = self._core.nodes.entry_of(entity)
        state = entry.state if entry else self._core.nodes.state_of(node)
        name = entry.label.name if entry else "a task" if entity is None else waitable_name(entity)
        self.callback_raised(state, name, error)

    def callback_raised(self, state: NodeState | None, name: str, error: BaseException) -> None:
        """Record an exception that left a callback; end its process, and let the others go on."""
        node = state.name if state else "A task"
        fault = fault_of(error, self._core.now(), node, name)
        self._recorder.faults.append(fault)
        self._console.raised(fault, error)
        repair_message_classes()
        if state is not None:
            kind = INTERRUPTED if isinstance(error, BrokenOff) else RAISED
            self._core.lives.end_process(
                state.process, Ending(kind, state.name, name, self._core.now())
            )
        if self._core.live is None:
            self.show_news()
            if state is not None:
                self.note_neighbors(state)

    def note_neighbors(self, state: NodeState) -> None:
        """Say which nodes have ended with another one of their process."""
        others = [one.name for one in state.process.states if one is not state]
        if others:
            note(f"{', '.join(others)} ran in the same process, which has ended.")

    def break_endless_off(self, interrupt: KeyboardInterrupt) -> str:
        """End the node whose callback an interrupt has hit, if the callback had run for long.

        Args:
            interrupt: The interrupt, as the session's `run` catches it.

        Returns:
            What to say, in three parts; an empty text if no callback had.
        """
        label, state = self._core.virtual.calling, None
        seconds = time.monotonic() - self._recorder.began
        line, code = line_of(_innermost(interrupt))
        if label is not None and line and seconds >= _ENDLESS:
            state = self._core.nodes.named(label.node)
        if label is None or state is None or state.process.program is not None:
            return ""
        self._core.lives.end_process(
            state.process, Ending(INTERRUPTED, state.name, label.name, self._core.now())
        )
        return (
            f"{state.name} had been in {label.name} for {seconds:.0f} s.\n"
            f"    line {line}: {code}\n"
            "  What it means: While a callback runs, nothing else can. The node has ended; the "
            "other nodes go on.\n"
            "  What to try:   Mend the callback so that it returns, then "
            f"{self._console.add_again}"
        )

    def deadlocked(self, waits: Sequence[Wait]) -> None:
        """Record that callbacks wait for ever, at the line where the first of them waits."""
        for wait in waits:
            wait.reported = True
        call, thread, error = waits[0].call, waits[0].thread, deadlock(waits)
        if call is not None:
            frame = thread.gr_frame if thread is not getcurrent() else sys._getframe(1)
            now, kind = self._core.now(), type(error).__name__
            fault = Fault(now, call.node, call.name, kind, str(error), *line_of(frame))
            self.add_fault(fault)
            if waits[0].needs is not None:  # else what a test does next may end the wait
                self._console.raised(fault, error)
            self._console.deadlock(fault, error)

    def work_raised(self, state: NodeState, name: str, error: BaseException) -> None:
        """Record an exception that left the work on a goal; rclpy aborts the goal and logs it."""
        fault = fault_of(error, self._core.now(), state.name, name)
        self.add_fault(fault)
        self._console.raised(fault, error)
        self._console.work_fault(fault)

    # What is printed.

    def show_news(self) -> None:
        """Print the log lines and faults that have not been printed yet."""
        logs = self._recorder.logs
        while self._shown_logs < len(logs):
            self._shown_logs += 1
            self._console.log(logs[self._shown_logs - 1])
        self.show_faults()

    def show_faults(self) -> None:
        """Print the faults that have not been printed yet."""
        faults = self._recorder.faults
        while self._shown_faults < len(faults):
            self._shown_faults += 1
            self._console.fault(faults[self._shown_faults - 1])

    def add_fault(self, fault: Fault) -> None:
        """Record a fault that the caller prints in its own way."""
        self._recorder.faults.append(fault)
        self._shown_faults += 1


def _innermost(interrupt: KeyboardInterrupt) -> FrameType | None:
    """Return the learner's frame that an interrupt of `run` has hit; None if it was none of theirs.

    It may have been raised anew by code that asked for it (`Interrupts`).
    """
    error: BaseException | None = interrupt
    while error is not None:
        frames = [frame for frame, _ in walk_tb(error.__traceback__)]
        found = next(filter(is_learners, reversed(frames)), None)
        if found is not None:
            return found
        error = error.__context__
    return None
