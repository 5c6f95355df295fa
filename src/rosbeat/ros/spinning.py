"""Run `rclpy.spin` and related functions that a page calls for the nodes of its session.

In the code of a node and in a simulated program these functions are rclpy's own (see `wait_set`).
In a cell, `spin` runs the nodes against the wall clock until Interrupt, because rclpy's own version
waits in C, where Interrupt has no effect. rclpy itself spins nodes that belong to no session.
"""

from __future__ import annotations

import sys
import threading
from collections.abc import Callable
from functools import wraps
from types import FrameType
from typing import TYPE_CHECKING, Any

import rclpy
from rclpy.executors import Executor, SingleThreadedExecutor
from rclpy.node import Node
from rclpy.task import Future

from rosbeat.errors import SessionError
from rosbeat.ros.context import Interrupts, show_briefly
from rosbeat.ros.errors import note
from rosbeat.ros.recording import core_of
from rosbeat.ros.waits import board_here

if TYPE_CHECKING:
    from rosbeat.ros.ports import Spinner

#: Seconds between two looks at whether the learner pressed Interrupt.
PULSE = 0.1


def spin_for_pages(original: Callable[..., None]) -> Callable[..., None]:
    """Wrap `rclpy.spin`: for a node of a session, a cell runs all nodes live."""

    @wraps(original)
    def spin(node: Node, executor: Executor | None = None) -> None:
        core: Spinner | None = core_of(node)
        if core is None:
            _spin_until_interrupt(node, executor or _executor_for(node))
            return
        if _is_simulated(core) and _may_spin(core):
            began = core.virtual.now
            original(node, executor)
            if core.virtual.now == began:
                core.virtual.give_way()  # in a loop after a shutdown, `spin` returns at once
        else:
            _refuse_in_constructor(node)
            _spin_in_session(core, node)

    return spin


def spin_once_for_pages(original: Callable[..., None]) -> Callable[..., None]:
    """Wrap `rclpy.spin_once`, which a cell need not call for a node of a session."""

    @wraps(original)
    def spin_once(
        node: Node, *, executor: Executor | None = None, timeout_sec: float | None = None
    ) -> None:
        core: Spinner | None = core_of(node)
        if core is None:
            wait = PULSE if timeout_sec is None else timeout_sec
            original(node, executor=executor, timeout_sec=wait)
        elif _is_simulated(core):
            original(node, executor=executor, timeout_sec=timeout_sec)
        else:
            raise SessionError(
                "rclpy.spin_once was called for a node of a session.",
                "The session runs this node's callbacks itself.",
                "Use `ros.run(seconds=1)`, with any number of seconds.",
            )

    return spin_once


def spin_until_for_pages(original: Callable[..., None]) -> Callable[..., None]:
    """Wrap `rclpy.spin_until_future_complete`: in a cell, the session runs its nodes."""

    @wraps(original)
    def spin_until_future_complete(
        node: Node,
        future: Future,
        executor: Executor | None = None,
        timeout_sec: float | None = None,
    ) -> None:
        core: Spinner | None = core_of(node)
        if core is None or _is_simulated(core):
            began = core.virtual.now if core is not None else 0
            original(node, future, executor, timeout_sec)
            if core is not None and core.virtual.now == began:
                core.virtual.give_way()
            return
        core.refuse_in_callback("rclpy.spin_until_future_complete")
        core.lives.spin_node(core.nodes.member(node))
        if core.live is not None:
            core.live.wait_for(future, timeout_sec)
        else:
            core.wait_until(lambda: future.done() or future.cancelled(), timeout_sec)

    return spin_until_future_complete


def refuse_in_session(original: Callable[..., Any]) -> Callable[..., Any]:
    """Wrap the `EventsExecutor`, which virtual time does not reach."""

    @wraps(original, updated=())
    def make(*args: Any, **kwargs: Any) -> Any:  # noqa: ANN401 - rclpy's own
        if board_here() is not None:
            raise SessionError(
                "A session cannot run an EventsExecutor.",
                "This executor of `rclpy.experimental` waits in C++, where virtual time does not "
                "reach it.",
                "Use a SingleThreadedExecutor or a MultiThreadedExecutor here.",
            )
        return original(*args, **kwargs)

    return make


def _is_simulated(core: Spinner) -> bool:
    return core.live is None and bool(core.virtual.in_callback)


def _may_spin(core: Spinner) -> bool:
    """Return whether the caller is the `main` of a program, or a thread of its own."""
    call = core.virtual.current
    assert call is not None  # code of a node is running
    return call.process.program is not None or call.ident > 0


# In a cell.


def _executor_for(node: Node) -> Executor:
    if node.context is rclpy.get_default_context():
        return rclpy.get_global_executor()
    # While a session is open its context is the default, which is not the node's.
    return SingleThreadedExecutor(context=node.context)


def _spin_until_interrupt(node: Node, executor: Executor) -> None:
    try:
        executor.add_node(node)
        while executor.context.ok():
            executor.spin_once(timeout_sec=PULSE)
    except KeyboardInterrupt as interrupt:
        show_briefly(interrupt, f"{node.get_name()} has stopped spinning.")
        raise
    finally:
        executor.remove_node(node)


def _spin_in_session(core: Spinner, node: Node) -> None:
    """Run the session's nodes against the wall clock until Interrupt."""
    core.refuse_in_callback("rclpy.spin")
    state = core.nodes.member(node)
    core.lives.spin_node(state)
    was_live = core.live is not None
    if not was_live:
        core.go_live()
    note(f"{state.name} spins in real time until you interrupt it.")
    pulse = threading.Event()  # nobody sets it: it is a sleep that Interrupt ends at once
    try:
        with Interrupts() as interrupts:  # printing may swallow the exception
            while core.live is not None and not state.ended:
                interrupts.raise_if_pressed()
                core.reports.show_news()
                pulse.wait(PULSE / 2)
    except KeyboardInterrupt as interrupt:
        show_briefly(interrupt, f"{state.name} has stopped spinning; the session is still open.")
        core.interrupt()
        raise
    finally:
        if not was_live:
            core.go_virtual()
        core.reports.show_news()


def _refuse_in_constructor(node: Node) -> None:
    """Refuse to spin a node while it is being made: it would never be there.

    Raises:
        SessionError: If the node's own `__init__` is running.
    """
    frame: FrameType | None = sys._getframe(1)
    while frame is not None:
        code = frame.f_code
        if code.co_name == "__init__" and frame.f_locals.get(code.co_varnames[0]) is node:
            raise SessionError(
                "`rclpy.spin` was called from inside the constructor.",
                "`rclpy.spin` does not return while the node runs, so the constructor does not "
                "return either, on a real robot too.",
                "The program that creates the node spins it, after the constructor has returned. "
                "In a session, use `ros.run(10)`.",
            )
        frame = frame.f_back
