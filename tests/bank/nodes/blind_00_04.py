# ruff: noqa: E501
"""Answers to pages 00, 03 and 04, written by somebody who had seen the pages and no judge."""

from bank.answer import Answer, edited, either, right, wrong

# ---------------------------------------------------------------------------------------- page 00

_READER = """
    class WeatherReader(Node):
        def __init__(self):
            super().__init__("weather_reader")
            self.create_subscription(String, "weather", self.read, 10)

        def read(self, msg):
            self.get_logger().info(f"I read: {msg.data}")
"""
_LISTENS = 'self.create_subscription(String, "weather", self.read, 10)'
_LOGS = 'self.get_logger().info(f"I read: {msg.data}")'


def _reader(*edits: tuple[str, str]) -> str:
    return edited(_READER, *edits)


_READERS = (
    right(
        "00a",
        "blind: a general reader, and a class of it with defaults",
        """
        class Reader(Node):
            def __init__(self, name, topic, kind=String, depth=10):
                super().__init__(name)
                self.subscription = self.create_subscription(kind, topic, self.read, depth)

            def read(self, msg):
                self.get_logger().info(f"I read: {msg.data}")

        class WeatherReader(Reader):
            def __init__(self):
                super().__init__("weather_reader", "weather")
        """,
    ),
    right(
        "00a",
        "blind: a lambda",
        """
        class WeatherReader(Node):
            def __init__(self):
                super().__init__("weather_reader")
                log = self.get_logger()
                self.create_subscription(
                    String, "weather", lambda msg: log.info("I read: " + msg.data), 10
                )
        """,
    ),
    right(
        "00a",
        "blind: all arguments by name",
        _reader(
            (
                _LISTENS,
                'self.create_subscription(qos_profile=10, callback=self.read, topic="weather",'
                " msg_type=String)",
            )
        ),
    ),
    right(
        "00a",
        "blind: partial, with a prefix",
        """
        from functools import partial

        class WeatherReader(Node):
            def __init__(self):
                super().__init__("weather_reader")
                self.create_subscription(String, "weather", partial(self.read, "I read:"), 10)

            def read(self, prefix, msg):
                self.get_logger().info(prefix + " " + msg.data)
        """,
    ),
    right(
        "00a",
        "blind: a coroutine as callback",
        _reader(("def read", "async def read")),
    ),
    right(
        "00a",
        "blind: a constant, type hints and a match",
        """
        class WeatherReader(Node):
            TOPIC: str = "/weather"

            def __init__(self, depth: int = 10) -> None:
                super().__init__("weather_reader")
                self.heard: list[str] = []
                self.create_subscription(String, self.TOPIC, self.read, depth)

            def read(self, msg: String) -> None:
                match msg:
                    case String(data=text):
                        self.heard.append(text)
                        self.get_logger().info(f"I read: {text} ({len(self.heard)})")
        """,
    ),
    right(
        "00a",
        "blind: a function outside the class",
        """
        def reads_aloud(node):
            def read(msg):
                node.get_logger().info(f"I read: {msg.data}")
            return read

        class WeatherReader(Node):
            def __init__(self):
                super().__init__("weather_reader")
                self.create_subscription(String, "weather", reads_aloud(self), 10)
        """,
    ),
    right(
        "00a",
        "blind: a loop over the topics, of which there is one",
        _reader(
            (
                _LISTENS,
                'for topic in ("weather",): self.create_subscription(String, topic, self.read, 10)',
            )
        ),
    ),
    # The reader writes the topic as the heading has it, with a capital letter.
    wrong("00a", "blind: a capital", "topic-misspelled", _reader(('"weather"', '"Weather"'))),
    # The quotes are forgotten.
    wrong("00a", "blind: no quotes", "name-error", _reader(('"weather"', "weather"))),
    # The name of the reporter instead of its topic.
    either(
        "00a",
        "blind: the reporter's name",
        ("wrong-topic", "topic-misspelled"),
        _reader(('"weather"', '"weather_reporter"')),
    ),
    # One reader for all: weather and sports, too.
    either(
        "00a",
        "blind: sports, too",
        ("wrong-topic", "new-to-me", "wrong-values"),
        _reader((_LISTENS, f"{_LISTENS}; {_LISTENS.replace('weather', 'sports')}")),
    ),
    # The callback is called at once.
    wrong("00a", "blind: brackets", "callback-called", _reader(("self.read,", "self.read(),"))),
    # A blank in the topic's name.
    wrong("00a", "blind: a blank", "invalid-name", _reader(('"weather"', '"the weather"'))),
    # The page's first publisher sends Float32, and its type was copied.
    wrong(
        "00a",
        "blind: Float32",
        "type-mismatch",
        _reader((_LISTENS, _LISTENS.replace("String", "Float32"))),
    ),
    # The callback has no parameter for the message.
    wrong(
        "00a",
        "blind: no msg",
        "callback-parameters",
        _reader(("(self, msg)", "(self)"), ("{msg.data}", "it")),
    ),
    # The message is logged, not a text.
    wrong(
        "00a",
        "blind: logs the message",
        "logged-no-text",
        _reader((_LOGS, "self.get_logger().info(msg)")),
    ),
    # The word is spelt as one hears it.
    wrong("00a", "blind: whether", "topic-misspelled", _reader(('"weather"', '"whether"'))),
)

_REPORTER = """
    class SportsReporter(Node):
        def __init__(self):
            super().__init__("sports_reporter")
            self.publisher = self.create_publisher(String, "sports", 10)
            self.timer = self.create_timer(2.0, self.write)

        def write(self):
            self.publisher.publish(String(data="What a match"))
"""
_TIMER = "self.timer = self.create_timer(2.0, self.write)"
_PUBLISHES = 'self.publisher.publish(String(data="What a match"))'


def _reporter(*edits: tuple[str, str]) -> str:
    return edited(_REPORTER, *edits)


