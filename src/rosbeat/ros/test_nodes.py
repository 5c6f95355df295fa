"""Nodes that scenarios put beside an answer."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from itertools import islice
from typing import Any

from rclpy.duration import Duration
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, HistoryPolicy, QoSProfile, ReliabilityPolicy
from std_msgs.msg import Bool, Float32, Int32, String

from rosbeat.records import Observation, QoS
from rosbeat.ros.randomness import tilt
from rosbeat.ros.recording import message_class
from rosbeat.ros.session import Session

_DEFAULT_DEPTH = 10
#: How a test node begins: without the six services for its parameters, which nobody asks and which
#: are two thirds of what a node costs (measured: 11 of 16 ms).
BARE = {"start_parameter_services": False}


def message(type_name: str, value: Any) -> Any:  # noqa: ANN401 - a message of any type
    """Return a message that holds a value.

    Args:
        type_name: The type's ROS name.
        value: The value of its field `data`, or a dict from field name to value.
    """
    fields = value if isinstance(value, dict) else {"data": value}
    return message_class(type_name)(**fields)


def profile(qos: QoS | int) -> QoSProfile:
    """Return the QoS profile of a record, or of a queue depth.

    What a record does not know, as that of a recording, is ROS's default.
    """
    if isinstance(qos, int):
        return QoSProfile(depth=qos)
    best_effort, stored = qos.reliability == "BEST_EFFORT", qos.durability == "TRANSIENT_LOCAL"
    limits = {"deadline": qos.deadline_ns, "lifespan": qos.lifespan_ns}
    return QoSProfile(
        reliability=ReliabilityPolicy.BEST_EFFORT if best_effort else ReliabilityPolicy.RELIABLE,
        durability=DurabilityPolicy.TRANSIENT_LOCAL if stored else DurabilityPolicy.VOLATILE,
        history=HistoryPolicy.KEEP_ALL if qos.history == "KEEP_ALL" else HistoryPolicy.KEEP_LAST,
        depth=qos.depth or _DEFAULT_DEPTH,
        **{name: Duration(nanoseconds=limit) for name, limit in limits.items() if limit},
    )


# Nodes that publish what they were given, and nodes that log what they receive.


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
    """Return a node that publishes value after value, from one period on, and then falls silent.

    Args:
        name: The node's name.
        topic: The topic.
        type_name: A message type with a field `data`, such as `std_msgs/msg/Float32`; of another
            type the values are dicts from field name to value.
        values: The values, in order; NaN and infinity are values like others, and None is a turn
            without a message.
        period: Virtual seconds from one to the next.
        burst: How many it publishes each time, at one instant.
        qos: The quality of service of its publisher, or the depth of its queue.

    Returns:
        A function that makes the node, for `Session.add` or `observe`.
    """
    messages = [None if value is None else message(type_name, value) for value in values]

    class Feeder(Node):
        """Publishes what it was given."""

        def __init__(self) -> None:
            super().__init__(name, **BARE)
            self._left = iter(messages)
            self._publisher = self.create_publisher(message_class(type_name), topic, profile(qos))
            self.create_timer(period, self._send)

        def _send(self) -> None:
            for one in islice(self._left, burst):
                if one is not None:
                    self._publisher.publish(one)

    return Feeder


def station(name: str, topic: str, readings: Iterable[float | None]) -> Callable[[], Node]:
    """Return a sensor that publishes one `Float32` a second, the first after one second.

    Args:
        name: The node's name.
        topic: The topic.
        readings: The readings, in order; None is a second without a message.

    Returns:
        A function that makes the node, for `Session.add` or a scenario.
    """
    values = (None if reading is None else float(reading) for reading in readings)
    return feeder(name, topic, "std_msgs/msg/Float32", values)


def hearer(name: str, topic: str, type_name: str, qos: QoS | int = 10) -> Callable[[], Node]:
    """Return a node that logs the field `data` of each message that it gets, and nothing else.

    Args:
        name: The node's name.
        topic: The topic.
        type_name: A message type with a field `data`, such as `std_msgs/msg/String`.
        qos: The quality of service that it asks for, or the depth of its queue.

    Returns:
        A function that makes the node, for `Session.add`, `observe` or the step `Add`.
    """

    class Hearer(Node):
        """Logs what it receives."""

        def __init__(self) -> None:
            super().__init__(name, **BARE)
            self.create_subscription(message_class(type_name), topic, self._receive, profile(qos))

        def _receive(self, message: Any) -> None:  # noqa: ANN401 - a message of any type
            self.get_logger().info(str(message.data))

    return Hearer


# A room with a heater: whole degrees, so that nothing depends on rounding.


#: Seconds in which a room loses one degree while it is not heated.
_COOLS_IN = 5


def room(degrees: int) -> Callable[[], Node]:
    """Return a node that publishes the temperature of a heated room each second.

    It gains one degree a second while the last message on `heater` was True, and else loses one
    in five seconds.

    Args:
        degrees: Its first temperature, in whole degrees.

    Returns:
        A function that makes the node, for `Session.add` or `observe`.
    """

    class Room(Node):
        """Publishes its temperature."""

        def __init__(self) -> None:
            super().__init__("room")
            self._degrees, self._heating, self._cold = degrees, False, 0
            self._readings = self.create_publisher(Float32, "temperature", 10)
            self.create_subscription(Bool, "heater", self._switch, 10)
            self.create_timer(1.0, self._measure)

        def _switch(self, message: Bool) -> None:
            self._heating = bool(message.data)

        def _measure(self) -> None:
            if self._heating:
                self._degrees += 1
            else:
                self._cold += 1
                self._degrees -= self._cold % _COOLS_IN == 0
            self._readings.publish(Float32(data=float(self._degrees)))

    return Room


# A tendency in the random numbers, so that a random walk soon meets both of its limits.
#
# A free walk needs hours to wander from one end of its range to the other, and may miss one of them
# for ever. A check cannot wait for luck. So the numbers drift: up for a while, down for a while,
# then freely. Each single number is one that could have been drawn anyway.


_AT_ONCE = 1e-6


def drift(phases: Sequence[tuple[float, float]]) -> Callable[[], Node]:
    """Return a node that tilts what others draw with the functions of Python's `random`.

    NumPy's generators stay as they are, and so does a `random.Random` of a node's own.

    Args:
        phases: How long each lasts, in virtual seconds, and its exponent; see `tilt`. There is at
            least one, and the last one stays until the session's `run` returns.

    Returns:
        A function that makes the node, for `Session.add` or `observe`.
    """

    class Drift(Node):
        """Changes the tendency at the end of each phase."""

        def __init__(self) -> None:
            super().__init__("weather", **BARE)
            self._left = list(phases)
            # A tilt lasts until the call of the session ends that set it, so not from here.
            self._timer = self.create_timer(_AT_ONCE, self._next_phase)

        def _next_phase(self) -> None:
            self.destroy_timer(self._timer)
            seconds, exponent = self._left.pop(0)
            tilt(exponent)
            if self._left:
                self._timer = self.create_timer(seconds, self._next_phase)

    return Drift


# A small system that a learner did not write: a greenhouse of five nodes.
#
# Page 07 looks at it from outside. What there is to find is told by nothing but the nodes
# themselves.


#: Virtual seconds after which everything has happened at least once.
_SECONDS = 20.0
_WETTEST, _DRIEST = 60, 30
#: Seconds from one complaint to the next.
_PATIENCE = 30


class Weather(Node):
    """Publishes temperature and light of a still day, always the same."""

    def __init__(self) -> None:
        super().__init__("weather")
        self._temperature = self.create_publisher(Float32, "temperature", 10)
        self._light = self.create_publisher(Float32, "lights", 10)
        self.create_timer(0.5, self._measure)

    def _measure(self) -> None:
        self._temperature.publish(Float32(data=23.0))
        self._light.publish(Float32(data=800.0))


class Window(Node):
    """Opens when it is warm."""

    def __init__(self) -> None:
        super().__init__("window")
        self.declare_parameter("open_above", 25.0)
        self._state = self.create_publisher(String, "window_state", 10)
        self.create_subscription(Float32, "temperature", self._look, 10)

    def _look(self, msg: Float32) -> None:
        is_open = msg.data > self.get_parameter("open_above").value
        self._state.publish(String(data="open" if is_open else "shut"))


class SoilProbe(Node):
    """Publishes how wet the soil is, in per cent: it dries, and is wet again."""

    def __init__(self) -> None:
        super().__init__("soil_probe")
        self._moisture = self.create_publisher(Int32, "moisture", 10)
        self._percent = _WETTEST
        self.create_timer(0.2, self._measure)

    def _measure(self) -> None:
        self._percent = self._percent - 1 if self._percent > _DRIEST else _WETTEST
        self._moisture.publish(Int32(data=self._percent))


class Gardener(Node):
    """Waters when the soil is dry."""

    def __init__(self) -> None:
        super().__init__("gardener")
        self.declare_parameter("dry_below", 35)
        self._watering = self.create_publisher(String, "watering", 10)
        self.create_subscription(Int32, "moisture", self._look, 3)
        self.create_subscription(String, "window_state", self._keep, 10)
        self._window = ""

    def _look(self, msg: Int32) -> None:
        dry = msg.data < self.get_parameter("dry_below").value
        self._watering.publish(String(data="on" if dry else "off"))

    def _keep(self, msg: String) -> None:
        if msg.data != self._window:
            self._window = msg.data
            self.get_logger().info(f"The window is {msg.data}")


class Lamp(Node):
    """Shines in the dark, if it ever learns that it is dark."""

    def __init__(self) -> None:
        super().__init__("lamp")
        self._heard = self._ticks = 0
        self.create_subscription(Float32, "light", self._look, 10)
        self.create_subscription(String, "watering", self._pause, 10)
        self.create_timer(1.0, self._complain)

    def _look(self, _: Float32) -> None:
        self._heard += 1

    def _pause(self, _: String) -> None:
        """No light while it is wet."""

    def _complain(self) -> None:
        if not self._heard and self._ticks % _PATIENCE == 0:
            self.get_logger().warning("I do not know how bright it is")
        self._ticks += 1


GREENHOUSE = (Weather, Window, SoilProbe, Gardener, Lamp)


def add_greenhouse(session: Session) -> None:
    """Add the nodes of the greenhouse to a session."""
    for make in GREENHOUSE:
        session.add(make)


def observe_greenhouse() -> tuple[Observation, dict[str, Any]]:
    """Run a greenhouse in virtual time.

    Returns:
        The observation; and the value of each parameter that its nodes declare, by `/node name`.
    """
    with Session(seed=0) as session:
        add_greenhouse(session)
        session.run(seconds=_SECONDS, quiet=True)
        return session.observation(), _parameters(session)


def _parameters(session: Session) -> dict[str, Any]:
    return {
        f"{node.get_fully_qualified_name()} {name}": one.value
        for node in session.nodes
        for name, one in node._parameters.items()
        if name not in ("use_sim_time", "start_type_description_service")
    }
