"""Describe the systems of the clinic as plain data.

A plan lists the nodes and the task of each. A house (`houses.py`) is a plan of a healthy system; a
fault (`faults.py`) turns a plan into another one.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import Any

#: Roles of nodes.
SENSOR, GUARD, DISPLAY, DIARY, TEACHER = "sensor", "guard", "display", "diary", "teacher"

#: A room goes up and down by so many degrees at a time, and so far over both of its limits.
STEP, OVER = 0.5, 2.5

FLOAT, STRING = "std_msgs/msg/Float32", "std_msgs/msg/String"


@dataclass(frozen=True)
class Wiring:
    """Describe a connection that the owner ordered.

    Attributes:
        node: Full name of the node.
        kind: `publisher` or `subscription`.
        topic: Full name of the topic.
        once: Whether to publish a single message, soon after the start.
    """

    node: str
    kind: str
    topic: str
    once: bool = False


@dataclass(frozen=True)
class Orders:
    """Hold the owner's specification of the system.

    Attributes:
        topic: The topic of the readings.
        low: Lower limit; a reading below it is `Low`.
        high: Upper limit; a reading above it is `High`.
        least: Smallest reading that the sensor may publish.
        most: Largest reading that the sensor may publish.
        period: Time between two measurements, in seconds.
        burst: Number of readings that the sensor publishes each time.
        wiring: The required publishers and subscriptions.
    """

    topic: str
    low: float
    high: float
    least: float
    most: float
    period: float = 1.0
    burst: int = 1
    wiring: tuple[Wiring, ...] = ()


@dataclass(frozen=True)
class Part:
    """Describe one node of a plan.

    Attributes:
        role: Role of the node; see `nodes.py`.
        name: Name of the node, without namespace or slash.
        listens: Topic that its code subscribes to; empty if there is none.
        speaks: Topic that its code publishes on; empty if there is none.
        namespace: Namespace in which it is started.
        remappings: Topic remappings with which it is started.
        joins: Seconds after the start of the session at which it is added.
        handed_over: Whether an executor runs its callbacks.
        options: Differences between its code and that of other nodes of the same role.
    """

    role: str
    name: str
    listens: str = ""
    speaks: str = ""
    namespace: str = ""
    remappings: dict[str, str] = field(default_factory=dict)
    joins: float = 0.0
    handed_over: bool = True
    options: dict[str, Any] = field(default_factory=dict)

    @property
    def path(self) -> str:
        """Return the node's full name."""
        return f"/{self.namespace}/{self.name}" if self.namespace else f"/{self.name}"

    def doing(self, **options: Any) -> Part:  # noqa: ANN401 - an option is of any type
        """Return a copy of the node with other options."""
        return replace(self, options={**self.options, **options})


@dataclass(frozen=True)
class Plan:
    """Describe a system.

    Attributes:
        place: Where the system is, such as `the greenhouse`.
        owner: The owner's word for the measured quantity, such as `temperature`.
        orders: The owner's specification.
        parts: The nodes, in the order in which they are added.
        seconds: How long the system has run when the learner first sees it.
    """

    place: str
    owner: str
    orders: Orders
    parts: tuple[Part, ...]
    seconds: float = 60.0

    def the(self, role: str) -> Part:
        """Return the first node with a role."""
        return next(part for part in self.parts if part.role == role)

    def having(self, new: Part, instead_of: Part) -> Plan:
        """Return a copy of the system with one node replaced."""
        parts = tuple(new if part is instead_of else part for part in self.parts)
        return replace(self, parts=parts)

    def also(self, new: Part) -> Plan:
        """Return a copy of the system with one more node."""
        return replace(self, parts=(*self.parts, new))


@dataclass(frozen=True)
class Truth:
    """Hold a correct diagnosis.

    Attributes:
        mistake: Id of the mistake.
        places: Full names of nodes and topics, each of which is a correct answer to "where".
    """

    mistake: str
    places: tuple[str, ...]


def full(name: str) -> str:
    """Return a name with its leading slash, as ROS prints it."""
    return "/" + name.strip().lstrip("/")
