"""Define the nodes of the clinic: real rclpy nodes with real faults."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from rclpy.node import Node
from std_msgs.msg import Float32, String

from rosbeat.clinic.plans import DIARY, DISPLAY, GUARD, OVER, SENSOR, STEP, TEACHER, Orders, Part
from rosbeat.records import QoS
from rosbeat.ros.test_nodes import profile

#: From degrees Celsius.
_UNITS: dict[str, Callable[[float], float]] = {
    "Celsius": lambda value: value,
    "Fahrenheit": lambda value: value * 1.8 + 32.0,
    "Kelvin": lambda value: value + 273.15,
}


def maker(part: Part, orders: Orders) -> Callable[[], Node]:
    """Return a factory for the node of a part.

    Args:
        part: The part.
        orders: The owner's specification, such as limits.
    """
    kind = _ROLES[part.role]
    return lambda: kind(part, orders)


class _Member(Node):
    """What the nodes have in common: their part, and a line that says when they started."""

    def __init__(self, part: Part, orders: Orders) -> None:
        super().__init__(part.name)
        self._part, self._orders, self.count = part, orders, 0
        self.get_logger().info(f"{part.name} started")

    def option(self, name: str, default: Any) -> Any:  # noqa: ANN401 - an option is of any type
        return self._part.options.get(name, default)

    def quality(self) -> QoS:
        found: QoS = self.option("qos", QoS())
        return found


class Sensor(_Member):
    """Publish one reading or a burst of readings whenever the timer fires."""

    def __init__(self, part: Part, orders: Orders) -> None:
        super().__init__(part, orders)
        self.publisher = self.create_publisher(Float32, part.speaks, profile(self.quality()))
        self.timer = self.create_timer(self.option("period", orders.period), self.publish_reading)
        self.calibration = [0.0] * self.option("calibrated", 10_000)

    def publish_reading(self) -> None:
        """Measure and publish."""
        for _ in range(self._orders.burst):
            value = self._measured() + self.calibration[self.count]
            self.count += 1
            if not self.option("mute", False):
                self.publisher.publish(Float32(data=_UNITS[self.option("unit", "Celsius")](value)))
        if self.count >= self.option("stops_after", 10_000):
            self.timer.cancel()

    def _measured(self) -> float:
        """What it feels, held within its limits; the room's own steps are half a degree."""
        least: float = self.option("least", self._orders.least)
        most: float = self.option("most", self._orders.most)
        value = self._felt(least, most)
        clamp = self.option("clamp", "last")
        if clamp != "none":
            value = max(least, min(most, value))
        if clamp == "first":
            value += (-STEP, STEP, 0.0, STEP)[self.count % 4]
        return float(value)

    def _felt(self, least: float, most: float) -> float:
        """Steadily up and down, a little over both limits, so that every half degree comes."""
        if "stuck" in self._part.options:
            return float(self._part.options["stuck"])
        step: float = self.option("step", STEP)
        turn = round((most - least + 2 * OVER) / step)
        at = (self.count + self.option("phase", 0)) % (2 * turn)
        return least - OVER + step * float(min(at, 2 * turn - at))


class Guard(_Member):
    """Publish a status for each reading that arrives."""

    def __init__(self, part: Part, orders: Orders) -> None:
        super().__init__(part, orders)
        self.create_subscription(Float32, part.listens, self.judge_reading, profile(self.quality()))
        self.publisher = self.create_publisher(String, part.speaks, 10)
        self.seen = {"Low": 0, "Normal": 0, "High": 0}
        if self.option("forgets_high", False):
            del self.seen["High"]

    def judge_reading(self, msg: Float32) -> None:
        """Find the status of a reading and publish it."""
        word = self._word(msg.data)
        self.seen[word] += 1
        self.count += 1
        if self.option("mute", False) or self.count > self.option("stops_after", 10_000):
            return
        self.publisher.publish(String(data=f"{msg.data:.1f} {word}"))

    def _word(self, value: float) -> str:
        low, high = self._orders.low, self._orders.high
        if value > high or (self.option("high_too", False) and value == high):
            return "High"
        if value < low or (self.option("low_too", False) and value == low):
            return "Low"
        return "Normal"


class Display(_Member):
    """Log every status."""

    def __init__(self, part: Part, orders: Orders) -> None:
        super().__init__(part, orders)
        self.create_subscription(String, part.listens, self.show_status, profile(self.quality()))

    def show_status(self, msg: String) -> None:
        """Show one status."""
        self.get_logger().info(f"Light: {msg.data}")


class Diary(_Member):
    """Log every reading."""

    def __init__(self, part: Part, orders: Orders) -> None:
        super().__init__(part, orders)
        self.create_subscription(Float32, part.listens, self.keep_reading, profile(self.quality()))

    def keep_reading(self, msg: Float32) -> None:
        """Keep one reading."""
        self.count += 1
        if self.count > self.option("pages", 10_000):
            raise OverflowError(f"all {self.option('pages', 0)} pages of the diary are full")
        self.get_logger().info(f"Kept {msg.data:.1f}")


class Teacher(_Member):
    """Publish a rule once, soon after the start."""

    def __init__(self, part: Part, orders: Orders) -> None:
        super().__init__(part, orders)
        self.publisher = self.create_publisher(String, part.speaks, profile(self.quality()))
        self.timer = self.create_timer(1.0, self.tell_rule)

    def tell_rule(self) -> None:
        """Publish the range of normal readings."""
        self.publisher.publish(String(data=f"{self._orders.low:g} to {self._orders.high:g}"))
        self.timer.cancel()


_ROLES: dict[str, type[_Member]] = {
    SENSOR: Sensor,
    GUARD: Guard,
    DISPLAY: Display,
    DIARY: Diary,
    TEACHER: Teacher,
}
