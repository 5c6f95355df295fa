"""03c, a greenhouse: right answers, in many styles."""

from bank.answer import edited, right

BASE = """
    class GreenhouseSensor(Node):
        def __init__(self):
            super().__init__("greenhouse_sensor")
            self.publisher_ = self.create_publisher(Float32, "greenhouse/temperature", 10)
            self.timer = self.create_timer(0.25, self.publish_temperature)
            self.temperature = 22.0

        def publish_temperature(self):
            self.temperature += random.uniform(-0.5, 0.5)
            self.temperature = max(10.2, min(28.0, self.temperature))
            fahrenheit = self.temperature * 9 / 5 + 32
            self.publisher_.publish(Float32(data=fahrenheit))
"""
_SEND = "self.publisher_.publish(Float32(data=fahrenheit))"


def _right(name, *edits):
    return right("03c", name, edited(BASE, *edits))


ANSWERS = (
    _right("as the page's sensor, one thing after the other changed"),
    _right("in other words",
           ("GreenhouseSensor", "Gewächshaus"), ("greenhouse_sensor", "gewaechshaus"),
           ('"greenhouse/', '"/greenhouse/'), ("0.25", "1 / 4"), ("* 9 / 5 +", "* 1.8 +"),
           (", 10)", ", 1)")),
    _right("in three steps, with a log line",
           (_SEND, "msg = Float32()\n        msg.data = fahrenheit\n"
                   "        self.publisher_.publish(msg)\n"
                   '        self.get_logger().info(f"Publishing: {fahrenheit:.2f}F")')),
    _right("the name in the node's namespace",
           ('"greenhouse_sensor"', '"sensor", namespace="greenhouse"'),
           ('"greenhouse/temperature"', '"temperature"')),
    _right("a private name, and a node of that name",
           ('"greenhouse_sensor"', '"greenhouse"'), ('"greenhouse/', '"~/')),
    _right("a remapped name",
           ('"greenhouse_sensor"', '"sensor", cli_args=["--ros-args", "-r", '
                                   '"temperature:=greenhouse/temperature"]'),
           ('"greenhouse/temperature"', '"temperature"')),
    _right("the profile for sensor data",
           ("class G", "from rclpy.qos import qos_profile_sensor_data\n\nclass G"),
           (", 10)", ", qos_profile_sensor_data)")),
    _right("random.random, scaled", ("random.uniform(-0.5, 0.5)", "random.random() - 0.5")),
    _right("a choice of steps",
           ("random.uniform(-0.5, 0.5)", "random.choice([-0.5, -0.25, 0.25, 0.5])")),
    _right("numpy", ("class G", "import numpy as np\n\nclass G"),
           ("random.uniform", "np.random.uniform"),
           ("max(10.2, min(28.0, self.temperature))",
            "float(np.clip(self.temperature, 10.2, 28.0))")),
    _right("walking in Fahrenheit",
           ("self.temperature = 22.0", "self.temperature = 71.6"),
           ("(-0.5, 0.5)", "(-0.9, 0.9)"),
           ("max(10.2, min(28.0, ", "max(50.36, min(82.4, "),
           ("self.temperature * 9 / 5 + 32", "self.temperature")),
    right("03c", "a function that converts, and class attributes", '''
        def to_fahrenheit(celsius: float) -> float:
            """Degrees Fahrenheit for degrees Celsius."""
            return celsius * 9.0 / 5.0 + 32.0

        class Greenhouse(Node):
            LOW, HIGH, STEP, RATE = 10.2, 28.0, 0.5, 4

            def __init__(self) -> None:
                super().__init__("greenhouse")
                self.celsius = 22.0
                self.out = self.create_publisher(Float32, "greenhouse/temperature", 5)
                self.create_timer(1.0 / self.RATE, self.tick)

            def tick(self) -> None:
                self.celsius = self.walk()
                self.out.publish(Float32(data=to_fahrenheit(self.celsius)))

            def walk(self) -> float:
                moved = self.celsius + random.uniform(-self.STEP, self.STEP)
                if moved > self.HIGH:
                    return self.HIGH
                if moved < self.LOW:
                    return self.LOW
                return moved
    '''),
    right("03c", "parameters and a partial", '''
        import functools

        class Greenhouse(Node):
            def __init__(self):
                super().__init__("greenhouse")
                self.declare_parameter("rate", 4.0)
                self.value = 22.0
                out = self.create_publisher(Float32, "greenhouse/temperature", 10)
                period = 1 / self.get_parameter("rate").value
                self.timer = self.create_timer(period, functools.partial(self.tick, out))

            def tick(self, out):
                self.value += random.uniform(-0.5, 0.5)
                self.value = min(max(self.value, 10.2), 28.0)
                out.publish(Float32(data=32 + self.value * 9 / 5))
    '''),
    right("03c", "inheritance: the page's sensor, taught to convert", '''
        class TemperatureSensor(Node):
            topic, period = "temperature", 1.0

            def __init__(self):
                super().__init__("temperature_sensor")
                self.publisher_ = self.create_publisher(Float32, self.topic, 10)
                self.timer = self.create_timer(self.period, self.publish_temperature)
                self.temperature = 22.0

            def publish_temperature(self):
                self.temperature += random.uniform(-0.5, 0.5)
                self.temperature = max(10.2, min(28.0, self.temperature))
                self.publisher_.publish(Float32(data=self.shown()))

            def shown(self):
                return self.temperature

        class GreenhouseSensor(TemperatureSensor):
            topic, period = "greenhouse/temperature", 0.25

            def shown(self):
                return super().shown() * 1.8 + 32.0
    '''),
    right("03c", "an async callback, and a property", '''
        class Greenhouse(Node):
            def __init__(self):
                super().__init__("greenhouse")
                self.c = 22.0
                self.publisher_ = self.create_publisher(Float32, "greenhouse/temperature", 10)
                self.timer = self.create_timer(0.25, self.tick)

            @property
            def fahrenheit(self):
                return self.c * 9 / 5 + 32

            async def tick(self):
                step = random.uniform(-0.5, 0.5)
                self.c = sorted([10.2, self.c + step, 28.0])[1]
                self.publisher_.publish(Float32(data=self.fahrenheit))
    '''),
    right("03c", "it hears itself, and closes its books", '''
        from collections import deque

        class Greenhouse(Node):
            def __init__(self):
                super().__init__("greenhouse")
                self.values = deque([22.0], maxlen=10)
                self.publisher_ = self.create_publisher(Float32, "greenhouse/temperature", 10)
                self.create_subscription(Float32, "greenhouse/temperature", self.heard, 10)
                self.create_timer(0.25, self.tick)
                self.count = 0

            def heard(self, msg):
                self.count += 1

            def tick(self):
                value = self.values[-1] + random.uniform(-0.5, 0.5)
                self.values.append(max(10.2, min(28.0, value)))
                self.publisher_.publish(Float32(data=self.values[-1] * 9 / 5 + 32))
    '''),
)  # fmt: skip
