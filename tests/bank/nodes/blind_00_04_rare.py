# ruff: noqa: E501
"""Answers to pages 00, 03 and 04 by the same hand again: rarer ways, most of them right."""

from bank.answer import Answer, edited, either, right, wrong
from bank.nodes.blind_00_04 import (
    _ALARM,
    _CALM,
    _FRIDGE,
    _GREEN,
    _HUMIDITY,
    _READER,
    _REPORTER,
    _ROOM,
)

_LISTENS = 'self.create_subscription(String, "weather", self.read, 10)'
_LOGS = 'self.get_logger().info(f"I read: {msg.data}")'
_TICK = "self.timer = self.create_timer(2.0, self.write)"
_STEP = "random.uniform(-0.3, 0.3)"
_SAYS = 'self.get_logger().info(f"Fridge: {temp:.2f}C - Status:{status}")'
_STARTS = 'super().__init__("fridge_monitor")'
_ALERT = 'self.alerts.publish(String(data=f"{msg.data:.1f} degrees"))'
_SENSOR = 'super().__init__("temperature_sensor")'


def _imported(line: str, text: str, *edits: tuple[str, str]) -> str:
    return f"{line}\n{edited(text, *edits)}"


_RIGHT = (
    right(
        "00a", "blind: another node name", edited(_READER, ('"weather_reader"', '"anas_weather"'))
    ),
    right(
        "00a",
        "blind: best effort",
        _imported(
            "from rclpy.qos import QoSProfile, ReliabilityPolicy",
            _READER,
            (
                "self.read, 10",
                "self.read, QoSProfile(depth=1, reliability=ReliabilityPolicy.BEST_EFFORT)",
            ),
        ),
    ),
    right(
        "00a",
        "blind: a remark each second while it waits",
        edited(
            _READER,
            (
                _LISTENS,
                f'{_LISTENS}; self.create_timer(1.0, lambda: self.get_logger().info("I am waiting"))',
            ),
        ),
    ),
    right(
        "00a",
        "blind: tells others how much it has read",
        _imported(
            "from std_msgs.msg import Int32",
            _READER,
            (
                _LISTENS,
                f'{_LISTENS}; self.count = 0; self.out = self.create_publisher(Int32, "read_so_far", 10)',
            ),
            (_LOGS, f"{_LOGS}; self.count += 1; self.out.publish(Int32(data=self.count))"),
        ),
    ),
    right("00a", "blind: a warning", edited(_READER, (".info(", ".warning("))),
    right(
        "00a",
        "blind: a class made by a function",
        """
        def reader_of(topic):
            class Reader(Node):
                def __init__(self):
                    super().__init__(f"{topic}_reader")
                    self.create_subscription(String, topic, self.read, 10)

                def read(self, msg):
                    self.get_logger().info(f"I read: {msg.data}")

            return Reader

        WeatherReader = reader_of("weather")
        """,
        "WeatherReader",
    ),
    right(
        "00a",
        "blind: a mixin",
        """
        class Reads:
            def read(self, msg):
                self.get_logger().info(f"I read: {msg.data}")

        class WeatherReader(Reads, Node):
            def __init__(self):
                super().__init__("weather_reader")
                self.create_subscription(String, "weather", self.read, 10)
        """,
    ),
    right(
        "00a",
        "blind: kept, and read a tenth of a second later",
        """
        from queue import SimpleQueue

        class WeatherReader(Node):
            def __init__(self):
                super().__init__("weather_reader")
                self.letters = SimpleQueue()
                self.create_subscription(String, "weather", self.letters.put, 10)
                self.create_timer(0.1, self.read)

            def read(self):
                while not self.letters.empty():
                    self.get_logger().info(f"I read: {self.letters.get().data}")
        """,
    ),
    right(
        "00b",
        "blind: reads its own paper",
        edited(
            _REPORTER,
            (
                _TICK,
                f'{_TICK}; self.create_subscription(String, "sports", lambda msg: self.get_logger().info(msg.data), 10)',
            ),
        ),
    ),
    right(
        "00b",
        "blind: kept for those who come late",
        _imported(
            "from rclpy.qos import DurabilityPolicy, QoSProfile",
            _REPORTER,
            (
                '"sports", 10',
                '"sports", QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)',
            ),
        ),
    ),
    right(
        "00b",
        "blind: made with type()",
        """
        def __init__(self):
            Node.__init__(self, "sports_reporter")
            self.publisher = self.create_publisher(String, "sports", 10)
            self.timer = self.create_timer(2.0, self.write)

        SportsReporter = type(
            "SportsReporter",
            (Node,),
            {"__init__": __init__, "write": lambda self: self.publisher.publish(String(data="Goal"))},
        )
        """,
        "SportsReporter",
    ),
    right(
        "00b",
        "blind: tells the time of its clock",
        edited(
            _REPORTER,
            ('"What a match"', 'f"Goal at {self.get_clock().now().nanoseconds / 1e9:.1f}"'),
        ),
    ),
    right(
        "00b",
        "blind: a timer that is reset at each tick",
        edited(
            _REPORTER, ("self.publisher.publish(", "self.timer.reset(); self.publisher.publish(")
        ),
    ),
    right(
        "00b",
        "blind: begins a timer in a timer",
        """
        class SportsReporter(Node):
            def __init__(self):
                super().__init__("sports_reporter")
                self.publisher = self.create_publisher(String, "sports", 10)
                self.first = self.create_timer(2.0, self.begin)

            def begin(self):
                self.destroy_timer(self.first)
                self.write()
                self.create_timer(2.0, self.write)

            def write(self):
                self.publisher.publish(String(data="What a match"))
        """,
    ),
    right(
        "03a",
        "blind: the profile for sensor data, which has a depth of 5",
        _imported(
            "from rclpy.qos import qos_profile_sensor_data",
            _HUMIDITY,
            ('"humidity", 5', '"humidity", qos_profile_sensor_data'),
        ),
    ),
    right(
        "03a",
        "blind: kept for those who come late",
        _imported(
            "from rclpy.qos import DurabilityPolicy, QoSProfile",
            _HUMIDITY,
            (
                '"humidity", 5',
                '"humidity", QoSProfile(depth=5, durability=DurabilityPolicy.TRANSIENT_LOCAL)',
            ),
        ),
    ),
    right(
        "03a",
        "blind: dew point on a topic more",
        edited(
            _HUMIDITY,
            ("self.timer =", 'self.dew = self.create_publisher(Float32, "dew", 10); self.timer ='),
            (
                "self.publisher_.publish(",
                "self.dew.publish(Float32(data=9.0)); self.publisher_.publish(",
            ),
        ),
    ),
    right(
        "03a",
        "blind: depth as a parameter of the node",
        edited(
            _HUMIDITY, ('"humidity", 5', '"humidity", self.declare_parameter("depth", 5).value')
        ),
    ),
    right(
        "03b",
        "blind: a seed in the constructor",
        edited(_ROOM, (_SENSOR, f"{_SENSOR}; random.seed(1)")),
    ),
    right(
        "03b",
        "blind: the message remembers",
        edited(
            _ROOM,
            ("self.temperature = 22.0", "self.msg = Float32(data=22.0)"),
            ("self.temperature += ", "self.msg.data += "),
            (
                "self.temperature = max(18.0, min(28.0, self.temperature))",
                "self.msg.data = max(18.0, min(28.0, self.msg.data))",
            ),
            ("Float32(data=self.temperature)", "self.msg"),
        ),
    ),
    right(
        "03b",
        "blind: numpy's float64 all through",
        _imported(
            "import numpy as np",
            _ROOM,
            ("22.0", "np.float64(22)"),
            ("max(18.0, min(28.0, self.temperature))", "np.clip(self.temperature, 18.0, 28.0)"),
        ),
    ),
    right(
        "03b",
        "blind: the difference of two dice",
        edited(_ROOM, (_STEP, "0.3 * (random.random() - random.random())")),
    ),
    right(
        "03b",
        "blind: hundredths from randrange",
        edited(_ROOM, (_STEP, "random.randrange(-30, 31) / 100")),
    ),
    right(
        "03b",
        "blind: a bell curve of numpy, clipped",
        _imported(
            "import numpy as np",
            _ROOM,
            (_STEP, "float(np.clip(np.random.normal(0, 0.2), -0.3, 0.3))"),
        ),
    ),
    right("03b", "blind: at most 0.3, so 0.2", edited(_ROOM, ("(-0.3, 0.3)", "(-0.2, 0.2)"))),
    right(
        "03b", "blind: up, down or stay", edited(_ROOM, (_STEP, "random.choice([-0.3, 0.0, 0.3])"))
    ),
    right(
        "03b",
        "blind: angle",
        _imported("import math", _ROOM, (_STEP, "0.3 * math.sin(random.uniform(0, 2 * math.pi))")),
    ),
    right(
        "03b",
        "blind: 18 to 28 by float()",
        edited(
            _ROOM,
            ("max(18.0, min(28.0, self.temperature))", "float(max(18, min(28, self.temperature)))"),
        ),
    ),
    right(
        "03c",
        "blind: one decimal is published",
        edited(_GREEN, ("self.celsius * 9 / 5 + 32)", "round(self.celsius * 9 / 5 + 32, 1))")),
    ),
    right(
        "03c",
        "blind: eight beats a second, and every other is heard",
        edited(
            _GREEN,
            ("0.25", "0.125"),
            ("self.celsius = 22.0", "self.celsius = 22.0; self.beats = 0"),
            ("step = ", "self.beats += 1\n        if self.beats % 2: return\n        step = "),
        ),
    ),
    right("03c", "blind: an int at the start", edited(_GREEN, ("22.0", "22"))),
    right(
        "03c",
        "blind: a remapped name",
        edited(
            _GREEN,
            (
                '("greenhouse_sensor")',
                '("greenhouse_sensor", cli_args=["--ros-args", "-r", "t:=greenhouse/temperature"])',
            ),
            ('"greenhouse/temperature"', '"t"'),
        ),
    ),
    right(
        "04a",
        "blind: the words in the first line, too",
        edited(
            _FRIDGE,
            (
                _STARTS,
                f'{_STARTS}; self.get_logger().info("Warm above 8, Frost below 2, Fine in between")',
            ),
        ),
    ),
    right(
        "04a",
        "blind: tells of changes, too",
        edited(
            _FRIDGE,
            (_STARTS, f"{_STARTS}; self.old = 'Fine'"),
            (
                _SAYS,
                f"{_SAYS}\n        if status != self.old: self.get_logger().info(f'It was {{self.old}} before')\n        self.old = status",
            ),
        ),
    ),
    right(
        "04a",
        "blind: with the limits in the line",
        edited(_FRIDGE, ("Status:{status}", "Status:{status} (Fine is from 2 to 8)")),
    ),
    right(
        "04a",
        "blind: published, too",
        _imported(
            "",
            _FRIDGE,
            (_STARTS, f'{_STARTS}; self.out = self.create_publisher(String, "fridge", 10)'),
            (_SAYS, f"{_SAYS}; self.out.publish(String(data=status))"),
        ),
    ),
    right(
        "04a",
        "blind: best effort",
        _imported(
            "from rclpy.qos import qos_profile_sensor_data",
            _FRIDGE,
            ("self.temperature_callback, 10", "self.temperature_callback, qos_profile_sensor_data"),
        ),
    ),
    right(
        "04b",
        "blind: an alert in another alphabet",
        edited(
            _ALARM, ('f"{msg.data:.1f} degrees"', '"Achtung: \u00fc\u00e4\u6e29\u5ea6 \U0001f525"')
        ),
    ),
    right(
        "04b",
        "blind: sends waiting alerts ten times a second",
        edited(
            _ALARM,
            (
                "self.alerts = ",
                "self.waiting = []; self.create_timer(0.1, self.send); self.alerts = ",
            ),
            (
                _ALERT,
                'self.waiting.append(f"{msg.data:.1f}")\n\n    def send(self):\n        while self.waiting: self.alerts.publish(String(data=self.waiting.pop(0)))',
            ),
        ),
    ),
    right(
        "04b",
        "blind: counts, too",
        _imported(
            "from std_msgs.msg import Int32",
            _ALARM,
            (
                "self.alerts = ",
                'self.n = 0; self.counts = self.create_publisher(Int32, "alert_count", 10); self.alerts = ',
            ),
            (_ALERT, f"self.n += 1; self.counts.publish(Int32(data=self.n)); {_ALERT}"),
        ),
    ),
    right(
        "04c",
        "blind: an enum that is a text",
        _imported(
            "from enum import Enum\n\nclass Status(str, Enum):\n    HIGH = 'High'\n    LOW = 'Low'\n    NORMAL = 'Normal'\n",
            _CALM,
            ('"High"', "Status.HIGH"),
            ('"Low"', "Status.LOW"),
            ('"Normal"', "Status.NORMAL"),
        ),
    ),
    right(
        "04c",
        "blind: minus one, nothing, one",
        _imported(
            "NAMES = {-1: 'Low', 0: 'Normal', 1: 'High'}",
            _CALM,
            ('"High"', "1"),
            ('"Low"', "-1"),
            ('"Normal"', "0"),
            ("data=status", "data=NAMES[status]"),
        ),
    ),
    right(
        "04c",
        "blind: says the status again on another topic",
        edited(
            _CALM,
            (
                'self.status = "Normal"',
                'self.status = "Normal"; self.every = self.create_publisher(String, "status/every", 10)',
            ),
            (
                "if status != self.status:",
                "self.every.publish(String(data=status))\n        if status != self.status:",
            ),
        ),
    ),
    right(
        "04c",
        "blind: Welford's way",
        edited(
            _CALM,
            ("sum(self.values) / len(self.values)", "self.mean()"),
            (
                "    def judge",
                "    def mean(self):\n        m = 0.0\n        for n, x in enumerate(self.values, 1):\n            m += (x - m) / n\n        return m\n\n    def judge",
            ),
        ),
    ),
    right(
        "04c",
        "blind: no node name of the page, topics in full",
        edited(
            _CALM,
            ('"calm_monitor"', '"peace"'),
            ('"temperature"', '"/temperature"'),
            ('"mean"', '"/mean"'),
            ('"status"', '"/status"'),
        ),
    ),
    right("03b", "blind: at most 0.3, so 0.29", edited(_ROOM, ("(-0.3, 0.3)", "(-0.29, 0.29)"))),
    right("03b", "blind: at most 0.3, so 0.25", edited(_ROOM, ("(-0.3, 0.3)", "(-0.25, 0.25)"))),
    right(
        "03b",
        "blind: three small draws",
        edited(_ROOM, (_STEP, "sum(random.uniform(-0.1, 0.1) for _ in range(3))")),
    ),
    right(
        "03b",
        "blind: twelve tiny draws",
        edited(_ROOM, (_STEP, "sum(random.uniform(-0.025, 0.025) for _ in range(12))")),
    ),
    right(
        "03b",
        "blind: a narrow bell, cut off",
        edited(_ROOM, (_STEP, "max(-0.3, min(0.3, random.gauss(0, 0.05)))")),
    ),
    right(
        "03b",
        "blind: a bell of a third, cut off",
        edited(_ROOM, (_STEP, "max(-0.3, min(0.3, random.gauss(0, 0.1)))")),
    ),
    right(
        "03b",
        "blind: a product of two draws",
        edited(_ROOM, (_STEP, "0.3 * random.uniform(-1, 1) * random.uniform(0, 1)")),
    ),
    right(
        "04a",
        "blind: what was heard, in a line of its own",
        edited(
            _FRIDGE,
            ("temp = msg.data", 'temp = msg.data; self.get_logger().info(f"I heard {temp:.2f}")'),
        ),
    ),
    right(
        "04a",
        "blind: a remark near the limit",
        edited(
            _FRIDGE,
            (_SAYS, f'{_SAYS}\n        if temp < 3: self.get_logger().warning("Frost is near")'),
        ),
    ),
    right(
        "04a",
        "blind: the word alone",
        edited(_FRIDGE, ('f"Fridge: {temp:.2f}C - Status:{status}"', "status")),
    ),
    right(
        "04a",
        "blind: an arrow at each change",
        edited(
            _FRIDGE,
            (_STARTS, f'{_STARTS}; self.old = "Fine"'),
            (
                _SAYS,
                f'{_SAYS}\n        if status != self.old: self.get_logger().info(f"{{self.old}} -> {{status}}")\n        self.old = status',
            ),
        ),
    ),
)

