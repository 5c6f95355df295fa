"""Create and start nodes.

A node's name, namespace, remappings and parameters are those that a `Node(...)` action of a launch
file sets, or `ros2 run` after `--ros-args`. They reach the node in the same way, as arguments that
rcl parses, so the class does not have to change.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from inspect import isclass
from math import isfinite
from typing import TYPE_CHECKING, Any, TypedDict

from rclpy.exceptions import InvalidHandle
from rclpy.node import Node

from rosbeat.errors import NodeClassError, SessionError
from rosbeat.ros.exception_origin import fault_of
from rosbeat.ros.recording import repair_message_classes

if TYPE_CHECKING:
    from rosbeat.ros.errors import Console
    from rosbeat.ros.ports import Starter
    from rosbeat.ros.processes import Process


class Start(TypedDict, total=False):
    """Hold the keyword arguments of `Session.add`; see `Launch`."""

    name: str | None
    namespace: str | None
    remappings: Mapping[str, str] | None
    parameters: Mapping[str, Any] | None


@dataclass(frozen=True)
class Launch:
    """Describe how a node is started.

    `remappings` maps the topic and service names in the node's code to new names. If `name` is
    empty, the node keeps its own name.
    """

    name: str = ""
    namespace: str = ""
    remappings: Mapping[str, str] = field(default_factory=dict)
    parameters: Mapping[str, Any] = field(default_factory=dict)

    def __bool__(self) -> bool:
        return bool(self.options())

    def options(self) -> dict[str, Any]:
        """Return the same as keyword arguments of `Session.add`."""
        return {name: value for name, value in vars(self).items() if value}

    def arguments(self) -> list[str]:
        """Return the arguments of the command line that say the same."""
        rules = dict(self.remappings)
        rules |= {"__node": self.name} if self.name else {}
        rules |= {"__ns": "/" + self.namespace.strip("/")} if self.namespace else {}
        said = [word for old, new in rules.items() for word in ("-r", f"{old}:={new}")]
        for name, value in self.parameters.items():
            # rcl reads YAML, of which JSON is a part.
            said += ["-p", f"{name}:={json.dumps(value)}"]
        return ["--ros-args", *said, "--"] if said else []


@dataclass(frozen=True)
class Maker:
    """Hold a node class or a function that returns a node, and how the node is started."""

    make: Callable[[], Any]
    start: Launch = Launch()


def checked(
    name: object = None,
    namespace: object = None,
    remappings: object = None,
    parameters: object = None,
) -> Launch:
    """Make a `Launch`; raise a SessionError for a name or value that cannot be one."""
    for what, one in (("name", name), ("namespace", namespace)):
        if one is not None and not (isinstance(one, str) and one.strip("/")):
            raise _refused(f"{what}={one!r}", "The value has to be a name in quotation marks.")
    renamed, values = _mapping("remappings", remappings), _mapping("parameters", parameters)
    for old, new in renamed.items():
        if not (isinstance(new, str) and new):
            raise _refused(f"{old!r}: {new!r} in remappings", "The new name has to be a string.")
    for key, value in values.items():
        if not _is_value(value):
            raise _refused(
                f"{key!r}: {value!r} in parameters",
                "A parameter is a number, a string, True or False, or a list of one of these.",
            )
    return Launch(str(name or ""), str(namespace or ""), renamed, values)


def _mapping(what: str, given: object) -> dict[str, Any]:
    if given is None:
        return {}
    if isinstance(given, Mapping) and all(isinstance(key, str) and key for key in given):
        return dict(given)
    raise _refused(f"{what}={given!r}", "The value has to be a dict whose keys are names.")


def _is_value(value: object) -> bool:
    if isinstance(value, float):
        return isfinite(value)
    if isinstance(value, list | tuple):
        kinds = {type(one) for one in value}
        return len(kinds) == 1 and kinds <= {bool, int, float, str}
    return isinstance(value, bool | int | str)


def _refused(what: str, means: str) -> SessionError:
    return SessionError(
        f"A node cannot be started with {what}.",
        means,
        'For example, write `ros.add(TemperatureMonitor, remappings={"temperature": "humidity"}, '
        'parameters={"high": 60.0})`.',
    )


def build_in(
    core: Starter, targets: Sequence[Any], start: Launch, process: Process | None = None
) -> tuple[Node, ...]:
    """Make the nodes of a process in a session; if that fails, nothing of them is left there.

    Raises:
        NodeClassError: If a target is no class of nodes, function that returns one, or node.
        NodeConstructionError: If a constructor or function raises.
    """
    before = core.nodes.states()
    try:
        with core.starting(start, process):
            return tuple(_build_node(target, core.console) for target in targets)
    except BaseException:  # Interrupt, too
        for state in core.nodes.states():
            if state not in before:
                core.lives.destroy(state)
        raise


def _build_node(target: Any, console: Console) -> Node:  # noqa: ANN401 - unchecked input
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
    name = getattr(target, "__name__", type(target).__name__)
    try:
        made = target()
        if isinstance(made, Node):
            with suppress(InvalidHandle):  # destroyed; that is told elsewhere
                Node.get_name(made)  # raises if super().__init__ was never called
    except (Exception, SystemExit) as error:
        repair_message_classes()
        raise console.construction_error(name, fault_of(error, 0, "", "__init__"), error) from error
    if not isinstance(made, Node):
        raise _not_a_node(f"What {name}() returned, {made!r},", made)
    return made


def _not_a_node(subject: str, found: object) -> NodeClassError:
    return NodeClassError(
        f"{subject} is not a node, but of type {type(found).__name__}.",
        "A session runs nodes: it needs a node class, a function that returns a node, or a node.",
        "Pass the class itself, without quotes or parentheses: `ros.add(TemperatureSensor)`.",
    )
