"""Run the work that virtual time leaves to rclpy: coroutines, guard conditions and waitables.

Tasks and coroutines remain rclpy's own; this module only schedules them. Guard conditions and
waitables (actions, middleware events) cannot be taken directly, so they go through rclpy's wait
set.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Coroutine, Iterable
from contextlib import suppress
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from greenlet import GreenletExit
from rclpy.client import Client
from rclpy.event_handler import EventHandler
from rclpy.exceptions import InvalidHandle
from rclpy.executors import Executor, SingleThreadedExecutor, TimeoutException
from rclpy.guard_condition import GuardCondition
from rclpy.node import Node
from rclpy.service import Service
from rclpy.subscription import Subscription
from rclpy.task import Task
from rclpy.timer import Timer

from rosbeat.ros.differences import HAS_OLDEST_TASK_FIRST, forget_executing
from rosbeat.ros.isolation import DeadlinePassed
from rosbeat.ros.processes import Call, Entry, NodeState, Process, callback_name
from rosbeat.ros.qos_events import event_name, topic_of

if TYPE_CHECKING:
    from rosbeat.ros.recording import Entity
    from rosbeat.ros.session_core import SessionCore

# Callbacks that wait by themselves: `async def` callbacks and tasks.


@dataclass(frozen=True, eq=False)
class Waiting:
    """Hold a coroutine or task that has not ended.

    Attributes:
        process: The process in which it runs; None if it was created outside of all nodes.
        state: The node that began it, if there is one.
        name: Its name in errors.
        entry: The entity whose callback it is; its callback group is occupied until it ends.
    """

    task: Task
    process: Process | None
    state: NodeState | None
    name: str
    entry: Entry | None = None

    @property
    def ended(self) -> bool:
        """Return whether it has returned, raised or been canceled."""
        return bool(self.task.done() or self.task.cancelled())

    @property
    def abandoned(self) -> bool:
        """Return whether the node that began it has ended."""
        return self.state is not None and self.state.ended and not self.task.executing()

    @property
    def rests(self) -> bool:
        """Return whether it cannot continue now, because its node is paused or its process is busy.

        rclpy visits its tasks again when it has handled everything that its last wait found ready.
        """
        if self.task.executing() or (self.state is not None and not self.state.spinning):
            return True
        process = self.process
        return process is not None and (not process.has_thread() or process.is_in_round())

    def place(self) -> object:
        """Return what it awaits, innermost: another object each time it has got further."""
        # A task has no public name for its coroutine.
        inner, deeper = None, self.task._handler
        while deeper is not None:  # a coroutine, a generator, or neither
            inner, deeper = deeper, getattr(deeper, "cr_await", None)
            deeper = getattr(inner, "gi_yieldfrom", None) if deeper is None else deeper
        return inner


class Coroutines:
    """Hold the coroutines of one executor that have not ended, in the order in which they began.

    The newest coroutine of each process continues first, as in Jazzy (`_wait_for_ready_callbacks`);
    in Kilted the oldest.
    """

    def __init__(self, executor: Executor) -> None:
        self._executor = executor
        self.waiting: list[Waiting] = []
        self._round: deque[Waiting] = deque()

    def add_task(self, task: Task, callback: object, call: Call | None) -> None:
        """Begin a task at the next turn, in the process of the call that has created it."""
        process, state = (call.process, call.state) if call else (None, None)
        self.waiting.append(Waiting(task, process, state, callback_name(callback)))

    def adopt(self, coroutine: Coroutine[Any, Any, Any], entry: Entry) -> Waiting:
        """Keep the coroutine that a callback returned; its group is occupied until it ends."""
        entry.entity.callback_group.beginning_execution(entry.entity)
        task = Task(coroutine, executor=self._executor)
        state = entry.state
        waiting = Waiting(task, state.process, state, entry.label.name, entry)
        self.waiting.append(waiting)
        return waiting

    def step(self, run: Callable[[Waiting], None]) -> bool:
        """Let one of them go on until it waits again; return whether any made progress.

        Each gets its turn before one of them gets another.
        """
        for _ in range(2):
            while self._round:
                waiting = self._round.popleft()
                if not waiting.ended and not waiting.rests:
                    before = waiting.place()
                    run(waiting)
                    if waiting.ended or waiting.place() is not before:
                        return True
            of_process: dict[int, list[Waiting]] = {}
            for waiting in self.waiting:
                of_process.setdefault(id(waiting.process), []).append(waiting)
            for group in of_process.values():
                self._round.extend(group if HAS_OLDEST_TASK_FIRST else reversed(group))
        return False

    def end(self, waiting: Waiting) -> None:
        """Forget one that has ended, and free its callback group."""
        if waiting not in self.waiting:
            return
        self.waiting.remove(waiting)  # the executor holds on to the list
        if waiting.entry is not None:
            waiting.entry.entity.callback_group.ending_execution(waiting.entry.entity)

    def drop_abandoned(self) -> None:
        """Close the coroutines of nodes that have ended."""
        for waiting in [waiting for waiting in self.waiting if waiting.abandoned]:
            waiting.task.cancel()
            self.end(waiting)


# What cannot be taken directly: guard conditions and waitables, through rclpy's own wait set.


_TAKEN_DIRECTLY = (Subscription, Timer, Client, Service)


#: What ends more than the callback in which it is raised.
NOT_OF_CALLBACKS = (KeyboardInterrupt, GreenletExit, DeadlinePassed)


class WaitSetExecutor(SingleThreadedExecutor):
    """Ask rclpy's executor only for entities that cannot be taken directly.

    One pass costs about a millisecond. A pass runs for nodes with guard conditions or waitables
    (such as actions), and once for all nodes after entities were created or destroyed: publishers
    and subscriptions report incompatible QoS through waitables too, but only then.
    """

    current: Any
    _core: SessionCore

    def __init__(self, **options: Any) -> None:  # noqa: ANN401 - rclpy's own
        self._changed = True
        self._wait_set_nodes: list[Node] = []
        super().__init__(**options)

    def __del__(self) -> None:
        # An interrupt may have come while it was made, or it is collected after its parts.
        with suppress(AttributeError, InvalidHandle):
            super().__del__()

    def get_nodes(self) -> list[Node]:
        """Return the nodes whose processes have a thread for them, in order of creation.

        rclpy's own answer comes from an unordered set.
        """
        return [
            state.node
            for state in self._core.states()
            if state.spinning and state.process.has_thread()
        ]

    def wake(self) -> None:
        """Note that entities were made or destroyed."""
        self._changed = True
        super().wake()

    def can_execute(self, entity: Any) -> bool:  # noqa: ANN401 - rclpy's own signature
        """Keep from rclpy's wait set what is taken directly."""
        return not isinstance(entity, _TAKEN_DIRECTLY) and bool(super().can_execute(entity))

    def ask_rclpy(self) -> bool:
        """Make one pass of rclpy's own wait set; return whether anything came of it."""
        nodes = self._nodes_for_wait_set()
        progress = False
        self._cb_iter = None  # a pass that was left when a callback waited is over
        while nodes:
            try:
                handler, entity, node = self.wait_for_ready_callbacks(timeout_sec=0, nodes=nodes)
            except TimeoutException:
                break
            self._handle(handler, entity, node)
            progress = progress or handler.done()
            nodes = [node for node in nodes if node in self.get_nodes()]
        return progress

    def forget_passes(self) -> None:
        """Let go of a pass that was interrupted."""
        self._cb_iter = None
        forget_executing(self)

    def _call_task_in_next_spin(self, task: Task) -> None:
        """Leave to `Coroutines` what it continues; newer releases of rclpy call this."""
        if task in self._pending_tasks:
            super()._call_task_in_next_spin(task)

    def _make_handler(self, entity: Entity, node: Node, take: Callable[..., Any]) -> Task:
        self._core.callback_ran(entity, node)
        return super()._make_handler(entity, node, take)

    def _handle(self, handler: Task, entity: Entity, node: Node) -> None:
        state = self._core.state_of(node)
        if state is None:
            return
        call = self.current = Call(state.process, state)
        error: BaseException | None = None
        try:
            handler()
        except NOT_OF_CALLBACKS:
            raise
        except BaseException as stop:
            error = stop
            handler.cancel()
        finally:
            self._end_call(call)
        error = error or handler.exception()
        if error is not None:
            self._raised(call, waitable_name(entity), error)

    def _end_call(self, call: Call) -> None:
        raise NotImplementedError

    def _raised(self, call: Call, name: str, error: BaseException) -> None:
        raise NotImplementedError

    def _nodes_for_wait_set(self) -> list[Node]:
        if not self._changed and not self._wait_set_nodes:
            return []
        nodes = self.get_nodes()
        if not self._changed:
            return [node for node in self._wait_set_nodes if node in nodes]
        self._changed = False
        self._wait_set_nodes = list(_with_waitables(self._core.states()))
        return nodes


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


def _with_waitables(states: Iterable[NodeState]) -> Iterable[Node]:
    for node in (state.node for state in states if state.spinning):
        ours = any(not isinstance(waitable, EventHandler) for waitable in node.waitables)
        if ours or any(True for _ in node.guards):
            yield node
