"""What a scenario does to its nodes at a certain time, as plain data."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

from rosbeat.records import NANOSECONDS, QoS
from rosbeat.runtime.launch import Launch


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
class SetParameters(Step):
    """Set parameters, all at once or none.

    Attributes:
        values: Their new values by their names.
    """

    values: dict[str, Any] = field(default_factory=dict)


@dataclass(frozen=True)
class Call(Step):
    """Call a service from a node `/tester`; the answer is a `Reply`.

    Attributes:
        service: Which.
        type_name: Its type, such as `std_srvs/srv/Trigger`.
        values: The fields of the request.
    """

    service: str = ""
    type_name: str = "std_srvs/srv/Trigger"
    values: dict[str, Any] = field(default_factory=dict)


@dataclass(frozen=True)
class SendGoal(Step):
    """Send a goal from a node `/tester`; what comes back are `Reply`s.

    Attributes:
        action: To which action.
        type_name: Its type, such as `test_msgs/action/Fibonacci`.
        goal: The fields of the goal.
        cancel_after: After how many seconds it is canceled, if it was accepted; None for never.
    """

    action: str = ""
    type_name: str = "test_msgs/action/Fibonacci"
    goal: dict[str, Any] = field(default_factory=dict)
    cancel_after: float | None = None


@dataclass(frozen=True)
class Cancel(Step):
    """Cancel a goal; a `SendGoal` with `cancel_after` brings it along.

    Attributes:
        sent: The step that sent it.
    """

    sent: SendGoal = field(default_factory=lambda: SendGoal(0))


@dataclass(frozen=True)
class Remove(Step):
    """Destroy a node."""


@dataclass(frozen=True)
class Add(Step):
    """Add another node.

    Attributes:
        make: A node class, or a function that returns a node.
        start: How it is started.
    """

    make: Any = None
    start: Launch = field(default_factory=Launch)