_REPORTERS = (
    right(
        "00b",
        "blind: a generator of articles",
        """
        class SportsReporter(Node):
            def __init__(self):
                super().__init__("sports_reporter")
                self.articles = self.think()
                self.create_timer(2, lambda: self.paper.publish(next(self.articles)))
                self.paper = self.create_publisher(String, "sports", 10)

            def think(self):
                number = 0
                while True:
                    number += 1
                    yield String(data=f"Match number {number}")
        """,
    ),
    right(
        "00b",
        "blind: partial, no method",
        """
        from functools import partial

        class SportsReporter(Node):
            def __init__(self):
                super().__init__("sports_reporter")
                sports = self.create_publisher(String, "sports", 10)
                self.create_timer(2.0, partial(sports.publish, String(data="What a match")))
        """,
    ),
    right(
        "00b",
        "blind: beats each second and writes at every other",
        """
        class SportsReporter(Node):
            def __init__(self):
                super().__init__("sports_reporter")
                self.publisher = self.create_publisher(String, "sports", 10)
                self.beats = 0
                self.create_timer(1.0, self.beat)

            def beat(self):
                self.beats += 1
                if self.beats % 2 == 0:
                    self.publisher.publish(String(data="What a match"))
        """,
    ),
    right(
        "00b",
        "blind: looks at the clock",
        """
        from rclpy.duration import Duration

        class SportsReporter(Node):
            def __init__(self):
                super().__init__("sports_reporter")
                self.publisher = self.create_publisher(String, "sports", 10)
                self.last = self.get_clock().now()
                self.create_timer(0.5, self.look)

            def look(self):
                if (now := self.get_clock().now()) - self.last >= Duration(seconds=2):
                    self.last = now
                    self.publisher.publish(String(data="What a match"))
        """,
    ),
    right(
        "00b",
        "blind: a dataclass of an article",
        """
        from dataclasses import dataclass

        @dataclass
        class Article:
            title: str
            goals: int = 0

            def message(self):
                return String(data=f"{self.title}: {self.goals}")

        class SportsReporter(Node):
            def __init__(self):
                super().__init__("sports_reporter")
                self.publisher = self.create_publisher(String, "sports", 10)
                self.article = Article("Goals")
                self.start()

            def start(self, period=60 / 30):
                self.timer = self.create_timer(period, self.write)

            def write(self):
                self.publisher.publish(self.article.message())
                self.article.goals += 1
        """,
    ),
    right(
        "00b",
        "blind: one message for all times, and a topic more",
        """
        class SportsReporter(Node):
            def __init__(self):
                super().__init__("sports_reporter")
                self.publisher = self.create_publisher(String, "sports", 10)
                self.echo = self.create_publisher(String, "sports_echo", 10)
                self.msg = String()
                self.msg.data = "What a match"
                self.timer = self.create_timer(2.0, self.write)

            def write(self):
                self.publisher.publish(self.msg)
                self.echo.publish(self.msg)
        """,
    ),
    right("00b", "blind: a coroutine", _reporter(("def write", "async def write"))),
    right(
        "00b",
        "blind: a one-shot timer, set again each time",
        """
        class SportsReporter(Node):
            def __init__(self):
                super().__init__("sports_reporter")
                self.publisher = self.create_publisher(String, "sports", 10)
                self.timer = self.create_timer(2.0, self.write)

            def write(self):
                self.publisher.publish(String(data="What a match"))
                self.timer.cancel()
                self.timer = self.create_timer(2.0, self.write)
        """,
    ),
    # Twice a second instead of every two seconds.
    either(
        "00b", "blind: half a second", ("wrong-rate", "period-for-rate"), _reporter(("2.0", "0.5"))
    ),
    # The period in milliseconds.
    either(
        "00b", "blind: milliseconds", ("wrong-rate", "never-published"), _reporter(("2.0", "2000"))
    ),
    # One letter less.
    wrong("00b", "blind: sport", "topic-misspelled", _reporter(('sports",', 'sport",'))),
    # The method is called, and None is handed over.
    wrong("00b", "blind: brackets", "callback-called", _reporter(("self.write)", "self.write())"))),
    # The text itself is published.
    wrong(
        "00b",
        "blind: the text",
        "number-published",
        _reporter(('String(data="What a match")', '"What a match"')),
    ),
    # No name of the field.
    wrong("00b", "blind: no data=", "field-without-name", _reporter(("data=", ""))),
    # A field that String does not have.
    wrong("00b", "blind: text=", "wrong-keyword", _reporter(("data=", "text="))),
    # The publisher is not kept, only a name of the constructor's.
    wrong(
        "00b",
        "blind: no self.",
        "wrong-attribute",
        _reporter(("self.publisher = ", "publisher = ")),
    ),
    # No timer: it writes once, in its constructor.
    wrong("00b", "blind: once", "no-timer", _reporter((_TIMER, "self.write()"))),
    # A loop in the constructor, with a pause.
    wrong(
        "00b",
        "blind: a loop in the constructor",
        "constructor-blocks",
        "    import time\n"
        + _REPORTER.replace(_TIMER, "while True: self.write(); time.sleep(2.0)"),
    ),
    # Topic before type.
    wrong(
        "00b",
        "blind: topic first",
        "arguments-swapped",
        _reporter(('String, "sports"', '"sports", String')),
    ),
    # The timer is stopped after the first article.
    wrong(
        "00b",
        "blind: stops",
        "gone-quiet",
        _reporter((_PUBLISHES, f"{_PUBLISHES}; self.timer.cancel()")),
    ),
    # Each article sets one more timer, and the old ones go on.
    wrong(
        "00b",
        "blind: more and more timers",
        "wrong-rate",
        _reporter((_PUBLISHES, f"{_PUBLISHES}; {_TIMER}")),
    ),
)

# ---------------------------------------------------------------------------------------- page 03

_HUMIDITY = """
    class HumiditySensor(Node):
        def __init__(self):
            super().__init__("humidity_sensor")
            self.publisher_ = self.create_publisher(Float32, "humidity", 5)
            self.timer = self.create_timer(0.5, self.publish_humidity)

        def publish_humidity(self):
            self.publisher_.publish(Float32(data=45.0))
"""
_VOICE = 'self.create_publisher(Float32, "humidity", 5)'
_BEAT = "self.create_timer(0.5, self.publish_humidity)"


def _humid(*edits: tuple[str, str]) -> str:
    return edited(_HUMIDITY, *edits)


_HUMIDITIES = (
    right(
        "03a",
        "blind: a profile in full, names of arguments",
        "from rclpy.qos import HistoryPolicy, QoSProfile, ReliabilityPolicy\n"
        + _humid(
            (
                _VOICE,
                'self.create_publisher(msg_type=Float32, topic="/humidity", qos_profile=QoSProfile('
                "history=HistoryPolicy.KEEP_LAST, depth=5, reliability=ReliabilityPolicy.RELIABLE))",
            ),
            (_BEAT, "self.create_timer(timer_period_sec=1 / 2, callback=self.publish_humidity)"),
        ),
    ),
    right(
        "03a",
        "blind: a base class that asks its children",
        """
        class Sensor(Node):
            name = topic = ""
            depth, period = 10, 1.0

            def __init__(self):
                super().__init__(self.name)
                self.publisher_ = self.create_publisher(Float32, self.topic, self.depth)
                self.timer = self.create_timer(self.period, self.tick)

            def tick(self):
                self.publisher_.publish(Float32(data=self.read()))

        class HumiditySensor(Sensor):
            name, topic, depth, period = "humidity_sensor", "humidity", 5, 0.5

            def read(self):
                return 45.0
        """,
    ),
    right(
        "03a",
        "blind: a cached property makes the publisher",
        """
        from functools import cached_property

        class HumiditySensor(Node):
            def __init__(self):
                super().__init__("humidity_sensor")
                self.sink.publish
                self.create_timer(0.5, self.publish_humidity)

            @cached_property
            def sink(self):
                return self.create_publisher(Float32, "humidity", 5)

            def publish_humidity(self):
                self.sink.publish(Float32(data=45.0))
        """,
    ),
    right("03a", "blind: nothing kept of the timer", _humid(("self.timer = ", ""))),
    right(
        "03a",
        "blind: numpy and a group of callbacks",
        """
        import numpy as np
        from rclpy.callback_groups import ReentrantCallbackGroup

        class HumiditySensor(Node):
            def __init__(self):
                super().__init__("humidity_sensor")
                self.group = ReentrantCallbackGroup()
                self.publisher_ = self.create_publisher(Float32, "humidity", 5)
                self.timer = self.create_timer(
                    0.5, self.publish_humidity, callback_group=self.group
                )

            def publish_humidity(self):
                self.publisher_.publish(Float32(data=np.float64(45.0)))
        """,
    ),
    right(
        "03a",
        "blind: two timers of one second, half a second apart",
        """
        class HumiditySensor(Node):
            def __init__(self):
                super().__init__("humidity_sensor")
                self.publisher_ = self.create_publisher(Float32, "humidity", 5)
                self.create_timer(1.0, self.publish_humidity)
                self.starter = self.create_timer(0.5, self.start)

            def start(self):
                self.starter.cancel()
                self.publish_humidity()
                self.create_timer(1.0, self.publish_humidity)

            def publish_humidity(self):
                self.publisher_.publish(Float32(data=45.0))
        """,
    ),
    right(
        "03a",
        "blind: wanders, and logs it",
        _humid(
            (
                "self.publisher_.publish(Float32(data=45.0))",
                "msg = Float32(data=random.gauss(45.0, 2.0)); self.publisher_.publish(msg);"
                ' self.get_logger().info("%.1f %%" % msg.data)',
            )
        ),
    ),
    # Twice a second taken for every two seconds.
    either("03a", "blind: two seconds", ("wrong-rate", "period-for-rate"), _humid(("0.5", "2.0"))),
    # The depth of the sensor above.
    wrong("03a", "blind: ten", "wrong-depth", _humid((", 5)", ", 10)"))),
    # The topic of the sensor above.
    wrong("03a", "blind: temperature", "wrong-topic", _humid(('"humidity"', '"temperature"'))),
    # Float64 for more digits.
    wrong(
        "03a",
        "blind: Float64",
        "type-mismatch",
        "from std_msgs.msg import Float64\n" + _humid(("Float32", "Float64")),
    ),
    # Depth before topic.
    wrong(
        "03a", "blind: depth first", "arguments-swapped", _humid(('"humidity", 5', '5, "humidity"'))
    ),
    # Method before period.
    wrong(
        "03a",
        "blind: method first",
        "arguments-swapped",
        _humid(("0.5, self.publish_humidity", "self.publish_humidity, 0.5")),
    ),
    # A message made in the place of its type.
    wrong("03a", "blind: Float32()", "not-a-message-type", _humid(("(Float32,", "(Float32(),"))),
    # The name of the method of the sensor above.
    wrong(
        "03a",
        "blind: publish_temperature",
        "wrong-attribute",
        _humid((_BEAT, "self.create_timer(0.5, self.publish_temperature)")),
    ),
    # The method's name without self.
    wrong(
        "03a",
        "blind: no self",
        "name-error",
        _humid((_BEAT, "self.create_timer(0.5, publish_humidity)")),
    ),
    # The number is put into the class.
    either(
        "03a",
        "blind: into the class",
        ("class-changed", "class-published"),
        _humid(
            (
                "self.publisher_.publish(Float32(data=45.0))",
                "msg = Float32; msg.data = 45.0; self.publisher_.publish(msg)",
            )
        ),
    ),
    # A whole number.
    wrong("03a", "blind: an int", "not-a-float", _humid(("45.0", "45"))),
    # Nothing to call.
    either(
        "03a",
        "blind: no callback",
        ("callback-missing", "argument-missing"),
        _humid((_BEAT, "self.create_timer(0.5)")),
    ),
    # No depth.
    wrong("03a", "blind: no depth", "depth-missing", _humid((", 5)", ")"))),
    # The depth as text.
    either(
        "03a",
        "blind: a text as depth",
        ("wrong-argument", "wrong-depth"),
        _humid((", 5)", ', "5")')),
    ),
)

