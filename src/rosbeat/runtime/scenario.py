"""Running a learner's node and writing down what it did.

A scenario says nothing about right or wrong. Whatever goes wrong in the learner's code becomes a
fault in the observation; nothing is printed and nothing is raised.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from contextlib import redirect_stderr, redirect_stdout
from dataclasses import replace
from importlib import import_module
from io import StringIO
from typing import Any

from rclpy.node import Node

from rosbeat.errors import NodeClassError, NodeConstructionError, RosbeatError
from rosbeat.records import Fault, Observation
from rosbeat.runtime.faults import fault_of
from rosbeat.runtime.session import Session


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


def feeder(name: str, topic: str, type_name: str, values: Iterable[Any]) -> Callable[[], Node]:
    """A node that publishes one value a second, from 1 s on, and then falls silent.

    Args:
        name: The node's name.
        topic: Where it publishes.
        type_name: A message type with a field `data`, such as `std_msgs/msg/Float32`.
        values: What it publishes, in order.

    Returns:
        A function that makes the node, for `Session.add` or `observe`.
    """
    waiting, message_type = list(values), message_class(type_name)

    class Feeder(Node):
        """Publishes what it was given."""

        def __init__(self) -> None:
            super().__init__(name)
            self._queue = list(waiting)
            self._publisher = self.create_publisher(message_type, topic, 10)
            self.create_timer(1.0, self._send)

        def _send(self) -> None:
            if self._queue:
                self._publisher.publish(message_type(data=self._queue.pop(0)))

    return Feeder


def observe(
    answer: Any,  # noqa: ANN401 - whatever a learner hands over
    seconds: float,
    *,
    others: Iterable[Callable[[], Node]] = (),
    seed: int = 0,
) -> Observation:
    """Run an answer among other nodes in virtual time.

    Args:
        answer: What should be a node class.
        seconds: Virtual seconds to run.
        others: Nodes to run beside it. They are added first, so that what clashes with them is
            raised by the answer's own line.
        seed: Seed of the random numbers that nodes draw.

    Returns:
        What happened. An answer that cannot be made into a node, and an endless chain, are faults.
    """
    silence = StringIO()
    with redirect_stdout(silence), redirect_stderr(silence), Session(seed=seed) as ros:
        try:
            for other in others:
                ros.add(other)
            ros.add(answer)
            ros.run(seconds, quiet=True)
        except RosbeatError as error:
            return _with_fault(ros.observation(), error)
        return ros.observation()


def _with_fault(observation: Observation, error: RosbeatError) -> Observation:
    cause = error.__cause__
    if isinstance(error, NodeConstructionError) and cause is not None:
        fault = fault_of(cause, observation.time_ns, "", "__init__")
    elif isinstance(error, NodeClassError):
        fault = Fault(observation.time_ns, "", "add", "NodeClassError", error.what, 0, "")
    else:
        fault = Fault(observation.time_ns, "", "run", type(error).__name__, error.what, 0, "")
    return replace(observation, faults=(*observation.faults, fault))
