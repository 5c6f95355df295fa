"""Say what each part of `ros/` asks of the session, so that none of them has to know all of it.

Each port is a protocol, named after what the session is to its caller. `SessionCore` fulfills them
all; mypy checks that, wherever it hands itself over. Nothing of ours is imported at run time.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from contextlib import AbstractContextManager
from typing import TYPE_CHECKING, Any, Protocol

if TYPE_CHECKING:
    from weakref import WeakSet

    from rclpy.executors import Executor
    from rclpy.impl.rcutils_logger import RcutilsLogger
    from rclpy.node import Node

    from rosbeat.records import Fault, GraphSnapshot
    from rosbeat.ros.context import SessionContext
    from rosbeat.ros.engine import VirtualTime
    from rosbeat.ros.errors import Console
    from rosbeat.ros.graph import GraphObserver
    from rosbeat.ros.launch import Launch
    from rosbeat.ros.live import LiveExecutor
    from rosbeat.ros.node_registry import NodeRegistry
    from rosbeat.ros.processes import NodeState, Process
    from rosbeat.ros.recording import Entity, Recorder
    from rosbeat.ros.waits import Wait


class Timekeeper(Protocol):
    """Tell what time it is, and by which clock the nodes run: virtual time, or live the wall's."""

    @property
    def virtual(self) -> VirtualTime:
        """Return the engine of virtual time."""

    @property
    def live(self) -> LiveExecutor | None:
        """Return the live executor while the session is live, else None."""

    def now(self) -> int:
        """Return nanoseconds since the session began."""


class Reporter(Protocol):
    """Record which callbacks run and what goes wrong in them, and print what is new of it."""

    def callback_ran(self, entity: Entity, node: Node | None) -> None:
        """Record a callback that is about to run, live or through rclpy's wait set."""

    def event_heard(self, handler: Entity, state: NodeState) -> None:
        """Record the callback of a QoS event that is about to run."""

    def heard(self, state: NodeState, kind: str, name: str, source: str) -> None:
        """Record a callback of an action or another waitable that is about to run."""

    def callback_raised(self, state: NodeState | None, name: str, error: BaseException) -> None:
        """Record an exception that left a callback; end its process."""

    def entity_raised(self, node: Node | None, entity: Entity, error: BaseException) -> None:
        """Record an exception that left a callback, in live mode."""

    def work_raised(self, state: NodeState, name: str, error: BaseException) -> None:
        """Record an exception that left the work on a goal."""

    def deadlocked(self, waits: Sequence[Wait]) -> None:
        """Record that callbacks wait for ever."""

    def add_fault(self, fault: Fault) -> None:
        """Record a fault that the caller prints in its own way."""

    def show_news(self) -> None:
        """Print the log lines and faults that have not been printed yet."""


class Lives(Protocol):
    """Run a node's callbacks, and take a node away."""

    def spin_node(self, state: NodeState) -> None:
        """Run this node's callbacks from now on."""

    def destroy(self, state: NodeState) -> None:
        """Destroy a node, whole or half-made."""


class Overview(Protocol):
    """Know the nodes of the session, and record what becomes of them."""

    @property
    def nodes(self) -> NodeRegistry:
        """Return which nodes and entities there are."""

    @property
    def reports(self) -> Reporter:
        """Return what records callbacks and faults, and prints what is new."""


class Host(Overview, Protocol):
    """Serve the engine and the executors: which nodes there are, and where callbacks run."""

    @property
    def context(self) -> SessionContext:
        """Return the context of the session."""

    @property
    def threads(self) -> int:
        """Return how many threads a `MultiThreadedExecutor()` has."""

    @property
    def next_number(self) -> Callable[[], int]:
        """Return what gives the position of a new entity in the order of creation."""

    def running(self, code: Iterable[object] = ()) -> AbstractContextManager[None]:
        """Prepare this thread for running nodes, and classes and functions besides."""