_ROOM = """
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
_SENDS = "self.publisher_.publish(Float32(data=self.temperature))"


def _room(*edits: tuple[str, str]) -> str:
    return edited(_ROOM, *edits)


_ROOMS = (
    right(
        "03b",
        "blind: numpy clips",
        "import numpy as np\n"
        + _room((_CLAMP, "self.temperature = float(np.clip(self.temperature, 18, 28))")),
    ),
    right(
        "03b",
        "blind: numpy draws",
        "import numpy as np\n" + _room(("random.uniform", "np.random.uniform")),
    ),
    right(
        "03b",
        "blind: numpy's generator",
        """
        import numpy as np

        class RoomSensor(Node):
            def __init__(self):
                super().__init__("temperature_sensor")
                self.publisher_ = self.create_publisher(Float32, "temperature", 10)
                self.timer = self.create_timer(1.0, self.publish_temperature)
                self.temperature = 22.0
                self.chance = np.random.default_rng()

            def publish_temperature(self):
                self.temperature += self.chance.uniform(-0.3, 0.3)
                self.temperature = max(18.0, min(28.0, self.temperature))
                self.publisher_.publish(Float32(data=self.temperature))
        """,
    ),
    right(
        "03b",
        "blind: chance of its own, with a seed",
        _room(
            (_STEP, "self.temperature += self.chance.uniform(-0.3, 0.3)"),
            ("22.0", "22.0; self.chance = random.Random(7)"),
        ),
    ),
    right(
        "03b", "blind: tenths", _room(("random.uniform(-0.3, 0.3)", "random.randint(-3, 3) / 10"))
    ),
    right(
        "03b", "blind: a coin", _room(("random.uniform(-0.3, 0.3)", "random.choice((-0.3, 0.3))"))
    ),
    right(
        "03b",
        "blind: a die and a coin",
        _room(("random.uniform(-0.3, 0.3)", "random.choice([1, -1]) * random.random() * 0.3")),
    ),
    right(
        "03b",
        "blind: a bell curve, cut off",
        _room(("random.uniform(-0.3, 0.3)", "max(-0.3, min(0.3, random.gauss(0, 0.15)))")),
    ),
    right(
        "03b",
        "blind: the middle of three",
        _room((_CLAMP, "_, self.temperature, _ = sorted((18.0, self.temperature, 28.0))")),
    ),
    right(
        "03b",
        "blind: draws again until it fits",
        """
        class RoomSensor(Node):
            def __init__(self):
                super().__init__("temperature_sensor")
                self.publisher_ = self.create_publisher(Float32, "temperature", 10)
                self.timer = self.create_timer(1.0, self.publish_temperature)
                self.temperature = 22.0

            def publish_temperature(self):
                while not 18.0 <= (new := self.temperature + random.uniform(-0.3, 0.3)) <= 28.0:
                    pass
                self.temperature = new
                self.publisher_.publish(Float32(data=self.temperature))
        """,
    ),
    right(
        "03b",
        "blind: a walker of its own, a dataclass",
        """
        from dataclasses import dataclass

        @dataclass
        class Walk:
            at: float = 22.0
            low: float = 18.0
            high: float = 28.0
            step: float = 0.3

            def __next__(self):
                self.at += (2 * random.random() - 1) * self.step
                if self.at > self.high:
                    self.at = self.high
                elif self.at < self.low:
                    self.at = self.low
                return self.at

        class RoomSensor(Node):
            def __init__(self):
                super().__init__("temperature_sensor")
                self.publisher_ = self.create_publisher(Float32, "temperature", 10)
                self.walk = Walk()
                self.timer = self.create_timer(1.0, self.publish_temperature)

            def publish_temperature(self):
                self.publisher_.publish(Float32(data=next(self.walk)))
        """,
        "RoomSensor",
    ),
    right(
        "03b",
        "blind: a property that keeps the limits",
        """
        class RoomSensor(Node):
            def __init__(self):
                super().__init__("temperature_sensor")
                self.publisher_ = self.create_publisher(Float32, "temperature", 10)
                self.timer = self.create_timer(1.0, self.publish_temperature)
                self.temperature = 22.0

            @property
            def temperature(self):
                return self._temperature

            @temperature.setter
            def temperature(self, value):
                self._temperature = min(max(value, 18.0), 28.0)

            def publish_temperature(self):
                self.temperature += random.triangular(-0.3, 0.3)
                self.publisher_.publish(Float32(data=self.temperature))
                self.get_logger().info(f"{self.temperature=:.2f}")
        """,
    ),
    right(
        "03b",
        "blind: bounces off the limits",
        _room(
            (
                _CLAMP,
                "t = self.temperature; self.temperature = 56.0 - t if t > 28.0 else 36.0 - t if t < 18.0 else t",
            )
        ),
    ),
    right(
        "03b",
        "blind: the system's chance",
        _room(("random.uniform(", "random.SystemRandom().uniform(")),
    ),
    # 18 and 28 are ints: at a limit the float becomes an int.
    wrong("03b", "blind: whole limits", "not-a-float", _room(("18.0", "18"), ("28.0", "28"))),
    # The step of the sensor above.
    wrong("03b", "blind: half a degree", "step-too-wide", _room(("(-0.3, 0.3)", "(-0.5, 0.5)"))),
    # Only upwards.
    wrong("03b", "blind: from 0", "one-way", _room(("(-0.3, 0.3)", "(0, 0.3)"))),
    # The step is the temperature.
    either("03b", "blind: = for +=", ("forgets-itself", "never-changes"), _room(("+=", "="))),
    # min and max swapped.
    either(
        "03b",
        "blind: min of max",
        ("clamp-swapped", "never-changes"),
        _room(("max(18.0, min(28.0, self.temperature))", "min(18.0, max(28.0, self.temperature))")),
    ),
    # The lower limit of the sensor above.
    either("03b", "blind: 10.2", ("other-limits", "no-clamp"), _room(("18.0", "10.2"))),
    # Only the upper limit.
    wrong(
        "03b",
        "blind: only min",
        "no-clamp",
        _room((_CLAMP, "self.temperature = min(28.0, self.temperature)")),
    ),
    # The clamped value is published and not kept.
    wrong(
        "03b",
        "blind: not kept",
        "clamp-not-kept",
        _room(
            (_CLAMP, "t = max(18.0, min(28.0, self.temperature))"),
            ("data=self.temperature", "data=t"),
        ),
    ),
    # First the clamp, then the step.
    wrong(
        "03b",
        "blind: first the clamp",
        "clamped-too-early",
        edited(_ROOM, (_STEP, "XX"), (_CLAMP, _STEP), ("XX", _CLAMP)),
    ),
    # Compared instead of assigned.
    wrong("03b", "blind: ==", "no-clamp", _room((_CLAMP, _CLAMP.replace(" = ", " == ")))),
    # The step is drawn once for all, in the constructor.
    either(
        "03b",
        "blind: one step for all",
        ("not-random", "one-way"),
        _room(
            (_STEP, "self.temperature += self.step"),
            ("22.0", "22.0; self.step = random.uniform(-0.3, 0.3)"),
        ),
    ),
    # Back to the start at a limit.
    wrong(
        "03b",
        "blind: back to 22",
        "set-back",
        _room(
            (
                _CLAMP,
                "self.temperature = self.temperature if 18.0 < self.temperature < 28.0 else 22.0",
            )
        ),
    ),
    # The step is rounded to a whole number.
    either(
        "03b",
        "blind: a rounded step",
        ("never-changes", "step-too-small", "not-random"),
        _room(("random.uniform(-0.3, 0.3)", "round(random.uniform(-0.3, 0.3))")),
    ),
    # The number for the log is rounded, and published.
    wrong(
        "03b",
        "blind: a text",
        "not-a-float",
        _room(("data=self.temperature", 'data=f"{self.temperature:.2f}"')),
    ),
    # randint wants whole numbers.
    either(
        "03b", "blind: randint", ("wrong-argument",), _room(("random.uniform", "random.randint"))
    ),
    # The walk, and nobody hears of it.
    wrong(
        "03b",
        "blind: not published",
        "never-published",
        _room((_SENDS, 'self.get_logger().info("published")')),
    ),
    # The step without the sign: minus forgotten in one place.
    either(
        "03b",
        "blind: from 0.3 to 0.3",
        ("not-random", "one-way"),
        _room(("(-0.3, 0.3)", "(0.3, 0.3)")),
    ),
    # random used as a function.
    wrong(
        "03b",
        "blind: random()",
        "not-callable",
        _room(("random.uniform(-0.3, 0.3)", "random(-0.3, 0.3)")),
    ),
)

_GREEN = """
    class GreenhouseSensor(Node):
        def __init__(self):
            super().__init__("greenhouse_sensor")
            self.readings = self.create_publisher(Float32, "greenhouse/temperature", 10)
            self.create_timer(0.25, self.measure)
            self.celsius = 22.0

        def measure(self):
            step = random.uniform(-0.5, 0.5)
            self.celsius = min(28.0, max(10.2, self.celsius + step))
            self.readings.publish(Float32(data=self.celsius * 9 / 5 + 32))
