"""Describe the clinic's systems as plain data, and draw healthy ones at random.

A fault (`faults.py`) turns a healthy system into a broken one; `nodes.py` has the real nodes.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from random import Random

from rosbeat.records import QoS

#: Roles of nodes.
SENSOR, MONITOR, DISPLAY, LOGGER, ANNOUNCER = "sensor", "monitor", "display", "logger", "announcer"

#: A room's temperature goes up and down by so many degrees at a time, and so far over its limits.
STEP, OVERSHOOT = 0.5, 2.5
#: How often something happens to a node that has no fault: never.
_NEVER = 10_000
_DEFAULT_QOS = QoS()


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
class Specification:
    """Hold what the owner ordered.

    Attributes:
        topic: Full name of the topic of the readings.
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
class NodeSpec:
    """Describe one node of a system: how it is started, and how its code behaves.

    Attributes:
        role: Which class of `nodes.py` it is.
        name: Name of the node, without namespace or slash.
        subscribes: Topic that its code subscribes to, without a slash; empty if there is none.
        publishes: Topic that its code publishes on, without a slash; empty if there is none.
        namespace: Namespace in which it is started.
        remappings: Topic remappings with which it is started.
        starts_at: Seconds after the start of the session at which it is added.
        spun: Whether an executor runs its callbacks.
        qos: QoS of its subscription; of its publisher, if it has no subscription.
        least: Smallest reading of a sensor.
        most: Largest reading of a sensor.
        step: Difference between two readings of a sensor.
        period: Period of a sensor's timer, in seconds.
        phase: Number of steps that a sensor skips at the start.
        unit: Unit of a sensor's readings.
        clamp: When a sensor clamps its readings: `last`, `first` or `never`.
        stuck_at: The only reading of a sensor, in degrees Celsius; None if its readings change.
        calibrated: For how many readings a sensor has calibration data.
        mute: Whether it never publishes.
        stops_after: Number of messages after which it stops publishing.
        forgets_high: Whether a monitor cannot count the status High.
        wrong_at_limit: Status that a monitor also gives to a reading exactly at the limit.
        pages: Number of readings that a logger has room for.
    """

    role: str
    name: str
    subscribes: str = ""
    publishes: str = ""
    namespace: str = ""
    remappings: dict[str, str] = field(default_factory=dict)
    starts_at: float = 0.0
    spun: bool = True
    qos: QoS = _DEFAULT_QOS
    least: float = 0.0
    most: float = 0.0
    step: float = STEP
    period: float = 1.0
    phase: int = 0
    unit: str = "Celsius"
    clamp: str = "last"
    stuck_at: float | None = None
    calibrated: int = _NEVER
    mute: bool = False
    stops_after: int = _NEVER
    forgets_high: bool = False
    wrong_at_limit: str = ""
    pages: int = _NEVER

    @property
    def path(self) -> str:
        """Return the node's full name."""
        return f"/{self.namespace}/{self.name}" if self.namespace else f"/{self.name}"


@dataclass(frozen=True)
class System:
    """Describe a system of nodes.

    Attributes:
        place: Where the system is, such as `the greenhouse`.
        spec: What the owner ordered.
        nodes: The nodes, in the order in which they are added.
    """

    place: str
    spec: Specification
    nodes: tuple[NodeSpec, ...]

    def node(self, role: str) -> NodeSpec:
        """Return the first node with a role."""
        return next(node for node in self.nodes if node.role == role)

    def replaced(self, old: NodeSpec, new: NodeSpec) -> System:
        """Return a copy of the system with one node replaced."""
        return replace(self, nodes=tuple(new if node is old else node for node in self.nodes))

    def with_node(self, node: NodeSpec) -> System:
        """Return a copy of the system with one more node."""
        return replace(self, nodes=(*self.nodes, node))


# Healthy systems.

