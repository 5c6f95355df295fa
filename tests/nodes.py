"""Small nodes that the tests put together."""

from collections.abc import Callable
from functools import partial
from typing import Any

from rclpy.node import Node
from std_msgs.msg import Int32, String
from std_srvs.srv import Trigger

SECOND = 1_000_000_000


class Talker(Node):
    """Counts upwards on a topic, `burst` messages each period."""

    def __init__(
        self,
        name: str = "talker",
        topic: str = "count",
        period: float = 1.0,
        burst: int = 1,
        qos: Any = 10,
    ) -> None:
        super().__init__(name)
        self.burst = burst
        self.count = 0
        self.publisher = self.create_publisher(Int32, topic, qos)
        self.timer = self.create_timer(period, self.talk)

    def talk(self) -> None:
        for _ in range(self.burst):
            self.count += 1
            self.publisher.publish(Int32(data=self.count))


class Listener(Node):
    """Remembers what it hears, and when."""

    def __init__(self, name: str = "listener", topic: str = "count", qos: Any = 10) -> None:
        super().__init__(name)
        self.heard: list[int] = []
        self.times: list[int] = []
        self.subscription = self.create_subscription(Int32, topic, self.listen, qos)

    def listen(self, message: Int32) -> None:
        self.heard.append(message.data)
        self.times.append(since_start(self))


class Relay(Node):
    """Sends on what it hears, one higher."""

    def __init__(self, name: str, source: str, target: str, copies: int = 1) -> None:
        super().__init__(name)
        self.copies = copies
        self.publisher = self.create_publisher(Int32, target, 10)
        self.create_subscription(Int32, source, self.relay, 10)

    def relay(self, message: Int32) -> None:
        for _ in range(self.copies):
            self.publisher.publish(Int32(data=message.data + 1))


class Ticker(Node):
    """Has timers of the given periods, in seconds, and remembers when each fired."""

    def __init__(self, *periods: float, name: str = "ticker") -> None:
        super().__init__(name)
        self.fired: list[tuple[int, int]] = []
        self.clocks = [self.create_timer(p, partial(self.tick, n)) for n, p in enumerate(periods)]

    def tick(self, number: int) -> None:
        self.fired.append((since_start(self), number))

    def times(self, number: int = 0) -> list[int]:
        return [at for at, which in self.fired if which == number]


class Doer(Node):
    """Does one thing once, or again and again, in a timer's callback."""

    def __init__(
        self, do: Callable[["Doer"], Any], name: str = "doer", period: float = 1.0
    ) -> None:
        super().__init__(name)
        self.do = do
        self.timer = self.create_timer(period, self.act)

    def act(self) -> Any:
        return self.do(self)


class AsyncDoer(Doer):
    """The same with a coroutine."""

    async def act(self) -> Any:
        return await self.do(self)


class Server(Node):
    """Answers `/ask` with how often it was asked."""

    def __init__(self, name: str = "server", service: str = "ask") -> None:
        super().__init__(name)
        self.asked = 0
        self.create_service(Trigger, service, self.answer)

    def answer(self, _: Trigger.Request, response: Trigger.Response) -> Trigger.Response:
        self.asked += 1
        response.success, response.message = True, str(self.asked)
        return response


class Speaker(Node):
    """Logs its own name each period."""

    def __init__(self, name: str = "speaker", period: float = 1.0) -> None:
        super().__init__(name)
        self.create_timer(period, self.speak)

    def speak(self) -> None:
        self.get_logger().info(f"here is {self.get_name()}")


class Words(Node):
    """Publishes one text a second."""

    def __init__(self, text: str = "hello", name: str = "words", topic: str = "text") -> None:
        super().__init__(name)
        self.text = text
        self.publisher = self.create_publisher(String, topic, 10)
        self.create_timer(1.0, self.say)

    def say(self) -> None:
        self.publisher.publish(String(data=self.text))


def since_start(node):
    """Return the nanoseconds since the session began, by a node's own clock."""
    from rosbeat.ros.clock import START  # here, so that the lines above stay where they are

    return node.get_clock().now().nanoseconds - START * SECOND
