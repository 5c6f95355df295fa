"""Talk to nodes under test: a node that publishes, calls services and sends goals.

It also makes messages from plain values, and QoS profiles from records. `rosbeat.testing` is its
public face.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from typing import Any

from action_msgs.msg import GoalStatus
from rcl_interfaces.srv import SetParametersAtomically
from rclpy.action import ActionClient, get_action_names_and_types
from rclpy.duration import Duration
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.qos import DurabilityPolicy, HistoryPolicy, QoSProfile, ReliabilityPolicy
from rclpy.task import Future

from rosbeat.records import QoS
from rosbeat.ros.recording import message_class

#: Options of a test node: the six parameter services take two thirds of the time to make a node.
BARE = {"start_parameter_services": False}

#: The words for a goal's status, as `ros2 action send_goal` prints them.
STATUS = {
    GoalStatus.STATUS_SUCCEEDED: "SUCCEEDED",
    GoalStatus.STATUS_CANCELED: "CANCELED",
    GoalStatus.STATUS_ABORTED: "ABORTED",
    GoalStatus.STATUS_UNKNOWN: "UNKNOWN",
}


def message(type_name: str, value: Any) -> Any:  # noqa: ANN401 - a message of any type
    """Return a message whose field `data` is a value, or whose fields are those of a dict."""
    fields = value if isinstance(value, dict) else {"data": value}
    return filled(message_class(type_name), fields)


def filled(kind: Any, fields: Mapping[str, Any]) -> Any:  # noqa: ANN401 - a class of messages
    """Return a message with these fields; dicts, also in lists, fill fields that are messages.

    Raises:
        AttributeError: If there is no such field.
        AssertionError: If a value does not fit into its field.
    """
    made, types = kind(), kind.get_fields_and_field_types()
    for name, value in fields.items():
        if name not in types:
            raise AttributeError(f"{kind.__name__} has no field `{name}`.")
        setattr(made, name, _field(value, getattr(made, name), types[name]))
    return made


def _field(value: Any, default: Any, type_name: str) -> Any:  # noqa: ANN401 - of any type
    """Return the value of a field, whose type is written as in `sequence<std_msgs/String, 3>`."""
    if isinstance(value, dict):
        return filled(type(default), value)
    names = re.search(r"(\w+)/(\w+)", type_name)
    if names and isinstance(value, list | tuple):
        kind = message_class(f"{names[1]}/msg/{names[2]}")
        return [filled(kind, one) if isinstance(one, dict) else one for one in value]
    return value


def profile(qos: QoS | int) -> QoSProfile:
    """Return the QoS profile of a record, or of a queue depth; ROS's defaults for unknown parts."""
    if isinstance(qos, int):
        return QoSProfile(depth=qos)
    best_effort, stored = qos.reliability == "BEST_EFFORT", qos.durability == "TRANSIENT_LOCAL"
    limits = {"deadline": qos.deadline_ns, "lifespan": qos.lifespan_ns}
    return QoSProfile(
        reliability=ReliabilityPolicy.BEST_EFFORT if best_effort else ReliabilityPolicy.RELIABLE,
        durability=DurabilityPolicy.TRANSIENT_LOCAL if stored else DurabilityPolicy.VOLATILE,
        history=HistoryPolicy.KEEP_ALL if qos.history == "KEEP_ALL" else HistoryPolicy.KEEP_LAST,
        depth=qos.depth or 10,
        **{name: Duration(nanoseconds=limit) for name, limit in limits.items() if limit},
    )


def parameters_request(values: Mapping[str, Any]) -> Any:  # noqa: ANN401 - a request of ROS
    """Return the request that sets all these parameters or, if one is refused, none of them."""
    messages = [Parameter(name, value=value).to_parameter_msg() for name, value in values.items()]
    return SetParametersAtomically.Request(parameters=messages)


class SentGoal:
    """Follow a goal from its request to its result.

    Attributes:
        accepted: Whether the server accepted it; None before it has answered.
        feedback: The feedback messages, in order.
        status: How it ended, as in `STATUS`, or `REJECTED`; an empty text before.
        result: The result message; None without one.
    """

    def __init__(self, node: Node, client: Any, goal: Any, cancel_after: float | None) -> None:  # noqa: ANN401 - of any action
        self.accepted: bool | None = None
        self.feedback: list[Any] = []
        self.status, self.result = "", None
        self._node, self._cancel_after = node, cancel_after
        sent = client.send_goal_async(goal, lambda heard: self.feedback.append(heard.feedback))
        sent.add_done_callback(self._answered)

    def _answered(self, future: Future) -> None:
        goal = future.result()
        self.accepted = bool(goal.accepted)
        if not self.accepted:
            self.status = "REJECTED"
            return
        goal.get_result_async().add_done_callback(self._ended)
        if self._cancel_after is not None:
            _later(self._node, self._cancel_after, goal.cancel_goal_async)

    def _ended(self, future: Future) -> None:
        response = future.result()
        self.result = response.result
        self.status = STATUS.get(response.status, "UNKNOWN")


class Tester(Node):
    """Publish messages, call services and send goals for a test."""

    def __init__(self) -> None:
        super().__init__("tester", **BARE)
        # By topic, service or action, and type.
        self._by_topic: dict[tuple[str, type], Any] = {}
        self._by_service: dict[tuple[str, str], Any] = {}
        self._by_action: dict[tuple[str, str], Any] = {}

    def publish(self, topic: str, value: Any, qos: QoSProfile, wait: float | None) -> None:  # noqa: ANN401 - a message
        """Publish a message after so many seconds, or at once if that is None."""
        key = topic, type(value)
        if key not in self._by_topic:
            self._by_topic[key] = self.create_publisher(type(value), topic, qos)
        if wait is None:
            self._by_topic[key].publish(value)
        else:
            _later(self, wait, lambda: self._by_topic[key].publish(value))

    def offered_services(self) -> dict[str, str]:
        """Return the services that nodes offer, with their types."""
        return {name: types[0] for name, types in self.get_service_names_and_types()}

    def offered_actions(self) -> dict[str, str]:
        """Return the actions that nodes offer, with their types."""
        return {name: types[0] for name, types in get_action_names_and_types(self)}

    def ask(self, service: str, type_name: str, request: Any) -> Future:  # noqa: ANN401 - of any service
        """Call a service; the request is a message, or a dict of fields."""
        key = service, type_name
        if key not in self._by_service:
            self._by_service[key] = self.create_client(message_class(type_name), service)
        client = self._by_service[key]
        if isinstance(request, Mapping):
            request = filled(client.srv_type.Request, request)
        sent: Future = client.call_async(request)
        return sent

    def send(
        self,
        action: str,
        type_name: str,
        goal: Any,  # noqa: ANN401 - of any action
        cancel_after: float | None,
    ) -> SentGoal:
        """Send a goal, a message or a dict of fields; cancel it after so many seconds, if given."""
        kind: Any = message_class(type_name)
        key = action, type_name
        if key not in self._by_action:
            self._by_action[key] = ActionClient(self, kind, action)
        if isinstance(goal, Mapping):
            goal = filled(kind.Goal, goal)
        return SentGoal(self, self._by_action[key], goal, cancel_after)


def _later(node: Node, seconds: float, act: Callable[[], object]) -> None:
    """Do something once, after so many seconds."""

    def once() -> None:
        timer.cancel()
        node.destroy_timer(timer)
        act()

    timer = node.create_timer(seconds, once)
