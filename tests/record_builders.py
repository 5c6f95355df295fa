"""Builders of records for tests that need no ROS. Times are seconds of virtual time."""

from rosbeat.records import (
    NANOSECONDS,
    CallbackRecord,
    Endpoint,
    GraphSnapshot,
    Observation,
    QoS,
    Sample,
    WaitRecord,
)

FLOAT, STRING = "std_msgs/msg/Float32", "std_msgs/msg/String"


def at(seconds):
    """Return a time in nanoseconds."""
    return round(seconds * NANOSECONDS)


def pub(node, topic, matched=1, type_name=FLOAT, qos=QoS()):  # noqa: B008 - it is frozen
    return Endpoint(node, topic, type_name, "publisher", qos, matched)


def sub(node, topic, matched=1, type_name=FLOAT, qos=QoS()):  # noqa: B008 - it is frozen
    return Endpoint(node, topic, type_name, "subscription", qos, matched)


def graph_of(*ends, alone=(), processes=()):
    """Return a graph of these endpoints, and of the nodes `alone`, which have none."""
    nodes = tuple(dict.fromkeys([*(end.node for end in ends), *alone]))
    return GraphSnapshot(nodes, ends, processes=tuple(processes))


def sample(time, value, topic="/temperature", node="/sensor", kind=FLOAT):
    data = value if isinstance(value, dict) else {"data": value}
    return Sample(at(time), topic, kind, node, data)


def call(time, node, name, kind="timer", source="1 s"):
    return CallbackRecord(at(time), node, kind, name, source)


def timer(time, node="/sensor"):
    return call(time, node, "publish")


def heard(time, node="/monitor", topic="/temperature"):
    return call(time, node, "hear", "subscription", topic)


def wait(begin, end, node, callback, reason="sleep"):
    return WaitRecord(at(begin), at(end), node, callback, reason)


def run_of(values, seconds=None, seed=7):
    """Return what a sensor sends that publishes these values, one each second."""
    samples = tuple(sample(time, value) for time, value in enumerate(values, 1))
    length = len(samples) if seconds is None else seconds
    graph = GraphSnapshot(("/sensor",), (pub("/sensor", "/temperature", -1),))
    return Observation(at(length), seed, samples, graph=graph)


def pair(count, **more):
    """Return what a sensor that publishes once a second and its monitor do."""
    times = range(1, count + 1)
    calls = tuple(made for time in times for made in (timer(time), heard(time)))
    graph = graph_of(pub("/sensor", "/temperature"), sub("/monitor", "/temperature"))
    samples = tuple(sample(time, 20.0 + time % 7) for time in times)
    return Observation(at(count), 7, samples, callbacks=calls, graph=graph, **more)
