"""Define the faults of the clinic, and its cases: one or two faults, as their owner describes them.

A fault is `(system, role, rng) -> (system, truth)`. It changes one node, as the author or operator
of that node might by mistake, and returns the diagnosis with all places that count as right.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from random import Random

from rosbeat.clinic.systems import (
    ANNOUNCER,
    DISPLAY,
    LOGGER,
    MONITOR,
    OVERSHOOT,
    SENSOR,
    STEP,
    NodeSpec,
    Specification,
    System,
    healthy,
    in_bursts,
    with_announcer,
    with_humidity,
)
from rosbeat.records import QoS


@dataclass(frozen=True)
class Truth:
    """Hold a correct diagnosis.

    Attributes:
        mistake: Id of the mistake.
        places: Full names of nodes and topics, each of which is a correct answer to "where".
    """

    mistake: str
    places: tuple[str, ...]


Fault = Callable[[System, str, Random], tuple[System, Truth]]
#: Returns a changed copy of a node.
_Change = Callable[[NodeSpec, Specification, Random], NodeSpec]


# Faults.


def _node_fault(mistake: str, change: _Change, *, topic: str = "publishes") -> Fault:
    """A fault of one node, and of the topic that it `publishes` or `subscribes`, if any."""

    def apply(system: System, role: str, rng: Random) -> tuple[System, Truth]:
        node = system.node(role)
        topics = {"publishes": [node.publishes], "subscribes": [node.subscribes], "": []}[topic]
        places = (node.path, *(f"/{name}" for name in topics))
        return system.replaced(node, change(node, system.spec, rng)), Truth(mistake, places)

    return apply


def _misspelled(system: System, role: str, rng: Random) -> tuple[System, Truth]:
    """Misspell the name of the topic that a node uses."""
    node = system.node(role)
    wrong = _with_slip(node.subscribes or node.publishes, rng)
    truth = Truth("topic-misspelled", (f"/{wrong}", node.path))
    return system.replaced(node, _on_topic(node, wrong)), truth


def _on_topic(node: NodeSpec, topic: str) -> NodeSpec:
    return replace(node, subscribes=topic) if node.subscribes else replace(node, publishes=topic)


def _with_slip(name: str, rng: Random) -> str:
    """A name with a small slip of the hand in its second half."""
    at = rng.randrange(len(name) // 2, len(name) - 1)
    head, _, last = name.rpartition("_")
    slips = (
        name[:at] + name[at + 1 :],
        name + "s",
        name[:at] + name[at + 1] + name[at] + name[at + 2 :],
        f"{head}_{last.capitalize()}",
    )
    return rng.choice([slip for slip in slips if slip != name and not slip.endswith("_")])


def _namespaced(system: System, role: str, rng: Random) -> tuple[System, Truth]:
    """Move a node's topic into a namespace that the other nodes do not use.

    Either its code names the namespace, or the node is started there.
    """
    node, namespace = system.node(role), rng.choice(("north", "hall_2", "test", "upstairs"))
    topic = f"{namespace}/{node.subscribes or node.publishes}"
    if rng.random() < 0.5:
        new = _on_topic(node, topic)
    else:
        new = replace(node, namespace=namespace)
        # The owner's description has the name that the node has now.
        wiring = tuple(
            replace(one, node=new.path) if one.node == node.path else one
            for one in system.spec.wiring
        )
        system = replace(system, spec=replace(system.spec, wiring=wiring))
    return system.replaced(node, new), Truth("wrong-namespace", (f"/{topic}", new.path))


def _unfit(system: System, role: str, rng: Random) -> tuple[System, Truth]:
    """Make the QoS of a node incompatible with that of the other side."""
    node = system.node(role)
    if role == SENSOR:
        qos = QoS(reliability="BEST_EFFORT")
    else:
        qos = QoS(durability="TRANSIENT_LOCAL", depth=rng.choice((1, 5, 10)))
    partners = {SENSOR: (MONITOR, LOGGER), DISPLAY: (MONITOR,)}.get(role, (SENSOR,))
    others = [one.path for one in system.nodes if one.role in partners]
    truth = Truth("qos-mismatch", (f"/{node.subscribes or node.publishes}", node.path, *others))
    return system.replaced(node, replace(node, qos=qos)), truth


def _ended(system: System, role: str, rng: Random) -> tuple[System, Truth]:
    """Make a callback of a node raise, which ends the node."""
    node = system.node(role)
    changes = {
        SENSOR: replace(node, calibrated=rng.randrange(15, 40)),
        MONITOR: replace(node, forgets_high=True),
        LOGGER: replace(node, pages=rng.randrange(10, 30)),
    }
    if role == MONITOR:
        # The readings begin a little above the lower limit, and rise: the first ones are Normal.
        sensor, spec = system.node(SENSOR), system.spec
        phase = round((spec.low + STEP - (spec.least - OVERSHOOT)) / STEP)
        system = system.replaced(sensor, replace(sensor, phase=phase))
    return system.replaced(node, changes[role]), Truth("node-ended", (node.path,))


def _late(system: System, role: str, rng: Random) -> tuple[System, Truth]:
    """Start the node that displays the rule after the rule has been published."""
    node = system.nodes[-1]
    places = (f"/{node.subscribes}", node.path, system.node(ANNOUNCER).path)
    new = replace(node, starts_at=float(rng.randrange(5, 25)))
    return system.replaced(node, new), Truth("first-messages-lost", places)


def _two_sources(system: System, role: str, rng: Random) -> tuple[System, Truth]:
    """Add a second sensor, which nobody ordered, on the same topic."""
    node = system.node(role)
    suffix = rng.choice(("_spare", "_old_sensor", "_test_sensor"))
    phase = (node.phase + rng.randrange(15, 25)) % 60
    extra = replace(node, name=node.name.partition("_")[0] + suffix, phase=phase)
    return system.with_node(extra), Truth("two-sources", (f"/{node.publishes}", extra.path))


def _other_topic(system: System, role: str, rng: Random) -> tuple[System, Truth]:
    """Remap a node's subscription to the topic of the last sensor, which measures the humidity."""
    node, topic = system.node(role), system.nodes[-1].publishes
    new = replace(node, remappings={node.subscribes: topic})
    return system.replaced(node, new), Truth("wrong-topic", (node.path, f"/{topic}"))