#: By place: how its nodes are called, and the limits `least`, `low`, `high` and `most` of its
#: temperature, in degrees Celsius.
_PLACES = {
    "greenhouse": ("leaf", 16.0, 18.0, 24.0, 26.0),
    "aquarium": ("water", 20.0, 23.0, 26.0, 29.0),
    "wine cellar": ("cellar", 8.0, 10.0, 14.0, 17.0),
    "bakery": ("dough", 22.0, 24.0, 28.0, 31.0),
    "server room": ("rack", 15.0, 18.0, 22.0, 25.0),
    "museum": ("hall", 16.0, 19.0, 21.0, 24.0),
    "library": ("shelf", 14.0, 16.0, 20.0, 23.0),
    "beehive": ("comb", 30.0, 33.0, 36.0, 39.0),
    "cheese dairy": ("milk", 4.0, 6.0, 9.0, 12.0),
    "stable": ("stall", 10.0, 12.0, 17.0, 20.0),
    "paint shop": ("booth", 18.0, 20.0, 25.0, 28.0),
    "theatre": ("stage", 17.0, 19.0, 23.0, 26.0),
    "swimming pool": ("pool", 23.0, 25.0, 28.0, 31.0),
    "seed bank": ("vault", 2.0, 4.0, 7.0, 10.0),
}
PLACES = tuple(_PLACES)
#: What the nodes may be called, after the place's own word.
_NAMES = (
    ("sensor", "probe", "thermometer"),
    ("monitor", "guard", "watch"),
    ("lamp", "display", "panel"),
    ("diary", "logger", "notebook"),
)


def healthy(rng: Random, place: str, burst: int = 1) -> System:
    """Draw a healthy system: a sensor, a monitor, a display, and a logger.

    Args:
        rng: Source of random numbers.
        place: Where the system is, one of `PLACES`.
        burst: Number of readings that the sensor publishes at once.
    """
    prefix, least, low, high, most = _PLACES[place]
    topic, status = f"{prefix}_temperature", f"{prefix}_status"
    phase = rng.randrange(20)
    sensor, monitor, display, logger = (f"{prefix}_{rng.choice(names)}" for names in _NAMES)
    # Sixty readings, so that every reading between the limits comes, up and down.
    period = float(burst) if burst > 1 else rng.choice((0.5, 1.0))
    nodes = (
        NodeSpec(SENSOR, sensor, "", topic, least=least, most=most, period=period, phase=phase),
        NodeSpec(MONITOR, monitor, topic, status),
        NodeSpec(DISPLAY, display, status),
        NodeSpec(LOGGER, logger, topic),
    )
    spec = Specification(f"/{topic}", low, high, least, most, period, burst)
    return _as_ordered(System(f"the {place}", spec, nodes))


def in_bursts(rng: Random, place: str) -> System:
    """Draw a healthy system whose sensor publishes five readings at once."""
    return healthy(rng, place, burst=5)


def with_humidity(rng: Random, place: str) -> System:
    """Draw a healthy system with a second sensor, which measures the humidity of the air."""
    system = healthy(rng, place)
    prefix = _PLACES[place][0]
    hygrometer = NodeSpec(SENSOR, f"{prefix}_hygrometer", publishes=f"{prefix}_humidity")
    hygrometer = replace(hygrometer, least=40.0, most=70.0, step=1.0, period=2.0, phase=9)
    return _as_ordered(system.with_node(hygrometer))


def with_announcer(rng: Random, place: str) -> System:
    """Draw a healthy system in which a node publishes the rule once, and another displays it."""
    system = healthy(rng, place)
    prefix = _PLACES[place][0]
    system = system.with_node(NodeSpec(ANNOUNCER, f"{prefix}_rules", publishes=f"{prefix}_rule"))
    return _as_ordered(system.with_node(NodeSpec(DISPLAY, f"{prefix}_plate", f"{prefix}_rule")))


def _as_ordered(system: System) -> System:
    """The system with its wiring as what the owner ordered."""
    wiring = []
    for node in system.nodes:
        if node.publishes:
            once = node.role == ANNOUNCER
            wiring.append(Wiring(node.path, "publisher", f"/{node.publishes}", once))
        if node.subscribes:
            wiring.append(Wiring(node.path, "subscription", f"/{node.subscribes}"))
    return replace(system, spec=replace(system.spec, wiring=tuple(wiring)))
