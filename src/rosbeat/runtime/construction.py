"""From what a learner hands to `add` to a node."""

from __future__ import annotations

from collections.abc import Callable
from inspect import isclass
from typing import Any

from rclpy.node import Node

from rosbeat.errors import NodeClassError, NodeConstructionError
from rosbeat.runtime.faults import learners_line

Buildable = type[Node] | Node | Callable[[], Node]


def build_node(target: Any) -> Node:  # noqa: ANN401 - unchecked input
    """Make a node from a class, a factory, or a node.

    Raises:
        NodeClassError: If it is none of these, or the factory returns something else.
        NodeConstructionError: If the constructor or factory raises.
    """
    if isinstance(target, Node):
        return target
    if isclass(target) and not issubclass(target, Node):
        raise NodeClassError(
            f"{target.__name__} is a class, but not a node.",
            "A node is a class that inherits from `rclpy.node.Node`.",
            f"Write `class {target.__name__}(Node):`, with `from rclpy.node import Node` above it.",
        )
    if not callable(target):
        raise _not_a_node(repr(target), target)
    made = _call(target)
    if not isinstance(made, Node):
        raise _not_a_node(f"What {_name(target)}() returned, {made!r},", made)
    return made


def _not_a_node(subject: str, found: object) -> NodeClassError:
    return NodeClassError(
        f"{subject} is not a node, but of type {type(found).__name__}.",
        "A session runs nodes: it needs the class, a function that returns a node, or a node.",
        "Hand over the class itself, without quotes or brackets: `ros.add(TemperatureSensor)`.",
    )


def _call(target: Callable[[], Any]) -> Any:  # noqa: ANN401
    try:
        return target()
    except (Exception, SystemExit) as error:
        raise _refusal(_name(target), error) from error


def _refusal(name: str, error: BaseException) -> NodeConstructionError:
    line, code = learners_line(error)
    where = f"\n    line {line}: {code}" if line else ""
    return NodeConstructionError(
        f"{name} could not be made: {type(error).__name__}: {error}{where}",
        "The constructor, `__init__`, raised before the node was ready, so there is no node.",
        f"Mend line {line}, then run the cell again." if line else "Mend `__init__`.",
    )


def _name(target: Any) -> str:  # noqa: ANN401
    return getattr(target, "__name__", type(target).__name__)
