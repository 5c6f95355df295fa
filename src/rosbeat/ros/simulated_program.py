"""Run a file with `main()` unchanged as a simulated process, in virtual time.

`rclpy.init`, `spin`, `destroy_node` and `shutdown` behave as in an operating-system process: the
program has its own default context and arguments, and a freshly imported module.
Ctrl+C and SIGTERM arrive at a chosen time, with the effects of rclpy's and Python's signal
handlers: the context is shut down, and `KeyboardInterrupt` is raised where the program is (rclpy
7.1, `signal_handler.cpp`; `tests/conformance` compares the two).

The program's nodes live in the session's context, so that one participant carries all messages; the
program's own context has no nodes.
"""

from __future__ import annotations

import ast
import linecache
import reprlib
import signal
import sys
import traceback
from collections.abc import Callable, Sequence
from contextlib import suppress
from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path
from types import ModuleType
from typing import TYPE_CHECKING, Any
from weakref import WeakSet

import rclpy.utilities
from greenlet import GreenletExit
from rclpy.context import Context
from rclpy.exceptions import InvalidHandle
from rclpy.node import Node

from rosbeat.errors import SessionError
from rosbeat.records import Fault
from rosbeat.ros.context import ProgramContext
from rosbeat.ros.errors import note
from rosbeat.ros.exception_origin import error_text, fault_of
from rosbeat.ros.processes import Process
from rosbeat.ros.recording import invalid_context
from rosbeat.ros.waits import Call

if TYPE_CHECKING:
    from rosbeat.ros.ports import AllPorts

_OWN = str(Path(__file__).parents[1])
_KNOWN_SIGNALS = (signal.SIGINT, signal.SIGTERM, signal.SIGKILL)


