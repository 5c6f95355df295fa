"""04b, raise the alarm: right answers, in many styles."""

from bank.answer import edited, right

BASE = """
    class Alarm(Node):
        def __init__(self):
            super().__init__("alarm")
            self.create_subscription(Float32, "temperature", self.temperature_callback, 10)
            self.alerts = self.create_publisher(String, "alert", 10)

        def temperature_callback(self, msg):
            if msg.data > 26.0 or msg.data < 20.0:
                self.alerts.publish(String(data=f"{msg.data:.1f} degrees"))
"""
_IF = "if msg.data > 26.0 or msg.data < 20.0:"
_SEND = 'self.alerts.publish(String(data=f"{msg.data:.1f} degrees"))'


def _right(name, *edits):
    return right("04b", name, edited(BASE, *edits))


ANSWERS = (
    _right("not between", (_IF, "if not 20.0 <= msg.data <= 26.0:")),
    _right("ints", (_IF, "if msg.data > 26 or msg.data < 20:")),
    _right("from the middle", (_IF, "if abs(msg.data - 23.0) > 3.0:")),
    _right("a text of its own", (_SEND, 'out = String()\n            out.data = "Alarm!"\n'
                                        "            self.alerts.publish(out)")),
    _right("an empty text", (_SEND, "self.alerts.publish(String())")),
    _right("any", (_IF, "if any((msg.data > 26.0, msg.data < 20.0)):")),
    _right("an early return",
           (f"{_IF}\n            {_SEND}",
            f"if 20.0 <= msg.data <= 26.0:\n            return\n        {_SEND}")),
    _right("two branches",
           (f"{_IF}\n            {_SEND}",
            'if msg.data > 26.0:\n            self.alerts.publish(String(data="Too hot"))\n'
            '        elif msg.data < 20.0:\n'
            '            self.alerts.publish(String(data="Too cold"))')),
    _right("two ifs, and a log line",
           (f"{_IF}\n            {_SEND}",
            'if msg.data > 26.0:\n            self.alerts.publish(String(data="Hot"))\n'
            '        if msg.data < 20.0:\n            self.alerts.publish(String(data="Cold"))\n'
            '        self.get_logger().info("looked")')),
    _right("a profile that keeps the last alert",
           ("class A", "from rclpy.qos import DurabilityPolicy, QoSProfile\n\nclass A"),
           ('"alert", 10',
            '"alert", QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)')),
    _right("absolute names, and keywords",
           ('self.create_subscription(Float32, "temperature", self.temperature_callback, 10)',
            'self.create_subscription(\n            msg_type=Float32, topic="/temperature", '
            'qos_profile=1,\n            callback=self.temperature_callback)'),
           ('"alert"', '"/alert"')),
    right("04b", "a local function and match", '''
        class Alarm(Node):
            def __init__(self):
                super().__init__("alarm")
                alerts = self.create_publisher(String, "alert", 10)

                def listen(msg):
                    match msg.data:
                        case value if value > 26.0:
                            alerts.publish(String(data="hot"))
                        case value if value < 20.0:
                            alerts.publish(String(data="cold"))
                        case _:
                            pass

                self.create_subscription(Float32, "temperature", listen, 10)
    '''),
    right("04b", "a lambda", '''
        class Alarm(Node):
            def __init__(self):
                super().__init__("alarm")
                alerts = self.create_publisher(String, "alert", 10)
                self.create_subscription(
                    Float32,
                    "temperature",
                    lambda msg: alerts.publish(String(data=str(msg.data)))
                    if msg.data > 26.0 or msg.data < 20.0 else None,
                    10,
                )
    '''),
    right("04b", "composition and type hints", '''
        from rclpy.publisher import Publisher

        class Bell:
            """Läutet."""

            def __init__(self, publisher: Publisher) -> None:
                self._publisher = publisher

            def ring(self, text: str) -> None:
                self._publisher.publish(String(data=text))

        class Alarm(Node):
            low: float = 20.0
            high: float = 26.0

            def __init__(self) -> None:
                super().__init__("alarm")
                self.bell = Bell(self.create_publisher(String, "alert", 10))
                self.create_subscription(Float32, "temperature", self.check, 10)

            def check(self, msg: Float32) -> None:
                if self.is_alarming(msg.data):
                    self.bell.ring(f"{msg.data:.1f} degrees")

            def is_alarming(self, value: float) -> bool:
                return value > self.high or value < self.low
    '''),
    right("04b", "parameters, async, callback groups", '''
        from rclpy.callback_groups import ReentrantCallbackGroup

        class Alarm(Node):
            def __init__(self):
                super().__init__("alarm")
                self.declare_parameter("low", 20.0)
                self.declare_parameter("high", 26.0)
                group = ReentrantCallbackGroup()
                self.alerts = self.create_publisher(String, "alert", 10, callback_group=group)
                self.create_subscription(
                    Float32, "temperature", self.check, 10, callback_group=group
                )

            async def check(self, msg):
                low = self.get_parameter("low").value
                high = self.get_parameter("high").value
                if msg.data < low or msg.data > high:
                    self.alerts.publish(String(data="alarm"))
    '''),
    right("04b", "a mixin", '''
        class Speaks:
            def setup(self):
                self.out = self.create_publisher(String, "alert", 10)

            def say(self, text):
                self.out.publish(String(data=text))

        class Alarm(Speaks, Node):
            def __init__(self):
                super().__init__("alarm")
                self.setup()
                self.create_subscription(Float32, "temperature", self.check, 10)

            def check(self, msg):
                too_hot, too_cold = msg.data > 26.0, msg.data < 20.0
                if too_hot | too_cold:
                    self.say("too hot" if too_hot else "too cold")
    '''),
    right("04b", "the publisher is made at the first alert", '''
        from functools import cached_property

        class Alarm(Node):
            def __init__(self):
                super().__init__("alarm")
                self.create_subscription(Float32, "temperature", self.check, 10)

            @cached_property
            def alerts(self):
                return self.create_publisher(String, "alert", 10)

            def check(self, msg):
                if msg.data > 26.0 or msg.data < 20.0:
                    self.alerts.publish(String(data="alarm"))
    '''),
    right("04b", "numpy", '''
        import numpy as np

        class Alarm(Node):
            def __init__(self):
                super().__init__("alarm")
                self.alerts = self.create_publisher(String, "alert", 10)
                self.create_subscription(Float32, "temperature", self.check, 10)

            def check(self, msg):
                if np.clip(msg.data, 20.0, 26.0) != msg.data:
                    self.alerts.publish(String(data=f"{np.float32(msg.data)}"))
    '''),
)  # fmt: skip
