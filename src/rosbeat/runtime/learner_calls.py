"""What `rclpy.init`, `rclpy.spin` and their kin do when a learner calls them in a page.

They are written for a process that does nothing else. In a kernel the originals would take over
Interrupt (`init` installs signal handlers that shut down *every* context) or never give it back
(`spin` waits in C, where Interrupt does not reach). Here they do what their name says and leave the
kernel alive; nodes of a session stay with their session.
"""

from __future__ import annotations

import sys
import threading
from collections.abc import Callable
from functools import wraps
from types import FrameType
from typing import Any

import rclpy
import rclpy.signals
from rclpy.context import Context
from rclpy.executors import Executor, SingleThreadedExecutor
from rclpy.node import Node
from rclpy.task import Future

from rosbeat.errors import SessionError
from rosbeat.runtime.console import note
from rosbeat.runtime.context import SessionContext
from rosbeat.runtime.hooks import in_kernel, watcher_of
from rosbeat.runtime.interrupts import show_briefly

#: Seconds between two looks at whether the learner pressed Interrupt.
PULSE = 0.1


def install() -> None:
    """Put this module's functions in the place of rclpy's; a second call does nothing."""
    if hasattr(rclpy.spin, "__wrapped__"):
        return
    rclpy.init = _init(rclpy.init)
    rclpy.spin = _spin(rclpy.spin)
    rclpy.spin_once = _spin_once(rclpy.spin_once)
    rclpy.spin_until_future_complete = _spin_until(rclpy.spin_until_future_complete)
    if in_kernel() and threading.current_thread() is threading.main_thread():
        # rclpy.init() may have been called before rosbeat was imported.
        rclpy.signals.uninstall_signal_handlers()


def _init(original: Callable[..., None]) -> Callable[..., None]:
    @wraps(original)
    def init(
        *,
        args: list[str] | None = None,
        context: Context | None = None,
        **options: Any,  # noqa: ANN401 - rclpy's own
    ) -> None:
        target = context or rclpy.get_default_context()
        if isinstance(target, SessionContext):
            target.init()
            return
        if in_kernel():
            options.setdefault("signal_handler_options", rclpy.signals.SignalHandlerOptions.NO)
            if context is None and target.ok():
                note("ROS is running already in this kernel; rclpy.init() changes nothing.")
                return
            args = [] if args is None else args  # sys.argv is the kernel's, not the node's
        original(args=args, context=context, **options)

    return init


def _spin(original: Callable[..., None]) -> Callable[..., None]:
    @wraps(original)
    def spin(node: Node, executor: Executor | None = None) -> None:
        watcher: Any = watcher_of(node)
        if watcher is not None:
            _spin_in_session(watcher, node)
            return
        _spin_until_interrupt(node, executor or _executor_for(node))

    return spin


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


def _spin_in_session(world: Any, node: Node) -> None:  # noqa: ANN401 - World imports this package
    """Run the session's nodes against the wall clock until Interrupt."""
    world.refuse_in_callback("rclpy.spin")
    _refuse_in_constructor(node)
    state = world.state_of(node)
    world.spin_node(state)
    was_live = world.live is not None
    if not was_live:
        world.go_live()
    note(f"{state.name} spins in real time until you interrupt the cell.")
    pulse = threading.Event()  # nobody sets it: it is a sleep that Interrupt ends at once
    try:
        while world.live is not None and not state.ended:
            world.show_news()
            pulse.wait(PULSE / 2)
    except KeyboardInterrupt as interrupt:
        show_briefly(interrupt, f"{state.name} has stopped spinning; the session goes on.")
        world.hurry()
        raise
    finally:
        if not was_live:
            world.go_virtual()
        world.show_news()


def _refuse_in_constructor(node: Node) -> None:
    """A node that spins while it is being made would never be there.

    Raises:
        SessionError: If the node's own `__init__` is running.
    """
    frame: FrameType | None = sys._getframe(1)
    while frame is not None:
        code = frame.f_code
        if code.co_name == "__init__" and frame.f_locals.get(code.co_varnames[0]) is node:
            raise SessionError(
                "`rclpy.spin` was called from inside the constructor.",
                "It does not return while the node runs, so the constructor does not end either, "
                "on a real robot too.",
                "Whoever makes the node spins it, when it is ready. In a session: `ros.run(10)`.",
            )
        frame = frame.f_back


def _spin_once(original: Callable[..., None]) -> Callable[..., None]:
    @wraps(original)
    def spin_once(
        node: Node, *, executor: Executor | None = None, timeout_sec: float | None = None
    ) -> None:
        if watcher_of(node) is not None:
            raise SessionError(
                "rclpy.spin_once was called for a node of a session.",
                "The session runs this node's callbacks itself.",
                "Use `ros.run(seconds=1)`, or any other number of seconds.",
            )
        original(node, executor=executor, timeout_sec=PULSE if timeout_sec is None else timeout_sec)

    return spin_once


def _spin_until(original: Callable[..., None]) -> Callable[..., None]:
    @wraps(original)
    def spin_until_future_complete(
        node: Node,
        future: Future,
        executor: Executor | None = None,
        timeout_sec: float | None = None,
    ) -> None:
        world: Any = watcher_of(node)
        if world is None:
            original(node, future, executor, timeout_sec)
            return
        world.refuse_in_callback("rclpy.spin_until_future_complete")
        world.spin_node(world.state_of(node))
        if world.live is not None:
            world.live.wait_for(future, timeout_sec)
        else:
            world.wait_until(lambda: future.done() or future.cancelled(), timeout_sec)

    return spin_until_future_complete
