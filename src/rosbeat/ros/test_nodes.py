"""Create the nodes that scenarios run beside an answer."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from itertools import islice
from typing import Any

from rclpy.duration import Duration
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, HistoryPolicy, QoSProfile, ReliabilityPolicy
from rclpy.timer import Timer
from std_msgs.msg import Bool, Float32, Int32, String

from rosbeat.records import Observation, QoS
from rosbeat.ros.randomness import tilt
from rosbeat.ros.recording import message_class
from rosbeat.ros.session import Session

#: Options of a test node: the six parameter services take two thirds of the time to make a node.
BARE = {"start_parameter_services": False}


def message(type_name: str, value: Any) -> Any:  # noqa: ANN401 - a message of any type
    """Return a message whose field `data` is a value, or whose fields are those of a dict."""
    fields = value if isinstance(value, dict) else {"data": value}
    return message_class(type_name)(**fields)


def profile(qos: QoS | int) -> QoSProfile:
    """Return the QoS profile of a record, or of a queue depth; ROS's defaults for unknown parts."""
    if isinstance(qos, int):
        return QoSProfile(depth=qos)
    best_effort, stored = qos.reliability == "BEST_EFFORT", qos.durability == "TRANSIENT_LOCAL"
    limits = {"deadline": qos.deadline_ns, "lifespan": qos.lifespan_ns}
    return QoSProfile(
        reliability=ReliabilityPolicy.BEST_EFFORT if best_effort else ReliabilityPolicy.RELIABLE,
        durability=DurabilityPolicy.TRANSIENT_LOCAL if stored else DurabilityPolicy.VOLATILE,
        history=HistoryPolicy.KEEP_ALL if qos.history == "KEEP_ALL" else HistoryPolicy.KEEP_LAST,
        depth=qos.depth or 10,
        **{name: Duration(nanoseconds=limit) for name, limit in limits.items() if limit},
    )


class Tester(Node):
    """Publish messages for a test, now or later."""

    def __init__(self) -> None:
        super().__init__("tester", **BARE)
        self._by_topic: dict[tuple[str, type], Any] = {}

    def publish(self, topic: str, value: Any, qos: QoSProfile, wait: float | None) -> None:  # noqa: ANN401 - a message
        """Publish a message after so many seconds, or at once if that is None."""
        key = topic, type(value)
        if key not in self._by_topic:
            self._by_topic[key] = self.create_publisher(type(value), topic, qos)
        if wait is None:
            self._by_topic[key].publish(value)
            return

        def once() -> None:
            timer.cancel()
            self._by_topic[key].publish(value)

        timer = self.create_timer(wait, once)


# Nodes of one callback or two.


def _node(name: str, prepare: Callable[[Node], None]) -> Callable[[], Node]:
    """Return a function that makes a node, and its entities with `prepare`."""

    def make() -> Node:
        node = Node(name, **BARE)
        prepare(node)
        return node

    return make


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
    """Return a function that makes a node that publishes value after value.

    Args:
        name: The node's name.
        topic: The topic.
        type_name: The message type, such as `std_msgs/msg/Float32`.
        values: See `message`; None is a turn without a message.
        period: Virtual seconds from one to the next, and before the first.
        burst: How many are published each time, at one instant.
        qos: The publisher's quality of service, or the depth of its queue.
    """
    messages = [None if value is None else message(type_name, value) for value in values]

    def prepare(node: Node) -> None:
        left = iter(messages)
        publisher = node.create_publisher(message_class(type_name), topic, profile(qos))

        def _send() -> None:
            for one in islice(left, burst):
                if one is not None:
                    publisher.publish(one)

        node.create_timer(period, _send)

    return _node(name, prepare)


def listener(name: str, topic: str, type_name: str, qos: QoS | int = 10) -> Callable[[], Node]:
    """Return a function that makes a node that logs the field `data` of each message."""

    def prepare(node: Node) -> None:
        def _receive(message: Any) -> None:  # noqa: ANN401 - a message of any type
            node.get_logger().info(str(message.data))

        node.create_subscription(message_class(type_name), topic, _receive, profile(qos))

    return _node(name, prepare)