class SimulatedProgram:
    """Run a program in a session's virtual time; `Session.spawn` creates one.

    Its methods are those of `subprocess.Popen`, as far as they make sense in virtual time.

    Args:
        core: The state of the session.
        target: A file with a function `main`, or without one, or such a function.
        arguments: Command-line arguments after the program's name.
        entry: The function of the file to call; by default `main`, if there is one.

    Attributes:
        name: The file's name without `.py`, or the function's module and name.
        returncode: The exit code; negative for a signal that ended it; None while it runs.
        stderr: The traceback with which it ended; empty if there was none.
        core: The state of the session.
        contexts: The contexts that it has made.
        argv: Its command line, as in `sys.argv`.
        interrupt: The exception that a simulated Ctrl+C raises, to distinguish it from a real one.
        failure: The exception that left `main`, and its record; None if there was none.
        has_begun: Whether any of its code has run.
        on_end: Called with the exit code when it has ended.

    Raises:
        SessionError: If `target` is neither a file nor a function.
    """

    def __init__(
        self,
        core: AllPorts,
        target: Any,  # noqa: ANN401 - unchecked input
        arguments: Sequence[str],
        entry: str | None = None,
    ) -> None:
        self._target, self._entry = _checked(target), entry
        self.name = target.__name__ if callable(target) else self._target.stem
        self.returncode: int | None = None
        self.stderr = ""
        self.core = core
        self.contexts: WeakSet[Context] = WeakSet()
        self._process = Process(program=self)
        self._main: Call | None = None
        self.interrupt: KeyboardInterrupt | None = None
        self.failure: tuple[Fault, BaseException] | None = None
        self.on_end: Callable[[int], None] = lambda _: None
        self.has_begun = False
        self._has_handlers = False  # those of rclpy
        self._depth = 0  # how many times it was entered and not left
        self.argv = [self.name, *arguments]
        self._context: Context | None = None
        self._outside: tuple[Any, ...] = ()
        if isinstance(self._target, Path):
            self._root = _root_of(self._target)
            parts = self._target.relative_to(self._root).with_suffix("").parts
            self._module, self._package = ".".join(parts), parts[0] if len(parts) > 1 else ""

    def __repr__(self) -> str:
        state = "running" if self.returncode is None else f"exit code {self.returncode}"
        return f"SimulatedProgram({self.name}, {state})"

    # What a page asks.

    @property
    def nodes(self) -> tuple[Node, ...]:
        """Return the nodes that the program has created and not destroyed."""
        return tuple(state.node for state in self._process.states if state.node is not None)

    def poll(self) -> int | None:
        """Return the exit code, or None while it runs."""
        return self.returncode

    def send_signal(self, number: int) -> None:
        """Send a signal to the program, as `kill` and Ctrl+C (`SIGINT`) do.

        What it does then happens at this instant: the session has run it when this returns.

        Args:
            number: `signal.SIGINT`, `signal.SIGTERM` or `signal.SIGKILL`.

        Raises:
            SessionError: If it is another signal, or a callback calls this.
        """
        if number not in _KNOWN_SIGNALS:
            raise SessionError(
                f"The signal {number!r} cannot be sent to a simulated program.",
                "A session simulates Ctrl+C, the system's request to terminate, and `kill -9`.",
                "Use `signal.SIGINT`, `signal.SIGTERM` or `signal.SIGKILL`.",
            )
        self.core.refuse_in_callback("send_signal")
        if self.returncode is not None:
            return
        if number == signal.SIGKILL:
            self._end(-number)
            return
        with self.core.running():
            self._deliver(signal.Signals(number))
            self.core.virtual.run_until(self.core.virtual.now)

    def terminate(self) -> None:
        """Send SIGTERM."""
        self.send_signal(signal.SIGTERM)

    def kill(self) -> None:
        """End it at once, as `kill -9` does."""
        if self.returncode is None:
            self._end(-signal.SIGKILL)

    # What the session calls.

    def start(self) -> None:
        """Run it until it waits for the first time."""
        self.begin()
        self.core.virtual.run_until(self.core.virtual.now)

    def begin(self) -> None:
        """Run it as soon as the session goes on."""
        self._main = Call(self._process)
        self.core.virtual.start_greenlet(self._main, self._run)

    def enter(self) -> None:
        """Put the program's own `sys.argv`, context and folder in place."""
        self._depth += 1
        if self._depth > 1:
            return
        utilities = rclpy.utilities
        self._outside = (
            utilities.g_default_context, utilities.Context, sys.argv, signal.signal, list(sys.path),
        )  # fmt: skip
        utilities.Context = self._new_context
        utilities.g_default_context = self._context
        sys.argv = self.argv
        signal.signal = _keep_handler  # type: ignore[assignment]  # `leave` puts it back
        if isinstance(self._target, Path):
            sys.path.insert(0, str(self._root))

    @property
    def is_entered(self) -> bool:
        """Return whether what belongs to the program is in place."""
        return self._depth > 0

    def leave(self) -> None:
        """Put everything back; the program's own state is kept for the next time."""
        self._depth -= 1
        if self._depth:
            return
        utilities = rclpy.utilities
        self._context = utilities.g_default_context
        (utilities.g_default_context, utilities.Context, sys.argv, signal.signal, path) = (
            self._outside
        )
        sys.path[:] = path

    def shut_down(self, context: Context) -> None:
        """Let publishers and clients of a context that was shut down fail from now on."""
        for state in self._process.states:
            if state.node.context is context:
                for tap in state.taps:
                    tap.close()
                for entry in state.entries:
                    if entry.kind == "client":
                        entry.entity.service_is_ready = _no_service

    def install_handlers(self) -> None:
        """Let rclpy's handlers answer Ctrl+C and SIGTERM, as after `rclpy.init`."""
        self._has_handlers = True

    # How it works.

    def _new_context(self) -> ProgramContext:
        return ProgramContext(self)

    def _run(self) -> None:
        error: BaseException | None = None
        self.has_begun = True
        try:
            try:
                code = self._load()()
                sys.exit(code)
            finally:
                self._wait_for_threads()
        except BaseException as raised:
            error = raised
        while self._depth:  # what it printed and drew is its own; what follows is the session's
            self.leave()
        if isinstance(error, GreenletExit):  # it was killed, or its session was closed
            for context in list(self.contexts):
                _shut_down(context)
            if self.returncode is None:  # else a signal has ended it, and has said so
                self.returncode = -signal.SIGKILL
            return
        if isinstance(error, KeyboardInterrupt) and error is not self.interrupt:
            self._end(-signal.SIGINT)
            raise error  # a real one, meant for the cell
        self._finish(error)

    def _wait_for_threads(self) -> None:
        """Wait for the threads that are no daemons, as Python does when `main` has returned."""
        for running in list(self._process.running):
            if running.outlives_main and not self._process.is_over:
                running.join(None)

    def _load(self) -> Callable[[], Any]:
        """Return `main` of the file, imported afresh, as the script of an entry point does.

        So are the modules of its own that the file imports; afterwards the kernel has its own back.
        """
        if not isinstance(self._target, Path):
            found: Callable[[], Any] = self._target
            return found
        linecache.checkcache(str(self._target))
        if self._entry is None and _is_script(self._target):
            return self._run_script
        spec = spec_from_file_location(self._module, self._target)
        assert spec is not None
        assert spec.loader is not None
        hidden = self._take_own_modules()
        module = sys.modules[self._module] = module_from_spec(spec)
        try:
            spec.loader.exec_module(module)
        finally:
            self._take_own_modules()
            sys.modules.update(hidden)
        main: Callable[[], Any] = getattr(module, self._entry or "main")
        return main

    def _run_script(self) -> None:
        """Run a file that has no function `main` from top to bottom, as `python3 FILE` does."""
        assert isinstance(self._target, Path)
        module = ModuleType("__main__")
        module.__file__ = str(self._target)
        code = compile(self._target.read_bytes(), self._target, "exec")
        exec(code, vars(module))

    def _take_own_modules(self) -> dict[str, ModuleType]:
        """Take the program's modules out of `sys.modules`, and return them."""
        own = [name for name, one in sys.modules.copy().items() if self._is_own(name, one)]
        return {name: sys.modules.pop(name) for name in own}

    def _is_own(self, name: str, module: Any) -> bool:  # noqa: ANN401 - anything may stand there
        """Return whether a module is the program's: of its package, or from its folder.

        The folder alone says little: the virtual environment may be in there, too.
        """
        if name == self._module:
            return True
        if self._package and self._package != name.partition(".")[0]:
            return False
        place = str(self._root / name.replace(".", "/"))
        file = getattr(module, "__file__", None)
        if isinstance(file, str):
            return file.startswith((f"{place}.", f"{place}/"))
        return place in getattr(module, "__path__", ())  # a package without `__init__.py`

    def _deliver(self, number: signal.Signals) -> None:
        """Do what the signal handlers of rclpy and of Python do."""
        context = self._context
        caught = self._has_handlers and context is not None and context.ok()
        for running in [context for context in self.contexts if caught and context.ok()]:
            # As in C++: nobody is told but the executors, which wait for this, too.
            with running.handle:
                running.handle.shutdown()
            self.shut_down(running)
        if number == signal.SIGINT:
            self.interrupt = KeyboardInterrupt()
            self._raise(self.interrupt)
        elif not caught:
            self._end(-number)
            return
        for call in self._process.calls:
            if call.idle and call.wait is not None and call.wait.reason == "spin":
                self.core.virtual.wake(call.wait)

    def _raise(self, error: BaseException) -> None:
        """Raise an exception where the main thread of the program is."""
        waits = [call for call in self._process.calls if call.wait is not None and not call.ident]
        if waits:
            self.core.virtual.end_wait(waits[-1], error)

    def _finish(self, error: BaseException | None) -> None:
        code = 0
        if isinstance(error, SystemExit):
            if isinstance(error.code, int):
                code = error.code & 0xFF  # as the system does
            elif error.code is not None:
                code, self.stderr = 1, f"{error.code}\n"
        elif error is not None:
            self.stderr = _traceback_of(error)
            code = -signal.SIGINT if isinstance(error, KeyboardInterrupt) else 1
            self.failure = fault_of(error, self.core.now(), self.name, "main"), error
            self.core.reports.add_fault(self.failure[0])
        if self.stderr:
            print(self.stderr, end="", file=sys.stderr)
        self._end(code)

    def _end(self, code: int) -> None:
        """End the process: its callbacks, its threads, its nodes and its context."""
        self.returncode = code
        self._process.is_over = True
        virtual = self.core.virtual
        for call in list(self._process.calls):
            if call is not virtual.current:
                virtual.break_off(call)
        for state in list(self._process.states):
            self.core.lives.destroy(state)
        for context in list(self.contexts):
            _shut_down(context)
        self.core.console.program_ended(self)
        self.on_end(code)


