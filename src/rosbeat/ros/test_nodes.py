"""Nodes that scenarios put beside an answer."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from typing import Any

from rclpy.duration import Duration
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, HistoryPolicy, QoSProfile, ReliabilityPolicy
from std_msgs.msg import Bool, Float32, Int32, String

from rosbeat.records import Observation, QoS
from rosbeat.ros.randomness import tilt
from rosbeat.ros.recording import message_class
from rosbeat.ros.session import Session

# Nodes that publish what they were given.


#: How a node begins that only keeps an answer company: without the six services for its parameters,
#: which nobody asks and which are two thirds of what a node costs (measured: 11 of 16 ms).
BARE = {"start_parameter_services": False}


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


# Sensors that say what they are told, once a second, and may be silent for a while.


_FLOAT = "std_msgs/msg/Float32"


def station(name: str, topic: str, readings: Iterable[float | None]) -> Callable[[], Node]:
    """A sensor that publishes one `Float32` a second, the first after one second.

    Args:
        name: The node's name.
        topic: Where it publishes.
        readings: What it says, in order; None is a second without a message. Then it is silent.

    Returns:
        A class, for `Session.add` or a scenario.
    """
    told = tuple(readings)

    class Station(Node):
        """Says what it was told."""

        def __init__(self) -> None:
            super().__init__(name, **BARE)
            self._left = iter(told)
            self._publisher = self.create_publisher(message_class(_FLOAT), topic, 10)
            self.create_timer(1.0, self._send)

        def _send(self) -> None:
            value = next(self._left, None)
            if value is not None:
                self._publisher.publish(message(_FLOAT, float(value)))

    return Station


# A room with a heater, for scenarios: whole degrees, so that nothing depends on rounding.


#: Seconds in which a room loses one degree while it is not heated.
_COOLS_IN = 5


def room(degrees: int) -> Callable[[], Node]:
    """A node that publishes its temperature each second.

    It gains one degree a second while the last message on `heater` was True, and else loses one
    in five seconds.

    Args:
        degrees: Where it begins.

    Returns:
        A function that makes the node, for `Session.add` or `observe`.
    """

    class Room(Node):
        """A room."""

        def __init__(self) -> None:
            super().__init__("room")
            self._degrees, self._heating, self._cold = degrees, False, 0
            self._readings = self.create_publisher(Float32, "temperature", 10)
            self.create_subscription(Bool, "heater", self._switch, 10)
            self.create_timer(1.0, self._let_a_second_pass)

        def _switch(self, message: Bool) -> None:
            self._heating = bool(message.data)

        def _let_a_second_pass(self) -> None:
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


#: The node that makes the drift; a judge may want to tell it from the learner's.
NAME = "weather"
_AT_ONCE = 1e-6


def drift(phases: Sequence[tuple[float, float]]) -> Callable[[], Node]:
    """A node that tilts what the nodes beside it draw with the functions of Python's `random`.

    NumPy's generators stay as they are, and so does a `random.Random` of a node's own.

    Args:
        phases: How long each lasts, in virtual seconds, and its exponent; see `tilt`. There is at
            least one, and the last one stays until the session's `run` returns.

    Returns:
        A function that makes the node, for `Session.add` or `observe`.
    """

    class Weather(Node):
        """Turns the tendency at the end of each phase."""

        def __init__(self) -> None:
            super().__init__(NAME, **BARE)
            self._left = list(phases)
            # A tilt lasts until the call of the session ends that set it, so not from here.
            self._next = self.create_timer(_AT_ONCE, self._turn)

        def _turn(self) -> None:
            self.destroy_timer(self._next)
            seconds, exponent = self._left.pop(0)
            tilt(exponent)
            if self._left:
                self._next = self.create_timer(seconds, self._turn)

    return Weather


# Nodes that say in their log what they hear.


def hearer(name: str, topic: str, type_name: str, qos: QoS | int = 10) -> Callable[[], Node]:
    """A node that logs the field `data` of each message that it gets, and nothing else.

    Args:
        name: The node's name.
        topic: Where it listens.
        type_name: A message type with a field `data`, such as `std_msgs/msg/String`.
        qos: The quality of service that it asks for, or the depth of its queue.

    Returns:
        A function that makes the node, for `Session.add`, `observe` or the step `Add`.
    """

    class Hearer(Node):
        """Logs what it hears."""

        def __init__(self) -> None:
            super().__init__(name, **BARE)
            self.create_subscription(message_class(type_name), topic, self._hear, profile(qos))

        def _hear(self, message: Any) -> None:  # noqa: ANN401 - a message of any type
            self.get_logger().info(str(message.data))

    return Hearer


# A small system that a learner did not write: a greenhouse of five nodes.
#
# Page 07 looks at it from outside. What there is to find is told by nothing but the nodes
# themselves.


#: Virtual seconds after which everything has happened at least once.
SECONDS = 20.0
_WETTEST, _DRIEST = 60, 30
#: Seconds from one complaint to the next.
_PATIENCE = 30


class Weather(Node):
    """A still day: temperature and light, always the same."""

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
    """How wet the soil is, in per cent: it dries, and is wet again."""

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


def settle(session: Session) -> None:
    """Add the nodes of the greenhouse to a session."""
    for make in GREENHOUSE:
        session.add(make)


def watched() -> tuple[Observation, dict[str, Any]]:
    """Run a greenhouse of one's own in virtual time and write down what it does.

    Returns:
        What was seen; and the value of each parameter that its nodes declare, by `/node name`.
    """
    with Session(seed=0) as session:
        settle(session)
        session.run(seconds=SECONDS, quiet=True)
        return session.observation(), _parameters(session)


def _parameters(session: Session) -> dict[str, Any]:
    return {
        f"{node.get_fully_qualified_name()} {name}": one.value
        for node in session.nodes
        for name, one in node._parameters.items()
        if name not in ("use_sim_time", "start_type_description_service")
    }
