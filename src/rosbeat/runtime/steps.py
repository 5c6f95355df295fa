"""What a scenario does to its nodes at a certain time, as plain data."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

from rosbeat.records import NANOSECONDS, QoS


@dataclass(frozen=True)
class Step:
    """Something that is done at a time.

    Attributes:
        at: When, in virtual seconds. What is due at the same instant happens before.
        node: The node that it is done to, by name; empty for the learner's.
    """

    at: float
    node: str = ""

    @property
    def at_ns(self) -> int:
        """When, in nanoseconds of virtual time."""
        return round(self.at * NANOSECONDS)


@dataclass(frozen=True)
class Publish(Step):
    """Publish messages, all at one instant, from a node `/tester`.

    Attributes:
        topic: Where.
        type_name: Their type, such as `std_msgs/msg/Float32`.
        values: Each is what the field `data` holds, or a dict from field name to value.
        qos: The quality of service of the publisher, which is there from the beginning.
    """

    topic: str = ""
    type_name: str = "std_msgs/msg/Float32"
    values: tuple[Any, ...] = ()
    qos: QoS = field(default_factory=QoS)


@dataclass(frozen=True)
class Pause(Step):
    """Run none of a node's callbacks, as if it were busy."""


@dataclass(frozen=True)
class Resume(Step):
    """Run a node's callbacks again."""


@dataclass(frozen=True)
class SetParameter(Step):
    """Set a parameter, as `ros2 param set` does.

    Attributes:
        name: The parameter.
        value: Its new value.
    """

    name: str = ""
    value: Any = None


@dataclass(frozen=True)
class Remove(Step):
    """Destroy a node."""


@dataclass(frozen=True)
class Add(Step):
    """Add another node.

    Attributes:
        make: A node class, or a function that returns a node.
    """

    make: Any = None
