"""The nodes that are measured."""

from __future__ import annotations

import random
import time

from rclpy.node import Node
from std_msgs.msg import Float32, Int64


class Source(Node):
    """Publishes `burst` messages each period."""

    def __init__(self, burst: int = 1, period: float = 0.001, name: str = "source") -> None:
        super().__init__(name)
        self.publisher = self.create_publisher(Float32, "flow", 10)
        self.message = Float32(data=1.5)
        self.burst = burst
        self.create_timer(period, self.send)

    def send(self) -> None:
        for _ in range(self.burst):
            self.publisher.publish(self.message)


class Sink(Node):
    """Counts what it hears."""

    def __init__(self) -> None:
        super().__init__("sink")
        self.count = 0
        self.subscription = self.create_subscription(Float32, "flow", self.hear, 10)

    def hear(self, _: Float32) -> None:
        self.count += 1


class Sensor(Node):
    """A random walk at 1 Hz, logged: what a first publisher looks like."""

    def __init__(self) -> None:
        super().__init__("sensor")
        self.publisher = self.create_publisher(Float32, "temperature", 10)
        self.value = 20.0
        self.create_timer(1.0, self.measure)

    def measure(self) -> None:
        self.value = min(30.0, max(10.0, self.value + random.uniform(-0.5, 0.5)))
        self.publisher.publish(Float32(data=self.value))
        self.get_logger().info(f"Publishing: {self.value:.2f}")


class Monitor(Node):
    """Judges the temperature, logged: what a first subscriber looks like."""

    def __init__(self) -> None:
        super().__init__("monitor")
        self.create_subscription(Float32, "temperature", self.judge, 10)

    def judge(self, message: Float32) -> None:
        state = "high" if message.data > 25 else "low" if message.data < 15 else "normal"
        self.get_logger().info(f"{message.data:.2f} is {state}")


class Pulse(Node):
    """Publishes the time at 100 Hz."""

    def __init__(self) -> None:
        super().__init__("pulse")
        self.publisher = self.create_publisher(Int64, "pulse", 10)
        self.create_timer(0.01, self.send)

    def send(self) -> None:
        self.publisher.publish(Int64(data=time.perf_counter_ns()))


class Stopwatch(Node):
    """Notes how long each message took, in nanoseconds."""

    def __init__(self) -> None:
        super().__init__("stopwatch")
        self.delays: list[int] = []
        self.create_subscription(Int64, "pulse", self.stop, 10)

    def stop(self, message: Int64) -> None:
        self.delays.append(time.perf_counter_ns() - message.data)


class Neighbour(Node):
    """One of many in a ring: hears the one before, is heard by the one after."""

    def __init__(self, number: int, total: int) -> None:
        super().__init__(f"node{number}")
        self.publisher = self.create_publisher(Float32, f"ring{number}", 10)
        self.heard = 0
        self.create_subscription(Float32, f"ring{(number - 1) % total}", self.hear, 10)
        self.create_timer(0.1 + 0.0001 * number, self.send)

    def send(self) -> None:
        self.publisher.publish(Float32(data=1.0))

    def hear(self, _: Float32) -> None:
        self.heard += 1