class Observer(Protocol):
    """Hear from the hooks on rclpy what nodes make and destroy, and who spins them."""

    @property
    def start(self) -> Launch:
        """Return how the node that is being created is started."""

    @property
    def has_separate_types(self) -> bool:
        """Return whether two processes may use one topic with two types."""

    @property
    def topic_types(self) -> dict[str, type]:
        """Return the first type of each topic."""

    @property
    def counts_limits(self) -> bool:
        """Return whether the session counts deadlines and lifespans of what is made now."""

    def node_begins(self, name: str, namespace: str) -> None:
        """Make room for a node that is about to be made."""

    def node_made(self, node: Node) -> None:
        """Note that `Node.__init__` has returned."""

    def entity_begins(self, node: Node) -> None:
        """Prepare a new node before anything of it reads the time."""

    def entity_made(self, node: Node, kind: str, entity: Entity) -> None:
        """Tap what sends; run the callbacks of whatever has some."""

    def waitable_made(self, node: Node) -> None:
        """Let rclpy's own executor run a node that has guard conditions or waitables."""

    def node_ends(self, node: Node) -> None:
        """Forget a node that is about to be destroyed."""

    def executor_changed(self, executor: Executor, node: Node, spins: bool) -> None:
        """Note that an executor has begun or ceased to spin a node."""

    def logger_of(self, node: Node, logger: RcutilsLogger) -> RcutilsLogger:
        """Return the logger that the node's code gets."""


class Guide(Protocol):
    """Answer the calls of `rclpy.init` and `rclpy.shutdown` that reach the session's context."""

    def explain_init(self) -> None:
        """Answer `rclpy.init()` of a learner."""

    def explain_shutdown(self) -> None:
        """Answer `rclpy.shutdown()` of a learner."""

    def process_here(self) -> Process | None:
        """Return the simulated process whose code is running, or None if a cell is."""


class Sender(Timekeeper, Protocol):
    """Serve actions and the clocks of QoS: note what they send, hear and wait for."""

    @property
    def reports(self) -> Reporter:
        """Return what records callbacks and faults, and prints what is new."""

    @property
    def recorder(self) -> Recorder:
        """Return the recorder of the session."""

    @property
    def action_ends(self) -> WeakSet[Any]:
        """Return the action clients and servers, which are destroyed with the session."""

    def sent(self, kind: str, name: str, origin: NodeState | None = None) -> None:
        """Note that a node sent something to the `kind` entities called `name`."""

    def wait(self, call: str, done: Callable[[], bool], seconds: float | None) -> bool:
        """Wait until something is done, in a cell."""

    def waiting_for(self, reason: str, needs: Entity) -> AbstractContextManager[None]:
        """Say what code of a node waits for in a block, and the entity that has to run first."""

    def next_goal(self) -> int:
        """Return how many goals were sent here; 0 in a domain with other processes in it."""


class Keeper(Overview, Protocol):
    """Know the nodes of the session, and run and destroy them."""

    @property
    def lives(self) -> Lives:
        """Return what runs nodes and destroys them."""


class Starter(Keeper, Protocol):
    """Make nodes and take half-made ones back, for a launch and for programs."""

    @property
    def console(self) -> Console:
        """Return what prints for the session."""

    def starting(
        self, start: Launch, process: Process | None = None
    ) -> AbstractContextManager[None]:
        """Let nodes that are made in a block be started so, in a process of theirs."""


class Spinner(Keeper, Timekeeper, Protocol):
    """Run the nodes for a cell that calls `rclpy.spin`, until it is interrupted."""

    def refuse_in_callback(self, call: str) -> None:
        """Refuse a call that runs the simulation, if a node makes it."""

    def wait_until(self, done: Callable[[], bool], seconds: float | None) -> bool:
        """Run virtual time for a cell until `done` is true, at most so many seconds."""

    def go_live(self) -> None:
        """Run the nodes against the wall clock."""

    def go_virtual(self) -> None:
        """End live mode; virtual time goes on from where the wall clock has come to."""

    def interrupt(self) -> None:
        """End a callback that hangs: Interrupt was pressed while the nodes run live."""


class Domain(Protocol):
    """Show which nodes there are, those of other processes in the domain included."""

    @property
    def domain_id(self) -> int | None:
        """Return the domain that the session has joined; None in a private session."""

    @property
    def graph_observer(self) -> GraphObserver | None:
        """Return what observes the other processes; None in a private session."""

    def graph(self) -> GraphSnapshot:
        """Return the graph as it is now, or as it was when the session ended."""


class EngineHost(Host, Timekeeper, Protocol):
    """Serve a wait set, which reaches the engine as well as the nodes."""


class LimitHost(Host, Sender, Protocol):
    """Serve the clocks of QoS, which stand in the engine's order as entities do."""


class AllPorts(Host, Observer, Guide, Sender, Starter, Spinner, Protocol):
    """Combine what a node's context leads to: hooks and programs find the session through it."""

    def logged(self, level: str, name: str, text: str, function: str, line: int) -> None:
        """Record a log line; see `logs.LogHost`."""
