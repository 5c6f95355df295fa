"""A small system that a learner did not write: a greenhouse of five nodes.

Page 07 looks at it from outside. What there is to find is told by nothing but the nodes themselves.
"""

from __future__ import annotations

from typing import Any

from rclpy.node import Node
from std_msgs.msg import Float32, Int32, String

from rosbeat.records import Observation
from rosbeat.runtime.session import Session

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
