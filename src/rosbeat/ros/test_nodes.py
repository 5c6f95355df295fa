"""Create nodes of the course's own: beside an answer, for a bag that is played, for the panel."""

from __future__ import annotations

import time
from collections import deque
from collections.abc import Callable, Iterable, Sequence
from functools import partial
from itertools import islice
from math import nan
from random import Random
from typing import Any, NamedTuple

from rclpy.context import Context
from rclpy.node import Node
from rclpy.publisher import Publisher
from rclpy.timer import Timer
from std_msgs.msg import Bool, Float32, Int32, String

from rosbeat.errors import SessionError
from rosbeat.records import Observation, QoS
from rosbeat.ros.isolation import tilt
from rosbeat.ros.recording import Message, message_class
from rosbeat.ros.session import Session
from rosbeat.ros.tester import BARE, message, profile

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


# A node that plays a recording.


#: Makes a node; `Session.add` takes it.
NodeFactory = Callable[[], Node]


class PlayedTopic(NamedTuple):
    """Describe a topic to publish on: its full name, its type and the QoS to offer."""

    topic: str
    type_name: str
    qos: QoS


class PlayedStep(NamedTuple):
    """Describe what to publish in one callback.

    `time_ns` counts from the creation of the node. `messages` holds pairs of a topic's index and a
    serialized message.
    """

    time_ns: int
    messages: tuple[tuple[int, bytes], ...]


def player(name: str, topics: Sequence[PlayedTopic], steps: Sequence[PlayedStep]) -> NodeFactory:
    """Return a class of node that publishes prepared messages at prepared times.

    All that one of the `steps`, which are in order of time, causes is over before the next one
    begins, also at the same instant.

    Raises:
        SessionError: If no installed package has a topic's type.
    """
    classes = [_class_of(topic) for topic in topics]

    class Player(Node):
        """Publishes what was recorded."""

        #: Its timer is reset at each step, and comes before those of nodes that were made later.
        keeps_turn = True

        def __init__(self) -> None:
            super().__init__(name)
            self._topic_publishers = [
                self.create_publisher(kind, one.topic, profile(one.qos))
                for kind, one in zip(classes, topics, strict=True)
            ]
            self._begun, self._left = self.get_clock().now(), deque(steps)
            if steps:
                self._step_timer = self.create_timer(steps[0].time_ns / 1e9, self._play)
                self._schedule()

        def _play(self) -> None:
            for topic, data in self._left.popleft().messages:
                self._topic_publishers[topic].publish(data)
            self._schedule()

        def _schedule(self) -> None:
            if not self._left:
                self._step_timer.cancel()
                return
            elapsed = (self.get_clock().now() - self._begun).nanoseconds
            self._step_timer.timer_period_ns = max(0, self._left[0].time_ns - elapsed)
            self._step_timer.reset()

    return Player


def _class_of(topic: PlayedTopic) -> type:
    try:
        return message_class(topic.type_name)
    except (ImportError, AttributeError, ValueError) as error:
        raise SessionError(
            f"Messages of the type {topic.type_name} cannot be published here.",
            f"{topic.topic} has this type, but no package that defines the type is installed.",
            "Build and source the package that defines the type.",
        ) from error


# What the instrument panel adds to a live session: a node, and faults on topics.


#: The name of the node through which the panel publishes.
INJECTOR = "instrument_panel"


class Injector(Node):
    """Publish numbers on topics, once or every second, and run a slow callback on request.

    The injector appears in the graph like any other node, because subscriptions do receive its
    messages.
    """

    def __init__(self, context: Context) -> None:
        super().__init__(INJECTOR, context=context, start_parameter_services=False)
        self._publishers_by_topic: dict[str, Any] = {}
        self._repeated: dict[str, float] = {}
        self._repeat_timer: Timer | None = None
        self._load_timer: Timer | None = None
        self._load_s = 0.0

    def send(self, topic: str, type_name: str, value: float) -> None:
        """Publish one number on a topic of a type with a field `data` for a number."""
        if topic not in self._publishers_by_topic:
            kind = message_class(type_name)
            self._publishers_by_topic[topic] = self.create_publisher(kind, topic, 10)
        self._publish(topic, value)
        if topic in self._repeated:
            self._repeated[topic] = value

    def repeat(self, topic: str, value: float | None) -> None:
        """Publish a number every second on a topic of which `send` knows the type; None ends it."""
        if value is None:
            self._repeated.pop(topic, None)
        else:
            self._repeated[topic] = value
            self._repeat_timer = self._repeat_timer or self.create_timer(1.0, self._send_again)

    def load(self, milliseconds: float) -> None:
        """Run a callback for so long, once a second; 0 ends that."""
        self._load_s = milliseconds / 1000
        self._load_timer = self._load_timer or self.create_timer(1.0, self._work)

    def _work(self) -> None:
        # This blocks the executor as a computation does, and leaves the processor to the page.
        time.sleep(self._load_s)

    def _send_again(self) -> None:
        for topic, value in list(self._repeated.items()):
            self._publish(topic, value)

    def _publish(self, topic: str, value: float) -> None:
        publisher = self._publishers_by_topic[topic]
        publisher.publish(publisher.msg_type(data=value))


class TopicFault:
    """Drop or change what nodes publish on one topic.

    The fault applies between a node and its publisher, before recording, so the recording contains
    what was really sent.

    Attributes:
        kind: `none`, `dropout`, `nan` or `offset`.
        amount: Of a dropout, the share of lost messages in percent; of an offset, the number to
            add.
    """

    def __init__(self, topic: str) -> None:
        self.kind, self.amount = "none", 0.0
        self._topic = topic
        # Its own generator, so that the numbers which the nodes draw stay as they are.
        self._random = Random(0)
        self._originals: dict[Publisher, Callable[[Any], None]] = {}

    def apply(self, publishers: Iterable[Publisher]) -> None:
        """Disturb these publishers, too, as far as they are on the topic."""
        for publisher in publishers:
            if publisher.topic_name == self._topic and publisher not in self._originals:
                self._originals[publisher] = publisher.publish
                publisher.publish = partial(self._publish, publisher.publish)

    def remove(self) -> None:
        """Let every publisher publish as before."""
        self.kind = "none"
        for publisher, publish in self._originals.items():
            publisher.publish = publish
        self._originals.clear()

    def _publish(self, send: Callable[[Message], None], msg: Message) -> None:
        if self.kind == "dropout" and self._random.uniform(0, 100) < self.amount:
            return
        send(self._changed(msg))

    def _changed(self, msg: Message) -> Message:
        value = getattr(msg, "data", None)
        if not isinstance(value, float):  # bytes, or what rclpy refuses in its own words
            return msg
        if self.kind == "nan":
            return type(msg)(data=nan)
        return type(msg)(data=value + self.amount) if self.kind == "offset" else msg
