"""What an action is made of: three services and two topics, with hidden names."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from rosbeat.records import Endpoint
from rosbeat.runtime.introspection import qos_of
from rosbeat.runtime.messages import type_name

#: The last parts of their names, behind `/_action/`; and which option holds their QoS.
SERVICES = ("send_goal", "cancel_goal", "get_result")
FEEDBACK, STATUS = "feedback", "status"
_QOS_OF = {"send_goal": "goal", "cancel_goal": "cancel", "get_result": "result"}


def parts_of(
    node: str,
    kind: str,
    name: str,
    action: Any,  # noqa: ANN401
    options: Mapping[str, Any],
) -> list[Endpoint]:
    """One end of an action as endpoints: the action itself, then its five parts.

    Args:
        node: Full name of the node.
        kind: `action server` or `action client`.
        name: Full name of the action.
        action: Its class.
        options: The arguments of the server's or the client's constructor.
    """
    is_server = kind.endswith("server")
    types, end = _types(action), "pub" if is_server else "sub"
    goal = qos_of(options["goal_service_qos_profile"])
    found = [Endpoint(node, name, type_name(action), kind, goal)]
    for part in SERVICES:
        qos = qos_of(options[f"{_QOS_OF[part]}_service_qos_profile"])
        service = "server" if is_server else "client"
        found.append(Endpoint(node, f"{name}/_action/{part}", types[part], service, qos))
    for part in (FEEDBACK, STATUS):
        qos = qos_of(options[f"{part}_{end}_qos_profile"])
        topic = "publisher" if is_server else "subscription"
        found.append(Endpoint(node, f"{name}/_action/{part}", types[part], topic, qos))
    return found


def _types(action: Any) -> dict[str, str]:  # noqa: ANN401
    own = type_name(action)
    return {
        "send_goal": f"{own}_SendGoal",
        "cancel_goal": "action_msgs/srv/CancelGoal",
        "get_result": f"{own}_GetResult",
        FEEDBACK: f"{own}_FeedbackMessage",
        STATUS: "action_msgs/msg/GoalStatusArray",
    }
