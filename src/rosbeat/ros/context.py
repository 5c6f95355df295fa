"""Manage the ROS contexts of sessions and programs, interrupts, and `rclpy.init` in a page."""

from __future__ import annotations

import os
import signal
import sys
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager, nullcontext, suppress
from functools import wraps
from itertools import count
from types import FrameType
from typing import TYPE_CHECKING, Any

import rclpy
import rclpy.signals
import rclpy.utilities
from rclpy.context import Context

from rosbeat.domains import SESSION_DOMAINS
from rosbeat.ros.arguments import ros_arguments
from rosbeat.ros.differences import (
    FORGIVES_SHUTDOWN_AFTER_SIGNAL,
    INIT_IS_FOR_WITH,
    SHUTDOWN_DESTROYS_NODES,
)
from rosbeat.ros.errors import note
from rosbeat.ros.logs import set_levels
from rosbeat.ros.recording import in_kernel
from rosbeat.ros.waits import board_here

if TYPE_CHECKING:
    from rosbeat.ros.ports import AllPorts
    from rosbeat.ros.simulated_program import SimulatedProgram

#: No node says anything on file descriptor 2: log lines are printed in the cell that ran the node,
#: the same in JupyterLab and in a test. Nor are log files written into the home directory.
SESSION_ARGUMENTS = ["--ros-args", "--disable-stdout-logs", "--disable-external-lib-logs"]

# The isolation of a private session: its context is made with discovery off, and then accepts no
# other participant. Fast DDS looks for free ports among a hundred pairs of the context's domain, so
# private sessions spread over several domains (`rosbeat.domains.SESSION_DOMAINS`).

#: rcl reads these in `Context.init`; ROS_LOCALHOST_ONLY=1 would take precedence.
_NO_DISCOVERY: dict[str, str | None] = {
    "ROS_AUTOMATIC_DISCOVERY_RANGE": "OFF",
    "ROS_LOCALHOST_ONLY": None,
}
#: Fast DDS reads this when a context's first node is made. Messages in one process take no
#: transport; without shared memory, a process that is killed leaves no files in /dev/shm.
_NO_SHARED_MEMORY: dict[str, str | None] = {"FASTDDS_BUILTIN_TRANSPORTS": "UDPv4"}
#: A process has one environment: nobody may read it while it is changed for somebody else.
_environment_lock = threading.RLock()
_private_contexts = count()


@contextmanager
def _environment(values: dict[str, str | None]) -> Iterator[None]:
    """Let the middleware read these variables, for which there is no argument, in this block."""
    with _environment_lock:
        before = {name: os.environ.get(name) for name in values}
        _set_environment(values)
        try:
            yield
        finally:
            _set_environment(before)


def _set_environment(values: dict[str, str | None]) -> None:
    for name, value in values.items():
        if value is not None:
            os.environ[name] = value
        elif name in os.environ:
            del os.environ[name]


