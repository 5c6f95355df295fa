"""03b, a living room: right answers, in many styles."""

from bank.answer import edited, right

BASE = """
    class RoomSensor(Node):
        def __init__(self):
            super().__init__("temperature_sensor")
            self.publisher_ = self.create_publisher(Float32, "temperature", 10)
            self.timer = self.create_timer(1.0, self.publish_temperature)
            self.temperature = 22.0

        def publish_temperature(self):
            self.temperature += random.uniform(-0.3, 0.3)
            self.temperature = max(18.0, min(28.0, self.temperature))
            self.publisher_.publish(Float32(data=self.temperature))
"""
_STEP = "self.temperature += random.uniform(-0.3, 0.3)"
_CLAMP = "self.temperature = max(18.0, min(28.0, self.temperature))"
_SEND = "self.publisher_.publish(Float32(data=self.temperature))"


def _right(name, *edits):
    return right("03b", name, edited(BASE, *edits))


ANSWERS = (
    _right("min outside", (_CLAMP, "self.temperature = min(28.0, max(18.0, self.temperature))")),
    _right("in three steps, with a log line",
           (_SEND, "msg = Float32()\n        msg.data = self.temperature\n"
                   "        self.publisher_.publish(msg)\n"
                   '        self.get_logger().info(f"Publishing: {self.temperature:.2f}C")')),
    _right("if and elif",
           (_CLAMP, "if self.temperature > 28.0:\n            self.temperature = 28.0\n"
                    "        elif self.temperature < 18.0:\n            self.temperature = 18.0")),
    _right("ints for limits, and float in the message",
           (_CLAMP, "self.temperature = max(18, min(28, self.temperature))"),
           ("data=self.temperature", "data=float(self.temperature)")),
    _right("one expression",
           (f"{_STEP}\n        {_CLAMP}",
            "self.temperature = max(18.0, min(28.0, self.temperature + "
            "random.uniform(-0.3, 0.3)))")),
    _right("random.random, scaled",
           (_STEP, "self.temperature = self.temperature + (random.random() - 0.5) * 0.6")),
    _right("a choice of two steps", (_STEP, "self.temperature += random.choice([-0.3, 0.3])")),
    _right("hundredths", (_STEP, "self.temperature += random.randint(-30, 30) / 100")),
    _right("up or down, and how far",
           (_STEP, "step = random.uniform(0.0, 0.3)\n        "
                   "self.temperature += step if random.random() < 0.5 else -step")),
    _right("a triangular step", (_STEP, "self.temperature += random.triangular(-0.3, 0.3)")),
    _right("a generator of its own",
           ("self.temperature = 22.0", "self.temperature = 22.0\n        "
                                       "self.random = random.Random(42)"),
           ("random.uniform", "self.random.uniform")),
    _right("numpy's global generator",
           ("class R", "import numpy as np\n\nclass R"),
           ("random.uniform", "np.random.uniform"),
           (_CLAMP, "self.temperature = float(np.clip(self.temperature, 18.0, 28.0))")),
    _right("a generator of numpy's",
           ("class R", "import numpy as np\n\nRNG = np.random.default_rng(3)\n\nclass R"),
           ("random.uniform", "RNG.uniform")),
    _right("sorted", (_CLAMP, "self.temperature = sorted((18.0, self.temperature, 28.0))[1]")),
    _right("a step that is refused at a limit",
           (f"{_STEP}\n        {_CLAMP}",
            "new = self.temperature + random.uniform(-0.3, 0.3)\n"
            "        if 18.0 <= new <= 28.0:\n            self.temperature = new")),
    _right("a wall that reflects",
           (_CLAMP, "if self.temperature > 28.0:\n"
                    "            self.temperature = 56.0 - self.temperature\n"
                    "        if self.temperature < 18.0:\n"
                    "            self.temperature = 36.0 - self.temperature")),
    _right("the profile for sensor data",
           ("class R", "from rclpy.qos import qos_profile_sensor_data\n\nclass R"),
           ('"temperature", 10', '"temperature", qos_profile_sensor_data')),
    right("03b", "a property that clamps", '''
        class RoomSensor(Node):
            LOW, HIGH, STEP = 18.0, 28.0, 0.3

            def __init__(self) -> None:
                super().__init__("room_sensor")
                self._temperature = 22.0
                self._out = self.create_publisher(Float32, "/temperature", 1)
                self.create_timer(1.0, self._tick)

            @property
            def temperature(self) -> float:
                return self._temperature

            @temperature.setter
            def temperature(self, value: float) -> None:
                self._temperature = max(self.LOW, min(self.HIGH, value))

            def _tick(self) -> None:
                self.temperature += random.uniform(-self.STEP, self.STEP)
                self._out.publish(Float32(data=self.temperature))
    '''),
    right("03b", "a helper that walks, a dataclass", '''
        from dataclasses import dataclass

        @dataclass
        class Walk:
            value: float
            low: float
            high: float
            step: float

            def next(self) -> float:
                moved = self.value + random.uniform(-self.step, self.step)
                self.value = min(self.high, max(self.low, moved))
                return self.value

        class RoomSensor(Node):
            def __init__(self):
                super().__init__("temperature_sensor")
                self.walk = Walk(22.0, 18.0, 28.0, 0.3)
                self.publisher_ = self.create_publisher(Float32, "temperature", 10)
                self.create_timer(1.0, lambda: self.publisher_.publish(
                    Float32(data=self.walk.next())))
    '''),
    right("03b", "a generator function", '''
        def walk(value, low, high, step):
            while True:
                value = max(low, min(high, value + random.uniform(-step, step)))
                yield value

        class RoomSensor(Node):
            def __init__(self):
                super().__init__("temperature_sensor")
                self.publisher_ = self.create_publisher(Float32, "temperature", 10)
                self.values = walk(22.0, 18.0, 28.0, 0.3)
                self.timer = self.create_timer(1.0, self.publish_temperature)

            def publish_temperature(self):
                self.publisher_.publish(Float32(data=next(self.values)))
    '''),
    right("03b", "the page's own sensor as a base, and parameters", '''
        class SteadySensor(Node):
            def __init__(self):
                super().__init__("temperature_sensor")
                self.publisher_ = self.create_publisher(Float32, "temperature", 10)
                self.timer = self.create_timer(1.0, self.publish_temperature)
                self.temperature = 22.0

            def publish_temperature(self):
                self.publisher_.publish(Float32(data=self.temperature))

        class RoomSensor(SteadySensor):
            def __init__(self):
                super().__init__()
                self.declare_parameter("low", 18.0)
                self.declare_parameter("high", 28.0)
                self.declare_parameter("step", 0.3)

            def publish_temperature(self):
                low, high, step = (self.get_parameter(n).value for n in ("low", "high", "step"))
                self.temperature += random.uniform(-step, step)
                self.temperature = max(low, min(high, self.temperature))
                super().publish_temperature()
    '''),
)  # fmt: skip
