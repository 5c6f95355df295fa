"""Answers to the exercises, right ones and wrong ones, as learners write them.

Each class is one answer. What it is wrong about stands in its name.
"""

import functools
import random

from rclpy.node import Node
from rclpy.qos import QoSProfile
from std_msgs.msg import Float32, Float64, String


class WeatherReader(Node):
    topic = "weather"

    def __init__(self):
        super().__init__("weather_reader")
        self.create_subscription(String, self.topic, self.read, 10)

    def read(self, msg):
        self.get_logger().info(msg.data)


class LambdaReader(Node):
    def __init__(self):
        super().__init__("anything")
        self.create_subscription(
            String, "/weather", lambda msg: print(msg.data), QoSProfile(depth=1)
        )


class ReaderOfAnotherTopic(WeatherReader):
    topic = "sports"


class ReaderWithALetterWrong(WeatherReader):
    topic = "wether"


class GreedyReader(WeatherReader):
    def __init__(self):
        super().__init__()
        self.create_subscription(String, "politics", self.read, 10)


class ReaderWithoutSubscription(Node):
    def __init__(self):
        super().__init__("weather_reader")


class UntouchedReader(Node):
    def __init__(self):
        super().__init__("weather_reader")
        self.create_subscription(String, ____, self.read, 10)  # noqa: F821


class SportsReporter(Node):
    topic, period = "sports", 2.0

    def __init__(self):
        super().__init__("sports_reporter")
        self.articles = self.create_publisher(String, self.topic, 10)
        self.create_timer(self.period, self.write)

    def write(self):
        self.articles.publish(String(data="Goal"))


class CountingReporter(Node):
    """One beat a second, every second one counts."""

    def __init__(self):
        super().__init__("reporter")
        self.beats, self.articles = 0, self.create_publisher(String, "/sports", 1)
        self.create_timer(1, functools.partial(self.beat, 1))

    def beat(self, step):
        self.beats += step
        if self.beats % 2 == 0:
            self.articles.publish(String(data=f"Goal {self.beats}"))


class HastyReporter(SportsReporter):
    period = 1.0


class ReporterOnAnotherTopic(SportsReporter):
    topic = "sport"


class SilentReporter(SportsReporter):
    def write(self):
        pass


class HumiditySensor(Node):
    kind, topic, period, depth = Float32, "humidity", 0.5, 5

    def __init__(self):
        super().__init__("humidity_sensor")
        self.publisher_ = self.create_publisher(self.kind, self.topic, self.depth)
        self.timer = self.create_timer(self.period, self.publish_humidity)

    def publish_humidity(self):
        self.publisher_.publish(self.kind(data=45.0))


class ParameterHumiditySensor(Node):
    def __init__(self):
        super().__init__("any_name")
        self.declare_parameter("period", 0.5)
        period = self.get_parameter("period").value
        publisher = self.create_publisher(Float32, "humidity", QoSProfile(depth=5))
        self.create_timer(period, lambda: publisher.publish(Float32(data=1.0)))


class SlowHumiditySensor(HumiditySensor):
    period = 1.0


class ShallowHumiditySensor(HumiditySensor):
    depth = 10


class DoubleHumiditySensor(HumiditySensor):
    kind = Float64


class TemperatureInsteadOfHumidity(HumiditySensor):
    topic = "temperature"


class HumidityWithoutTimer(HumiditySensor):
    def create_timer(self, *_):
        return None


class HumidityThatForgetsToPublish(HumiditySensor):
    def publish_humidity(self):
        pass


class HumidityThatCallsItsCallback(HumiditySensor):
    def __init__(self):
        super().__init__()
        self.create_timer(0.5, self.publish_humidity())


class HumidityWithoutQuotes(Node):
    def __init__(self):
        super().__init__("humidity_sensor")
        self.publisher_ = self.create_publisher(Float32, humidity, 5)  # noqa: F821


class HumidityWithSwappedArguments(Node):
    def __init__(self):
        super().__init__("humidity_sensor")
        self.create_publisher("humidity", Float32, 5)


class RoomSensor(Node):
    step, low, high = 0.3, 18.0, 28.0

    def __init__(self):
        super().__init__("temperature_sensor")
        self.publisher_ = self.create_publisher(Float32, "temperature", 10)
        self.create_timer(1.0, self.publish_temperature)
        self.temperature = 22.0

    def publish_temperature(self):
        self.temperature += random.uniform(-self.step, self.step)
        self.temperature = max(self.low, min(self.high, self.temperature))
        self.publisher_.publish(Float32(data=self.temperature))


class RoomSensorWithIfs(RoomSensor):
    def publish_temperature(self):
        temperature = self.temperature + 0.6 * (random.random() - 0.5)
        if temperature < 18:
            temperature = 18.0
        elif temperature > 28:
            temperature = 28.0
        self.temperature = temperature
        msg = Float32()
        msg.data = temperature
        self.publisher_.publish(msg)


class RoomWithTheTutorialsSlip(RoomSensor):
    low = 10.2


class RoomWithoutUpperLimit(RoomSensor):
    high = 99.0


class NarrowRoom(RoomSensor):
    low, high = 20.0, 26.0


class JumpyRoom(RoomSensor):
    step = 0.5


class LazyRoom(RoomSensor):
    step = 0.1


class ConstantRoom(RoomSensor):
    step = 0.0


class SwappedRoom(RoomSensor):
    def publish_temperature(self):
        self.temperature += random.uniform(-0.3, 0.3)
        self.temperature = min(18.0, max(28.0, self.temperature))
        self.publisher_.publish(Float32(data=self.temperature))


class RisingRoom(RoomSensor):
    def publish_temperature(self):
        self.temperature = min(28.0, self.temperature + 0.3)
        self.publisher_.publish(Float32(data=self.temperature))


class WholeRoom(RoomSensor):
    low, high = 18, 28


class FridgeMonitor(Node):
    def __init__(self):
        super().__init__("fridge_monitor")
        self.create_subscription(Float32, "temperature", self.temperature_callback, 10)

    def temperature_callback(self, msg):
        self.get_logger().info(f"Status:{self.status(msg.data)}")

    def status(self, temp):
        return "Warm" if temp > 8.0 else "Frost" if temp < 2.0 else "Fine"
