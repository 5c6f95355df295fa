"""What cannot be taken directly: guard conditions and waitables, through rclpy's own wait set."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any, Protocol

from rclpy.client import Client
from rclpy.event_handler import EventHandler
from rclpy.executors import SingleThreadedExecutor, TimeoutException
from rclpy.guard_condition import GuardCondition
from rclpy.node import Node
from rclpy.service import Service
from rclpy.subscription import Subscription
from rclpy.task import Task
from rclpy.timer import Timer

from rosbeat.runtime.entities import NodeState

_TAKEN_DIRECTLY = (Subscription, Timer, Client, Service)


class Host(Protocol):
    """What the executor asks of its session."""

    def states(self) -> list[NodeState]:
        """All nodes, in order of creation."""

    def state_of(self, node: Node) -> NodeState | None:
        """What is known of a node."""

    def callback_ran(self, entity: Any, node: Node | None) -> None:  # noqa: ANN401
        """A callback of this entity is about to run."""

    def callback_raised(self, state: NodeState | None, name: str, error: BaseException) -> None:
        """An exception left a callback."""


class WaitSetExecutor(SingleThreadedExecutor):
    """rclpy's executor, asked only for what cannot be taken directly.

    One pass costs about a millisecond. It is made for nodes that have guard conditions or waitables
    (actions, say), and once for all nodes after entities were made or destroyed: publishers and
    subscriptions tell of a QoS that does not fit by waitables too, but only then.

    Attributes:
        current: The node whose callback is running, or None.
    """

    _host: Host
    # rclpy's `__del__` asks for it, also if an interrupt has come before it was made.
    _sigint_gc: Any = None

    def __init__(self, **options: Any) -> None:  # noqa: ANN401 - rclpy's own
        self.current: NodeState | None = None
        self._changed = True
        self._wait_set_nodes: list[Node] = []
        super().__init__(**options)

    def get_nodes(self) -> list[Node]:
        """The nodes in order of creation; rclpy's own answer comes from an unordered set."""
        return [state.node for state in self._host.states() if state.spinning]

    def wake(self) -> None:
        """Entities were made or destroyed."""
        self._changed = True
        super().wake()

    def can_execute(self, entity: Any) -> bool:  # noqa: ANN401 - rclpy's own signature
        """Keep from rclpy's wait set what is taken directly."""
        return not isinstance(entity, _TAKEN_DIRECTLY) and bool(super().can_execute(entity))

    def ask_rclpy(self) -> bool:
        """One pass of rclpy's own wait set; say whether anything came of it."""
        nodes = self._nodes_for_wait_set()
        progress = False
        self._cb_iter = None  # that of a callback which sleeps: it would hand out that node's, too
        while nodes:
            try:
                handler, entity, node = self.wait_for_ready_callbacks(timeout_sec=0, nodes=nodes)
            except TimeoutException:
                break
            self._handle(handler, entity, node)
            progress = progress or handler.done()
        return progress

    def forget_passes(self) -> None:
        """Let go of a pass that was interrupted."""
        self._cb_iter = None
        # rclpy would take what was interrupted for running, for ever.
        self._tasks[:] = [parts for parts in self._tasks if not parts[0].executing()]

    def _make_handler(self, entity: Any, node: Node, take: Any) -> Task:  # noqa: ANN401
        self._host.callback_ran(entity, node)
        return super()._make_handler(entity, node, take)

    def _handle(self, handler: Task, entity: Any, node: Node) -> None:  # noqa: ANN401
        state = self._host.state_of(node)
        self.current = state
        error: BaseException | None = None
        try:
            handler()
        except SystemExit as stop:
            error = stop
            handler.cancel()
        finally:
            self.current = None
        error = error or handler.exception()
        if error is not None:
            self._host.callback_raised(state, waitable_name(entity), error)

    def _nodes_for_wait_set(self) -> list[Node]:
        if not self._changed:
            return self._wait_set_nodes and self._those_that_spin()
        self._changed = False
        nodes = self.get_nodes()
        self._wait_set_nodes = list(_with_waitables(nodes))
        return nodes

    def _those_that_spin(self) -> list[Node]:
        spinning = self.get_nodes()
        return [node for node in self._wait_set_nodes if node in spinning]


def waitable_name(entity: Any) -> str:  # noqa: ANN401 - any of rclpy's
    """What a guard condition's or waitable's callback is called."""
    callback = getattr(entity, "callback", None) or entity
    return getattr(callback, "__name__", type(callback).__name__)


def waitable_kind(entity: Any) -> str:  # noqa: ANN401 - any of rclpy's
    """What kind of callback it has, as `CallbackRecord` names it."""
    if isinstance(entity, EventHandler):
        return "event"
    return "guard condition" if isinstance(entity, GuardCondition) else "waitable"


def _with_waitables(nodes: Iterable[Node]) -> Iterable[Node]:
    for node in nodes:
        ours = any(not isinstance(waitable, EventHandler) for waitable in node.waitables)
        if ours or any(True for _ in node.guards):
            yield node