def _shut_down(context: Context) -> None:
    with suppress(InvalidHandle):  # the program has destroyed it
        Context.try_shutdown(context)


def _no_service() -> bool:
    raise invalid_context("failed to check service availability: rcl node's", "node.c")


def _keep_handler(number: int, handler: object) -> object:
    """Answer `signal.signal` of a program: its signals are simulated, and the kernel's its own."""
    note("signal.signal() has no effect here, because the session simulates a program's signals.")
    return signal.SIG_DFL


def _checked(target: Any) -> Any:  # noqa: ANN401 - unchecked input
    """Return the file or the function; refuse anything else."""
    if callable(target) and not isinstance(target, type):
        return target
    if isinstance(target, str | Path):
        return _checked_file(str(target))
    raise SessionError(
        f"{target!r} is not a program.",
        "`ros.spawn` runs a Python file with a function `main`, or such a function.",
        'For example, write `ros.spawn("temperature_publisher.py")`; for a class, use `ros.add`.',
    )


def _checked_file(name: str) -> Path:
    with suppress(OSError, ValueError):  # too long, or with a NUL character
        file = Path(name).resolve()
        if file.is_file() and file.suffix == ".py":
            return file
    raise SessionError(
        f"There is no Python file {reprlib.repr(name)}.",
        "`ros.spawn` runs a program: a Python file, most often with a function `main`.",
        "Check the name; it ends in `.py`, and a relative one begins at the current folder.",
    )


