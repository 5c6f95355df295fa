# ruff: noqa: E501
"""More answers to pages 00, 03 and 04 by the same hand, written after the first run of the others."""

from bank.answer import Answer, edited, either, right, wrong
from bank.nodes.blind_00_04 import (
    _ALARM,
    _CALM,
    _DECIDES,
    _FRIDGE,
    _GREEN,
    _HUMIDITY,
    _READER,
    _REPORTER,
    _ROOM,
)

_ALERT = 'self.alerts.publish(String(data=f"{msg.data:.1f} degrees"))'
_MEANS = "self.means.publish(Float32(data=sum(self.values) / len(self.values)))"
_WHEN = "msg.data > 26.0 or msg.data < 20.0"
_LOGS = 'self.get_logger().info(f"I read: {msg.data}")'
_CLAMP = "self.temperature = max(18.0, min(28.0, self.temperature))"
_SAYS = 'self.get_logger().info(f"Fridge: {temp:.2f}C - Status:{status}")'

_NEWSROOM = (
    right(
        "00a",
        "blind: the callback also takes what is known of a message",
        edited(_READER, ("(self, msg)", "(self, msg, info)")),
    ),
    right(
        "00a",
        "blind: a parameter more, with a default",
        edited(_READER, ("(self, msg)", "(self, msg, shout=False)")),
    ),
    right(
        "00a",
        "blind: an object that can be called",
        """
        class Ear:
            def __init__(self, node):
                self.node = node

            def __call__(self, msg):
                self.node.get_logger().info(f"I read: {msg.data}")

        class WeatherReader(Node):
            def __init__(self):
                super().__init__("weather_reader")
                self.create_subscription(String, "weather", Ear(self), 10)
        """,
    ),
    right(
        "00a",
        "blind: an alias of the type",
        "    import std_msgs.msg as m\n" + _READER.replace("(String", "(m.String"),
    ),
    right("00a", "blind: the bare text", edited(_READER, ('f"I read: {msg.data}"', "msg.data"))),
    right(
        "00a",
        "blind: reads twice the sun",
        edited(_READER, (_LOGS, f"[{_LOGS} for _ in range(2)]")),
    ),
    right(
        "00b", "blind: a period as text, which float() takes", edited(_REPORTER, ("2.0", '"2.0"'))
    ),
    right(
        "00b",
        "blind: a decorator",
        """
        from functools import wraps

        def logged(method):
            @wraps(method)
            def wrapper(self, *args, **kwargs):
                self.get_logger().info(f"{method.__name__} is called")
                return method(self, *args, **kwargs)
            return wrapper

        class SportsReporter(Node):
            def __init__(self):
                super().__init__("sports_reporter")
                self.publisher = self.create_publisher(String, "sports", 10)
                self.timer = self.create_timer(2.0, self.write)

            @logged
            def write(self):
                self.publisher.publish(String(data="What a match"))
        """,
    ),
    right(
        "00b",
        "blind: super with the name of the class, no keeping",
        """
        class SportsReporter(Node):
            def __init__(self, **kwargs):
                Node.__init__(self, node_name="sports_reporter", **kwargs)
                self.create_timer(2e0, callback=lambda: self.write("What a match"))
                self.publisher = self.create_publisher(String, "sports", 10)

            def write(self, *words):
                for word in words:
                    self.publisher.publish(String(data=word))
        """,
    ),
    # Two articles at each tick.
    wrong(
        "00b",
        "blind: two articles",
        "wrong-rate",
        edited(
            _REPORTER,
            (
                'self.publisher.publish(String(data="What a match"))',
                'self.publisher.publish(String(data="What")); self.publisher.publish(String(data="a match"))',
            ),
        ),
    ),
    # The message's field is overwritten with the message.
    either(
        "00b",
        "blind: msg = text",
        ("number-published",),
        edited(
            _REPORTER,
            (
                'self.publisher.publish(String(data="What a match"))',
                'msg = String(); msg = "What a match"; self.publisher.publish(msg)',
            ),
        ),
    ),
    # A counter as data.
    wrong(
        "00b",
        "blind: a number as article",
        "not-a-float",
        edited(_REPORTER, ('"What a match"', "42")),
    ),
    # Two readers in one: the same topic twice.
    either(
        "00a",
        "blind: subscribed twice",
        ("heard-twice",),
        edited(
            _READER,
            (
                'self.create_subscription(String, "weather", self.read, 10)',
                'self.create_subscription(String, "weather", self.read, 10); self.create_subscription(String, "weather", self.read, 10)',
            ),
        ),
    ),
    # self forgotten before msg.
    either(
        "00a",
        "blind: read(msg)",
        ("self-missing", "callback-parameters"),
        edited(_READER, ("(self, msg)", "(msg)")),
    ),
    # The topic with the type's brackets.
    wrong("00a", "blind: msg.text", "wrong-field", edited(_READER, ("msg.data", "msg.text"))),
    # A publisher where a subscription belongs.
    either(
        "00a",
        "blind: create_publisher",
        ("no-subscription", "wrong-argument"),
        edited(
            _READER,
            (
                'create_subscription(String, "weather", self.read, 10)',
                'create_publisher(String, "weather", 10)',
            ),
        ),
    ),
)

