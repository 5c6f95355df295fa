"""Callbacks that wait: `async def` callbacks and tasks."""

from __future__ import annotations

from collections.abc import Callable, Coroutine
from dataclasses import dataclass
from typing import Any

from rclpy.executors import Executor
from rclpy.task import Task

from rosbeat.runtime.entities import Entry, NodeState


@dataclass(frozen=True, eq=False)
class Waiting:
    """A coroutine or task that has not ended.

    Attributes:
        task: rclpy's task.
        state: The node that began it, if one did.
        entry: The entity whose callback it is; its callback group is busy until it ends.
    """

    task: Task
    state: NodeState | None
    entry: Entry | None = None

    @property
    def name(self) -> str:
        """What it is called in an error."""
        return self.entry.label.name if self.entry else "a task"

    @property
    def ended(self) -> bool:
        """Whether it has returned, raised or been canceled."""
        return bool(self.task.done() or self.task.cancelled())


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

    def add_task(
        self, callback: Any, args: Any, kwargs: Any, state: NodeState | None  # noqa: ANN401
    ) -> Task:
        """Begin a task at the next turn."""
        task = Task(callback, args, kwargs, executor=self._executor)
        self.waiting.append(Waiting(task, state))
        return task

    def adopt(self, coroutine: Coroutine[Any, Any, Any], entry: Entry) -> None:
        """A callback turned out to be a coroutine; its callback group is busy until it ends."""

        async def run() -> Any:  # noqa: ANN401 - whatever the callback returns
            return await coroutine

        entry.entity.callback_group.beginning_execution(entry.entity)
        self.waiting.append(Waiting(Task(run, executor=self._executor), entry.state, entry))

    def is_free(self, entry: Entry) -> bool:
        """Whether the entity's callback group lets it run; if not, it runs when the group is free.

        Callbacks run one at a time, so a group can only be busy while a coroutine waits.
        """
        if not self.waiting or entry.entity.callback_group.can_execute(entry.entity):
            return True
        self._blocked.append(entry)
        return False

    def turn(self, run: Callable[[Waiting], None]) -> list[Waiting]:
        """Let each one go on until it waits again; return those that have ended."""
        for waiting in list(self.waiting):
            run(waiting)
        ended = [waiting for waiting in self.waiting if waiting.ended]
        # In place: the executor holds on to the list.
        self.waiting[:] = [waiting for waiting in self.waiting if not waiting.ended]
        for waiting in ended:
            if waiting.entry is not None:
                waiting.entry.entity.callback_group.ending_execution(waiting.entry.entity)
        return ended

    def unblock(self) -> list[Entry]:
        """The entities that were held back, once, for another try."""
        blocked, self._blocked = self._blocked, []
        return blocked
