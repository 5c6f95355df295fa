"""Observations that need no ROS, and a second opinion on what is the same."""

import math

import pytest

from rosbeat.records import (
    NANOSECONDS,
    Endpoint,
    GraphSnapshot,
    Observation,
    QoS,
    Sample,
)

FLOAT = "std_msgs/msg/Float32"


class Make:
    """Short ways to make records."""

    @staticmethod
    def sample(time, value, topic="/temperature", node="/sensor", kind=FLOAT):
        data = value if isinstance(value, dict) else {"data": value}
        return Sample(round(time * NANOSECONDS), topic, kind, node, data)

    @staticmethod
    def publisher(topic="/temperature", node="/sensor", kind=FLOAT, qos=QoS()):  # noqa: B008
        return Endpoint(node, topic, kind, "publisher", qos)

    @classmethod
    def run(cls, values, seconds=None, seed=7):
        """A sensor that publishes once a second."""
        samples = tuple(cls.sample(at, value) for at, value in enumerate(values, 1))
        length = len(samples) if seconds is None else seconds
        graph = GraphSnapshot(("/sensor",), (cls.publisher(),))
        return Observation(length * NANOSECONDS, seed, samples, graph=graph)


@pytest.fixture(scope="session")
def make():
    return Make


def alike(one, other):
    """Whether two plain values are the same, NaN and NaN included; written apart from ours."""
    if isinstance(one, dict):
        return (
            isinstance(other, dict)
            and set(one) == set(other)
            and all(alike(one[name], other[name]) for name in one)
        )
    if isinstance(one, list):
        return len(one) == len(other) and all(map(alike, one, other))
    if isinstance(one, float) and math.isnan(one):
        return isinstance(other, float) and math.isnan(other)
    return type(one) is type(other) and one == other


@pytest.fixture(scope="session")
def same():
    return alike