"""


def _green(*edits: tuple[str, str]) -> str:
    return edited(_GREEN, *edits)


_GREENHOUSES = (
    right(
        "03c",
        "blind: all in Fahrenheit",
        """
        class GreenhouseSensor(Node):
            def __init__(self):
                super().__init__("greenhouse_sensor")
                self.readings = self.create_publisher(Float32, "greenhouse/temperature", 10)
                self.create_timer(0.25, self.measure)
                self.fahrenheit = 71.6

            def measure(self):
                self.fahrenheit += random.uniform(-0.9, 0.9)
                self.fahrenheit = min(82.4, max(50.36, self.fahrenheit))
                self.readings.publish(Float32(data=self.fahrenheit))
        """,
    ),
    right(
        "03c",
        "blind: a namespace",
        _green(
            ('("greenhouse_sensor")', '("greenhouse_sensor", namespace="greenhouse")'),
            ('"greenhouse/temperature"', '"temperature"'),
        ),
    ),
    right(
        "03c",
        "blind: a generator of readings",
        """
        def walk(at, low, high, step):
            while True:
                at = min(high, max(low, at + random.uniform(-step, step)))
                yield at

        class GreenhouseSensor(Node):
            def __init__(self, frequency=4):
                super().__init__("greenhouse_sensor")
                out = self.create_publisher(Float32, "greenhouse/temperature", 10)
                celsius = walk(22.0, 10.2, 28.0, 0.5)
                fahrenheit = (c * 9 / 5 + 32 for c in celsius)
                self.create_timer(1 / frequency, lambda: out.publish(Float32(data=next(fahrenheit))))
        """,
    ),
    right(
        "03c",
        "blind: a property, a static method, constants",
        """
        class GreenhouseSensor(Node):
            LOW, HIGH, START, STEP, HERTZ = 10.2, 28.0, 22.0, 0.5, 4

            def __init__(self):
                super().__init__("greenhouse_sensor")
                self.celsius = self.START
                self.readings = self.create_publisher(Float32, "greenhouse/temperature", 10)
                self.create_timer(1.0 / self.HERTZ, self.measure)

            @staticmethod
            def clamp(value, low, high):
                if value < low:
                    return low
                return high if value > high else value

            @property
            def fahrenheit(self) -> float:
                return 32 + 1.8 * self.celsius

            def measure(self):
                self.celsius = self.clamp(
                    self.celsius + random.uniform(-self.STEP, self.STEP), self.LOW, self.HIGH
                )
                self.readings.publish(Float32(data=self.fahrenheit))
                self.get_logger().info(f"{self.celsius:.1f} C = {self.fahrenheit:.1f} F")
        """,
    ),
    right(
        "03c",
        "blind: parameters of the node",
        """
        class GreenhouseSensor(Node):
            def __init__(self):
                super().__init__("greenhouse_sensor")
                self.declare_parameter("low", 10.2)
                self.declare_parameter("high", 28.0)
                self.readings = self.create_publisher(Float32, "greenhouse/temperature", 10)
                self.create_timer(0.25, self.measure)
                self.celsius = 22.0

            def measure(self):
                low = self.get_parameter("low").value
                high = self.get_parameter("high").value
                self.celsius += random.uniform(-0.5, 0.5)
                self.celsius = max(low, min(high, self.celsius))
                self.readings.publish(Float32(data=self.celsius * 9 / 5 + 32))
        """,
    ),
    right(
        "03c",
        "blind: two classes, one walks and one converts",
        """
        class Walker(Node):
            def __init__(self, name, topic, period):
                super().__init__(name)
                self.out = self.create_publisher(Float32, topic, 10)
                self.value = 22.0
                self.create_timer(period, self.tick)

            def convert(self, value):
                return value

            def tick(self):
                self.value = max(10.2, min(28.0, self.value + random.uniform(-0.5, 0.5)))
                msg = Float32()
                msg.data = self.convert(self.value)
                self.out.publish(msg)

        class GreenhouseSensor(Walker):
            def __init__(self):
                super().__init__("greenhouse", "/greenhouse/temperature", 0.25)

            def convert(self, value):
                return super().convert(value) * 9 / 5 + 32
        """,
    ),
    right(
        "03c",
        "blind: one step in advance, a time delta",
        """
        from datetime import timedelta

        class GreenhouseSensor(Node):
            def __init__(self):
                super().__init__("greenhouse_sensor")
                self.readings = self.create_publisher(Float32, "greenhouse/temperature", 10)
                self.create_timer(timedelta(milliseconds=250).total_seconds(), self.measure)
                self.celsius = 22.0

            def measure(self):
                self.readings.publish(Float32(data=self.celsius * 9 / 5 + 32))
                self.celsius += random.uniform(-0.5, 0.5)
                self.celsius = sorted([10.2, self.celsius, 28.0])[1]
        """,
    ),
    right(
        "03c",
        "blind: Celsius on another topic, too",
        _green(
            (
                "self.celsius = 22.0",
                'self.celsius = 22.0; self.extra = self.create_publisher(Float32, "greenhouse/celsius", 10)',
            ),
            ("step = ", "self.extra.publish(Float32(data=self.celsius)); step = "),
        ),
    ),
    # Four seconds instead of four times a second.
    either(
        "03c", "blind: four seconds", ("wrong-rate", "period-for-rate"), _green(("0.25", "4.0"))
    ),
    # In Celsius.
    wrong("03c", "blind: Celsius", "wrong-unit", _green((" * 9 / 5 + 32", ""))),
    # 5/9 for 9/5.
    either(
        "03c",
        "blind: 5 / 9",
        ("wrong-unit", "wrong-values", "new-to-me"),
        _green(("9 / 5", "5 / 9")),
    ),
    # Converted, and kept converted.
    wrong(
        "03c",
        "blind: keeps Fahrenheit",
        "converted-back",
        _green(
            (
                "self.readings.publish(Float32(data=self.celsius * 9 / 5 + 32))",
                "self.celsius = self.celsius * 9 / 5 + 32; self.readings.publish(Float32(data=self.celsius))",
            )
        ),
    ),
    # An underscore for the slash.
    either(
        "03c",
        "blind: an underscore",
        ("topic-misspelled", "wrong-topic"),
        _green(("greenhouse/t", "greenhouse_t")),
    ),
    # The topic of the sensor above.
    either(
        "03c",
        "blind: temperature alone",
        ("topic-misspelled", "wrong-topic", "wrong-namespace"),
        _green(("greenhouse/t", "t")),
    ),
    # A dash in the node's name.
    wrong(
        "03c", "blind: a dash", "invalid-name", _green(("greenhouse_sensor", "greenhouse-sensor"))
    ),
    # No super().__init__.
    wrong(
        "03c",
        "blind: no super",
        "super-missing",
        _green(('super().__init__("greenhouse_sensor")', "pass")),
    ),
    # super without a name.
    wrong("03c", "blind: no name", "node-name-missing", _green(('"greenhouse_sensor"', ""))),
    # No limits.
    wrong(
        "03c",
        "blind: no limits",
        "no-clamp",
        _green(("min(28.0, max(10.2, self.celsius + step))", "self.celsius + step")),
    ),
    # The limits of the living room.
    wrong("03c", "blind: 18.0", "other-limits", _green(("10.2", "18.0"))),
    # Whole degrees after the conversion.
    wrong(
        "03c",
        "blind: rounded",
        "not-a-float",
        _green(("self.celsius * 9 / 5 + 32", "round(self.celsius * 9 / 5 + 32)")),
    ),
    # A step of half a degree Fahrenheit.
    wrong(
        "03c",
        "blind: half a degree Fahrenheit",
        "step-too-small",
        _green(
            ("22.0", "71.6"), ("min(28.0, max(10.2,", "min(82.4, max(50.36,"), (" * 9 / 5 + 32", "")
        ),
    ),
    # Starts at nothing.
    wrong("03c", "blind: starts at 0", "wrong-start", _green(("22.0", "0.0"))),
    # The step is taken from the start each time.
    wrong(
        "03c",
        "blind: from 22 each time",
        "forgets-itself",
        _green(("self.celsius + step", "22.0 + step")),
    ),
    # The value is made in the constructor, and self is forgotten.
    wrong(
        "03c",
        "blind: celsius",
        "wrong-attribute",
        _green(("self.celsius = 22.0", "celsius = 22.0")),
    ),
    # Brackets forgotten: 32 is added to 5.
    either(
        "03c",
        "blind: brackets",
        ("wrong-unit", "wrong-values", "new-to-me"),
        _green(("9 / 5 + 32", "9 / (5 + 32)")),
    ),
)

# ---------------------------------------------------------------------------------------- page 04

_FRIDGE = """
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
_DECIDES = """if temp > 8.0:
                status = "Warm"
            elif temp < 2.0:
                status = "Frost"
            else:
                status = "Fine"
"""
_SAYS = 'self.get_logger().info(f"Fridge: {temp:.2f}C - Status:{status}")'


