"""What `ros` runs answers with, imported when the first one runs.

So scenarios can be imported, and their evidence judged, where ROS is not installed, and a page that
only shows hints need not wait for it.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from typing import Any

from rosbeat.records import Observation, QoS

#: A node, or what makes one; its type is rclpy's, which is not imported here.
Node = Any


def observe(answer: Any, seconds: float, **options: Any) -> Observation:  # noqa: ANN401
    """Run an answer in virtual time; see `rosbeat.ros.scenario.observe`."""
    from rosbeat.ros import scenario

    return scenario.observe(answer, seconds, **options)


def feeder(
    name: str,
    topic: str,
    type_name: str,
    values: Iterable[Any],
    **options: Any,  # noqa: ANN401
) -> Callable[[], Node]:
    """A node that publishes one value a second; see `rosbeat.ros.scenario.feeder`."""
    from rosbeat.ros import scenario

    return scenario.feeder(name, topic, type_name, values, **options)


def hearer(name: str, topic: str, type_name: str, qos: QoS | int = 10) -> Callable[[], Node]:
    """A node that logs what it hears; see `rosbeat.ros.test_nodes.hearer`."""
    from rosbeat.ros import test_nodes

    return test_nodes.hearer(name, topic, type_name, qos)


def started(make: Any, **start: Any) -> Any:  # noqa: ANN401
    """A node to run beside an answer, started like `Session.add(make, **start)`."""
    from rosbeat.ros import launch

    return launch.Maker(make, launch.checked(**start))


def drift(phases: Sequence[tuple[float, float]]) -> Callable[[], Node]:
    """A node that tilts random numbers; see `rosbeat.ros.test_nodes.drift`."""
    from rosbeat.ros import test_nodes

    return test_nodes.drift(phases)


def observe_system(answer: Any, seconds: float, **options: Any) -> Observation:  # noqa: ANN401
    """Run several nodes in virtual time; see `rosbeat.ros.scenario.observe_system`."""
    from rosbeat.ros import scenario

    return scenario.observe_system(answer, seconds, **options)


def station(name: str, topic: str, readings: Iterable[float | None]) -> Callable[[], Node]:
    """A sensor that publishes a `Float32` each second; None is a second without a message."""
    values = [None if reading is None else float(reading) for reading in readings]
    return feeder(name, topic, "std_msgs/msg/Float32", values)


def adding(at: float, make: Callable[[], Node]) -> Any:  # noqa: ANN401
    """A step that adds a node."""
    from rosbeat.ros.scenario import Add

    return Add(at, make=make)


def removing(at: float, node: str) -> Any:  # noqa: ANN401
    """A step that destroys a node."""
    from rosbeat.ros.scenario import Remove

    return Remove(at, node)
