"""Let rclpy's own executors run in virtual time, over a wait set that suspends.

`Executor.spin`, `spin_once`, tasks, coroutines, callback groups, guard conditions and waitables
remain rclpy's own. Only one thing is replaced: where an executor waits in C for whatever comes, it
suspends its simulated thread, and the engine wakes it when something has come or time is up.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import wraps
from typing import TYPE_CHECKING, Any

import rclpy
import rclpy.executors
from rclpy.event_handler import EventHandler
from rclpy.executors import Executor, SingleThreadedExecutor
from rclpy.guard_condition import GuardCondition
from rclpy.impl.implementation_singleton import rclpy_implementation
from rclpy.node import Node
from rclpy.task import Task
from rclpy.timer import Timer

from rosbeat.ros.engine import VirtualTime
from rosbeat.ros.processes import Process, callback_name
from rosbeat.ros.qos_events import TakenEarly, event_name, topic_of
from rosbeat.ros.recording import core_of
from rosbeat.ros.waits import Call, board_here

if TYPE_CHECKING:
    from rosbeat.ros.ports import EngineHost
    from rosbeat.ros.recording import Entity

_WORK = ("subscription", "timer", "client", "service")
#: A guard condition may only say that the wait set has to be made anew.
_KINDS = (*_WORK, "guard_condition")


def _engine_here() -> VirtualTime | None:
    board = board_here()
    return board if isinstance(board, VirtualTime) and not board.is_live else None


class VirtualWaitSet(rclpy_implementation.WaitSet):
    """Stand in for the wait set of an executor; outside of simulated code, be an ordinary one."""

    def __init__(self, *arguments: Any) -> None:  # noqa: ANN401 - rclpy's own
        super().__init__(*arguments)
        self._counts = sum(arguments[:5])
        self._handles: dict[str, list[Any]] = {kind: [] for kind in _KINDS}

    def add_subscription(self, handle: Any) -> Any:  # noqa: ANN401 - rclpy's own
        """Add a subscription."""
        self._handles["subscription"].append(handle)
        return super().add_subscription(handle)

    def add_guard_condition(self, handle: Any) -> Any:  # noqa: ANN401 - rclpy's own
        """Add a guard condition."""
        self._handles["guard_condition"].append(handle)
        return super().add_guard_condition(handle)

    def add_timer(self, handle: Any) -> Any:  # noqa: ANN401 - rclpy's own
        """Add a timer."""
        self._handles["timer"].append(handle)
        return super().add_timer(handle)

    def add_client(self, handle: Any) -> Any:  # noqa: ANN401 - rclpy's own
        """Add a client."""
        self._handles["client"].append(handle)
        return super().add_client(handle)

    def add_service(self, handle: Any) -> Any:  # noqa: ANN401 - rclpy's own
        """Add a service."""
        self._handles["service"].append(handle)
        return super().add_service(handle)

    def wait(self, timeout_ns: int) -> None:
        """Wait until something may be ready, in virtual time; see `rclpy_implementation.WaitSet`.

        When it was woken by something that rclpy finds only with a wait set of its own, such as an
        action, nothing is ready here, and rclpy makes another wait set.
        """
        engine = _engine_here()
        if engine is None:
            super().wait(timeout_ns)
            return
        self._look(engine)
        if any(self.get_ready_entities(kind) for kind in _WORK):
            engine.found()
            return
        if timeout_ns == 0:
            engine.polled(self.next_timer(engine.now)[0])
            return
        if self.get_ready_entities("guard_condition") or engine.has_new_events():
            return
        engine.wait_in_set(self, timeout_ns)
        if not self.has_waitables:
            self._add_again()
            self._look(engine)

    @property
    def has_waitables(self) -> bool:
        """Return whether waitables, such as actions, have added entities of theirs."""
        return bool(self._counts > sum(map(len, self._handles.values())))

    def keys(self) -> list[int]:
        """Return the keys of what wakes this wait."""
        return [id(handle) for handles in self._handles.values() for handle in handles]

    def next_timer(self, now: int) -> tuple[int | None, int]:
        """Return when the next timer is due and its order; None and 0 if there is none."""
        engine = _engine_here()
        assert engine is not None
        nearest: int | None = None
        order = 0
        self._move_clocks(engine)
        for handle in self._handles["timer"]:
            timer = engine.timers.get(id(handle))
            with handle:
                if handle.is_timer_canceled():
                    continue
                remaining = max(0, handle.time_until_next_call())
            if remaining and timer is not None and getattr(timer.clock, "is_driven", False):
                continue  # nobody knows when the program will set its clock to that time
            due = now + remaining
            if nearest is None or due < nearest:
                entry = engine.entry_of(timer)
                nearest, order = due, entry.order if entry is not None else 0
        return nearest, order

    def get_ready_entities(self, kind: str) -> list[int]:
        """Return pointers of what is ready, with subscriptions whose messages were taken early."""
        ready: list[int] = super().get_ready_entities(kind)
        if kind == "subscription":
            ready += [handle.pointer for handle in self._with_early_messages()]
        return ready

    def _with_early_messages(self) -> list[Any]:
        engine = _engine_here()
        if engine is None:
            return []
        entries = [engine.entry_of_key(id(handle)) for handle in self._handles["subscription"]]
        return [
            entry.entity.handle for entry in entries
            if entry is not None and isinstance(entry.handle, TakenEarly) and len(entry.handle)
        ]  # fmt: skip

    def _look(self, engine: VirtualTime) -> None:
        self._move_clocks(engine)
        super().wait(0)

    def _move_clocks(self, engine: VirtualTime) -> None:
        """Let the clocks of the timers show the time of now."""
        timers = [engine.timers.get(id(handle)) for handle in self._handles["timer"]]
        if None in timers:  # one of rcl's own, in a waitable of the program's
            for clock in engine.clocks:
                clock.move()
        for timer in timers:
            move = getattr(timer.clock, "move", None) if timer is not None else None
            if move is not None:
                move()

    def _add_again(self) -> None:
        handles, self._handles = self._handles, {kind: [] for kind in _KINDS}
        self.clear_entities()
        for kind, listed in handles.items():
            for handle in listed:
                getattr(self, f"add_{kind}")(handle)


class Implementation:
    """Stand in for rclpy's C++ part where wait sets are made."""

    WaitSet = VirtualWaitSet

    def __getattr__(self, name: str) -> Any:  # noqa: ANN401 - anything
        return getattr(rclpy_implementation, name)


