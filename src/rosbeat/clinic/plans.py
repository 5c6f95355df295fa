"""How a system of the clinic is put together: plain data.

A plan says which nodes there are and what each does. A house (`houses.py`) is a plan of a healthy
system; a fault (`faults.py`) turns a plan into another one.
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
    """A connection as the owner ordered it.

    Attributes:
        node: Full name of the node.
        kind: `publisher` or `subscription`.
        topic: Full name of the topic.
        once: Whether it is to publish a single message, soon after its start.
    """

    node: str
    kind: str
    topic: str
    once: bool = False


@dataclass(frozen=True)
class Orders:
    """What the owner ordered: the system as it should be.

    Attributes:
        topic: The topic of the readings.
        low: Below this a reading is `Low`.
        high: Above this a reading is `High`.
        least: The least that the sensor may say.
        most: The most that the sensor may say.
        period: Seconds from one time that it measures to the next.
        burst: How many readings it publishes each time.
        wiring: Who is to publish and to listen where.
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
    """One node of a plan.

    Attributes:
        role: What it does; see `nodes.py`.
        name: Its name, without slash.
        listens: The topic that its code subscribes to; empty if it does not.
        speaks: The topic that its code publishes on; empty if it does not.
        namespace: The namespace in which it is started.
        remappings: New names of topics with which it is started.
        joins: Seconds after the beginning at which it is added.
        handed_over: Whether anybody runs its callbacks.
        options: How its code differs from others of its role.
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
        """Its full name."""
        return f"/{self.namespace}/{self.name}" if self.namespace else f"/{self.name}"

    def doing(self, **options: Any) -> Part:  # noqa: ANN401 - an option is of any type
        """The same node with other options."""
        return replace(self, options={**self.options, **options})


@dataclass(frozen=True)
class Plan:
    """A system.

    Attributes:
        place: Where it stands, such as `the greenhouse`.
        owner: What the owner calls the things that are measured, such as `temperature`.
        orders: What the owner ordered.
        parts: Its nodes, in the order in which they are added.
        seconds: How long it has run when the doctor comes.
    """

    place: str
    owner: str
    orders: Orders
    parts: tuple[Part, ...]
    seconds: float = 60.0

    def the(self, role: str) -> Part:
        """The first node of a role."""
        return next(part for part in self.parts if part.role == role)

    def having(self, new: Part, instead_of: Part) -> Plan:
        """The same system with one node changed."""
        parts = tuple(new if part is instead_of else part for part in self.parts)
        return replace(self, parts=parts)

    def also(self, new: Part) -> Plan:
        """The same system with a node more."""
        return replace(self, parts=(*self.parts, new))


@dataclass(frozen=True)
class Truth:
    """What is the matter, and where.

    Attributes:
        mistake: Id of the mistake.
        places: Full names of nodes and topics, each of which is a true answer to "where".
    """

    mistake: str
    places: tuple[str, ...]


def full(name: str) -> str:
    """A name with its slash, as ROS prints it."""
    return "/" + name.strip().lstrip("/")
