"""Scenes for an explanation: what a session sees of a sensor and a monitor."""

from dataclasses import replace

from record_builders import FLOAT
from record_builders import at as seconds
from rosbeat.diagnosis.topic_snapshot import Beat, Condition, Scene
from rosbeat.records import Endpoint, Fault, GraphSnapshot, QoS, TimerRecord

SENSOR, MONITOR, TOPIC = "/sensor", "/monitor", "/temperature"
SENSOR_DATA = QoS(reliability="BEST_EFFORT")
LATCHED = QoS(durability="TRANSIENT_LOCAL")


def pub(node=SENSOR, topic=TOPIC, kind=FLOAT, qos=None, matched=1):
    return Endpoint(node, topic, kind, "publisher", qos or QoS(), matched)


def sub(node=MONITOR, topic=TOPIC, kind=FLOAT, qos=None, matched=1):
    return Endpoint(node, topic, kind, "subscription", qos or QoS(), matched)


def spoke(node=SENSOR, number=10, last=10.0, rate=1.0, watched=10.0, **more):
    """A publisher's heartbeat."""
    return Beat(node, "publisher", number, seconds(last), rate, seconds(watched), **more)


def heard(number=10, last=10.0, missed=0, since=10, node=MONITOR, **more):
    """A subscription's heartbeat."""
    last_ns = seconds(last) if number else -1
    return Beat(node, "subscription", number, last_ns, 0.0, seconds(10), missed, since, **more)


def scene(*ends, beats=(), twins=(), timers=(), **more):
    """What a session of its own sees at 10 s; every node is the session's unless `own` says."""
    nodes = tuple(dict.fromkeys(end.node for end in ends))
    graph = GraphSnapshot((*nodes, *twins), ends, timers)
    more = {"now_ns": seconds(10), "own": frozenset(nodes), "virtual": True, **more}
    return Scene(graph, beats=tuple(beats), **more)


def well(**more):
    """A sensor that publishes once a second, and a monitor that gets it."""
    return scene(pub(), sub(), beats=(spoke(), heard()), **more)


def silent(*conditions, **more):
    """The same, and nothing has come."""
    beats = (spoke(number=0, last=-1e-9, rate=0.0), heard(number=0, since=0))
    return scene(pub(), sub(), beats=beats, conditions=conditions, **more)


def elsewhere(told, domain_id=7):
    """The same as a terminal sees it, where all nodes are in other processes."""
    return replace(told, own=frozenset(), virtual=False, domain_id=domain_id)


def ended(node=SENSOR):
    fault = Fault(seconds(3), node, "publish", "ZeroDivisionError", "division by zero", 5, "1 / 0")
    return Condition(node, "ended", fault)


def timer(calls=0, period=1.0, node=SENSOR):
    return TimerRecord(node, "publish_temperature", seconds(period), calls)
