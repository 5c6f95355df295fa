"""Callbacks that wait: `async def` callbacks and tasks."""

from __future__ import annotations

from collections.abc import Callable, Coroutine
from dataclasses import dataclass
from typing import Any

from rclpy.executors import Executor
from rclpy.task import Task

from rosbeat.runtime.entities import Entry, NodeState, callback_name


@dataclass(frozen=True, eq=False)
class Waiting:
    """A coroutine or task that has not ended.

    Attributes:
        task: rclpy's task.
        state: The node that began it, if one did.
        name: What it is called in an error.
        entry: The entity whose callback it is; its callback group is busy until it ends.
    """

    task: Task
    state: NodeState | None
    name: str
    entry: Entry | None = None

    @property
    def ended(self) -> bool:
        """Whether it has returned, raised or been canceled."""
        return bool(self.task.done() or self.task.cancelled())

    @property
    def abandoned(self) -> bool:
        """Whether the node that began it has ended."""
        return self.state is not None and self.state.ended and not self.task.executing()

    @property
    def rests(self) -> bool:
        """Whether its node is paused."""
        return self.state is not None and not self.state.spinning

    def place(self) -> object:
        """What it awaits, innermost: another object each time it has got further."""
        inner = self.task._handler
        while (deeper := _awaited_by(inner)) is not None:
            inner = deeper
        return inner


def _awaited_by(waiting: Any) -> Any:  # noqa: ANN401 - a coroutine, a generator, or neither
    awaited = getattr(waiting, "cr_await", None)
    return getattr(waiting, "gi_yieldfrom", None) if awaited is None else awaited


class Coroutines:
    """All coroutines of one executor, in the order in which they began.

    Args:
        executor: The executor that future results are scheduled on.

    Attributes:
        waiting: Those that have not ended.
    """

    def __init__(self, executor: Executor) -> None:
        self._executor = executor
        self.waiting: list[Waiting] = []
        self._blocked: list[Entry] = []

    def add_task(self, task: Task, callback: object, state: NodeState | None) -> None:
        """Begin a task at the next turn."""
        self.waiting.append(Waiting(task, state, callback_name(callback)))

    def adopt(self, coroutine: Coroutine[Any, Any, Any], entry: Entry) -> Waiting:
        """A callback turned out to be a coroutine; its callback group is busy until it ends."""
        entry.entity.callback_group.beginning_execution(entry.entity)
        task = Task(coroutine, executor=self._executor)
        waiting = Waiting(task, entry.state, entry.label.name, entry)
        self.waiting.append(waiting)
        return waiting

    def is_free(self, entry: Entry) -> bool:
        """Whether the entity's callback group lets it run; if not, it runs when the group is free.

        Callbacks run one at a time, so a group can only be busy while a coroutine waits.
        """
        if not self.waiting or entry.entity.callback_group.can_execute(entry.entity):
            return True
        self._blocked.append(entry)
        return False

    def turn(self, run: Callable[[Waiting], None]) -> bool:
        """Let each one go on until it waits again; say whether any has got further."""
        turns = [self._one(waiting, run) for waiting in list(self.waiting)]
        return any(turns)

    def end(self, waiting: Waiting) -> None:
        """Forget one that has ended, and free its callback group."""
        self.waiting.remove(waiting)  # the executor holds on to the list
        if waiting.entry is not None:
            waiting.entry.entity.callback_group.ending_execution(waiting.entry.entity)

    def drop_abandoned(self) -> None:
        """Close the coroutines of nodes that have ended."""
        for waiting in [waiting for waiting in self.waiting if waiting.abandoned]:
            waiting.task.cancel()
            self.end(waiting)

    def unblock(self) -> list[Entry]:
        """The entities that were held back, once, for another try."""
        blocked, self._blocked = self._blocked, []
        return blocked

    @staticmethod
    def _one(waiting: Waiting, run: Callable[[Waiting], None]) -> bool:
        if waiting.rests or waiting.ended:
            return False
        before = waiting.place()
        run(waiting)
        return waiting.ended or waiting.place() is not before
