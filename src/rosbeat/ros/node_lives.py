"""Run nodes, let them rest, start them again and end them, alone or with their process."""

from __future__ import annotations

from contextlib import suppress
from inspect import iscoroutine
from typing import TYPE_CHECKING

import rclpy.utilities
from rclpy.exceptions import InvalidHandle
from rclpy.executors import Executor, MultiThreadedExecutor
from rclpy.node import Node

from rosbeat.errors import SessionError
from rosbeat.ros.differences import tasks_of
from rosbeat.ros.errors import node_has_ended
from rosbeat.ros.launch import Launch, Maker, build_in
from rosbeat.ros.processes import Ending, NodeState, Process
from rosbeat.ros.wait_set import ProcessExecutor
from rosbeat.ros.waits import Call

if TYPE_CHECKING:
    from rosbeat.ros.session_core import SessionCore


class NodeLives:
    """Run, pause, restart, end and destroy the nodes of a session.

    Args:
        core: The session of the nodes.
    """

    def __init__(self, core: SessionCore) -> None:
        self._core = core

    def spin_node(self, state: NodeState) -> None:
        """Run this node's callbacks from now on."""
        state.paused = False
        process = state.process
        if self._core.live is not None:
            state.spinning = True
            state.node.executor = self._core.live
            self._core.live.wake()
        elif process.program is None:
            self.spin_in_process(state)
        else:
            state.spinning = state.node.executor is not None
            self._core.virtual.entities_changed()
        self._core.virtual.resume(state)

    def spin_in_process(self, state: NodeState) -> None:
        """Run this node's callbacks in virtual time, by the executor of its process."""
        process = state.process
        if process.executor is None:
            with self._core.starting(Launch(), process):
                process.executor = self._make_executor(process)
        if len(process.states) == 1 and process.pool_size == 1:
            # As in the `main` of most programs: `rclpy.spin(node)`.
            process.global_executor = process.executor
        state.spinning = True
        state.node.executor = process.executor
        self._core.watch.adopt(state)
        self._core.virtual.spin_process(process)

    def _make_executor(self, process: Process) -> Executor:
        if process.pool_size == 1:
            return ProcessExecutor(self._core, process)
        return MultiThreadedExecutor(process.pool_size, context=self._core.context)

    def pause_node(self, state: NodeState) -> None:
        """Run none of this node's callbacks until `spin_node`; its messages wait in queues."""
        state.spinning = False
        state.process.refresh()
        self._core.virtual.entities_changed()
        if self._core.live is not None:
            self._core.live.wake()  # it may be waiting for this node

    def pause(self, node: Node | str) -> None:
        """Pause a node, given itself or by name; raise a SessionError if there is no such node."""
        state = self._core.nodes.find(node)
        self.pause_node(state)
        state.paused = True

    def resume(self, node: Node | str) -> None:
        """Resume a node, given itself or by name.

        Raises:
            SessionError: If there is no such node, or it has ended.
        """
        state = self._core.nodes.find(node)
        if state.ended:
            raise node_has_ended(state.name)
        self.spin_node(state)

    def restart(self, name: str, maker: Maker) -> None:
        """Make a node of this name as it was made before, and run its callbacks.

        Raises:
            SessionError: If another session is open.
            NodeConstructionError: If its constructor raises.
        """
        # A node names no context, so it would land in the session that was opened last.
        if rclpy.utilities.g_default_context is not self._core.context:
            raise SessionError(
                f"{name} cannot be started now.",
                "Another session is open, and a new node would belong to that session.",
                "Close the other session first, or wait until the running check has ended.",
            )
        (made,) = build_in(self._core, [maker.make], maker.start)
        self._core.makers[made] = maker
        self.spin_node(self._core.nodes[made])

    def end_process(self, process: Process, ending: Ending) -> None:
        """Run no callbacks of a process any more; its nodes stay in the graph until destroyed."""
        for state in list(process.states):
            self.pause_node(state)
            state.ended, state.ending = True, state.ending or ending
        process.is_over = True
        for call in [call for call in process.calls if call.wait is not None]:
            self._core.virtual.break_off(call)
        if process.executor is not None:
            end_coroutines(process.executor)

    def destroy(self, state: NodeState) -> None:
        """Destroy a node, whole or half-made."""
        try:
            state.node.destroy_node()
        except Exception:
            # Its constructor stopped half-way, or its own destroy_node raises, or did half of it.
            with suppress(AttributeError, InvalidHandle):
                Node.destroy_node(state.node)
            self._core.node_ends(state.node)


def end_coroutines(executor: Executor, state: NodeState | None = None) -> None:
    """Close the coroutines that wait, of one node or all: their `finally` blocks run now."""
    for task in tasks_of(executor):
        call: Call | None = task.__dict__.get("_rosbeat_call")
        if state is not None and (call is None or call.state is not state):
            continue
        if iscoroutine(task._handler) and not task.executing():
            with suppress(Exception):  # what a `finally` block of a learner's raises
                task._handler.close()
