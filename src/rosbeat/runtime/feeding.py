"""Nodes that publish what they were given."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from importlib import import_module
from typing import Any

from rclpy.duration import Duration
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, HistoryPolicy, QoSProfile, ReliabilityPolicy

from rosbeat.records import QoS

#: How a node begins that only keeps an answer company: without the six services for its parameters,
#: which nobody asks and which are two thirds of what a node costs (measured: 11 of 16 ms).
BARE = {"start_parameter_services": False}


def message_class(type_name: str) -> type:
    """The Python class of a message type.

    Args:
        type_name: The type's ROS name, such as `std_msgs/msg/Float32`.

    Raises:
        ModuleNotFoundError, AttributeError: If no installed package has it.
    """
    package, kind, name = type_name.split("/")
    found: type = getattr(import_module(f"{package}.{kind}"), name)
    return found


def message(type_name: str, value: Any) -> Any:  # noqa: ANN401 - a message of any type
    """A message that holds a value.

    Args:
        type_name: The type's ROS name.
        value: What its field `data` holds, or a dict from field name to value.
    """
    fields = value if isinstance(value, dict) else {"data": value}
    return message_class(type_name)(**fields)


def profile(qos: QoS | int) -> QoSProfile:
    """A QoS profile from the record of one, or from a queue depth."""
    wanted = QoS(depth=qos) if isinstance(qos, int) else qos
    return QoSProfile(
        depth=wanted.depth,
        history=HistoryPolicy[wanted.history],
        reliability=ReliabilityPolicy[wanted.reliability],
        durability=DurabilityPolicy[wanted.durability],
        **limits(wanted),
    )


def limits(qos: QoS) -> dict[str, Duration]:
    """The limits of a quality of service as arguments of a QoS profile."""
    found = {"deadline": qos.deadline_ns, "lifespan": qos.lifespan_ns}
    return {name: Duration(nanoseconds=limit) for name, limit in found.items() if limit}


def feeder(
    name: str,
    topic: str,
    type_name: str,
    values: Iterable[Any],
    *,
    period: float = 1.0,
    burst: int = 1,
    qos: QoS | int = 10,
) -> Callable[[], Node]:
    """A node that publishes value after value, from one period on, and then falls silent.

    Args:
        name: The node's name.
        topic: Where it publishes.
        type_name: A message type with a field `data`, such as `std_msgs/msg/Float32`; of another
            type the values are dicts from field name to value.
        values: What it publishes, in order; NaN and infinity are values like others.
        period: Virtual seconds from one to the next.
        burst: How many it publishes each time, at one instant.
        qos: The quality of service of its publisher, or the depth of its queue.

    Returns:
        A function that makes the node, for `Session.add` or `observe`.
    """
    waiting = [message(type_name, value) for value in values]

    class Feeder(Node):
        """Publishes what it was given."""

        def __init__(self) -> None:
            super().__init__(name, **BARE)
            self._queue = list(waiting)
            self._publisher = self.create_publisher(message_class(type_name), topic, profile(qos))
            self.create_timer(period, self._send)

        def _send(self) -> None:
            for one in self._queue[:burst]:
                self._publisher.publish(one)
            del self._queue[:burst]

    return Feeder