def _fridge(decision: str) -> str:
    """The class with another decision, in one line or with its indents."""
    return edited(_FRIDGE.replace(_DECIDES, decision + "\n"))


_FRIDGES = (
    right(
        "04a",
        "blind: one line",
        _fridge('status = "Warm" if temp > 8 else "Frost" if temp < 2 else "Fine"'),
    ),
    right(
        "04a",
        "blind: the middle first",
        _fridge('status = "Fine" if 2 <= temp <= 8 else ("Frost", "Warm")[temp > 5]'),
    ),
    right(
        "04a",
        "blind: a place in a tuple",
        _fridge('status = ("Fine", "Warm", "Frost")[(temp > 8.0) - (temp < 2.0)]'),
    ),
    right(
        "04a",
        "blind: match with guards",
        """
        class FridgeMonitor(Node):
            def __init__(self):
                super().__init__("fridge_monitor")
                self.create_subscription(Float32, "temperature", self.temperature_callback, 10)

            def temperature_callback(self, msg):
                match msg.data:
                    case warm if warm > 8.0:
                        status = "Warm"
                    case cold if cold < 2.0:
                        status = "Frost"
                    case _:
                        status = "Fine"
                self.get_logger().info(f"Fridge: {msg.data:.2f}C - Status:{status}")
        """,
    ),
    right(
        "04a",
        "blind: a table of rules",
        """
        RULES = [(lambda t: t > 8.0, "Warm"), (lambda t: t < 2.0, "Frost"), (lambda t: True, "Fine")]

        class FridgeMonitor(Node):
            def __init__(self):
                super().__init__("fridge_monitor")
                self.create_subscription(Float32, "temperature", self.temperature_callback, 10)

            def temperature_callback(self, msg):
                temp = msg.data
                status = next(word for rule, word in RULES if rule(temp))
                self.get_logger().info("Fridge: %.2fC - Status:%s" % (temp, status))
        """,
    ),
    right(
        "04a",
        "blind: an enum",
        """
        from enum import Enum

        class State(Enum):
            WARM = "Warm"
            FROST = "Frost"
            FINE = "Fine"

            @classmethod
            def of(cls, temp):
                if temp > 8.0:
                    return cls.WARM
                if temp < 2.0:
                    return cls.FROST
                return cls.FINE

        class FridgeMonitor(Node):
            def __init__(self):
                super().__init__("fridge_monitor")
                self.create_subscription(Float32, "temperature", self.temperature_callback, 10)

            def temperature_callback(self, msg):
                temp = msg.data
                self.get_logger().info(f"Fridge: {temp:.2f}C - Status:{State.of(temp).value}")
        """,
    ),
    right(
        "04a",
        "blind: numpy selects",
        "import numpy as np\n"
        + _fridge('status = str(np.select([temp > 8.0, temp < 2.0], ["Warm", "Frost"], "Fine"))'),
    ),
    right(
        "04a",
        "blind: a line for each case, louder when it is bad",
        """
        class FridgeMonitor(Node):
            def __init__(self):
                super().__init__("fridge_monitor")
                self.create_subscription(Float32, "temperature", self.temperature_callback, 10)
                self.get_logger().info("Fridge Monitor Node Started")

            def temperature_callback(self, msg):
                temp = msg.data
                if temp > 8.0:
                    self.get_logger().warning(f"Fridge: {temp:.2f}C - Status:Warm")
                elif temp < 2.0:
                    self.get_logger().warning(f"Fridge: {temp:.2f}C - Status:Frost")
                else:
                    self.get_logger().info(f"Fridge: {temp:.2f}C - Status:Fine")
        """,
    ),
    right(
        "04a",
        "blind: also counts, and logs the count",
        """
        from collections import Counter

        class FridgeMonitor(Node):
            def __init__(self):
                super().__init__("fridge_monitor")
                self.seen = Counter()
                self.create_subscription(Float32, "temperature", self.temperature_callback, 10)

            def judge(self, temp: float) -> str:
                return "Frost" if temp < 2.0 else "Fine" if temp <= 8.0 else "Warm"

            def temperature_callback(self, msg):
                self.seen[status := self.judge(msg.data)] += 1
                self.get_logger().info(f"Fridge: {msg.data:.2f}C - Status:{status}")
                self.get_logger().info(f"That was reading {self.seen.total()}")
        """,
    ),
    # Both limits counted to the outside.
    wrong(
        "04a",
        "blind: >= and <=",
        "boundary",
        _fridge('status = "Warm" if temp >= 8 else "Frost" if temp <= 2 else "Fine"'),
    ),
    # Only one of them.
    wrong(
        "04a",
        "blind: <= below",
        "boundary",
        _fridge('status = "Warm" if temp > 8 else "Frost" if temp <= 2 else "Fine"'),
    ),
    # The two words swapped.
    either(
        "04a",
        "blind: swapped",
        ("wrong-state", "wrong-word"),
        _fridge('status = "Frost" if temp > 8 else "Warm" if temp < 2 else "Fine"'),
    ),
    # The words of the monitor above.
    wrong(
        "04a",
        "blind: High and Low",
        "wrong-word",
        _fridge('status = "High" if temp > 8 else "Low" if temp < 2 else "Normal"'),
    ),
    # Small letters.
    wrong(
        "04a",
        "blind: small letters",
        "wrong-word",
        _fridge('status = "warm" if temp > 8 else "frost" if temp < 2 else "fine"'),
    ),
    # if, if, else: the else belongs to the second if only.
    wrong("04a", "blind: if, if, else", "wrong-state", _FRIDGE.replace("elif", "if")),
    # No else.
    wrong(
        "04a",
        "blind: no else",
        "no-value-yet",
        _FRIDGE.replace('            else:\n                status = "Fine"\n', ""),
    ),
    # The limits of the monitor above.
    either(
        "04a",
        "blind: 26 and 20",
        ("wrong-state", "other-limits"),
        _fridge('status = "Warm" if temp > 26 else "Frost" if temp < 20 else "Fine"'),
    ),
    # The message is compared, not its number.
    wrong(
        "04a",
        "blind: msg compared",
        "message-for-value",
        _fridge('status = "Warm" if msg > 8 else "Frost" if msg < 2 else "Fine"'),
    ),
    # Whole degrees are compared.
    either(
        "04a",
        "blind: int(temp)",
        ("wrong-state", "boundary", "decimals-lost"),
        _fridge('status = "Warm" if int(temp) > 8 else "Frost" if int(temp) < 2 else "Fine"'),
    ),
    # Freezing point taken for the limit.
    either(
        "04a",
        "blind: below 0",
        ("wrong-state", "other-limits"),
        _fridge('status = "Warm" if temp > 8 else "Frost" if temp < 0 else "Fine"'),
    ),
    # A method that returns nothing.
    either(
        "04a",
        "blind: no return",
        ("wrong-word", "returns-nothing", "new-to-me", "wrong-state"),
        edited(
            _FRIDGE.replace(_DECIDES, "status = self.judge(temp)\n")
            + '\n        def judge(self, temp):\n            "Warm" if temp > 8 else "Frost" if temp < 2 else "Fine"\n'
        ),
    ),
    # self forgotten at a method of one's own.
    wrong(
        "04a",
        "blind: judge without self.",
        "name-error",
        edited(
            _FRIDGE.replace(_DECIDES, "status = judge(temp)\n")
            + '\n        def judge(self, temp):\n            return "Warm" if temp > 8 else "Frost" if temp < 2 else "Fine"\n'
        ),
    ),
    # The log line is thrown out.
    wrong(
        "04a",
        "blind: nothing logged",
        "nothing-logged",
        edited(_FRIDGE, (_SAYS, "self.status = status")),
    ),
    # All limits reversed: a fridge warm below 8.
    either(
        "04a",
        "blind: < for >",
        ("wrong-state", "new-to-me"),
        _fridge('status = "Warm" if temp < 8 else "Frost" if temp > 2 else "Fine"'),
    ),
)