class SessionContext(Context):
    """Watch the nodes that are created in this context.

    A learner's node calls `super().__init__("name")` without a context, so it is created in rclpy's
    default context. While a session is open, its context is the default.

    Args:
        core: What is notified of every node and entity created in this context.
        domain_id: The ROS domain to join; None for a private context, which no participant outside
            of it can hear, whether in this process or in another.

    Attributes:
        session_core: What is notified; None when the session has ended, so that the context keeps
            nothing alive.
    """

    def __init__(self, core: AllPorts, domain_id: int | None) -> None:
        super().__init__()
        self.session_core: AllPorts | None = core
        # Always an older one, so that these references never form a circle.
        self.previous: Context | None = rclpy.utilities.g_default_context
        self._is_private = domain_id is None
        if domain_id is None:
            number = os.getpid() + next(_private_contexts)
            domain_id = SESSION_DOMAINS[number % len(SESSION_DOMAINS)]
        with _environment(_NO_DISCOVERY if self._is_private else {}):
            super().init(SESSION_ARGUMENTS, domain_id=domain_id)

    def init(self, args: Any = None, **_: Any) -> None:  # noqa: ANN401 - rclpy's own signature
        """Answer a learner's `rclpy.init()`: this context is running already."""
        if self.session_core is not None:
            self.session_core.explain_init()

    def shutdown(self) -> None:
        """Answer a learner's `rclpy.shutdown()`: the session goes on."""
        if self.session_core is not None:
            self.install()  # rclpy.shutdown() has just forgotten the default context
            self.session_core.explain_shutdown()

    def try_shutdown(self) -> None:
        """Answer a learner's `rclpy.try_shutdown()`: the session goes on."""
        if self.session_core is not None:
            self.session_core.explain_shutdown()

    @contextmanager
    def making_node(self) -> Iterator[None]:
        """Make a node in this block: with the first one, Fast DDS creates the participant."""
        with _environment(_NO_SHARED_MEMORY if self._is_private else {}):
            yield

    def end(self) -> None:
        """Shut the context down for real and hand the default back."""
        self.session_core = None
        self.previous = _open_context(self.previous)
        if rclpy.utilities.g_default_context is self:
            self.uninstall(self.previous)
        super().try_shutdown()

    def _call_on_shutdown_callbacks(self) -> None:
        """Call all of them, also if one raises, as that of rclpy's global executor may."""
        told: list[Callable[[], Any]] = self._callbacks
        self._callbacks: list[Callable[[], Any]] = []
        for reference in told:
            with suppress(Exception):
                callback = reference()  # a weak reference, or the function itself
                if callback is not None:
                    callback()

    def install(self) -> Context | None:
        """Become rclpy's default context; return the one that was, for `uninstall`."""
        with rclpy.utilities.g_context_lock:
            before: Context | None = rclpy.utilities.g_default_context
            rclpy.utilities.g_default_context = self
        return before

    def uninstall(self, before: Context | None) -> None:
        """Make `before` the default again, or what came before it if its session has ended."""
        with rclpy.utilities.g_context_lock:
            rclpy.utilities.g_default_context = _open_context(before)


class ProgramContext(Context):
    """Act as a context of a program that a session runs; see `simulated_program`.

    It is the program's default one, or one that it makes itself with `Context()`. It is a real
    context, so that `init`, `ok` and `shutdown` behave as they do in a separate process. The
    program's nodes are created in the session's context.

    Args:
        program: The program, which is notified of a shutdown; by default the one that runs.

    Attributes:
        session_core: The state of the session.
        program: The program.
        home: The context in which nodes are created.
        ros_arguments: What `init` was told for ROS.
        publishes_logs: Whether its nodes have publishers on `/rosout`.
    """

    def __init__(self, program: SimulatedProgram | None = None) -> None:
        super().__init__()
        if program is None:
            board = board_here()
            assert board is not None
            assert board.current is not None
            program = board.current.process.program
            assert program is not None
        self.ros_arguments: list[str] = []
        self.publishes_logs = True
        self.session_core, self.program = program.core, program
        self.home: Context = program.core.context
        program.contexts.add(self)
        #: What the program itself has shut down, and no signal.
        self._shut_down: object = None

    def init(self, args: Any = None, **options: Any) -> None:  # noqa: ANN401 - rclpy's own signature
        """Initialize the context: the arguments hold for all of the program's nodes."""
        words = sys.argv if args is None else list(args)
        super().init(words, **options)  # which refuses arguments that are none
        self.ros_arguments = ros_arguments(words)
        process = self.session_core.process_here() or self.program
        self.publishes_logs = set_levels(process, self.ros_arguments)

    def shutdown(self) -> None:
        """Shut down, and let a `spin` of the program return."""
        by_signal = self.handle is not None and not self.ok() and self._shut_down is not self.handle
        self._destroy_nodes()
        if not (by_signal and FORGIVES_SHUTDOWN_AFTER_SIGNAL):
            super().shutdown()
        self._shut_down = self.handle
        self.program.shut_down(self)

    def try_shutdown(self) -> None:
        """Shut down if that was not done yet, and let a `spin` of the program return."""
        if self.ok():
            self._destroy_nodes()
            self._shut_down = self.handle
        super().try_shutdown()
        self.program.shut_down(self)

    def _destroy_nodes(self) -> None:
        """Destroy the nodes of the program, as rclpy does if they are in this very context."""
        if SHUTDOWN_DESTROYS_NODES and self.handle is not None:
            for node in self.program.nodes:
                if node.context is self:
                    node.destroy_node()


