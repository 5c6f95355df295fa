"""Define the nodes of the clinic: real rclpy nodes with real faults."""

from __future__ import annotations

from collections.abc import Callable

from rclpy.node import Node
from std_msgs.msg import Float32, String

from rosbeat.clinic.systems import (
    ANNOUNCER,
    DISPLAY,
    LOGGER,
    MONITOR,
    OVERSHOOT,
    SENSOR,
    STEP,
    NodeSpec,
    Specification,
)
from rosbeat.ros.tester import profile

#: From degrees Celsius.
_UNITS: dict[str, Callable[[float], float]] = {
    "Celsius": lambda value: value,
    "Fahrenheit": lambda value: value * 1.8 + 32.0,
    "Kelvin": lambda value: value + 273.15,
}


class _ClinicNode(Node):
    """What the nodes have in common: how they behave, and a line that says when they started.

    Args:
        own: How the node behaves.
        spec: What the owner ordered, such as limits.
    """

    def __init__(self, own: NodeSpec, spec: Specification) -> None:
        super().__init__(own.name)
        self._own, self._spec, self.count = own, spec, 0
        self._qos = profile(own.qos)
        self.get_logger().info(f"{own.name} started")


class Sensor(_ClinicNode):
    """Publish one reading or a burst of readings whenever the timer fires."""

    def __init__(self, own: NodeSpec, spec: Specification) -> None:
        super().__init__(own, spec)
        self.publisher = self.create_publisher(Float32, own.publishes, self._qos)
        self.timer = self.create_timer(own.period, self.publish_reading)
        self.calibration = [0.0] * own.calibrated

    def publish_reading(self) -> None:
        """Measure and publish."""
        for _ in range(self._spec.burst):
            value = self._measured() + self.calibration[self.count]
            self.count += 1
            if not self._own.mute:
                self.publisher.publish(Float32(data=_UNITS[self._own.unit](value)))
        if self.count >= self._own.stops_after:
            self.timer.cancel()

    def _measured(self) -> float:
        """The temperature, clamped to the limits."""
        own = self._own
        value = self._temperature()
        if own.clamp != "never":
            value = max(own.least, min(own.most, value))
        if own.clamp == "first":
            value += (-STEP, STEP, 0.0, STEP)[self.count % 4]
        return value

    def _temperature(self) -> float:
        """Steadily up and down, a little over both limits, so that every half degree comes."""
        own = self._own
        if own.stuck_at is not None:
            return own.stuck_at
        turn = round((own.most - own.least + 2 * OVERSHOOT) / own.step)
        at = (self.count + own.phase) % (2 * turn)
        return own.least - OVERSHOOT + own.step * float(min(at, 2 * turn - at))


class Monitor(_ClinicNode):
    """Publish a status for each reading that arrives."""

    def __init__(self, own: NodeSpec, spec: Specification) -> None:
        super().__init__(own, spec)
        self.create_subscription(Float32, own.subscribes, self.judge_reading, self._qos)
        self.publisher = self.create_publisher(String, own.publishes, 10)
        self.seen = {"Low": 0, "Normal": 0, "High": 0}
        if own.forgets_high:
            del self.seen["High"]

    def judge_reading(self, msg: Float32) -> None:
        """Find the status of a reading and publish it."""
        word = self._word(msg.data)
        self.seen[word] += 1
        self.count += 1
        if not self._own.mute and self.count <= self._own.stops_after:
            self.publisher.publish(String(data=f"{msg.data:.1f} {word}"))

    def _word(self, value: float) -> str:
        low, high, wrong = self._spec.low, self._spec.high, self._own.wrong_at_limit
        if value > high or (wrong == "High" and value == high):
            return "High"
        if value < low or (wrong == "Low" and value == low):
            return "Low"
        return "Normal"


class Display(_ClinicNode):
    """Log every status."""

    def __init__(self, own: NodeSpec, spec: Specification) -> None:
        super().__init__(own, spec)
        self.create_subscription(String, own.subscribes, self.show_status, self._qos)

    def show_status(self, msg: String) -> None:
        """Show one status."""
        self.get_logger().info(f"Light: {msg.data}")


class Logger(_ClinicNode):
    """Log every reading."""

    def __init__(self, own: NodeSpec, spec: Specification) -> None:
        super().__init__(own, spec)
        self.create_subscription(Float32, own.subscribes, self.keep_reading, self._qos)

    def keep_reading(self, msg: Float32) -> None:
        """Keep one reading."""
        self.count += 1
        if self.count > self._own.pages:
            raise OverflowError(f"all {self._own.pages} pages of the diary are full")
        self.get_logger().info(f"Kept {msg.data:.1f}")


class Announcer(_ClinicNode):
    """Publish the rule once, soon after the start."""

    def __init__(self, own: NodeSpec, spec: Specification) -> None:
        super().__init__(own, spec)
        self.publisher = self.create_publisher(String, own.publishes, self._qos)
        self.timer = self.create_timer(1.0, self.tell_rule)

    def tell_rule(self) -> None:
        """Publish the range of normal readings."""
        self.publisher.publish(String(data=f"{self._spec.low:g} to {self._spec.high:g}"))
        self.timer.cancel()


#: The class of each role.
NODE_CLASSES: dict[str, type[_ClinicNode]] = {
    SENSOR: Sensor,
    MONITOR: Monitor,
    DISPLAY: Display,
    LOGGER: Logger,
    ANNOUNCER: Announcer,
}