#: Every fault by its name.
FAULTS: dict[str, Fault] = {
    "misspelled": _misspelled,
    "namespaced": _namespaced,
    "unfit": _unfit,
    "ended": _ended,
    "late": _late,
    "two sources": _two_sources,
    "other topic": _other_topic,
    "unspun": _node_fault("not-spun", lambda node, *_: replace(node, spun=False), topic=""),
    "mute": _node_fault("never-published", lambda node, *_: replace(node, mute=True)),
    "quiet": _node_fault(
        "gone-quiet", lambda node, spec, rng: replace(node, stops_after=rng.randrange(18, 32))
    ),
    "wrong unit": _node_fault(
        "wrong-unit",
        lambda node, spec, rng: replace(node, unit=rng.choice(("Fahrenheit", "Kelvin"))),
    ),
    "short queue": _node_fault(
        "depth-too-small",
        lambda node, spec, rng: replace(node, qos=QoS(depth=rng.randrange(1, spec.burst - 1))),
        topic="subscribes",
    ),
    "unclamped": _node_fault("no-clamp", lambda node, *_: replace(node, clamp="never")),
    "clamped first": _node_fault(
        "clamped-too-early", lambda node, *_: replace(node, clamp="first")
    ),
    "other rate": _node_fault(
        "wrong-rate",
        lambda node, spec, rng: replace(node, period=spec.period * rng.choice((0.5, 0.25, 2.0))),
    ),
    "at the limit": _node_fault(
        "boundary",
        lambda node, spec, rng: replace(node, wrong_at_limit=rng.choice(("High", "Low"))),
    ),
    "stuck": _node_fault(
        "never-changes",
        lambda node, spec, rng: replace(
            node, stuck_at=rng.randrange(int(spec.low) + 1, int(spec.high)) + 0.5
        ),
    ),
}


# Cases.


@dataclass(frozen=True)
class BrokenSystem:
    """Describe a system with one or two faults.

    Attributes:
        case: Name of its case.
        system: The system.
        truths: The correct diagnoses.
        complaint: What its owner says.
    """

    case: str
    system: System
    truths: tuple[Truth, ...]
    complaint: str


#: Levels: something is silent; nothing is silent and something is wrong; two faults.
SILENT, HEARD, PAIR = "silent", "heard", "pair"


@dataclass(frozen=True)
class Case:
    """Describe a kind of patient.

    Attributes:
        level: `SILENT`, `HEARD` or `PAIR`.
        faults: Names of the faults in order, each with the roles of the nodes that it may affect.
        complaint: What the owner says, without the cause; by role of the first fault's node, if
            that makes a difference.
        draw_healthy: Draws the healthy system.
    """

    level: str
    faults: Mapping[str, tuple[str, ...]]
    complaint: str | Mapping[str, str]
    draw_healthy: Callable[[Random, str], System] = healthy

    @property
    def name(self) -> str:
        """Return the names of its faults."""
        return ", ".join(self.faults)

    def draw(self, rng: Random, place: str) -> BrokenSystem:
        """Draw a patient of this kind."""
        system, truths, affected = self.draw_healthy(rng, place), [], []
        for name, roles in self.faults.items():
            affected.append(rng.choice(roles))
            system, truth = FAULTS[name](system, affected[-1], rng)
            truths.append(truth)
        said = self.complaint
        text = said if isinstance(said, str) else said[affected[0]]
        names = {node.role: node.name for node in reversed(system.nodes)}
        return BrokenSystem(self.name, system, tuple(truths), text.format(**names))


