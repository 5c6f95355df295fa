"""How a node is started: under which name and namespace, with which topics and parameters.

The same four things that an `Node(...)` action of a launch file sets, and `ros2 run` behind
`--ros-args`. They reach the node the same way, as arguments that rcl reads, so an unmodified class
is what is started.

Source: design.ros2.org, "ROS Command Line Arguments"; launch_ros, `actions/node.py`.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from math import isfinite
from typing import Any, TypedDict

from rosbeat.errors import SessionError

_EXAMPLE = (
    'Write for example `ros.add(TemperatureMonitor, remappings={"temperature": "humidity"}, '
    'parameters={"high": 60.0})`.'
)


class Start(TypedDict, total=False):
    """The keyword arguments of `Session.add`; see `Launch`."""

    name: str | None
    namespace: str | None
    remappings: Mapping[str, str] | None
    parameters: Mapping[str, Any] | None


@dataclass(frozen=True)
class Launch:
    """How a node is started.

    Attributes:
        name: Its name, in the place of its own; empty to keep that.
        namespace: The namespace before its name and its relative topics, such as `/greenhouse`.
        remappings: New names of topics and services, by the names in its code.
        parameters: Values of parameters that it declares, by their names.
    """

    name: str = ""
    namespace: str = ""
    remappings: Mapping[str, str] = field(default_factory=dict)
    parameters: Mapping[str, Any] = field(default_factory=dict)

    def __bool__(self) -> bool:
        return bool(self.name or self.namespace or self.remappings or self.parameters)

    def options(self) -> dict[str, Any]:
        """The same as keyword arguments of `Session.add`."""
        return {name: value for name, value in vars(self).items() if value}

    def arguments(self) -> list[str]:
        """The arguments of the command line that say the same."""
        rules = dict(self.remappings)
        rules |= {"__node": self.name} if self.name else {}
        rules |= {"__ns": "/" + self.namespace.strip("/")} if self.namespace else {}
        said = [word for old, new in rules.items() for word in ("-r", f"{old}:={new}")]
        for name, value in self.parameters.items():
            said += ["-p", f"{name}:={_yaml(value)}"]
        return ["--ros-args", *said, "--"] if said else []


@dataclass(frozen=True)
class Maker:
    """What a session was handed to make a node of.

    Attributes:
        make: A node class, or a function that returns a node.
        start: How the node is started.
    """

    make: Callable[[], Any]
    start: Launch = Launch()


def checked(name: object, namespace: object, remappings: object, parameters: object) -> Launch:
    """Make a `Launch` of what a caller gave.

    Raises:
        SessionError: If a name is no text, or a value is none that a parameter can have.
    """
    for what, one in (("name", name), ("namespace", namespace)):
        if one is not None and not (isinstance(one, str) and one.strip("/")):
            raise _refused(f"{what}={one!r}", "It has to be a name in quotation marks.")
    renamed, values = _mapping("remappings", remappings), _mapping("parameters", parameters)
    for old, new in renamed.items():
        if not (isinstance(new, str) and new):
            raise _refused(f"{old!r}: {new!r} in remappings", "The new name has to be a text.")
    for key, value in values.items():
        if not _is_value(value):
            raise _refused(
                f"{key!r}: {value!r} in parameters",
                "A parameter is a number, a text, True or False, or a list of one of these.",
            )
    return Launch(str(name or ""), str(namespace or ""), renamed, values)


def _mapping(what: str, given: object) -> dict[str, Any]:
    if given is None:
        return {}
    if isinstance(given, Mapping) and all(isinstance(key, str) and key for key in given):
        return dict(given)
    raise _refused(f"{what}={given!r}", "It has to be a dict, with names on the left.")


def _is_value(value: object) -> bool:
    if isinstance(value, float):
        return isfinite(value)
    if isinstance(value, list | tuple):
        kinds = {type(one) for one in value}
        return len(kinds) == 1 and kinds <= {bool, int, float, str}
    return isinstance(value, bool | int | str)


def _yaml(value: Any) -> str:  # noqa: ANN401 - checked above
    """A value as rcl reads it: YAML, of which JSON is a part."""
    return json.dumps(list(value) if isinstance(value, tuple) else value)


def _refused(what: str, means: str) -> SessionError:
    return SessionError(f"A node cannot be started with {what}.", means, _EXAMPLE)
