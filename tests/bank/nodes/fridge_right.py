"""04a, watch a fridge: right answers, in many styles."""

from bank.answer import edited, right

BASE = """
    class FridgeMonitor(Node):
        def __init__(self):
            super().__init__("fridge_monitor")
            self.create_subscription(Float32, "temperature", self.temperature_callback, 10)

        def temperature_callback(self, msg):
            temp = msg.data
            if temp > 8.0:
                status = "Warm"
            elif temp < 2.0:
                status = "Frost"
            else:
                status = "Fine"
            self.get_logger().info(f"Fridge: {temp:.2f}C - Status:{status}")
"""
_HEAD = BASE.split("        if temp")[0]
_LOG = '        self.get_logger().info(f"Fridge: {temp:.2f}C - Status:{status}")\n'


def _decides(name, *lines, head="", foot=""):
    """The page's class with another decision in it."""
    body = "".join(f"        {line}\n" for line in lines)
    return right("04a", name, head + edited(_HEAD) + body + _LOG + foot)


ANSWERS = (
    right("04a", "as on the page", BASE),
    _decides("the middle first",
             "if 2.0 <= temp <= 8.0:", '    status = "Fine"', "elif temp > 8.0:",
             '    status = "Warm"', "else:", '    status = "Frost"'),
    _decides("ints", "if temp > 8:", '    status = "Warm"', "elif temp < 2:",
             '    status = "Frost"', "else:", '    status = "Fine"'),
    _decides("one expression",
             'status = "Warm" if temp > 8.0 else "Frost" if temp < 2.0 else "Fine"'),
    _decides("a start value and two ifs", 'status = "Fine"', "if temp > 8.0:",
             '    status = "Warm"', "if temp < 2.0:", '    status = "Frost"'),
    _decides("not", "if not temp <= 8.0:", '    status = "Warm"', "elif not temp >= 2.0:",
             '    status = "Frost"', "else:", '    status = "Fine"'),
    _decides("and", "if temp <= 8.0 and temp >= 2.0:", '    status = "Fine"',
             "elif temp < 2.0:", '    status = "Frost"', "else:", '    status = "Warm"'),
    _decides("match", "match (temp > 8.0, temp < 2.0):", "    case (True, _):",
             '        status = "Warm"', "    case (_, True):", '        status = "Frost"',
             "    case _:", '        status = "Fine"'),
    _decides("bisect", "words = ('Frost', 'Fine', 'Warm')",
             "status = words[(temp >= 2.0) + (temp > 8.0)]"),
    _decides("a function", "status = status_of(temp)", head="""def status_of(temp):
    if temp > 8.0:
        return "Warm"
    if temp < 2.0:
        return "Frost"
    return "Fine"

"""),
    _decides("a method", "status = self.decide(temp)", foot="""
    def decide(self, temp):
        for low, word in ((8.0, "Warm"), (1.9999999, "Fine")):
            if temp > low:
                return word
        return "Frost"
"""),
    _decides("a table of conditions",
             "table = {'Warm': temp > 8.0, 'Frost': temp < 2.0}",
             "status = next((word for word, true in table.items() if true), 'Fine')"),
    right("04a", "class attributes, an early return, a warning", '''
        class Kühlschrank(Node):
            """Meldet, wie kalt es ist."""

            WARM: float = 8.0
            FROST: float = 2.0

            def __init__(self) -> None:
                super().__init__("kuehlschrank")
                self.abo = self.create_subscription(Float32, "/temperature", self.melde, 1)

            def melde(self, nachricht: Float32) -> None:
                grad = nachricht.data
                if grad > self.WARM:
                    self.get_logger().warning(f"{grad:.1f} Grad: Warm")  # zu hoch
                    return
                if grad < self.FROST:
                    self.get_logger().error(f"{grad:.1f} Grad: Frost")
                    return
                self.get_logger().info(f"{grad:.1f} Grad: Fine")
    '''),
    right("04a", "a lambda, a child of the logger, parameters", '''
        class FridgeMonitor(Node):
            def __init__(self):
                super().__init__("fridge_monitor")
                self.declare_parameters("", [("warm", 8.0), ("frost", 2.0)])
                log = self.get_logger().get_child("states")
                self.create_subscription(
                    Float32, "temperature", lambda msg: log.info(self.word(msg.data)), 10
                )

            def word(self, value):
                if value > self.get_parameter("warm").value:
                    return "Warm"
                return "Frost" if value < self.get_parameter("frost").value else "Fine"
    '''),
    right("04a", "the profile for sensor data, an async callback", '''
        from rclpy.qos import qos_profile_sensor_data

        class FridgeMonitor(Node):
            def __init__(self):
                super().__init__("fridge_monitor")
                self.create_subscription(
                    Float32, "temperature", self.hear, qos_profile=qos_profile_sensor_data
                )

            async def hear(self, msg):
                status = "Fine"
                if msg.data > 8.0:
                    status = "Warm"
                elif msg.data < 2.0:
                    status = "Frost"
                self.get_logger().info(status)
    '''),
    right("04a", "composition: an object that judges", '''
        from enum import Enum

        class State(Enum):
            WARM = "Warm"
            FROST = "Frost"
            FINE = "Fine"

        class Fridge:
            def __init__(self, low, high):
                self.low, self.high = low, high

            def state(self, value):
                if value > self.high:
                    return State.WARM
                return State.FROST if value < self.low else State.FINE

        class FridgeMonitor(Node):
            def __init__(self):
                super().__init__("fridge_monitor")
                self.fridge = Fridge(2.0, 8.0)
                self.create_subscription(Float32, "temperature", self.hear, 10)

            def hear(self, msg):
                state = self.fridge.state(msg.data)
                self.get_logger().info(f"Fridge: {msg.data:.2f}C - Status:{state.value}")
    '''),
    right("04a", "two log lines for a reading", '''
        class FridgeMonitor(Node):
            def __init__(self):
                super().__init__("fridge_monitor")
                self.create_subscription(Float32, "temperature", self.hear, 10)

            def hear(self, msg):
                self.get_logger().info(f"I heard {msg.data:.2f}")
                word = "Warm" if msg.data > 8.0 else "Frost" if msg.data < 2.0 else "Fine"
                self.get_logger().info(word)
    '''),
    right("04a", "the word is published, too", '''
        class FridgeMonitor(Node):
            def __init__(self):
                super().__init__("fridge_monitor")
                self.out = self.create_publisher(String, "fridge", 10)
                self.create_subscription(Float32, "temperature", self.hear, 10)

            def hear(self, msg):
                word = "Warm" if msg.data > 8.0 else "Frost" if msg.data < 2.0 else "Fine"
                self.out.publish(String(data=word))
                self.get_logger().info(word)
    '''),
)  # fmt: skip
