"""The node `/tester` of a scenario: it publishes, calls services and sends goals."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable
from functools import partial
from typing import Any

from action_msgs.msg import GoalStatus
from rclpy.action import ActionClient
from rclpy.node import Node
from rclpy.parameter import Parameter

from rosbeat.records import Reply
from rosbeat.runtime.feeding import message, message_class, profile
from rosbeat.runtime.messages import plain
from rosbeat.runtime.steps import Call, Publish, SendGoal, SetParameters
from rosbeat.runtime.world import World

#: The node that publishes and asks.
TESTER = "tester"

_STATUS = {
    GoalStatus.STATUS_SUCCEEDED: "SUCCEEDED",
    GoalStatus.STATUS_CANCELED: "CANCELED",
    GoalStatus.STATUS_ABORTED: "ABORTED",
    GoalStatus.STATUS_UNKNOWN: "UNKNOWN",
}


class Tester:
    """What steps send goes out here, and what comes back is written down.

    Args:
        world: The session's world.

    Attributes:
        replies: What came back, in order.
    """

    def __init__(self, world: World) -> None:
        self.replies: list[Reply] = []
        self._world = world
        self._ends: dict[int, Any] = {}
        self._goals: dict[int, Any] = {}
        self._counts: Counter[str] = Counter()

    def prepare(self, node: Node, steps: Iterable[Publish | Call | SendGoal]) -> None:
        """Make what the steps need: publishers, and clients of services and actions."""
        made: dict[tuple[str, ...], Any] = {}
        for step in steps:
            if isinstance(step, Publish):
                kind = message_class(step.type_name)
                end = node.create_publisher(kind, step.topic, profile(step.qos))
            else:
                end = made.get(_address(step)) or _client(node, step)
                made[_address(step)] = end
            self._ends[id(step)] = end

    def publish(self, step: Publish) -> None:
        """Publish what a step says."""
        for value in step.values:
            self._ends[id(step)].publish(message(step.type_name, value))

    def call(self, step: Call) -> None:
        """Call a service."""
        client = self._ends[id(step)]
        request = client.srv_type.Request(**step.values)
        note = self._noting(client.service_name)
        client.call_async(request).add_done_callback(
            lambda future: note("response", plain(future.result()))
        )

    def send(self, step: SendGoal) -> None:
        """Send a goal, and ask for its result."""
        client = self._ends[id(step)]
        goal = client._action_type.Goal(**step.goal)
        note = self._noting(f"/{step.action.lstrip('/')}")
        sent = client.send_goal_async(goal, lambda heard: note("feedback", plain(heard.feedback)))
        sent.add_done_callback(lambda future: self._decided(step, note, future.result()))

    def _decided(self, step: SendGoal, note: Any, goal: Any) -> None:  # noqa: ANN401
        note("goal", {"accepted": goal.accepted})
        if goal.accepted:
            self._goals[id(step)] = (goal, note)
            goal.get_result_async().add_done_callback(
                lambda future: note("result", _result(future.result()))
            )

    def cancel(self, step: SendGoal) -> None:
        """Cancel the goal of a step, if it was accepted."""
        goal, note = self._goals.get(id(step), (None, None))
        if goal is not None:
            goal.cancel_goal_async().add_done_callback(
                lambda future: note("cancel", {"count": len(future.result().goals_canceling)})
            )

    def set_parameters(self, step: SetParameters, name: str, node: Node) -> str:
        """Set parameters of a node, all at once; `accepted`, or why they were refused."""
        note = self._noting(name)
        missing = [one for one in step.values if not node.has_parameter(one)]
        if missing:
            note("parameters", {"successful": False, "reason": "not declared", "values": {}})
            return "refused, not declared"
        wanted = [Parameter(one, value=value) for one, value in step.values.items()]
        result = node.set_parameters_atomically(wanted)
        values = {one: node.get_parameter(one).value for one in step.values}
        note("parameters", {**plain(result), "values": values})
        return "accepted" if result.successful else f"refused, {result.reason}".rstrip(", ")

    def _noting(self, name: str) -> partial[None]:
        self._counts[name] += 1
        return partial(self._note, name, self._counts[name])

    def _note(self, name: str, number: int, word: str, data: dict[str, Any]) -> None:
        self.replies.append(Reply(self._world.now(), name, number, word, data))


def _address(step: Call | SendGoal) -> tuple[str, ...]:
    name = step.service if isinstance(step, Call) else step.action
    return type(step).__name__, name, step.type_name


def _client(node: Node, step: Call | SendGoal) -> Any:  # noqa: ANN401 - of a service or action
    kind = message_class(step.type_name)
    if isinstance(step, Call):
        return node.create_client(kind, step.service)
    return ActionClient(node, kind, step.action)


def _result(response: Any) -> dict[str, Any]:  # noqa: ANN401 - of any action
    return {"status": _STATUS.get(response.status, "OTHER"), **plain(response.result)}