def new_context(kind: type[Context], *_: object, **__: object) -> Context:
    """Make a context; one that code of a program makes is the program's."""
    board = board_here()
    call = board.current if board is not None else None
    own = kind is Context and call is not None and call.process.program is not None
    made: Context = object.__new__(ProgramContext if own else kind)
    return made


def _open_context(context: Context | None) -> Context | None:
    while isinstance(context, SessionContext) and context.session_core is None:
        context = context.previous
    return context


def show_briefly(interrupt: KeyboardInterrupt, text: str) -> None:
    """Let IPython show one line for an interrupt, and not the stack it happened to hit."""
    lines = [f"KeyboardInterrupt: {text}"]
    interrupt._render_traceback_ = lambda: lines  # type: ignore[attr-defined] # IPython's protocol


class Interrupts:
    """Record whether the kernel was interrupted during a `with` block.

    Python raises `KeyboardInterrupt` wherever it is, and that may be in Python code that rclpy's C
    code has called, for example to convert a message. The C code then raises another exception: in
    a measurement, one interrupt in ten became `RuntimeError: Unable to convert call argument`. Code
    that catches an exception in the block can ask here whether an interrupt caused it.

    Attributes:
        pressed: Whether the kernel was interrupted in this block.
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

    def raise_if_pressed(self) -> None:
        """Raise the KeyboardInterrupt if there was one."""
        if self.pressed:
            raise KeyboardInterrupt from None

    def _note(self, number: int, frame: FrameType | None) -> None:
        self.pressed = True
        self._original(number, frame)


def release_interrupt() -> None:
    """Take back the signal handlers of an `rclpy.init()` that a kernel has called before.

    With them, Interrupt would shut down *every* context.
    """
    if in_kernel() and threading.current_thread() is threading.main_thread():
        rclpy.signals.uninstall_signal_handlers()


def init_for_pages(original: Callable[..., Any]) -> Callable[..., Any]:
    """Wrap `rclpy.init`, which is written for a process that does nothing else.

    In a kernel it would install signal handlers with which Interrupt shuts down *every* context.
    """

    @wraps(original)
    def init(
        *,
        args: list[str] | None = None,
        context: Context | None = None,
        **options: Any,  # noqa: ANN401 - rclpy's own
    ) -> Any:  # noqa: ANN401 - None in Jazzy; in Kilted what `with` shuts down at the end of its block
        target = context or rclpy.get_default_context()
        if isinstance(target, SessionContext | ProgramContext):
            options["signal_handler_options"] = rclpy.signals.SignalHandlerOptions.NO
            manager = original(args=args, context=target, **options)
            if isinstance(target, ProgramContext) and target is rclpy.get_default_context():
                target.program.install_handlers()
            return manager
        if in_kernel():
            options.setdefault("signal_handler_options", rclpy.signals.SignalHandlerOptions.NO)
            if context is None and target.ok():
                note("ROS is already running in this kernel, so rclpy.init() changes nothing.")
                return nullcontext() if INIT_IS_FOR_WITH else None
            args = [] if args is None else args  # sys.argv is the kernel's, not the node's
        return original(args=args, context=context, **options)

    return init
