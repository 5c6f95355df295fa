"""09c, a monitor for any place: right answers, in many styles."""

from bank.answer import edited, right

BASE = """
    class AnyMonitor(Node):
        def __init__(self):
            super().__init__("any_monitor")
            self.declare_parameter("low", 20.0)
            self.declare_parameter("high", 26.0)
            self.declare_parameter("unit", "C")
            self.statuses = self.create_publisher(String, "status", 10)
            self.create_subscription(Float32, "reading", self.hear, 10)

        def value_of(self, name):
            return self.get_parameter(name).value

        def hear(self, msg):
            if msg.data > self.value_of("high"):
                word = "High"
            elif msg.data < self.value_of("low"):
                word = "Low"
            else:
                word = "Normal"
            text = f"{word} {msg.data:.1f} {self.value_of('unit')}"
            self.statuses.publish(String(data=text))
"""
_TEXT = "text = f\"{word} {msg.data:.1f} {self.value_of('unit')}\""


def _right(name, *edits):
    return right("09c", name, edited(BASE, *edits))


ANSWERS = (
    _right("asked for each time"),
    _right("more decimals", (":.1f", ":.3f")),
    _right("text put together",
           (_TEXT, 'text = word + " " + str(round(msg.data, 1)) + " " + self.value_of("unit")')),
    _right("it logs, too", (_TEXT, _TEXT + "\n        self.get_logger().info(text)")),
    _right("another name for the node", ('"any_monitor"', '"thermometer"')),
    _right("other queues", ('"status", 10', '"status", 1'), ("self.hear, 10", "self.hear, 50")),
    right("09c", "read once, in the constructor", '''
        class AnyMonitor(Node):
            def __init__(self):
                super().__init__("any_monitor")
                self.low = self.declare_parameter("low", 20.0).value
                self.high = self.declare_parameter("high", 26.0).value
                self.unit = self.declare_parameter("unit", "C").value
                self.out = self.create_publisher(String, "status", 10)
                self.create_subscription(Float32, "reading", self.hear, 10)

            def hear(self, msg):
                word = "Normal"
                if not self.low <= msg.data <= self.high:
                    word = "Low" if msg.data < self.low else "High"
                self.out.publish(String(data="%s %.1f %s" % (word, msg.data, self.unit)))
    '''),
    right("09c", "all declared at once, and a local function", '''
        class AnyMonitor(Node):
            def __init__(self):
                super().__init__("any_monitor")
                declared = self.declare_parameters(
                    "", [("low", 20.0), ("high", 26.0), ("unit", "C")]
                )
                low, high, unit = (one.value for one in declared)
                out = self.create_publisher(String, "status", 10)

                def hear(msg):
                    found = [name for name, is_so in (
                        ("High", msg.data > high), ("Low", msg.data < low), ("Normal", True)
                    ) if is_so]
                    out.publish(String(data=f"{found[0]} {msg.data:.1f} {unit}"))

                self.create_subscription(Float32, "reading", hear, 10)
    '''),
    right("09c", "parameter values by their types", '''
        class AnyMonitor(Node):
            def __init__(self):
                super().__init__("any_monitor")
                self.declare_parameter("low", value=20.0)
                self.declare_parameter("high", value=26.0)
                self.declare_parameter("unit", value="C")
                self.pub = self.create_publisher(topic="status", msg_type=String, qos_profile=5)
                self.sub = self.create_subscription(Float32, "reading", self.on_reading, 5)

            @property
            def limits(self):
                low, high = self.get_parameters(["low", "high"])
                return (low.get_parameter_value().double_value,
                        high.get_parameter_value().double_value)

            def on_reading(self, msg):
                low, high = self.limits
                unit = self.get_parameter("unit").get_parameter_value().string_value
                match (msg.data > high, msg.data < low):
                    case (True, _):
                        word = "High"
                    case (_, True):
                        word = "Low"
                    case _:
                        word = "Normal"
                self.pub.publish(String(data=f"{word} {msg.data:.1f} {unit}"))
    '''),
    right("09c", "a rule in a class of its own", '''
        from dataclasses import dataclass

        @dataclass
        class Rule:
            low: float
            high: float

            def word(self, value):
                return "High" if value > self.high else "Low" if value < self.low else "Normal"

        class AnyMonitor(Node):
            def __init__(self):
                super().__init__("any_monitor")
                declare = self.declare_parameter
                self.rule = Rule(declare("low", 20.0).value, declare("high", 26.0).value)
                self.unit = declare("unit", "C").value
                self.pub = self.create_publisher(String, "status", 10)
                self.create_subscription(Float32, "reading", self.hear, 10)

            def hear(self, msg: Float32) -> None:
                out = String()
                out.data = f"{self.rule.word(msg.data)} {msg.data:.1f} {self.unit}"
                self.pub.publish(out)
    '''),
    right("09c", "names completed by hand", '''
        class AnyMonitor(Node):
            def __init__(self):
                super().__init__("any_monitor")
                space = self.get_namespace().rstrip("/")
                self.low = self.declare_parameter("low", 20.0).value
                self.high = self.declare_parameter("high", 26.0).value
                self.unit = self.declare_parameter("unit", "C").value
                self.out = self.create_publisher(String, f"{space}/status", 10)
                self.create_subscription(Float32, f"{space}/reading", self.hear, 10)

            def hear(self, msg):
                value = msg.data
                word = "High" if value > self.high else "Low" if value < self.low else "Normal"
                self.out.publish(String(data=f"{word} {value:.1f} {self.unit}"))
    '''),
)  # fmt: skip
