"""04c, a calm monitor: right answers, in many styles."""

from bank.answer import edited, right

BASE = """
    class CalmMonitor(Node):
        def __init__(self):
            super().__init__("calm_monitor")
            self.create_subscription(Float32, "temperature", self.temperature_callback, 10)
            self.means = self.create_publisher(Float32, "mean", 10)
            self.statuses = self.create_publisher(String, "status", 10)
            self.readings = []
            self.status = "Normal"

        def temperature_callback(self, msg):
            self.readings.append(msg.data)
            last = self.readings[-5:]
            self.means.publish(Float32(data=sum(last) / len(last)))
            new = self.next_status(msg.data)
            if new != self.status:
                self.status = new
                self.statuses.publish(String(data=self.status))

        def next_status(self, value):
            if value > 26.0:
                return "High"
            if value < 20.0:
                return "Low"
            if self.status == "High" and value < 25.0:
                return "Normal"
            if self.status == "Low" and value > 21.0:
                return "Normal"
            return self.status
"""
_MEAN = "self.means.publish(Float32(data=sum(last) / len(last)))"


def _right(name, *edits):
    return right("04c", name, edited(BASE, *edits))


ANSWERS = (
    _right("slices and a method"),
    _right("fsum", ("class C", "import math\n\nclass C"), ("sum(last)", "math.fsum(last)")),
    _right("statistics", ("class C", "from statistics import mean\n\nclass C"),
           ("sum(last) / len(last)", "mean(last)")),
    _right("numpy", ("class C", "import numpy as np\n\nclass C"),
           ("sum(last) / len(last)", "float(np.mean(last))")),
    _right("numpy in 32 bits", ("class C", "import numpy as np\n\nclass C"),
           ("sum(last) / len(last)", "float(np.asarray(last, dtype=np.float32).mean())")),
    _right("a deque", ("class C", "from collections import deque\n\nclass C"),
           ("self.readings = []", "self.readings = deque(maxlen=5)"),
           ("self.readings[-5:]", "self.readings")),
    _right("pop", ("last = self.readings[-5:]",
                   "if len(self.readings) > 5:\n            self.readings.pop(0)\n"
                   "        last = self.readings")),
    _right("the status first, then the mean",
           (f"        {_MEAN}\n", ""),
           ("self.statuses.publish(String(data=self.status))",
            f"self.statuses.publish(String(data=self.status))\n        {_MEAN}")),
    _right("absolute names, other depths, a text with a capital letter",
           ('"mean", 10', '"/mean", 1'), ('"status", 10', '"/status", 5'),
           ('"temperature"', '"/temperature"')),
    _right("profiles that keep the last status",
           ("class C", "from rclpy.qos import DurabilityPolicy, QoSProfile\n\nclass C"),
           ('"status", 10',
            '"status", QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)')),
    _right("lists begin with the newest",
           ("self.readings.append(msg.data)", "self.readings.insert(0, msg.data)"),
           ("self.readings[-5:]", "self.readings[:5]")),
    right("04c", "a running sum", '''
        class CalmMonitor(Node):
            def __init__(self):
                super().__init__("calm_monitor")
                self.window, self.total, self.status = [], 0.0, "Normal"
                self.mean_pub = self.create_publisher(Float32, "mean", 10)
                self.status_pub = self.create_publisher(String, "status", 10)
                self.create_subscription(Float32, "temperature", self.hear, 10)

            def hear(self, msg):
                self.window.append(msg.data)
                self.total += msg.data
                if len(self.window) > 5:
                    self.total -= self.window.pop(0)
                self.mean_pub.publish(Float32(data=self.total / len(self.window)))
                before = self.status
                if msg.data > 26.0:
                    self.status = "High"
                elif msg.data < 20.0:
                    self.status = "Low"
                elif self.status == "High" and msg.data < 25.0:
                    self.status = "Normal"
                elif self.status == "Low" and msg.data > 21.0:
                    self.status = "Normal"
                if self.status != before:
                    self.status_pub.publish(String(data=self.status))
    '''),
    right("04c", "helpers: a window and a state machine", '''
        from collections import deque
        from dataclasses import dataclass, field

        @dataclass
        class Window:
            values: deque = field(default_factory=lambda: deque(maxlen=5))

            def add(self, value: float) -> float:
                self.values.append(value)
                return sum(self.values) / len(self.values)

        class Thermostat:
            """Zustand mit Hysterese."""

            def __init__(self) -> None:
                self.state = "Normal"

            def update(self, value: float) -> bool:
                """Ob sich der Zustand ändert."""
                before = self.state
                high = 25.0 if before == "High" else 26.0
                low = 21.0 if before == "Low" else 20.0
                if before == "High" and value >= high or value > 26.0:
                    self.state = "High"
                elif before == "Low" and value <= low or value < 20.0:
                    self.state = "Low"
                else:
                    self.state = "Normal"
                if value < 20.0:
                    self.state = "Low"
                if value > 26.0:
                    self.state = "High"
                return self.state != before

        class CalmMonitor(Node):
            def __init__(self) -> None:
                super().__init__("ruhiger_monitor")
                self.window, self.thermostat = Window(), Thermostat()
                self.mean = self.create_publisher(Float32, "mean", 10)
                self.out = self.create_publisher(String, "status", 10)
                self.create_subscription(Float32, "temperature", self.hear, 10)

            def hear(self, msg: Float32) -> None:
                self.mean.publish(Float32(data=self.window.add(msg.data)))
                if self.thermostat.update(msg.data):
                    self.out.publish(String(data=self.thermostat.state))
    '''),
    right("04c", "match, and a table of limits", '''
        class CalmMonitor(Node):
            def __init__(self):
                super().__init__("calm_monitor")
                self.values = []
                self.state = "Normal"
                self.m = self.create_publisher(Float32, "mean", 10)
                self.s = self.create_publisher(String, "status", 10)
                self.create_subscription(Float32, "temperature", self.hear, 10)

            def hear(self, msg):
                self.values = [*self.values, msg.data][-5:]
                self.m.publish(Float32(data=sum(self.values) / len(self.values)))
                match self.state, msg.data:
                    case _, value if value > 26.0:
                        new = "High"
                    case _, value if value < 20.0:
                        new = "Low"
                    case "High", value if value >= 25.0:
                        new = "High"
                    case "Low", value if value <= 21.0:
                        new = "Low"
                    case _:
                        new = "Normal"
                self.change_to(new)

            def change_to(self, new):
                if new == self.state:
                    return
                self.state = new
                self.s.publish(String(data=new))
    '''),
    right("04c", "two subscriptions, one for each job", '''
        import collections
        import functools

        class CalmMonitor(Node):
            def __init__(self):
                super().__init__("calm_monitor")
                window = collections.deque([], 5)
                mean = self.create_publisher(Float32, "mean", 10)
                self.create_subscription(
                    Float32, "temperature", functools.partial(self.average, window, mean), 10
                )
                self.status = "Normal"
                self.out = self.create_publisher(String, "status", 10)
                self.create_subscription(Float32, "temperature", self.judge, 10)

            def average(self, window, mean, msg):
                window.append(msg.data)
                mean.publish(Float32(data=sum(window) / len(window)))

            def judge(self, msg):
                value = msg.data
                stays_high = self.status == "High" and value >= 25.0
                stays_low = self.status == "Low" and value <= 21.0
                if value > 26.0 or (stays_high and not value < 20.0):
                    new = "High"
                elif value < 20.0 or stays_low:
                    new = "Low"
                else:
                    new = "Normal"
                if new != self.status:
                    self.status = new
                    self.out.publish(String(data=new))
    '''),
    right("04c", "a property that publishes", '''
        class CalmMonitor(Node):
            limits = {"High": (25.0, 99.0), "Low": (-99.0, 21.0)}

            def __init__(self):
                super().__init__("calm_monitor")
                self._status = "Normal"
                self.last_five = []
                self.mean_publisher = self.create_publisher(Float32, "mean", 10)
                self.status_publisher = self.create_publisher(String, "status", 10)
                self.create_subscription(Float32, "temperature", self.on_reading, 10)

            @property
            def status(self):
                return self._status

            @status.setter
            def status(self, word):
                if word != self._status:
                    self._status = word
                    self.status_publisher.publish(String(data=word))

            def on_reading(self, msg):
                value = msg.data
                self.last_five = (self.last_five + [value])[-5:]
                mean = Float32()
                mean.data = sum(self.last_five) / len(self.last_five)
                self.mean_publisher.publish(mean)
                low, high = self.limits.get(self.status, (99.0, -99.0))
                if value > 26.0:
                    self.status = "High"
                elif value < 20.0:
                    self.status = "Low"
                elif not low <= value <= high:
                    self.status = "Normal"
    '''),
    right("04c", "async, parameters, and a namespace that changes nothing", '''
        class CalmMonitor(Node):
            def __init__(self):
                super().__init__("calm_monitor", namespace="/")
                self.declare_parameter("window", 5)
                self.heard, self.state = [], "Normal"
                self.mean = self.create_publisher(Float32, "mean", 10)
                self.status = self.create_publisher(String, "status", 10)
                self.create_subscription(Float32, "temperature", self.on_reading, 10)

            async def on_reading(self, msg):
                self.heard.append(msg.data)
                width = self.get_parameter("window").value
                last = self.heard[-width:]
                self.mean.publish(Float32(data=sum(last) / len(last)))
                await self.judge(msg.data)

            async def judge(self, value):
                if value > 26.0:
                    word = "High"
                elif value < 20.0:
                    word = "Low"
                elif 21.0 < value < 25.0:
                    word = "Normal"
                elif self.state == "High" and value < 25.0:
                    word = "Normal"
                elif self.state == "Low" and value > 21.0:
                    word = "Normal"
                else:
                    word = self.state
                if word != self.state:
                    self.state = word
                    self.status.publish(String(data=word))
    '''),
)  # fmt: skip
