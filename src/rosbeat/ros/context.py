"""The ROS context of a session; `rclpy.init`, `rclpy.spin` and their kin, called in a page."""

from __future__ import annotations

import signal
import sys
import threading
from collections.abc import Callable
from contextlib import suppress
from functools import wraps
from types import FrameType
from typing import Any

import rclpy
import rclpy.signals
import rclpy.utilities
from rclpy.context import Context
from rclpy.executors import Executor, SingleThreadedExecutor
from rclpy.impl.implementation_singleton import rclpy_implementation
from rclpy.node import Node
from rclpy.task import Future

from rosbeat.errors import SessionError
from rosbeat.ros.console import note
from rosbeat.ros.recording import Watcher, in_kernel, watcher_of

# The ROS context of a session.


#: No node says anything on file descriptor 2: log lines are printed in the cell that ran the node,
#: the same in JupyterLab and in a test. Nor are log files written into the home directory.
SESSION_ARGUMENTS = ["--ros-args", "--disable-stdout-logs", "--disable-external-lib-logs"]


class SessionContext(Context):
    """A context whose nodes are watched.

    A learner's node calls `super().__init__("name")` without a context, so it lands in rclpy's
    default context. While a session is open its context is that default.

    Args:
        watcher: What is told of every node and entity made in this context.
        domain_id: The ROS domain to join.

    Attributes:
        watcher: As above; None when the session has ended, so that the context keeps nothing alive.
        ended: Whether `end` was called.
    """

    def __init__(self, watcher: Watcher, domain_id: int) -> None:
        super().__init__()
        self.watcher: Watcher | None = watcher
        self.ended = False
        # Always an older one, so that these references never form a circle.
        self._previous: Context | None = rclpy.utilities.g_default_context
        super().init(SESSION_ARGUMENTS, domain_id=domain_id)
        _configure_logging(self, rclpy.utilities.g_default_context)

    def init(self, args: Any = None, **_: Any) -> None:  # noqa: ANN401 - rclpy's own signature
        """Answer a learner's `rclpy.init()`: this context is running already."""
        if self.watcher is not None:
            self.watcher.explain_init()

    def shutdown(self) -> None:
        """Answer a learner's `rclpy.shutdown()`: the session goes on."""
        if self.watcher is not None:
            self._be_default()  # rclpy.shutdown() has just forgotten the default context
            self.watcher.explain_shutdown()

    def try_shutdown(self) -> None:
        """Answer a learner's `rclpy.try_shutdown()`: the session goes on."""
        if self.watcher is not None:
            self.watcher.explain_shutdown()

    def end(self) -> None:
        """Shut the context down for real and hand the default back."""
        self.ended = True
        self._previous = _living(self._previous)
        if rclpy.utilities.g_default_context is self:
            self.uninstall(self._previous)
        super().try_shutdown()
        self.watcher = None
        _configure_logging(self._previous, self._previous)

    def _call_on_shutdown_callbacks(self) -> None:
        """Call all that asked to be told, also if one of them raises: the end must be one.

        rclpy's own one for its global executor does, if the node that spun was broken off.
        """
        told: list[Callable[[], Any]] = self._callbacks
        self._callbacks: list[Callable[[], Any]] = []
        for reference in told:
            with suppress(Exception):
                callback = reference()  # a weak reference, or the function itself
                if callback is not None:
                    callback()

    def install(self) -> Context | None:
        """Become rclpy's default context; return the one that was, for `uninstall`."""
        before: Context | None = rclpy.utilities.g_default_context
        self._be_default()
        return before

    def uninstall(self, before: Context | None) -> None:
        """Make `before` the default again, or what came before it if its session has ended."""
        with rclpy.utilities.g_context_lock:
            rclpy.utilities.g_default_context = _living(before)

    def _be_default(self) -> None:
        with rclpy.utilities.g_context_lock:
            rclpy.utilities.g_default_context = self


def _living(context: Context | None) -> Context | None:
    while isinstance(context, SessionContext) and context.ended:
        context = context._previous
    return context


def _configure_logging(settings: Context | None, other: Context | None) -> None:
    """Make logging follow one context's arguments.

    rcl configures logging for the whole process, by the arguments of the first context. If that
    was a learner's own (`other`), every line of a session's nodes would also appear on file
    descriptor 2, so the session takes logging over and gives it back.
    """
    if settings is None or other is None or isinstance(other, SessionContext) or not other.ok():
        return
    rclpy_implementation.rclpy_logging_fini()
    rclpy_implementation.rclpy_logging_configure(settings.handle)


# Interrupts that must not get lost.


def show_briefly(interrupt: KeyboardInterrupt, text: str) -> None:
    """Let IPython show one line for an interrupt, and not the stack it happened to hit.

    Args:
        interrupt: The exception that is on its way.
        text: What to say.
    """
    lines = [f"KeyboardInterrupt: {text}"]
    interrupt._render_traceback_ = lambda: lines  # type: ignore[attr-defined] # IPython's protocol


class Interrupts:
    """Remembers, within a `with` block, that Interrupt was pressed.

    Python raises `KeyboardInterrupt` wherever it is, and that may be a line of Python that rclpy's
    C code has called, to convert a message say. Then something else comes out of C: measured, one
    interrupt in ten became `RuntimeError: Unable to convert call argument`. Whoever catches an
    exception in the block can ask here what it really was.

    Attributes:
        pressed: Whether Interrupt was pressed in this block.
    """

    def __init__(self) -> None:
        self.pressed = False
        self._original: Any = None

    def __enter__(self) -> Interrupts:
        self.pressed, self._original = False, None
        # Only the main thread is interrupted, and only it may ask to be told.
        if threading.current_thread() is threading.main_thread():
            original = signal.getsignal(signal.SIGINT)
            if callable(original):
                self._original = original
                signal.signal(signal.SIGINT, self._note)
        return self

    def __exit__(self, *_: object) -> None:
        if self._original is not None:
            signal.signal(signal.SIGINT, self._original)

    def insist(self) -> None:
        """Raise the interrupt if there was one.

        Raises:
            KeyboardInterrupt: If Interrupt was pressed.
        """
        if self.pressed:
            raise KeyboardInterrupt from None

    def _note(self, number: int, frame: FrameType | None) -> None:
        self.pressed = True
        self._original(number, frame)


# What `rclpy.init`, `rclpy.spin` and their kin do when a learner calls them in a page.
#
# They are written for a process that does nothing else. In a kernel the originals would take over
# Interrupt (`init` installs signal handlers that shut down *every* context) or never give it back
# (`spin` waits in C, where Interrupt does not reach). Here they do what their name says and leave
# the kernel alive; nodes of a session stay with their session.


#: Seconds between two looks at whether the learner pressed Interrupt.
PULSE = 0.1


def install_learner_calls() -> None:
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