_ALARM = """
    class Alarm(Node):
        def __init__(self):
            super().__init__("alarm")
            self.create_subscription(Float32, "temperature", self.temperature_callback, 10)
            self.alerts = self.create_publisher(String, "alert", 10)

        def temperature_callback(self, msg):
            if msg.data > 26.0 or msg.data < 20.0:
                self.alerts.publish(String(data=f"{msg.data:.1f} degrees"))
"""
_WHEN = "msg.data > 26.0 or msg.data < 20.0"


def _alarm(*edits: tuple[str, str]) -> str:
    return edited(_ALARM, *edits)


_ALARMS = (
    right("04b", "blind: not in between", _alarm((_WHEN, "not 20.0 <= msg.data <= 26.0"))),
    right("04b", "blind: far from the middle", _alarm((_WHEN, "abs(msg.data - 23) > 3"))),
    right("04b", "blind: any of two", _alarm((_WHEN, "any((msg.data < 20, 26 < msg.data))"))),
    right(
        "04b",
        "blind: leaves early",
        """
        class Alarm(Node):
            def __init__(self):
                super().__init__("alarm")
                self.create_subscription(Float32, "temperature", self.temperature_callback, 10)
                self.alerts = self.create_publisher(String, "alert", 10)

            def temperature_callback(self, msg):
                if 20 <= msg.data <= 26:
                    return
                alert = String()
                alert.data = "Too " + ("hot" if msg.data > 26 else "cold")
                self.alerts.publish(alert)
        """,
    ),
    right(
        "04b",
        "blind: two publishers, and a log",
        """
        class Alarm(Node):
            def __init__(self):
                super().__init__("alarm")
                self.hot = self.create_publisher(String, "alert", 10)
                self.cold = self.create_publisher(String, "alert", 10)
                self.create_subscription(Float32, "temperature", self.temperature_callback, 10)

            def temperature_callback(self, msg):
                if msg.data > 26.0:
                    self.hot.publish(String(data="hot"))
                if msg.data < 20.0:
                    self.cold.publish(String(data="cold"))
                self.get_logger().info(f"{msg.data}")
        """,
    ),
    right(
        "04b",
        "blind: the callback publishes what a function finds",
        """
        def trouble(value, low=20.0, high=26.0):
            if value < low:
                yield f"{low - value:.1f} too cold"
            if value > high:
                yield f"{value - high:.1f} too hot"

        class Alarm(Node):
            def __init__(self):
                super().__init__("alarm")
                alerts = self.create_publisher(String, "/alert", 10)
                self.create_subscription(
                    Float32,
                    "/temperature",
                    lambda msg: [alerts.publish(String(data=text)) for text in trouble(msg.data)],
                    10,
                )
        """,
    ),
    right(
        "04b",
        "blind: kept for a timer that comes at once",
        """
        from collections import deque

        class Alarm(Node):
            def __init__(self):
                super().__init__("alarm")
                self.create_subscription(Float32, "temperature", self.keep, 10)
                self.alerts = self.create_publisher(String, "alert", 10)
                self.waiting = deque()

            async def keep(self, msg):
                self.waiting.append(msg.data)
                await self.work()

            async def work(self):
                while self.waiting:
                    value = self.waiting.popleft()
                    if value > 26.0 or value < 20.0:
                        self.alerts.publish(String(data=str(value)))
        """,
    ),
    right(
        "04b",
        "blind: the monitor inherited",
        """
        class Monitor(Node):
            def __init__(self, name):
                super().__init__(name)
                self.create_subscription(Float32, "temperature", self.temperature_callback, 10)

            def temperature_callback(self, msg):
                match (msg.data > 26.0, msg.data < 20.0):
                    case (True, _):
                        self.report("High", msg.data)
                    case (_, True):
                        self.report("Low", msg.data)

            def report(self, status, value):
                self.get_logger().info(f"{status}: {value}")

        class Alarm(Monitor):
            def __init__(self):
                super().__init__("alarm")
                self.alerts = self.create_publisher(String, "alert", 10)

            def report(self, status, value):
                super().report(status, value)
                self.alerts.publish(String(data=f"{status} {value:.1f}"))
        """,
    ),
    right("04b", "blind: an empty text", _alarm(('f"{msg.data:.1f} degrees"', '"!"'))),
    # and: no number is above 26 and below 20.
    wrong("04b", "blind: and", "never-published", _alarm((" or ", " and "))),
    # The limits are in.
    wrong("04b", "blind: >= and <=", "boundary", _alarm(("> 26", ">= 26"), ("< 20", "<= 20"))),
    # or with a number alone, which counts as true.
    wrong("04b", "blind: or 20.0", "alert-too-many", _alarm((_WHEN, "msg.data > 26.0 or 20.0"))),
    # Only the heat.
    wrong("04b", "blind: only above", "alert-missing", _alarm((" or msg.data < 20.0", ""))),
    # The number as text of the message.
    wrong(
        "04b",
        "blind: a number as text",
        "not-a-float",
        _alarm(('f"{msg.data:.1f} degrees"', "msg.data")),
    ),
    # The message that came is sent on.
    either(
        "04b",
        "blind: the message itself",
        ("number-published", "wrong-argument", "type-mismatch"),
        _alarm(('String(data=f"{msg.data:.1f} degrees")', "msg")),
    ),
    # The type of the incoming topic.
    wrong(
        "04b",
        "blind: Float32",
        "type-mismatch",
        _alarm(
            ("create_publisher(String", "create_publisher(Float32"),
            ('String(data=f"{msg.data:.1f} degrees")', "Float32(data=msg.data)"),
        ),
    ),
    # The message compared.
    wrong(
        "04b",
        "blind: msg compared",
        "message-for-value",
        _alarm((_WHEN, "msg > 26.0 or msg < 20.0")),
    ),
    # One letter more.
    wrong("04b", "blind: alerts", "topic-misspelled", _alarm(('"alert"', '"alerts"'))),
    # A text and a number added.
    wrong(
        "04b",
        "blind: text + number",
        "text-and-number",
        _alarm(('f"{msg.data:.1f} degrees"', '"It is " + msg.data')),
    ),
    # Logged, not published.
    wrong(
        "04b",
        "blind: logged",
        "never-published",
        _alarm(
            (
                'self.alerts.publish(String(data=f"{msg.data:.1f} degrees"))',
                'self.get_logger().info(f"{msg.data:.1f} degrees")',
            )
        ),
    ),
    # Only at the first of several in a row.
    wrong(
        "04b",
        "blind: once in a row",
        "alert-missing",
        """
        class Alarm(Node):
            def __init__(self):
                super().__init__("alarm")
                self.create_subscription(Float32, "temperature", self.temperature_callback, 10)
                self.alerts = self.create_publisher(String, "alert", 10)
                self.bad = False

            def temperature_callback(self, msg):
                bad = msg.data > 26.0 or msg.data < 20.0
                if bad and not self.bad:
                    self.alerts.publish(String(data="Alarm"))
                self.bad = bad
        """,
    ),
    # The inside for the outside.
    either(
        "04b",
        "blind: the inside",
        ("alert-too-many", "alert-missing"),
        _alarm((_WHEN, "20.0 < msg.data < 26.0")),
    ),
    # Says that all is well, too.
    wrong(
        "04b",
        "blind: all is well",
        "alert-too-many",
        _alarm(
            (
                'String(data=f"{msg.data:.1f} degrees"))',
                'String(data="Alarm"))\n        else:\n            self.alerts.publish(String(data="OK"))',
            )
        ),
    ),
    # Only at the start, because the publisher is a local name.
    wrong("04b", "blind: no self.", "wrong-attribute", _alarm(("self.alerts = ", "alerts = "))),
    # publish forgotten, the publisher is called.
    wrong(
        "04b", "blind: no publish", "not-callable", _alarm(("self.alerts.publish(", "self.alerts("))
    ),
)

