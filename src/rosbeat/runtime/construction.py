"""From what a learner hands to `add` to a node."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress
from inspect import isclass
from typing import Any

from rclpy.exceptions import InvalidHandle
from rclpy.node import Node

from rosbeat.diagnosis.faults import first_sentence, meaning_of
from rosbeat.errors import NodeClassError, NodeConstructionError, RosbeatError
from rosbeat.records import Fault
from rosbeat.runtime.faults import fault_of
from rosbeat.runtime.launch import Launch
from rosbeat.runtime.message_classes import mend_message_classes
from rosbeat.runtime.watching import Watching

Buildable = type[Node] | Node | Callable[[], Node]

_NOT_READY = "The constructor, `__init__`, raised before the node was ready, so there is no node."


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


def build_in(world: Watching, target: Any, start: Launch) -> Node:  # noqa: ANN401
    """Make a node in a session; if that fails, nothing of it is left there.

    Args:
        world: The session's.
        target: A class, a factory, or a node.
        start: How it is started.

    Raises:
        NodeClassError, NodeConstructionError: As `build_node` does.
    """
    before = world.states()
    try:
        with world.starting(start):
            return build_node(target)
    except BaseException:  # Interrupt, too
        for state in world.states():
            if state not in before:
                world.destroy(state)
        raise


def _not_a_node(subject: str, found: object) -> NodeClassError:
    return NodeClassError(
        f"{subject} is not a node, but of type {type(found).__name__}.",
        "A session runs nodes: it needs the class, a function that returns a node, or a node.",
        "Hand over the class itself, without quotes or brackets: `ros.add(TemperatureSensor)`.",
    )


def _call(target: Callable[[], Any]) -> Any:  # noqa: ANN401
    try:
        made = target()
        if isinstance(made, Node):
            with suppress(InvalidHandle):  # destroyed; that is told elsewhere
                Node.get_name(made)  # raises if super().__init__ was never called
        return made
    except (Exception, SystemExit) as error:
        raise _refusal(_name(target), error) from error


def _refusal(name: str, error: BaseException) -> NodeConstructionError:
    mend_message_classes()
    fault = fault_of(error, 0, "", "__init__")
    where = f"\n    line {fault.line}: {fault.code}" if fault.line else ""
    text, means, to_try = _told(error, fault)
    what = f"{name} could not be made: {fault.kind}: {text}{where}"
    return NodeConstructionError(what, means, to_try)


def _told(error: BaseException, fault: Fault) -> tuple[str, str, str]:
    """What is said of an exception: its text, what it means, what to try."""
    if isinstance(error, RosbeatError):
        return error.what, error.means, error.to_try
    known = meaning_of(fault)
    if known is not None:
        return (
            first_sentence(fault.text),
            known.beside_error,
            f"{known.to_try} Then run the cell again.",
        )
    line = f"line {fault.line}, then run the cell again." if fault.line else "`__init__`."
    return fault.text, _NOT_READY, f"Mend {line}"


def _name(target: Any) -> str:  # noqa: ANN401
    return getattr(target, "__name__", type(target).__name__)
