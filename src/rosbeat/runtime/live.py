"""Nodes against the wall clock, in one background thread."""

from __future__ import annotations

from threading import Event, Thread, current_thread
from typing import Any, Protocol

from rclpy.context import Context
from rclpy.executors import (
    ExternalShutdownException,
    ShutdownException,
    SingleThreadedExecutor,
)
from rclpy.node import Node
from rclpy.task import Future

from rosbeat.runtime.entities import NodeState


class LiveHost(Protocol):
    """What the live executor asks of its session."""

    def spinning_nodes(self) -> list[NodeState]:
        """The nodes whose callbacks run, in order of creation."""

    def callback_ran(self, entity: Any) -> None:  # noqa: ANN401 - rclpy's entities
        """A callback of this entity is about to run."""

    def entity_raised(self, node: Node | None, entity: Any, error: BaseException) -> None:  # noqa: ANN401
        """An exception left a callback of this entity."""


class LiveExecutor(SingleThreadedExecutor):
    """rclpy's own single-threaded executor, supervised.

    rclpy re-raises what a callback raises, which would end the thread and silence every node. Here
    the session is told, the node that raised is taken out, and the others go on.

    Args:
        context: The session's context.
        host: The session.
    """

    def __init__(self, context: Context, host: LiveHost) -> None:
        self._host = host
        super().__init__(context=context)
        self._thread = Thread(target=self.spin, name="rosbeat live", daemon=True)

    def get_nodes(self) -> list[Node]:
        """The nodes in order of creation; rclpy's own answer comes from an unordered set."""
        mine = set(super().get_nodes())
        return [s.node for s in self._host.spinning_nodes() if s.node in mine]

    def start(self) -> None:
        """Begin to run callbacks."""
        self._thread.start()

    def is_this_thread(self) -> bool:
        """Whether the caller is a callback of this executor."""
        return current_thread() is self._thread

    def wait_for(self, future: Future, seconds: float | None) -> None:
        """Wait in another thread until a future is done, at most so many seconds."""
        arrived = Event()
        future.add_done_callback(lambda _: arrived.set())
        arrived.wait(None if seconds is None or seconds < 0 else seconds)

    def finish(self) -> None:
        """Stop running callbacks and wait until the thread has ended.

        Without the wait the interpreter may be gone while the thread is still inside rclpy, which
        aborts the process.
        """
        self.shutdown()
        self._thread.join()

    def spin(self) -> None:
        """Run callbacks until `finish`."""
        try:
            while True:
                self._run_one()
        except (ShutdownException, ExternalShutdownException):
            pass

    def _run_one(self) -> None:
        handler, entity, node = self.wait_for_ready_callbacks()
        self._host.callback_ran(entity)
        handler()
        error = handler.exception()
        if error is not None:
            self._host.entity_raised(node, entity, error)