_CALM = """
    class CalmMonitor(Node):
        def __init__(self):
            super().__init__("calm_monitor")
            self.create_subscription(Float32, "temperature", self.listen, 10)
            self.means = self.create_publisher(Float32, "mean", 10)
            self.statuses = self.create_publisher(String, "status", 10)
            self.values = []
            self.status = "Normal"

        def listen(self, msg):
            self.values.append(msg.data)
            if len(self.values) > 5:
                self.values.pop(0)
            self.means.publish(Float32(data=sum(self.values) / len(self.values)))
            status = self.judge(msg.data)
            if status != self.status:
                self.status = status
                self.statuses.publish(String(data=status))

        def judge(self, value):
            if value > 26.0:
                return "High"
            if value < 20.0:
                return "Low"
            if self.status == "High" and value >= 25.0:
                return "High"
            if self.status == "Low" and value <= 21.0:
                return "Low"
            return "Normal"
"""


def _hysteresis(*edits: tuple[str, str]) -> str:
    return edited(_CALM, *edits)


_SWITCH = """
    class CalmMonitor(Node):
        def __init__(self):
            super().__init__("calm_monitor")
            self.create_subscription(Float32, "temperature", self.listen, 10)
            self.means = self.create_publisher(Float32, "mean", 10)
            self.statuses = self.create_publisher(String, "status", 10)
            self.values = deque(maxlen=5)
            self.status = "Normal"

        def listen(self, msg):
            self.values.append(msg.data)
            self.means.publish(Float32(data=MEAN))
            old = self.status
            match self.status, msg.data:
                case _, value if value > 26.0:
                    self.status = "High"
                case _, value if value < 20.0:
                    self.status = "Low"
                case ("High", value) if value < 25.0:
                    self.status = "Normal"
                case ("Low", value) if value > 21.0:
                    self.status = "Normal"
            if self.status != old:
                self.statuses.publish(String(data=self.status))
"""


def _mean(imports: str, expression: str) -> str:
    """A monitor with a deque and a match, with the mean as this expression says."""
    return f"from collections import deque\n{imports}\n" + edited(_SWITCH, ("MEAN", expression))


