"""Page 04: answers that were written from the page alone, and neighbours of those found wanting."""

from bank.answer import edited, right, wrong
from bank.nodes import alarm_right, fridge_right, hysteresis_right


def _fridge(name, mistake, *edits):
    return wrong("04a", name, mistake, edited(fridge_right.BASE, *edits))


def _alarm(name, mistake, *edits):
    return wrong("04b", name, mistake, edited(alarm_right.BASE, *edits))


def _hysteresis(name, mistake, *edits):
    return wrong("04c", name, mistake, edited(hysteresis_right.BASE, *edits))


_SUPER = 'super().__init__("alarm")'
_IF = "if msg.data > 26.0 or msg.data < 20.0:"

ANSWERS = (
    # 04a, right.
    right("04a", "a property and a NamedTuple", '''
        from typing import NamedTuple

        class Band(NamedTuple):
            word: str
            above: float
            to: float

            def holds(self, value):
                return self.above < value <= self.to

        class FridgeMonitor(Node):
            bands = Band("Warm", 8.0, 1e9), Band("Fine", 1.9999999, 8.0)

            def __init__(self):
                super().__init__("fridge_monitor")
                self.temp = 0.0
                self.create_subscription(Float32, "temperature", self.update, 10)

            def update(self, msg):
                self.temp = msg.data
                self.get_logger().warn("%.1f C (%s)" % (self.temp, self.status))

            @property
            def status(self):
                return next((one.word for one in self.bands if one.holds(self.temp)), "Frost")
    '''),
    right("04a", "inheritance, and a word with a full stop", '''
        class Monitor(Node):
            high, low, words = 26.0, 20.0, ("Low", "Normal", "High")

            def __init__(self, name="monitor"):
                super().__init__(name)
                self.create_subscription(Float32, "temperature", self.on_temperature, 10)

            def on_temperature(self, msg):
                place = 1 + (msg.data > self.high) - (msg.data < self.low)
                self.get_logger().info(f"It is {self.words[place]}.")

        class FridgeMonitor(Monitor):
            high, low, words = 8.0, 2.0, ("Frost", "Fine", "Warm")
    '''),
    right("04a", "numpy and format", '''
        import numpy as np

        class FridgeMonitor(Node):
            def __init__(self):
                super().__init__("fridge_monitor")
                self.create_subscription(Float32, "temperature", self.hear, 10)

            def hear(self, msg):
                words = np.array(["Frost", "Fine", "Warm"])
                place = np.select([msg.data < 2.0, msg.data > 8.0], [0, 2], default=1)
                self.get_logger().info("Status:{}".format(words[place]))
    '''),
    # 04a, wrong.
    wrong("04a", "capital letters", "wrong-word", '''
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
                    return "WARM"
                return "FROST" if value < self.get_parameter("frost").value else "FINE"
    '''),
    _fridge("small letters", "wrong-word", ("{status}", "{status.lower()}")),
    _fridge("one word in small letters", "wrong-word", ('"Frost"', '"frost"')),
    _fridge("a list with a word in it", "wrong-word",
            ('"Warm"', '["Warm"]'), ('"Frost"', '["Frost"]'), ('"Fine"', '["Fine"]')),
    _fridge("a tuple, by a comma too many", "wrong-word", ('"Fine"', '"Fine",')),
    _fridge("a set", "wrong-word", ("{status}", "{ {status} }")),
    _fridge("Fine between 2 and 8, without them", "boundary",
            ("temp > 8.0", "temp >= 8.0"), ("temp < 2.0", "not 2.0 < temp")),
    # 04b, right.
    right("04b", "a dataclass for the limits, and a walrus", '''
        from dataclasses import dataclass

        @dataclass(frozen=True)
        class Limits:
            low: float = 20.0
            high: float = 26.0

            def problem(self, value):
                return "cold" if value < self.low else "hot" if value > self.high else None

        class Alarm(Node):
            def __init__(self):
                super().__init__("alarm")
                self.limits = Limits()
                self.pub = self.create_publisher(msg_type=String, topic="alert", qos_profile=10)
                self.sub = self.create_subscription(Float32, "temperature", self.on_msg, 10)

            def on_msg(self, msg):
                if problem := self.limits.problem(msg.data):
                    self.pub.publish(String(data=f"too {problem}: {msg.data}"))
    '''),
    right("04b", "two subscriptions, one for each limit", '''
        class Alarm(Node):
            def __init__(self):
                super().__init__("alarm")
                self.alerts = self.create_publisher(String, "alert", 10)
                self.create_subscription(Float32, "temperature", self.too_hot, 10)
                self.create_subscription(Float32, "temperature", self.too_cold, 10)

            def too_hot(self, msg):
                if msg.data > 26:
                    self.alerts.publish(String(data="hot"))

            def too_cold(self, msg):
                if msg.data < 20:
                    self.alerts.publish(String(data="cold"))
    '''),
    # 04b, wrong.
    _alarm("it rings only once in its life", "alert-missing",
           (_SUPER, f"{_SUPER}\n        self.rang = False"),
           (_IF, "if not self.rang and (msg.data > 26.0 or msg.data < 20.0):\n"
                 "            self.rang = True")),
    _alarm("it rings once and destroys the subscription", "alert-missing",
           (_SUPER, f"{_SUPER}\n        self.done = []"),
           (_IF, "if not self.done and (msg.data > 26.0 or msg.data < 20.0):\n"
                 "            self.done.append(msg.data)")),
    _alarm("the fridge's limits", "alert-too-many", ("26.0", "8.0"), ("20.0", "2.0")),
    _alarm("a log line and nothing else", "never-published",
           ('self.alerts.publish(String(data=f"{msg.data:.1f} degrees"))',
            'self.get_logger().warn("Too hot or too cold")')),
    # 04c, right.
    right("04c", "a generator that holds the state", '''
        def states():
            status = "Normal"
            value = yield
            while True:
                if value > 26.0:
                    status = "High"
                elif value < 20.0:
                    status = "Low"
                elif (status, value < 25.0) == ("High", True):
                    status = "Normal"
                elif (status, value > 21.0) == ("Low", True):
                    status = "Normal"
                value = yield status

        class CalmMonitor(Node):
            def __init__(self):
                super().__init__("calm_monitor")
                self.states = states()
                next(self.states)
                self.old, self.values = "Normal", []
                self.mean_pub = self.create_publisher(Float32, "mean", 10)
                self.status_pub = self.create_publisher(String, "status", 10)
                self.create_subscription(Float32, "temperature", self.listen, 10)

            def listen(self, msg):
                self.values.append(msg.data)
                del self.values[:-5]
                self.mean_pub.publish(Float32(data=sum(self.values) / len(self.values)))
                new = self.states.send(msg.data)
                if self.old != new:
                    self.status_pub.publish(String(data=new))
                self.old = new
    '''),
    right("04c", "numpy, and a table by state", '''
        import numpy as np

        class CalmMonitor(Node):
            BACK = {"High": lambda v: v < 25.0, "Low": lambda v: v > 21.0, "Normal": lambda v: True}

            def __init__(self):
                super().__init__("calm_monitor")
                self.ring, self.count = np.full(5, np.nan), 0
                self.status = "Normal"
                self.pub_mean = self.create_publisher(Float32, "mean", 10)
                self.pub_status = self.create_publisher(String, "status", 10)
                self.create_subscription(Float32, "temperature", self.listen, 10)

            def listen(self, msg):
                self.ring[self.count % 5] = msg.data
                self.count += 1
                self.pub_mean.publish(Float32(data=float(np.nanmean(self.ring))))
                before = self.status
                if msg.data > 26.0:
                    self.status = "High"
                elif msg.data < 20.0:
                    self.status = "Low"
                elif self.BACK[before](msg.data):
                    self.status = "Normal"
                if before != self.status:
                    self.pub_status.publish(String(data=self.status))
    '''),
    # 04c, wrong.
    _hysteresis("a local variable for the status", "no-hysteresis",
          ("new = self.next_status(msg.data)", 'self.status = "Normal"\n        '
           "new = self.next_status(msg.data)"),
          ("if new != self.status:\n            self.status = new\n            "
           "self.statuses.publish(String(data=self.status))",
           "self.statuses.publish(String(data=new))")),
    _hysteresis("the new status is not kept, and the limits are right", "status-repeated",
          ("self.status = new\n            self.statuses.publish(String(data=self.status))",
           "self.statuses.publish(String(data=new))")),
    _hysteresis("capital letters", "wrong-word",
          ("String(data=self.status)", "String(data=self.status.upper())")),
    _hysteresis("a space behind the word", "wrong-word",
          ("String(data=self.status)", 'String(data=f"{self.status} ")')),
    _hysteresis("the mean is judged", "wrong-state",
          ("self.next_status(msg.data)", "self.next_status(sum(last) / len(last))")),
)  # fmt: skip