_ANY = (SENSOR, MONITOR, DISPLAY, LOGGER)
_DARK = "{display} stays dark. {logger} is fine."
_NO_DATA = {
    SENSOR: "{display} stays dark, and {logger} is empty.",
    MONITOR: _DARK,
    DISPLAY: _DARK,
    LOGGER: "{logger} is empty. {display} is fine.",
}
_NO_DATA_NOW = {
    SENSOR: "At first, everything worked. Then {display} stopped changing, and {logger} got no new "
    "entries.",
    MONITOR: "At first, everything worked. Then {display} stopped changing. {logger} is fine.",
    LOGGER: "At first, everything worked. Then {logger} got no new entries. {display} is fine.",
}
_FEWER = {
    MONITOR: "{display} shows fewer readings than {logger} has.",
    LOGGER: "There are gaps in {logger}. {display} has shown more readings than that.",
}
_UNRELATED = {
    MONITOR: "{display} says High all the time. The readings of {logger} are fine.",
    LOGGER: "The readings in {logger} don't match what {display} shows at all.",
}

CASES: tuple[Case, ...] = (
    Case(SILENT, {"misspelled": (SENSOR, DISPLAY, LOGGER)}, _NO_DATA),
    Case(SILENT, {"namespaced": (DISPLAY, LOGGER)}, _NO_DATA),
    Case(SILENT, {"unfit": _ANY}, _NO_DATA),
    Case(SILENT, {"ended": (SENSOR, MONITOR, LOGGER)}, _NO_DATA_NOW),
    Case(SILENT, {"mute": (SENSOR, MONITOR)}, _NO_DATA),
    Case(SILENT, {"unspun": _ANY}, _NO_DATA),
    Case(SILENT, {"quiet": (SENSOR, MONITOR)}, _NO_DATA_NOW),
    Case(SILENT, {"late": (DISPLAY,)},
         "The plate should show the rule, but it stays empty. Everything else is fine.",
         with_announcer),
    Case(HEARD, {"two sources": (SENSOR,)},
         "The readings jump up and down, as if they came from two rooms."),
    Case(HEARD, {"wrong unit": (SENSOR,)},
         "{display} says High, day and night. It doesn't feel that warm at all."),
    Case(HEARD, {"short queue": (MONITOR, LOGGER)}, _FEWER, in_bursts),
    Case(HEARD, {"other topic": (MONITOR, LOGGER)}, _UNRELATED, with_humidity),
    Case(HEARD, {"unclamped": (SENSOR,)},
         "{logger} contains readings that {sensor} should never send."),
    Case(HEARD, {"clamped first": (SENSOR,)},
         "{logger} contains a few readings that {sensor} should never send."),
    Case(HEARD, {"other rate": (SENSOR,)},
         "Something is odd: {logger} doesn't have as many entries as I expected."),
    Case(HEARD, {"at the limit": (MONITOR,)},
         "Now and then, {display} is wrong. Most of the time, it's right."),
    Case(HEARD, {"stuck": (SENSOR,)}, "{display} always says Normal. I don't believe it."),
    Case(PAIR, {"misspelled": (LOGGER,), "unfit": (DISPLAY,)},
         "{display} stays dark, and {logger} is empty."),
    Case(PAIR, {"unfit": (MONITOR,), "unspun": (DISPLAY,)},
         "{display} stays dark. I changed {monitor} a little, but {display} is still dark."),
    Case(PAIR, {"ended": (MONITOR,), "namespaced": (DISPLAY,)},
         "{display} never showed anything, not even in the first seconds."),
    Case(PAIR, {"mute": (MONITOR,), "misspelled": (DISPLAY,)}, _DARK),
    Case(PAIR, {"other topic": (MONITOR,), "unclamped": (SENSOR,)},
         "{display} says High all the time, and {logger} contains strange readings.",
         with_humidity),
    Case(PAIR, {"two sources": (SENSOR,), "stuck": (SENSOR,)},
         "I don't trust the readings: some look fine, and the others are all the same."),
    Case(PAIR, {"short queue": (LOGGER,), "wrong unit": (SENSOR,)},
         "{logger} has gaps, and its readings are hard to believe.", in_bursts),
    Case(PAIR, {"at the limit": (MONITOR,), "namespaced": (DISPLAY,)},
         "{display} stays dark. Before we moved it, it was wrong now and then."),
    Case(PAIR, {"other rate": (SENSOR,), "ended": (LOGGER,)},
         "{logger} gets no new entries. And its entries looked odd before that."),
)  # fmt: skip