_CALMS = (
    right("04c", "blind: pop and returns", _hysteresis()),
    right(
        "04c",
        "blind: deque, match, fmean",
        _mean("from statistics import fmean", "fmean(self.values)"),
    ),
    right("04c", "blind: numpy's mean", _mean("import numpy as np", "float(np.mean(self.values))")),
    right(
        "04c",
        "blind: numpy's mean with 32 bits",
        _mean("import numpy as np", "float(np.array(self.values, dtype=np.float32).mean())"),
    ),
    right(
        "04c", "blind: a sum of shares", _mean("", "sum(x / len(self.values) for x in self.values)")
    ),
    right(
        "04c",
        "blind: a running sum",
        """
        class CalmMonitor(Node):
            def __init__(self):
                super().__init__("calm_monitor")
                self.create_subscription(Float32, "temperature", self.listen, 10)
                self.means = self.create_publisher(Float32, "mean", 10)
                self.statuses = self.create_publisher(String, "status", 10)
                self.ring, self.total, self.count = [0.0] * 5, 0.0, 0
                self.status = "Normal"

            def listen(self, msg):
                at = self.count % 5
                self.total += msg.data - self.ring[at]
                self.ring[at] = msg.data
                self.count += 1
                self.means.publish(Float32(data=self.total / min(self.count, 5)))
                low, high = {"Low": (21, 26), "Normal": (20, 26), "High": (20, 25)}[self.status]
                value = msg.data
                new = self.status
                if self.status == "High":
                    if value < 20:
                        new = "Low"
                    elif value < 25:
                        new = "Normal"
                elif self.status == "Low":
                    if value > 26:
                        new = "High"
                    elif value > 21:
                        new = "Normal"
                elif value > high:
                    new = "High"
                elif value < low:
                    new = "Low"
                if new != self.status:
                    self.status = new
                    self.statuses.publish(String(data=new))
        """,
    ),
    right(
        "04c",
        "blind: two subscriptions, one for each task",
        """
        class CalmMonitor(Node):
            def __init__(self):
                super().__init__("calm_monitor")
                self.create_subscription(Float32, "temperature", self.average, 10)
                self.create_subscription(Float32, "temperature", self.watch, 10)
                self.means = self.create_publisher(Float32, "mean", 10)
                self.statuses = self.create_publisher(String, "status", 10)
                self.values = ()
                self.status = "Normal"

            def average(self, msg):
                self.values = (msg.data, *self.values[:4])
                self.means.publish(Float32(data=sum(self.values) / len(self.values)))

            def watch(self, msg):
                high = msg.data > (25 if self.status == "High" else 26) or (
                    msg.data == 25 and self.status == "High"
                )
                low = msg.data < (21 if self.status == "Low" else 20) or (
                    msg.data == 21 and self.status == "Low"
                )
                new = "High" if high else "Low" if low else "Normal"
                if new != self.status:
                    self.status = new
                    self.statuses.publish(String(data=new))
        """,
    ),
    right(
        "04c",
        "blind: helpers, and a property that tells of changes",
        """
        from collections import deque
        from dataclasses import dataclass, field

        @dataclass
        class Window:
            values: deque = field(default_factory=lambda: deque(maxlen=5))

            def add(self, value: float) -> float:
                self.values.append(value)
                return sum(self.values) / len(self.values)

        class CalmMonitor(Node):
            def __init__(self, name: str = "calm_monitor") -> None:
                super().__init__(name)
                self.window = Window()
                self._status = "Normal"
                self.means = self.create_publisher(Float32, "mean", 10)
                self.statuses = self.create_publisher(String, "status", 10)
                self.create_subscription(Float32, "temperature", self.listen, 10)

            @property
            def status(self) -> str:
                return self._status

            @status.setter
            def status(self, new: str) -> None:
                if new != self._status:
                    self._status = new
                    self.get_logger().info(f"Status: {new}")
                    self.statuses.publish(String(data=new))

            async def listen(self, msg: Float32) -> None:
                value = msg.data
                if value > 26.0:
                    self.status = "High"
                elif value < 20.0:
                    self.status = "Low"
                elif 21.0 < value < 25.0:
                    self.status = "Normal"
                elif self.status == "High" and value < 25.0 or self.status == "Low" and value > 21.0:
                    self.status = "Normal"
                self.means.publish(Float32(data=self.window.add(value)))
        """,
    ),
    right(
        "04c",
        "blind: a generator that is sent the readings",
        """
        def judge():
            status, value = "Normal", (yield)
            while True:
                if value > 26.0:
                    status = "High"
                elif value < 20.0:
                    status = "Low"
                elif (status, value < 25.0) == ("High", True) or (status, value > 21.0) == ("Low", True):
                    status = "Normal"
                value = yield status

        class CalmMonitor(Node):
            def __init__(self):
                super().__init__("calm_monitor")
                self.create_subscription(Float32, "temperature", self.listen, 10)
                self.means = self.create_publisher(Float32, "mean", 10)
                self.statuses = self.create_publisher(String, "status", 10)
                self.values, self.last = [], "Normal"
                self.judge = judge()
                next(self.judge)

            def listen(self, msg):
                self.values.append(msg.data)
                last = self.values[-5:]
                self.means.publish(Float32(data=sum(last) / len(last)))
                if (status := self.judge.send(msg.data)) != self.last:
                    self.statuses.publish(String(data=status))
                self.last = status
        """,
    ),
    # Four instead of five.
    wrong("04c", "blind: four", "wrong-window", _hysteresis(("> 5:", "> 4:"))),
    # Divided by five from the beginning.
    either(
        "04c",
        "blind: by five",
        ("wrong-window", "wrong-share"),
        _hysteresis(("/ len(self.values)", "/ 5")),
    ),
    # The mean of all that ever came.
    wrong(
        "04c",
        "blind: of all",
        "wrong-window",
        _hysteresis(
            (
                "if len(self.values) > 5:\n            self.values.pop(0)\n",
                "if False:\n            pass\n",
            )
        ),
    ),
    # pop() takes the newest out.
    wrong("04c", "blind: pop()", "wrong-window", _hysteresis(("pop(0)", "pop()"))),
    # Nothing until there are five.
    either(
        "04c",
        "blind: waits for five",
        ("wrong-window",),
        _hysteresis(("self.means.publish", "if len(self.values) == 5: self.means.publish")),
    ),
    # One border only.
    wrong(
        "04c",
        "blind: one border",
        "no-hysteresis",
        _hysteresis(("value >= 25.0", "False"), ("value <= 21.0", "False")),
    ),
    # The comparison is forgotten.
    wrong(
        "04c",
        "blind: each time",
        "status-repeated",
        _hysteresis(("if status != self.status:", "if True:")),
    ),
    # The new status is not kept.
    either(
        "04c",
        "blind: not kept",
        ("status-repeated", "wrong-state", "no-hysteresis", "hysteresis-lost", "new-to-me"),
        _hysteresis(("            self.status = status\n", "")),
    ),
    # The start is published.
    wrong(
        "04c",
        "blind: the start, too",
        "status-repeated",
        _hysteresis(('self.status = "Normal"', 'self.status = ""')),
    ),
    # Below 25 read as 25 and below.
    wrong(
        "04c",
        "blind: 25 and 21 come back",
        "boundary",
        _hysteresis((">= 25.0", "> 25.0"), ("<= 21.0", "< 21.0")),
    ),
    # The mean is judged, not the reading.
    either(
        "04c",
        "blind: judges the mean",
        ("wrong-state", "new-to-me"),
        _hysteresis(("self.judge(msg.data)", "self.judge(sum(self.values) / len(self.values))")),
    ),
    # The way back is left out on the cold side.
    either(
        "04c",
        "blind: Low comes back at 20",
        ("no-hysteresis", "wrong-state"),
        _hysteresis(("value <= 21.0", "value < 20.0")),
    ),
    # From Low it goes back only when it is High.
    wrong(
        "04c",
        "blind: Low stays",
        "hysteresis-lost",
        _hysteresis(('self.status == "Low" and value <= 21.0', 'self.status == "Low"')),
    ),
    # The words of the fridge's author: capital letters.
    wrong(
        "04c",
        "blind: capitals",
        "wrong-word",
        _hysteresis(('"High"', '"HIGH"'), ('"Low"', '"LOW"'), ('"Normal"', '"NORMAL"')),
    ),
    # means for mean.
    wrong("04c", "blind: means", "topic-misspelled", _hysteresis(('"mean"', '"means"'))),
    # The mean is made before the reading is added.
    wrong(
        "04c",
        "blind: mean first",
        "division-by-zero",
        _hysteresis(
            (
                "self.values.append(msg.data)",
                "self.means.publish(Float32(data=sum(self.values) / len(self.values))); self.values.append(msg.data)",
            )
        ),
    ),
    # The list is made anew at each reading.
    wrong(
        "04c",
        "blind: a new list each time",
        "wrong-window",
        _hysteresis(("self.values.append(msg.data)", "self.values = [msg.data]")),
    ),
    # Whole degrees.
    either(
        "04c",
        "blind: //",
        ("decimals-lost", "wrong-window", "wrong-values", "new-to-me", "other-mean"),
        _hysteresis((") / len", ") // len")),
    ),
    # The list holds messages.
    either(
        "04c",
        "blind: messages in the list",
        ("message-for-value",),
        _hysteresis(("append(msg.data)", "append(msg)")),
    ),
    # A status as number's message.
    either(
        "04c",
        "blind: the wrong publisher",
        ("type-mismatch", "wrong-argument"),
        _hysteresis(
            (
                "self.statuses.publish(String(data=status))",
                "self.means.publish(String(data=status))",
            )
        ),
    ),
)

_ALL: tuple[Answer, ...] = (
    *(_READERS + _REPORTERS),
    *(_HUMIDITIES + _ROOMS + _GREENHOUSES),
    *(_FRIDGES + _ALARMS + _CALMS),
)

#: Where the judge is wrong, and what it says: these answers are not in the table.
REASONS = {
    # The check of the page is right about these two; grading holds them for a person.
    "04a blind: numpy selects": "held: 'reaches for select', which is numpy's here and no system's.",
    "03b blind: random()": "held: 'hands on the module random', where the module is called.",
}
ANSWERS = tuple(one for one in _ALL if one.id not in REASONS)
DISAGREE = tuple(one for one in _ALL if one.id in REASONS)
