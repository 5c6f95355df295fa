"""The parameter `use_sim_time`, kept truthful."""

from __future__ import annotations

from rclpy.node import Node
from rclpy.parameter import Parameter

NAME = "use_sim_time"


def show_sim_time(node: Node | None, active: bool) -> None:
    """Let a node's `use_sim_time` say whether its time is virtual.

    The value is put in place directly, not with `set_parameters`: that would call the node's own
    callback for parameter changes, which may count the change or refuse it, would publish it on
    `/parameter_events`, and would subscribe the node to `/clock`, which makes every wait of the
    live executor longer. The node's clock does not depend on it; see `SessionClock`.
    """
    if node is not None and NAME in node._parameters:
        node._parameters[NAME] = Parameter(NAME, value=active)