def _is_script(file: Path) -> bool:
    """Return whether a file has no function `main`, and starts ROS from top to bottom.

    Of any other file without `main`, importing it says that `main` is missing, as `ros2 run` does.
    """
    try:
        tree = ast.parse(file.read_bytes())
    except (SyntaxError, ValueError):
        return False  # importing it says what is wrong
    if any("main" in _names_of(statement) for statement in tree.body):
        return False
    definitions = (ast.FunctionDef, ast.AsyncFunctionDef, ast.ClassDef)
    rest = [part for part in tree.body if not isinstance(part, definitions)]
    nodes = [node for statement in rest for node in ast.walk(statement)]
    is_guarded = any(isinstance(node, ast.Name) and node.id == "__name__" for node in nodes)
    return is_guarded or any(
        isinstance(node, ast.Call) and getattr(node.func, "attr", "") == "init" for node in nodes
    )


def _names_of(statement: ast.stmt) -> set[str]:
    """Return the names that a statement of a module defines."""
    if isinstance(statement, ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef):
        return {statement.name}
    if isinstance(statement, ast.Import | ast.ImportFrom):
        return {(alias.asname or alias.name).partition(".")[0] for alias in statement.names}
    if isinstance(statement, ast.Assign):
        return {name.id for name in statement.targets if isinstance(name, ast.Name)}
    if isinstance(statement, ast.Try):
        return {name for part in statement.body for name in _names_of(part)}
    return set()


def _root_of(file: Path) -> Path:
    """Return the folder from which a file is imported: above its package, if it is in one."""
    folder = file.parent
    while (folder / "__init__.py").is_file():
        folder = folder.parent
    return folder


def _traceback_of(error: BaseException) -> str:
    """Return what Python prints for an exception that nobody catches, without our own frames."""
    told = traceback.TracebackException.from_exception(error)
    kept = [one for one in told.stack if not one.filename.startswith(_OWN)]
    told.stack = traceback.StackSummary.from_list(kept)
    lines = list(told.format(chain=True))
    if isinstance(error, AttributeError | NameError):
        # Up to Python 3.11 only the interpreter's own printing adds what was probably meant.
        lines[-1] = f"{type(error).__name__}: {error_text(error)}\n"
    return "".join(lines)
