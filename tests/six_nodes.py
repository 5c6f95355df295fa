"""A program of six nodes that uses a little of everything; run as a script it prints its digest."""

import random
from functools import partial

from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from std_msgs.msg import Float32, String
from std_srvs.srv import Trigger

from digests import digest
from nodes import SECOND, Relay, Server, Speaker, since_start
from rosbeat import Session
from rosbeat.records import Observation

#: What every run on every Python must give. It changes with the program or the records, only.
DIGEST = "c1aa33bdada538bef13bb7f52be1a745734df7bd447aa56be0d4765cfaa56fce"
LATCHED = QoSProfile(depth=3, durability=DurabilityPolicy.TRANSIENT_LOCAL)


class Walker(Node):
    """Walks at random, and makes a second timer on its way."""

    def __init__(self) -> None:
        super().__init__("walker")
        self.value = 20.0
        self.walk = self.create_publisher(Float32, "walk", 10)
        self.news = self.create_publisher(String, "news", LATCHED)
        self.create_timer(0.3, self.step)

    def step(self) -> None:
        self.value += random.uniform(-0.5, 0.5)
        self.walk.publish(Float32(data=self.value))
        if since_start(self) == 3 * SECOND:
            self.create_timer(0.07, lambda: self.news.publish(String(data=f"{self.value:.3f}")))


class Asker(Node):
    """Awaits an answer for every third step, logs it and publishes a number."""

    def __init__(self) -> None:
        super().__init__("asker")
        group = ReentrantCallbackGroup()
        self.client = self.create_client(Trigger, "ask", callback_group=group)
        self.heard = 0
        self.first = self.create_publisher(Relay_type(), "first", 10)
        self.create_subscription(Float32, "walk", self.hear, 5, callback_group=group)

    async def hear(self, message: Float32) -> None:
        self.heard += 1
        if self.heard % 3 == 0:
            answer = await self.client.call_async(Trigger.Request())
            self.get_logger().info(f"{message.data:.6f} {answer.message}")
            self.first.publish(Relay_type()(data=self.heard))


def Relay_type() -> type:  # noqa: N802 - stands for a class
    from std_msgs.msg import Int32

    return Int32


class LateReader(Node):
    """Joins late, and reads what was stored."""

    def __init__(self) -> None:
        super().__init__("late_reader")
        self.create_timer(5.01, self.join)

    def join(self) -> None:
        self.create_subscription(
            String, "news", lambda message: self.get_logger().warning(message.data), LATCHED
        )


def observe(seconds: float = 12.0) -> Observation:
    """Run the program once."""
    with Session(seed=7) as ros:
        for node in (
            Walker, Asker, Server, partial(Relay, "relay", "first", "second"),
            partial(Speaker, "speaker", 0.3), LateReader,
        ):  # fmt: skip
            ros.add(node)
        ros.run(seconds, quiet=True)
        return ros.observation()


if __name__ == "__main__":
    print(digest(observe()))