def drift(phases: Sequence[tuple[float, float]]) -> Callable[[], Node]:
    """Return a function that makes a node that tilts the numbers of Python's `random`.

    A free random walk may take hours to meet both of its limits, and a check cannot wait. So the
    numbers drift: up for a while, down for a while, then freely. Each of them could have been drawn
    anyway. NumPy's generators and a `random.Random` of a node's own stay as they are.

    Args:
        phases: How long each lasts, in virtual seconds, and its exponent; see `tilt`. The last one
            stays until the session's `run` returns.
    """

    def prepare(node: Node) -> None:
        left = list(phases)
        timer: Timer

        def _next_phase() -> None:
            nonlocal timer
            node.destroy_timer(timer)
            seconds, exponent = left.pop(0)
            tilt(exponent)
            if left:
                timer = node.create_timer(seconds, _next_phase)

        # A tilt lasts until the call of the session ends that set it, so it is not set here.
        timer = node.create_timer(1e-6, _next_phase)

    return _node("weather", prepare)


class Room(Node):
    """Publish the temperature of a heated room each second, in whole degrees.

    It rises by one degree a second while the last message on `heater` was True, and otherwise falls
    by one degree in five seconds.
    """

    def __init__(self, degrees: int) -> None:
        super().__init__("room")
        self._degrees, self._heating, self._cold = degrees, False, 0
        self._temperature = self.create_publisher(Float32, "temperature", 10)
        self.create_subscription(Bool, "heater", self._switch, 10)
        self.create_timer(1.0, self._measure)

    def _switch(self, message: Bool) -> None:
        self._heating = bool(message.data)

    def _measure(self) -> None:
        if self._heating:
            self._degrees += 1
        else:
            self._cold += 1
            self._degrees -= self._cold % 5 == 0
        self._temperature.publish(Float32(data=float(self._degrees)))


# A greenhouse of five nodes, which page 07 examines from outside.


class Weather(Node):
    """Publish temperature and light of a calm day, always the same values."""

    def __init__(self) -> None:
        super().__init__("weather")
        self._temperature = self.create_publisher(Float32, "temperature", 10)
        self._light = self.create_publisher(Float32, "lights", 10)
        self.create_timer(0.5, self._measure)

    def _measure(self) -> None:
        self._temperature.publish(Float32(data=23.0))
        self._light.publish(Float32(data=800.0))


class Window(Node):
    """Publish whether the window is open, which depends on the temperature."""

    def __init__(self) -> None:
        super().__init__("window")
        self.declare_parameter("open_above", 25.0)
        self._state = self.create_publisher(String, "window_state", 10)
        self.create_subscription(Float32, "temperature", self._look, 10)

    def _look(self, msg: Float32) -> None:
        is_open = msg.data > self.get_parameter("open_above").value
        self._state.publish(String(data="open" if is_open else "shut"))


class SoilProbe(Node):
    """Publish the soil moisture in percent, which falls steadily and then jumps back."""

    def __init__(self) -> None:
        super().__init__("soil_probe")
        self._moisture = self.create_publisher(Int32, "moisture", 10)
        self._percent = 60
        self.create_timer(0.2, self._measure)

    def _measure(self) -> None:
        self._percent = self._percent - 1 if self._percent > 30 else 60
        self._moisture.publish(Int32(data=self._percent))


class Gardener(Node):
    """Publish whether to water, which depends on the soil moisture."""

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
    """Listen on the topic `light`, on which nothing is published, and complain about it."""

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
        if not self._heard and self._ticks % 30 == 0:
            self.get_logger().warning("I do not know how bright it is")
        self._ticks += 1


GREENHOUSE = (Weather, Window, SoilProbe, Gardener, Lamp)


def add_greenhouse(session: Session) -> None:
    """Add the nodes of the greenhouse to a session."""
    for make in GREENHOUSE:
        session.add(make)


def observe_greenhouse() -> tuple[Observation, dict[str, Any]]:
    """Run the greenhouse; return what happened, and the parameters by `/node name`."""
    with Session(seed=0) as session:
        add_greenhouse(session)
        session.run(seconds=20.0, quiet=True)  # everything has happened by then
        parameters = {
            f"{node.get_fully_qualified_name()} {name}": one.value
            for node in session.nodes
            for name, one in node.get_parameters_by_prefix("").items()
            if name not in ("use_sim_time", "start_type_description_service")
        }
        return session.observation(), parameters
