"""Run `rclpy.spin` and related functions for nodes of a session.

rclpy's versions are written for a process that does nothing else. In the code of a node, and in a
simulated program (see `simulated_program`), they suspend their simulated process in virtual time
and let its callbacks run. In a cell, `spin` runs the nodes against the wall clock until Interrupt,
because rclpy's own version waits in C, where Interrupt has no effect. rclpy itself spins nodes that
belong to no session.
"""

from __future__ import annotations

import sys
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import wraps
from types import FrameType
from typing import TYPE_CHECKING, Any, TypeAlias

import rclpy
from rclpy.client import Client
from rclpy.executors import Executor, MultiThreadedExecutor, SingleThreadedExecutor
from rclpy.node import Node
from rclpy.task import Future

from rosbeat.errors import SessionError
from rosbeat.ros.context import Interrupts, show_briefly
from rosbeat.ros.errors import note
from rosbeat.ros.processes import NodeState
from rosbeat.ros.recording import core_of

if TYPE_CHECKING:
    from rosbeat.ros.simulated_program import SimulatedProgram

#: A `SessionCore`, or None. Its own type would ask everywhere whether a node is of a session and
#: whether code of a node is running, which is known here.
_Core: TypeAlias = Any

#: Seconds between two looks at whether the learner pressed Interrupt.
PULSE = 0.1


def install() -> None:
    """Put this module's functions in the places of rclpy's; a second call does nothing."""
    if hasattr(rclpy.spin, "__wrapped__"):
        return
    rclpy.spin = _spin(rclpy.spin)
    rclpy.spin_once = _spin_once(rclpy.spin_once)
    rclpy.spin_until_future_complete = _spin_until(rclpy.spin_until_future_complete)
    Executor.spin = _executor_spin(Executor.spin)
    Executor.spin_until_future_complete = _executor_until(Executor.spin_until_future_complete)
    for kind in (SingleThreadedExecutor, MultiThreadedExecutor):
        kind.spin_once = _executor_once(kind.spin_once)


# `rclpy.spin(node)` and its kin.


def _spin(original: Callable[..., None]) -> Callable[..., None]:
    @wraps(original)
    def spin(node: Node, executor: Executor | None = None) -> None:
        core = _session_of(node)
        if core is None:
            _spin_until_interrupt(node, executor or _executor_for(node))
        elif _plays_program(core):
            _play(core, executor, [core.state_of(node)])
        else:
            _spin_in_session(core, node)

    return spin


def _spin_once(original: Callable[..., None]) -> Callable[..., None]:
    @wraps(original)
    def spin_once(
        node: Node, *, executor: Executor | None = None, timeout_sec: float | None = None
    ) -> None:
        core = _session_of(node)
        if core is None:
            wait = PULSE if timeout_sec is None else timeout_sec
            original(node, executor=executor, timeout_sec=wait)
        elif _is_simulated(core):
            with _global_executor(core, node) as states:
                core.virtual.spin(states, core.virtual.after(timeout_sec), most=1)
        else:
            raise SessionError(
                "rclpy.spin_once was called for a node of a session.",
                "The session runs this node's callbacks itself.",
                "Use `ros.run(seconds=1)`, with any number of seconds.",
            )

    return spin_once


def _spin_until(original: Callable[..., None]) -> Callable[..., None]:
    @wraps(original)
    def spin_until_future_complete(
        node: Node,
        future: Future,
        executor: Executor | None = None,
        timeout_sec: float | None = None,
    ) -> None:
        core = _session_of(node)
        if core is None:
            original(node, future, executor, timeout_sec)
        elif _is_simulated(core):
            with _global_executor(core, node) as states:
                _play_until(core, states, future, timeout_sec)
        else:
            core.refuse_in_callback("rclpy.spin_until_future_complete")
            core.spin_node(core.state_of(node))
            if core.live is not None:
                core.live.wait_for(future, timeout_sec)
            else:
                core.wait_until(lambda: future.done() or future.cancelled(), timeout_sec)

    return spin_until_future_complete


def _session_of(node: Node) -> _Core:
    """Return the session of a node, or None; refuse to spin a program's in another thread."""
    core: _Core = core_of(node)
    state = core.state_of(node) if core is not None else None
    _refuse_thread(core, state.process.program if state is not None else None)
    return core


def _refuse_thread(core: _Core, program: SimulatedProgram | None) -> None:
    """End a program that spins in another thread than the session's, and that thread."""
    if program is None or core.live is not None or threading.get_ident() == core.virtual.thread:
        return
    try:
        raise SessionError(
            f"{program.name} spins its node in a separate thread.",
            "A session runs all programs in one thread, in virtual time, but a separate thread "
            "runs in real time. The program does work in a terminal.",
            "Spin in `main`, and move the work of the program's loop to a timer's callback. Or "
            "start the program in a terminal, with `ros2 run`.",
        )
    except SessionError as error:
        program.fail(error)
    sys.exit()  # which ends this thread and says nothing


# Executors that a program makes itself.