_SENSORS = (
    right(
        "03a",
        "blind: a decorated tick",
        "    import std_msgs.msg\n" + _HUMIDITY.replace("Float32", "std_msgs.msg.Float32"),
    ),
    right(
        "03a",
        "blind: a fraction",
        "    from fractions import Fraction\n" + _HUMIDITY.replace("0.5,", "Fraction(1, 2),"),
    ),
    right(
        "03a",
        "blind: parameters with defaults, and a third method",
        """
        class HumiditySensor(Node):
            def __init__(self, topic="humidity", depth=5, hertz=2):
                super().__init__("humidity_sensor")
                self._hertz = hertz
                self._open(topic, depth)

            def _open(self, topic, depth):
                self.publisher_ = self.create_publisher(Float32, topic, depth)
                self.timer = self.create_timer(1 / self._hertz, self.publish_humidity)

            def publish_humidity(self):
                self.publisher_.publish(Float32(data=45.0))
        """,
    ),
    right(
        "03b",
        "blind: two decimals are kept",
        edited(
            _ROOM, (_CLAMP, "self.temperature = round(max(18.0, min(28.0, self.temperature)), 2)")
        ),
    ),
    right(
        "03b",
        "blind: uniform imported",
        "    from random import uniform\n" + _ROOM.replace("random.uniform(", "uniform("),
    ),
    right(
        "03b",
        "blind: start and step in one line",
        edited(
            _ROOM,
            (
                _CLAMP,
                "if self.temperature > 28: self.temperature = 28.0\n        if self.temperature < 18: self.temperature = 18.0",
            ),
        ),
    ),
    right(
        "03b",
        "blind: a step that leads out is not taken",
        edited(
            _ROOM,
            (
                "self.temperature += random.uniform(-0.3, 0.3)",
                "new = self.temperature + random.uniform(-0.3, 0.3)",
            ),
            (_CLAMP, "self.temperature = new if 18.0 <= new <= 28.0 else self.temperature"),
        ),
    ),
    right(
        "03b",
        "blind: hundredths, as whole numbers",
        edited(
            _ROOM,
            ("22.0", "2200"),
            ("random.uniform(-0.3, 0.3)", "random.randint(-30, 30)"),
            ("18.0", "1800"),
            ("28.0", "2800"),
            ("data=self.temperature", "data=self.temperature / 100"),
        ),
    ),
    right(
        "03b",
        "blind: accumulated",
        """
        from itertools import accumulate, repeat

        class RoomSensor(Node):
            def __init__(self):
                super().__init__("temperature_sensor")
                self.publisher_ = self.create_publisher(Float32, "temperature", 10)
                self.timer = self.create_timer(1.0, self.publish_temperature)
                self.walk = accumulate(repeat(None), lambda t, _: self.step(t), initial=22.0)
                next(self.walk)

            @staticmethod
            def step(t, wide=0.3, low=18.0, high=28.0):
                return max(low, min(high, t + random.uniform(-wide, +wide)))

            def publish_temperature(self):
                self.publisher_.publish(Float32(data=next(self.walk)))
        """,
    ),
    # numpy's float of 32 bits is no float of Python's.
    wrong(
        "03b",
        "blind: numpy.float32",
        "not-a-float",
        "    import numpy as np\n"
        + _ROOM.replace("data=self.temperature", "data=np.float32(self.temperature)"),
    ),
    # At the upper limit it goes on at the lower one.
    wrong(
        "03b",
        "blind: from 28 to 18",
        "wraps-round",
        edited(
            _ROOM,
            (
                _CLAMP,
                "if self.temperature > 28.0: self.temperature = 18.0\n        if self.temperature < 18.0: self.temperature = 28.0",
            ),
        ),
    ),
    # clamp and result not assigned.
    wrong(
        "03b",
        "blind: the clamp's result is lost",
        "no-clamp",
        edited(_ROOM, (_CLAMP, "max(18.0, min(28.0, self.temperature))")),
    ),
    # Only the step is clamped.
    either(
        "03b",
        "blind: clamps the step",
        ("no-clamp", "wrong-values", "forgets-itself", "jumps", "one-way", "never-changes"),
        edited(
            _ROOM,
            (
                "self.temperature += random.uniform(-0.3, 0.3)",
                "self.temperature += max(18.0, min(28.0, random.uniform(-0.3, 0.3)))",
            ),
            (_CLAMP, "pass"),
        ),
    ),
    # The step is subtracted only at the top, so it steps up by 0.3 and down by 0.1.
    wrong("03b", "blind: uneven", "uneven-steps", edited(_ROOM, ("(-0.3, 0.3)", "(-0.1, 0.3)"))),
    # A decimal comma.
    either(
        "03b",
        "blind: a decimal comma",
        ("wrong-argument", "argument-missing", "raised", "new-to-me"),
        edited(_ROOM, ("uniform(-0.3, 0.3)", "uniform(-0,3, 0,3)")),
    ),
    # A tenth.
    wrong("03b", "blind: 0.03", "step-too-small", edited(_ROOM, ("(-0.3, 0.3)", "(-0.03, 0.03)"))),
    right(
        "03c",
        "blind: c and f, a lambda",
        edited(
            _GREEN,
            (
                "Float32(data=self.celsius * 9 / 5 + 32)",
                "Float32(data=(lambda c: c * 9 / 5 + 32)(self.celsius))",
            ),
        ),
    ),
    right(
        "03c",
        "blind: from Kelvin",
        edited(
            _GREEN,
            ("22.0", "295.15"),
            ("28.0", "301.15"),
            ("10.2", "283.35"),
            ("self.celsius * 9", "(self.celsius - 273.15) * 9"),
        ),
    ),
    right(
        "03c",
        "blind: a helper object with the clock's time in the log",
        edited(
            _GREEN,
            (
                "step = ",
                'self.get_logger().debug(f"{self.get_clock().now().nanoseconds}"); step = ',
            ),
        ),
    ),
    right(
        "03c",
        "blind: the node's own default namespace",
        edited(
            _GREEN, ('"greenhouse/temperature"', 'self.get_namespace() + "greenhouse/temperature"')
        ),
    ),
    # Four in one second, at once.
    wrong(
        "03c",
        "blind: four at once",
        "wrong-rate",
        edited(
            _GREEN,
            ("0.25", "1.0"),
            ("step = ", "for _ in range(4): self.move()\n\n    def move(self):\n        step = "),
        ),
    ),
    # The limits are kept in Fahrenheit with Celsius' numbers.
    either(
        "03c",
        "blind: clamps Fahrenheit with Celsius limits",
        ("never-changes", "wrong-unit", "wrong-values", "other-limits"),
        edited(
            _GREEN,
            ("min(28.0, max(10.2, self.celsius + step))", "self.celsius + step"),
            ("self.celsius * 9 / 5 + 32", "min(28.0, max(10.2, self.celsius * 9 / 5 + 32))"),
        ),
    ),
    # 30 for 32.
    either(
        "03c",
        "blind: + 30",
        ("wrong-unit", "wrong-values", "new-to-me"),
        edited(_GREEN, ("+ 32", "+ 30")),
    ),
    # From Fahrenheit to Celsius.
    either(
        "03c",
        "blind: the other way",
        ("wrong-unit", "wrong-values", "new-to-me"),
        edited(_GREEN, ("self.celsius * 9 / 5 + 32", "(self.celsius - 32) * 5 / 9")),
    ),
    # The topic with a word in plural.
    wrong(
        "03c",
        "blind: temperatures",
        "topic-misspelled",
        edited(_GREEN, ("/temperature", "/temperatures")),
    ),
)