class ProcessExecutor(SingleThreadedExecutor):
    """Be the executor of a process that has no program; see `processes`.

    As long as the process is plain, the engine takes its work, and this executor only keeps its
    nodes and tasks.
    """

    def __init__(self, core: EngineHost, process: Process) -> None:
        self._core, self._process = core, process
        super().__init__(context=core.context)

    def create_task(self, callback: Any, *args: Any, **kwargs: Any) -> Task:  # noqa: ANN401 - rclpy's own signature
        """Run a callback or coroutine as soon as what is running has ended."""
        task = super().create_task(callback, *args, **kwargs)
        self._core.virtual.task_made(self._process)
        return task

    def wake(self) -> None:
        """Note that entities were made or destroyed."""
        self._core.virtual.entities_changed()
        super().wake()


# The hooks.


def watch_handlers(original: Callable[..., Task]) -> Callable[..., Task]:
    """Wrap `Executor._make_handler`, so that each callback is recorded as it begins."""

    @wraps(original)
    def make_handler(
        executor: Executor, entity: Entity, node: Node, take: Callable[..., Any]
    ) -> Task:
        core, engine = core_of(node), _engine_here()
        if core is None or engine is not core.virtual:
            return original(executor, entity, node, take)
        call, taking = core.virtual.observe(entity, node, take)
        task = original(executor, entity, node, taking)
        task._rosbeat_call = call
        return task

    return make_handler


def watch_tasks(original: Callable[..., Task]) -> Callable[..., Task]:
    """Wrap `Executor.create_task`, so that a task belongs to the process that has made it."""

    @wraps(original)
    def create_task(executor: Executor, callback: Any, *args: Any, **kwargs: Any) -> Task:  # noqa: ANN401 - rclpy's own
        task = original(executor, callback, *args, **kwargs)
        engine = _engine_here()
        if engine is not None and engine.current is not None:
            creator = engine.current
            task._rosbeat_call = call = Call(creator.process, creator.state)
            call.label = engine.task_label(creator, callback_name(callback))
        return task

    return create_task


def watch_steps(original: Callable[..., None]) -> Callable[..., None]:
    """Wrap `Task.__call__`, so that the code of a task is known while it runs."""

    @wraps(original)
    def step(task: Task) -> None:
        engine = _engine_here()
        call: Call | None = task.__dict__.get("_rosbeat_call")
        # A pool may be handed a task once more while another of its threads runs it; rclpy returns
        # at once then, and the call goes on.
        if engine is None or call is None or engine.current is call or task.executing():
            original(task)
            return
        caller = engine.current
        assert caller is not None
        call.ident = caller.ident
        engine.current = call
        try:
            original(task)
            if task.done() and task._exception is not None:
                call.process.failure = task._exception, call
        except BaseException as error:  # what no task keeps, such as SystemExit
            call.process.failure = error, call
            raise
        finally:
            engine.end_step(call, caller)

    return step