def _executor_spin(original: Callable[..., None]) -> Callable[..., None]:
    @wraps(original)
    def spin(executor: Executor) -> None:
        core = _core_of(executor)
        if core is None:
            original(executor)
        else:
            _play(core, executor, _states(core, executor))

    return spin


def _executor_once(original: Callable[..., None]) -> Callable[..., None]:
    @wraps(original)
    def spin_once(executor: Executor, timeout_sec: float | None = None) -> None:
        core = _core_of(executor)
        if core is None:
            original(executor, timeout_sec)
            return
        nodes = executor.get_nodes()
        core.virtual.spin(_states(core, executor), core.virtual.after(timeout_sec), most=1)
        _give_back(nodes, executor)

    return spin_once


def _executor_until(original: Callable[..., None]) -> Callable[..., None]:
    @wraps(original)
    def spin(executor: Executor, future: Future, timeout_sec: float | None = None) -> None:
        core = _core_of(executor)
        if core is None:
            original(executor, future, timeout_sec)
            return
        nodes = executor.get_nodes()
        _play_until(core, _states(core, executor), future, timeout_sec)
        _give_back(nodes, executor)

    return spin


def _core_of(executor: Executor) -> _Core:
    """Return the session in whose code an executor spins, or None."""
    core = getattr(executor.context, "session_core", None)
    _refuse_thread(core, getattr(executor.context, "program", None))
    return core if core is not None and _is_simulated(core) else None


def _states(core: _Core, executor: Executor) -> list[NodeState]:
    found = [core.state_of(node) for node in executor.get_nodes()]
    return sorted((one for one in found if one is not None), key=lambda one: one.number)


def _give_back(nodes: list[Node], executor: Executor) -> None:
    """Let nodes be a program's executor's again; while they spun they were the session's."""
    for node in nodes:
        if node.executor is not executor and core_of(node) is not None:
            node.executor = executor


# In virtual time.


def _is_simulated(core: _Core) -> bool:
    return core.live is None and bool(core.virtual.in_callback)


def _plays_program(core: _Core) -> bool:
    return _is_simulated(core) and core.virtual.current.process.program is not None


def _play(core: _Core, executor: Executor | None, states: list[NodeState]) -> None:
    """Spin until the program's context is shut down, as `spin` of a process does."""
    process = core.virtual.current.process
    before = process.threads
    if isinstance(executor, MultiThreadedExecutor):
        # Its number of threads has no public name.
        process.threads = executor._executor._max_workers
    try:
        if not rclpy.ok():  # at once, and yet a loop around it must not keep Interrupt away
            core.virtual.block("spin", core.virtual.now)
        while rclpy.ok():
            core.virtual.spin(states)
    finally:
        process.threads = before


def _play_until(
    core: _Core, states: list[NodeState], future: Future, timeout_sec: float | None
) -> None:
    until = core.virtual.after(timeout_sec)
    client = next((one for state in states for one in _clients(state) if _asked(one, future)), None)
    core.virtual.spin(states, until, lambda: future.done() or future.cancelled(), needs=client)


def _clients(state: NodeState) -> list[Any]:
    return list(state.node.clients) if state.node is not None else []


def _asked(client: Client, future: Future) -> bool:
    # `get_pending_request` would need the number of the request.
    return any(one is future for one in client._pending_requests.values())


@contextmanager
def _global_executor(core: _Core, node: Node) -> Iterator[list[NodeState]]:
    """Give the nodes that the global executor of a process has, with one that is added to it.

    A node that another executor spins is taken away from that one, and at the end nobody spins it
    (rclpy, `Node.executor` and `spin_once`).
    """
    state, process = core.state_of(node), core.virtual.current.process
    has_own = process.program is None and (len(process.states) > 1 or process.threads > 1)
    others = [] if has_own else [one for one in process.states if one.spinning and one is not state]
    taken_away = has_own and state.spinning
    yield [state, *others]
    if taken_away:
        core.pause_node(state)
        note(
            f"a spin function of rclpy has removed {state.name} from the executor of its "
            "process, so its callbacks no longer run."
        )


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


def _spin_in_session(core: _Core, node: Node) -> None:
    """Run the session's nodes against the wall clock until Interrupt."""
    core.refuse_in_callback("rclpy.spin")
    _refuse_in_constructor(node)
    state = core.state_of(node)
    core.spin_node(state)
    was_live = core.live is not None
    if not was_live:
        core.go_live()
    note(f"{state.name} spins in real time until you interrupt it.")
    pulse = threading.Event()  # nobody sets it: it is a sleep that Interrupt ends at once
    try:
        with Interrupts() as interrupts:  # printing may swallow the exception
            while core.live is not None and not state.ended:
                interrupts.raise_if_pressed()
                core.show_news()
                pulse.wait(PULSE / 2)
    except KeyboardInterrupt as interrupt:
        show_briefly(interrupt, f"{state.name} has stopped spinning; the session is still open.")
        core.interrupt()
        raise
    finally:
        if not was_live:
            core.go_virtual()
        core.show_news()


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