def _fridge(decision: str) -> str:
    return edited(_FRIDGE.replace(_DECIDES, decision + "\n"))


def _alarm(*edits: tuple[str, str]) -> str:
    return edited(_ALARM, *edits)


def _hysteresis(*edits: tuple[str, str]) -> str:
    return edited(_CALM, *edits)


_MONITORS = (
    right(
        "04a",
        "blind: a dict",
        _fridge(
            'status = {(True, False): "Warm", (False, True): "Frost"}.get((temp > 8, temp < 2), "Fine")'
        ),
    ),
    right(
        "04a",
        "blind: and, or",
        _fridge('status = temp > 8 and "Warm" or temp < 2 and "Frost" or "Fine"'),
    ),
    right(
        "04a",
        "blind: starts with Fine",
        _fridge(
            'status = "Fine"\n            if temp > 8.0:\n                status = "Warm"\n            if 2.0 > temp:\n                status = "Frost"'
        ),
    ),
    right(
        "04a",
        "blind: how far from the middle",
        _fridge('status = "Fine" if abs(temp - 5) <= 3 else "Warm" if temp > 5 else "Frost"'),
    ),
    # Printed.
    wrong(
        "04a",
        "blind: print",
        "nothing-logged",
        edited(_FRIDGE, ("self.get_logger().info", "print")),
    ),
    # A blank in the word.
    wrong(
        "04a",
        "blind: a list",
        "wrong-word",
        _fridge('status = ["Warm"] if temp > 8 else ["Frost"] if temp < 2 else ["Fine"]'),
    ),
    # Only the first reading counts.
    either(
        "04a",
        "blind: rounded first",
        ("wrong-state", "boundary", "decimals-lost"),
        _fridge(
            'temp = round(temp)\n            status = "Warm" if temp > 8 else "Frost" if temp < 2 else "Fine"'
        ),
    ),
    # Frost is never reached: the first condition takes all below 8.
    wrong(
        "04a",
        "blind: Frost never",
        "wrong-state",
        _fridge(
            'if temp > 8:\n                status = "Warm"\n            elif temp <= 8:\n                status = "Fine"\n            else:\n                status = "Frost"'
        ),
    ),
    # Typo.
    wrong(
        "04a",
        "blind: Forst",
        "wrong-word",
        _fridge('status = "Warm" if temp > 8 else "Forst" if temp < 2 else "Fine"'),
    ),
    right(
        "04b", "blind: min and max", _alarm((_WHEN, "msg.data != max(20.0, min(26.0, msg.data))"))
    ),
    right(
        "04b", "blind: a set of comparisons", _alarm((_WHEN, "(msg.data > 26) ^ (msg.data < 20)"))
    ),
    right(
        "04b",
        "blind: the text of a walrus",
        _alarm(
            (
                f"if {_WHEN}:",
                'if (word := "hot" if msg.data > 26 else "cold" if msg.data < 20 else ""):',
            ),
            ('f"{msg.data:.1f} degrees"', "word"),
        ),
    ),
    # A chain that no number fits.
    wrong(
        "04b", "blind: 26 < x < 20", "never-published", _alarm((_WHEN, "26.0 < msg.data < 20.0"))
    ),
    # The limits count as alarms.
    wrong(
        "04b",
        "blind: not strictly between",
        "boundary",
        _alarm((_WHEN, "not 20.0 < msg.data < 26.0")),
    ),
    # Whole degrees.
    either(
        "04b",
        "blind: int",
        ("alert-missing", "decimals-lost"),
        _alarm((_WHEN, "int(msg.data) > 26 or int(msg.data) < 20")),
    ),
    # One sign for or.
    either(
        "04b",
        "blind: |",
        ("wrong-argument", "raised", "new-to-me"),
        _alarm((_WHEN, "msg.data > 26.0 | msg.data < 20.0")),
    ),
    # A message in the place of a publisher.
    either(
        "04b",
        "blind: a String for a publisher",
        ("no-publisher", "wrong-attribute"),
        _alarm(('self.create_publisher(String, "alert", 10)', "String()")),
    ),
    # The number without quotes of any kind.
    wrong(
        "04b", "blind: f forgotten in the topic", "invalid-name", _alarm(('"alert"', '"{alert}"'))
    ),
    # Limits of the fridge.
    either(
        "04b",
        "blind: the fridge's limits",
        ("alert-too-many", "other-limits"),
        _alarm(("26.0", "8.0"), ("20.0", "2.0")),
    ),
    # The brackets of the callback.
    wrong(
        "04b",
        "blind: callback()",
        "callback-called",
        _alarm(("self.temperature_callback,", "self.temperature_callback(),")),
    ),
    # The name of another topic.
    wrong("04b", "blind: listens to alert", "wrong-topic", _alarm(('"temperature"', '"temp"'))),
    # One border at its place.
    wrong("04c", "blind: 25 comes back", "boundary", _hysteresis((">= 25.0", "> 25.0"))),
    wrong("04c", "blind: 21 comes back", "boundary", _hysteresis(("<= 21.0", "< 21.0"))),
    # 26 is High.
    wrong("04c", "blind: 26 is High", "boundary", _hysteresis(("> 26.0", ">= 26.0"))),
    # 20 is Low.
    wrong("04c", "blind: 20 is Low", "boundary", _hysteresis(("< 20.0", "<= 20.0"))),
    # From High one has to pass Normal first.
    either(
        "04c",
        "blind: High, then Normal, then Low",
        ("wrong-state", "hysteresis-lost", "new-to-me"),
        edited(
            _CALM[: _CALM.index("        def judge")]
            + """
        def judge(self, value):
            if self.status == "High":
                return "Normal" if value < 25.0 else "High"
            if self.status == "Low":
                return "Normal" if value > 21.0 else "Low"
            return "High" if value > 26.0 else "Low" if value < 20.0 else "Normal"
"""
        ),
    ),
    # The median.
    either(
        "04c",
        "blind: the median",
        ("other-mean", "wrong-window"),
        "    import statistics\n"
        + _CALM.replace("sum(self.values) / len(self.values)", "statistics.median(self.values)"),
    ),
    # Float64.
    wrong(
        "04c",
        "blind: a mean with 64 bits",
        "type-mismatch",
        "    from std_msgs.msg import Float64\n"
        + _CALM.replace(
            'create_publisher(Float32, "mean"', 'create_publisher(Float64, "mean"'
        ).replace("publish(Float32(", "publish(Float64("),
    ),
    # Said in a sentence.
    wrong(
        "04c",
        "blind: a sentence",
        "wrong-word",
        _hysteresis(("String(data=status)", 'String(data=f"Status: {status}")')),
    ),
    # The start said in the constructor.
    either(
        "04c",
        "blind: Normal said at first",
        ("status-repeated", "first-messages-lost"),
        _hysteresis(
            (
                'self.status = "Normal"',
                'self.status = "Normal"; self.statuses.publish(String(data=self.status))',
            )
        ),
    ),
    # Six.
    wrong("04c", "blind: six", "wrong-window", _hysteresis(("> 5:", "> 6:"))),
    # The two ways back are swapped.
    either(
        "04c",
        "blind: 21 and 25 swapped",
        ("hysteresis-lost", "no-hysteresis", "wrong-state", "new-to-me"),
        _hysteresis((">= 25.0", ">= 21.0"), ("<= 21.0", "<= 25.0")),
    ),
    # No mean.
    either(
        "04c", "blind: no mean", ("never-published", "no-publisher"), _hysteresis((_MEANS, "pass"))
    ),
    # The reading is told on, as it is.
    wrong(
        "04c",
        "blind: the reading for the mean",
        "wrong-window",
        _hysteresis((_MEANS, "self.means.publish(msg)")),
    ),
    # The status is not in self.
    wrong(
        "04c",
        "blind: status without self",
        "no-value-yet",
        _hysteresis(
            ("if status != self.status", "if old != status"),
            ("self.status = status", "old = status"),
        ),
    ),
    # Both topics swapped.
    either(
        "04c",
        "blind: topics swapped",
        ("type-mismatch", "wrong-topic"),
        _hysteresis(('"mean"', '"XX"'), ('"status"', '"mean"'), ('"XX"', '"status"')),
    ),
    right(
        "04c",
        "blind: the last five with a slice assigned",
        _hysteresis(
            (
                "if len(self.values) > 5:\n            self.values.pop(0)\n",
                "self.values[:] = self.values[-5:]\n",
            )
        ),
    ),
    right(
        "04c",
        "blind: first the status, then the mean",
        _hysteresis(
            (_MEANS, ""),
            (
                "status = self.judge(msg.data)\n",
                f"status = self.judge(msg.data)\n        self.window = self.values; {_MEANS}\n",
            ),
        ),
    ),
    right(
        "04c",
        "blind: limits in a table",
        edited(
            _CALM[: _CALM.index("        def judge")]
            + """
        def judge(self, value):
            low, high = {"Low": (21.0, 26.0), "High": (20.0, 25.0)}.get(self.status, (20.0, 26.0))
            if value > high or (self.status == "High" and value == high):
                return "High"
            if value < low or (self.status == "Low" and value == low):
                return "Low"
            return "Normal"
"""
        ),
    ),
)

_ALL: tuple[Answer, ...] = (*_NEWSROOM, *_SENSORS, *_MONITORS)

#: Where the judge is wrong, and what it says: these answers are not in the table.
REASONS = {}
ANSWERS = tuple(one for one in _ALL if one.id not in REASONS)
DISAGREE = tuple(one for one in _ALL if one.id in REASONS)