_WRONG = (
    # An article without a text.
    wrong(
        "00b",
        "blind: an empty article",
        "wrong-values",
        edited(_REPORTER, ('"What a match"', '""')),
    ),
    # subscriptions is a property of Node.
    wrong(
        "00a",
        "blind: self.subscriptions",
        "name-taken",
        edited(_READER, (_LISTENS, f"self.subscriptions = [{_LISTENS}]")),
    ),
    # publishers is, too.
    wrong(
        "00b",
        "blind: self.publishers",
        "name-taken",
        edited(
            _REPORTER,
            ("self.publisher ", "self.publishers "),
            ("self.publisher.", "self.publishers."),
        ),
    ),
    # handle is a property that the executor needs.
    wrong(
        "04a",
        "blind: a method handle",
        "name-taken",
        edited(_FRIDGE, ("temperature_callback", "handle")),
    ),
    # timers is a property.
    wrong(
        "03a",
        "blind: self.timers",
        "name-taken",
        edited(_HUMIDITY, ("self.timer ", "self.timers ")),
    ),
    # pause instead of a timer, in the callback.
    either(
        "03a",
        "blind: sleeps in its callback",
        ("callback-blocks", "wrong-rate"),
        _imported(
            "import time",
            _HUMIDITY,
            ("self.publisher_.publish(", "time.sleep(0.5); self.publisher_.publish("),
        ),
    ),
    # The constructor wants a name.
    wrong(
        "04b",
        "blind: a constructor that wants a name",
        "constructor-parameters",
        edited(_ALARM, ("def __init__(self)", "def __init__(self, name)"), ('"alarm"', "name")),
    ),
    # __init__ with one underscore.
    either(
        "03c",
        "blind: _init_",
        (
            "constructor-parameters",
            "node-name-missing",
            "argument-missing",
            "super-missing",
            "new-to-me",
        ),
        edited(_GREEN, ("def __init__", "def _init_")),
    ),
    # The class does not inherit.
    either("04c", "blind: no Node", ("no-node", "super-missing"), edited(_CALM, ("(Node)", ""))),
    # global name instead of self.
    wrong(
        "04c",
        "blind: values without self",
        "name-error",
        edited(_CALM, ("self.values.append(msg.data)", "values.append(msg.data)")),
    ),
    # append gives back None.
    wrong(
        "04c",
        "blind: = append",
        "none-used",
        edited(
            _CALM, ("self.values.append(msg.data)", "self.values = self.values.append(msg.data)")
        ),
    ),
    # A topic with an f-string's braces but nothing else.
    wrong(
        "03a",
        "blind: a percent sign",
        "invalid-name",
        edited(_HUMIDITY, ('"humidity"', '"humidity%"')),
    ),
    # Makes a publisher at each tick, which nobody hears at once.
    wrong(
        "00b",
        "blind: text.data",
        "wrong-attribute",
        edited(
            _REPORTER,
            (
                'self.publisher.publish(String(data="What a match"))',
                'msg = "What a match"; msg.data = msg; self.publisher.publish(msg)',
            ),
        ),
    ),
    # The limits are in, at both.
    wrong(
        "04c",
        "blind: 26 is High and 20 is Low",
        "boundary",
        edited(_CALM, ("> 26.0", ">= 26.0"), ("< 20.0", "<= 20.0")),
    ),
    # The last return is forgotten.
    either(
        "04c",
        "blind: judge ends without a return",
        ("returns-nothing", "none-used"),
        edited(_CALM, ('        return "Normal"\n', "        pass\n")),
    ),
    # A helper that returns nothing.
    either(
        "03b",
        "blind: a clamp without a return",
        ("returns-nothing", "none-used"),
        edited(
            _ROOM,
            (
                "self.temperature = max(18.0, min(28.0, self.temperature))",
                "self.temperature = self.clamp(self.temperature)",
            ),
        )
        + "\n    def clamp(self, t):\n        t = max(18.0, min(28.0, t))\n",
    ),
    # A message of another type than the publisher's, in a node that also listens.
    wrong(
        "04b",
        "blind: a Float32 publisher and a String",
        "type-mismatch",
        edited(_ALARM, ("create_publisher(String", "create_publisher(Float32")),
    ),
    # clients is a property of Node.
    wrong(
        "04a",
        "blind: a method clients",
        "name-taken",
        edited(_FRIDGE, ("temperature_callback", "clients")),
    ),
    # handle is one that the node keeps.
    wrong(
        "00b",
        "blind: self.handle",
        "name-taken",
        edited(_REPORTER, ("self.publisher ", "self.handle "), ("self.publisher.", "self.handle.")),
    ),
)

_ALL: tuple[Answer, ...] = (*_RIGHT, *_WRONG)

#: Where the judge is wrong, and what it says: these answers are not in the table.
REASONS = {
    # The check of the page is right about this one; grading holds it for a person.
    "00b blind: made with type()": "held: 'makes a class with type'.",
}
ANSWERS = tuple(one for one in _ALL if one.id not in REASONS)
DISAGREE = tuple(one for one in _ALL if one.id in REASONS)