def give_way(original: Callable[..., Any]) -> Callable[..., Any]:
    """Wrap `Executor.wait_for_ready_callbacks`, so that processes take turns."""

    @wraps(original)
    def wait_for_ready_callbacks(executor: Executor, *args: Any, **kwargs: Any) -> Any:  # noqa: ANN401 - rclpy's own
        engine = _engine_here()
        if engine is not None:
            # Each process does one thing in turn, as they do when they run side by side.
            engine.give_way_if_others_can_run()
        return original(executor, *args, **kwargs)

    return wait_for_ready_callbacks


def in_order(original: Callable[..., list[Node]]) -> Callable[..., list[Node]]:
    """Wrap `Executor.get_nodes`, so that nodes keep the order in which they were made."""

    @wraps(original)
    def get_nodes(executor: Executor) -> list[Node]:
        nodes = original(executor)
        core: EngineHost | None = getattr(executor.context, "session_core", None)
        if core is None or core.live is not None:
            return nodes
        states = [(core.nodes.state_of(node), node) for node in nodes]
        known = [state for state, _ in states if state and not (state.paused or state.ended)]
        known.sort(key=lambda state: state.number)
        return [
            *(state.node for state in known),
            *(node for state, node in states if state is None),
        ]

    return get_nodes


def watch_trigger(original: Callable[..., None]) -> Callable[..., None]:
    """Wrap `GuardCondition.trigger`, so that it wakes who waits for it."""

    @wraps(original)
    def trigger(guard: GuardCondition) -> None:
        original(guard)
        core: EngineHost | None = getattr(guard._context, "session_core", None)
        if core is not None:
            core.virtual.notify(id(guard.handle))

    return trigger


def watch_timers(original: Callable[..., None]) -> Callable[..., None]:
    """Wrap `Timer.__init__`, so that the engine finds the timer of a handle."""

    @wraps(original)
    def init(timer: Timer, *args: Any, **kwargs: Any) -> None:  # noqa: ANN401 - rclpy's own
        original(timer, *args, **kwargs)
        engine = _engine_here()
        if engine is not None:
            engine.timers[id(timer.handle)] = timer

    return init


def watch_nodes(original: Callable[..., Any], spins: bool) -> Callable[..., Any]:
    """Wrap `Executor.add_node` or `remove_node`, so that the session hears who spins a node."""

    @wraps(original)
    def change(executor: Executor, node: Node) -> Any:  # noqa: ANN401 - whether it was added, or None
        result = original(executor, node)
        core = core_of(node)
        if core is not None and core.live is None:
            core.executor_changed(executor, node, spins)
        return result

    return change


def choose_threads(original: Callable[..., None]) -> Callable[..., None]:
    """Wrap `MultiThreadedExecutor.__init__`: the machine does not choose the threads."""

    @wraps(original)
    def init(executor: Executor, num_threads: int | None = None, **options: Any) -> None:  # noqa: ANN401 - rclpy's own
        engine = _engine_here()
        if num_threads is None and engine is not None:
            num_threads = engine.threads
        original(executor, num_threads, **options)

    return init


def own_global_executor(original: Callable[[], Executor]) -> Callable[[], Executor]:
    """Wrap `rclpy.get_global_executor`: each process has one of its own."""

    @wraps(original)
    def get_global_executor() -> Executor:
        engine = _engine_here()
        if engine is None or engine.current is None:
            return original()
        process = engine.current.process
        if process.global_executor is None:
            process.global_executor = executor = SingleThreadedExecutor()

            def reset() -> None:
                executor.shutdown()
                process.global_executor = None

            rclpy.get_default_context().on_shutdown(reset)
        return process.global_executor

    return get_global_executor


def waitable_name(entity: Any) -> str:  # noqa: ANN401 - any of rclpy's
    """Return what a guard condition's or waitable's callback is called."""
    callback = getattr(entity, "callback", None) or entity
    return getattr(callback, "__name__", type(callback).__name__)


def waitable_label(entity: Entity, node: Node) -> tuple[str, str, str]:
    """Return kind, name and source with which a run of its callback is recorded."""
    if isinstance(entity, EventHandler):
        source = f"{event_name(entity)} of {topic_of(entity, node)}"
        return "event", waitable_name(entity), source
    kind = "guard condition" if isinstance(entity, GuardCondition) else "waitable"
    return kind, waitable_name(entity), ""
