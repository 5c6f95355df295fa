"""Carrying out the steps of a scenario."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterable, Iterator

from rclpy.node import Node
from rclpy.parameter import Parameter

from rosbeat.errors import RosbeatError
from rosbeat.records import CallbackRecord, Reply
from rosbeat.runtime.entities import NodeState
from rosbeat.runtime.feeding import BARE
from rosbeat.runtime.session import Session
from rosbeat.runtime.steps import (
    Add,
    Call,
    Cancel,
    Pause,
    Publish,
    Remove,
    Resume,
    SendGoal,
    SetParameter,
    SetParameters,
    Step,
)
from rosbeat.runtime.tester import TESTER, Tester


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
        self._todo = deque(sorted(_with_cancels(steps), key=lambda step: step.at_ns))
        self._tester = Tester(self._world)

    def prepare(self) -> None:
        """Make the node that the steps publish, call and send goals from, if any do."""
        wanted = [step for step in self._todo if isinstance(step, Publish | Call | SendGoal)]
        if wanted:
            self._tester.prepare(self._session.add(lambda: Node(TESTER, **BARE)), wanted)

    @property
    def replies(self) -> tuple[Reply, ...]:
        """What came back to those who asked."""
        return tuple(self._tester.replies)

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

    # The steps.

    def _do(self, step: Step) -> None:
        name = step.node or self.subject
        if isinstance(step, Publish | Call | SendGoal | Cancel):
            self._note(step, f"/{TESTER}", self._sent(step))
            return
        if isinstance(step, Add):
            self._join(step)
            return
        state = self._world.named("/" + name.lstrip("/"))
        if state is None or state.node is None:
            self._note(step, name, "no such node")
        elif isinstance(step, SetParameter | SetParameters):
            self._set(step, state)
        else:
            self._move(step, state)

    def _join(self, step: Add) -> None:
        """Add a node, even while a callback sleeps: it is another process, and waits for nobody."""
        virtual = self._world.virtual
        asleep, virtual.running = virtual.running, False
        try:
            self._session.add(step.make, **step.start.options())
        finally:
            virtual.running = asleep

    def _sent(self, step: Publish | Call | SendGoal | Cancel) -> str:
        """Let the tester send something; where to."""
        if isinstance(step, Publish):
            self._tester.publish(step)
            return step.topic
        if isinstance(step, Call):
            self._tester.call(step)
            return step.service
        if isinstance(step, SendGoal):
            self._tester.send(step)
            return step.action
        self._tester.cancel(step.sent)
        return step.sent.action

    def _move(self, step: Step, state: NodeState) -> None:
        if isinstance(step, Remove):
            self._world.destroy(state)
        elif state.asleep:
            state.paused = isinstance(step, Pause)  # which is looked at when it wakes
        elif isinstance(step, Pause):
            self._world.rest_node(state)
        elif isinstance(step, Resume) and not state.ended:
            self._world.spin_node(state)
        self._note(step, state.name, "")

    def _set(self, step: SetParameter | SetParameters, state: NodeState) -> None:
        try:
            answer = self._answer(step, state)
        except RosbeatError:
            raise
        except Exception as error:  # a callback of the learner's own
            self._world.callback_raised(state, "set_parameters", error)
            answer = f"raised {type(error).__name__}"
        names = step.name if isinstance(step, SetParameter) else ", ".join(step.values)
        self._note(step, state.name, f"{names}: {answer}")

    def _answer(self, step: SetParameter | SetParameters, state: NodeState) -> str:
        if isinstance(step, SetParameter):
            return _set_parameter(state, step)
        if state.node is None:
            return "refused, not declared"
        return self._tester.set_parameters(step, state.name, state.node)

    def _note(self, step: Step, node: str, source: str) -> None:
        kind = type(step).__name__
        self.records.append(CallbackRecord(self._world.now(), node, "step", kind, source))


def _with_cancels(steps: Iterable[Step]) -> Iterator[Step]:
    for step in steps:
        yield step
        if isinstance(step, SendGoal) and step.cancel_after is not None:
            yield Cancel(step.at + step.cancel_after, sent=step)


def _set_parameter(state: NodeState, step: SetParameter) -> str:
    """Set a parameter of a node; `accepted`, or why it was refused."""
    node = state.node
    if node is None or not node.has_parameter(step.name):
        return "refused, not declared"
    (result,) = node.set_parameters([Parameter(step.name, value=step.value)])
    return "accepted" if result.successful else f"refused, {result.reason}".rstrip(", ")
