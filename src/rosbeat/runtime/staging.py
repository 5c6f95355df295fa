"""Carrying out the steps of a scenario."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from typing import Any

from rclpy.node import Node
from rclpy.parameter import Parameter

from rosbeat.errors import RosbeatError
from rosbeat.records import CallbackRecord
from rosbeat.runtime.entities import NodeState
from rosbeat.runtime.feeding import message, message_class, profile
from rosbeat.runtime.session import Session
from rosbeat.runtime.steps import Add, Pause, Publish, Remove, Resume, SetParameter, Step

#: The node that `Publish` publishes from.
TESTER = "tester"


class Stage:
    """Runs virtual time from step to step.

    Args:
        session: The session.
        steps: What is to be done, in any order.

    Attributes:
        subject: Full name of the learner's node, to which steps without a name are done.
        records: What was done: callbacks of the kind `step`.
    """

    def __init__(self, session: Session, steps: Iterable[Step]) -> None:
        self.subject = ""
        self.records: list[CallbackRecord] = []
        self._session, self._world = session, session._world
        self._todo = deque(sorted(steps, key=lambda step: step.at_ns))
        self._publishers: dict[int, Any] = {}
        self._asleep: NodeState | None = None
        self._wakes = True

    def prepare(self) -> None:
        """Make the publishers that the steps need."""
        wanted = [step for step in self._todo if isinstance(step, Publish)]
        if not wanted:
            return
        node = self._session.add(lambda: Node(TESTER))
        for step in wanted:
            kind = message_class(step.type_name)
            made = node.create_publisher(kind, step.topic, profile(step.qos))
            self._publishers[id(step)] = made

    def advance(self, end: int, run: Callable[[int], None]) -> None:
        """Let virtual time pass, and do on the way what is to be done.

        Args:
            end: Until when, in nanoseconds.
            run: Runs the nodes until a time.
        """
        while self._todo and self._todo[0].at_ns <= end:
            step = self._todo.popleft()
            run(max(step.at_ns, self._world.now()))
            self._do(step)
        run(end)

    @contextmanager
    def resting(self, state: NodeState) -> Iterator[None]:
        """Run none of a node's callbacks in this block: it sleeps in one of them."""
        outer, self._asleep, self._wakes = (self._asleep, self._wakes), state, True
        self._world.virtual.current = None
        self._world.rest_node(state)
        try:
            yield
        finally:
            wakes = self._wakes
            self._asleep, self._wakes = outer
            if wakes and not state.ended:
                self._world.spin_node(state)

    # The steps.

    def _do(self, step: Step) -> None:
        name = step.node or self.subject
        if isinstance(step, Publish):
            for value in step.values:
                self._publishers[id(step)].publish(message(step.type_name, value))
            self._note(step, f"/{TESTER}", step.topic)
            return
        if isinstance(step, Add):
            self._session.add(step.make)
            return
        state = self._world.named("/" + name.lstrip("/"))
        if state is None or state.node is None:
            self._note(step, name, "no such node")
        elif isinstance(step, SetParameter):
            self._set(step, state)
        else:
            self._move(step, state)

    def _move(self, step: Step, state: NodeState) -> None:
        if isinstance(step, Remove):
            self._world.destroy(state)
        elif state is self._asleep:
            self._wakes = isinstance(step, Resume)
        elif isinstance(step, Pause):
            self._world.rest_node(state)
        elif isinstance(step, Resume) and not state.ended:
            self._world.spin_node(state)
        self._note(step, state.name, "")

    def _set(self, step: SetParameter, state: NodeState) -> None:
        try:
            answer = _set_parameter(state, step)
        except RosbeatError:
            raise
        except Exception as error:  # a callback of the learner's own
            self._world.callback_raised(state, "set_parameters", error)
            answer = f"raised {type(error).__name__}"
        self._note(step, state.name, f"{step.name}: {answer}")

    def _note(self, step: Step, node: str, source: str) -> None:
        kind = type(step).__name__
        self.records.append(CallbackRecord(self._world.now(), node, "step", kind, source))


def _set_parameter(state: NodeState, step: SetParameter) -> str:
    """Set a parameter of a node; `accepted`, or why it was refused."""
    node = state.node
    if node is None or not node.has_parameter(step.name):
        return "refused, not declared"
    (result,) = node.set_parameters([Parameter(step.name, value=step.value)])
    return "accepted" if result.successful else f"refused, {result.reason}".rstrip(", ")
