"""Further answers to page 00, from the page alone: right ones, and what they are near to."""

from bank.answer import edited, either, right, wrong
from bank.nodes.reader_wrong import BASE as READER
from bank.nodes.reporter_wrong import BASE as REPORTER

_SUB = 'self.create_subscription(String, "weather", self.read, 10)'
_LOG = 'self.get_logger().info(f"I read: {msg.data}")'

ANSWERS = (
    right(
        "00a",
        "it cancels nothing and counts in a dict",
        edited(
            READER,
            ("class W", "from collections import Counter\n\nclass W"),
            (_SUB, _SUB + "\n        self.words = Counter()"),
            (_LOG, "self.words.update(msg.data.split())"),
        ),
    ),
    right(
        "00a",
        "the page's Reader, told its topic",
        """
    class Reader(Node):
        def __init__(self, name, topic):
            super().__init__(name)
            self.subscription = self.create_subscription(String, topic, self.read, 10)

        def read(self, msg):
            self.get_logger().info(f"I read: {msg.data}")

    class WeatherReader(Reader):
        def __init__(self):
            super().__init__("weather_reader", "weather")
 """,
    ),
    right(
        "00a",
        "a list of topics with one entry",
        edited(
            READER,
            (
                _SUB,
                'for topic in ["weather"]:\n'
                "            self.create_subscription(String, topic, self.read, 10)",
            ),
        ),
    ),
    either(
        "00a",
        "the reporter's name for a topic",
        ("topic-misspelled", "wrong-topic"),
        edited(READER, ('String, "weather"', 'String, "weather_reporter"')),
    ),
    wrong(
        "00a",
        "two topics",
        "wrong-topic",
        edited(READER, (_SUB, _SUB + "\n        " + _SUB.replace("weather", "sports"))),
    ),
    wrong(
        "00a",
        "it unsubscribes after one article",
        "new-to-me",
        edited(
            READER,
            ("self.create_sub", "self.sub = self.create_sub"),
            (_LOG, _LOG + "\n        self.destroy_subscription(self.sub)"),
        ),
    ),
    either(
        "00a",
        "rclpy.init in the constructor",
        ("initialised-twice",),
        edited(
            READER,
            ("class W", "import rclpy\n\nclass W"),
            ("super().__init__", "rclpy.init()\n        super().__init__"),
        ),
    ),
    right(
        "00b",
        "an f-string with a score",
        edited(
            REPORTER,
            ("class S", "class Score:\n    goals = 0\n\nclass S"),
            ('"What a match"', 'f"It is {Score.goals} to 0"'),
        ),
    ),
    right(
        "00b",
        "an article from a list, with blanks around",
        edited(
            REPORTER,
            (
                "class S",
                "from itertools import cycle\n"
                "\n"
                'ARTICLES = cycle(["  Goal  ", "Foul", "0"])\n'
                "\n"
                "class S",
            ),
            ('"What a match"', "next(ARTICLES)"),
        ),
    ),
    right(
        "00b",
        "a timer made by a helper class",
        """
    class Desk:
        def __init__(self, node, topic, period):
            self.out = node.create_publisher(String, topic, 10)
            node.create_timer(period, self.write)

        def write(self):
            self.out.publish(String(data="What a match"))

    class SportsReporter(Node):
        def __init__(self):
            super().__init__("sports_reporter")
            self.desk = Desk(self, "sports", 2.0)
 """,
    ),
    wrong("00b", "an empty article", "wrong-values", edited(REPORTER, ('"What a match"', '""'))),
    wrong(
        "00b",
        "a message that nothing is put into",
        "wrong-values",
        edited(REPORTER, ('String(data="What a match")', "String()")),
    ),
    wrong(
        "00b", "an article of blanks", "wrong-values", edited(REPORTER, ('"What a match"', '"   "'))
    ),
    wrong(
        "00b",
        "only the first article is written",
        "wrong-values",
        edited(
            REPORTER,
            ("self.timer =", 'self.text = "Goal"\n        self.timer ='),
            (
                'self.publisher.publish(String(data="What a match"))',
                'self.publisher.publish(String(data=self.text))\n        self.text = ""',
            ),
        ),
    ),
    wrong(
        "00b",
        "a subscription for a publisher",
        "no-publisher",
        edited(
            REPORTER,
            (
                'self.publisher = self.create_publisher(String, "sports", 10)',
                'self.publisher = self.create_subscription(String, "sports", self.write, 10)',
            ),
        ),
    ),
    wrong(
        "00b",
        "it sleeps between two articles",
        "callback-blocks",
        edited(
            REPORTER,
            ("2.0", "0.5"),
            (
                "self.publisher.publish(",
                "import time\n        time.sleep(2.0)\n        self.publisher.publish(",
            ),
        ),
    ),
    wrong(
        "00b",
        "four articles, then it stops",
        "gone-quiet",
        edited(
            REPORTER,
            ("2.0, self", "2.0, self"),
            (
                'self.publisher.publish(String(data="What a match"))',
                'self.publisher.publish(String(data="What a match"))\n        self.timer.cancel()',
            ),
        ),
    ),
    either(
        "00b",
        "rclpy.init in the constructor",
        ("initialised-twice",),
        edited(
            REPORTER,
            ("class S", "import rclpy\n\nclass S"),
            ("super().__init__", "rclpy.init()\n        super().__init__"),
        ),
    ),
    wrong("00b", "half a second each", "wrong-rate", edited(REPORTER, ("2.0", "1 / 2"))),
    wrong(
        "00b",
        "an article at once, too",
        "wrong-rate",
        edited(REPORTER, ("self.write)", "self.write)\n        self.write()")),
    ),
    right(
        "00a",
        "async callback and message info",
        edited(READER, ("def read(self, msg)", "async def read(self, msg, info)")),
    ),
    right(
        "00a",
        "best effort",
        edited(
            READER,
            ("class W", "from rclpy.qos import qos_profile_sensor_data\n\nclass W"),
            ("self.read, 10", "self.read, qos_profile_sensor_data"),
        ),
    ),
    right(
        "00a",
        "it counts and then publishes elsewhere",
        edited(
            READER,
            (
                "self.create_sub",
                'self.out = self.create_publisher(String, "seen", 10)\n        self.create_sub',
            ),
            ('self.get_logger().info(f"I read: {msg.data}")', "self.out.publish(msg)"),
        ),
    ),
    either(
        "00a",
        "weather republished on weather",
        ("endless-chain", "wrong-rate"),
        edited(
            READER,
            (
                "self.create_sub",
                'self.out = self.create_publisher(String, "weather", 10)\n        self.create_sub',
            ),
            ('self.get_logger().info(f"I read: {msg.data}")', "self.out.publish(msg)"),
        ),
    ),
    either(
        "00a",
        "a timer that asks for the weather",
        ("no-subscription",),
        edited(
            READER,
            (
                'self.create_subscription(String, "weather", self.read, 10)',
                "self.create_timer(1.0, lambda: None)",
            ),
        ),
    ),
    either(
        "00a",
        "a publisher instead",
        (
            "no-subscription",
            "arguments-swapped",
            "wrong-argument",
            "not-a-message-type",
            "argument-missing",
        ),
        edited(
            READER,
            (
                'self.create_subscription(String, "weather", self.read, 10)',
                'self.create_publisher(String, "weather", 10)',
            ),
        ),
    ),
    wrong(
        "00a",
        "it sleeps for three seconds",
        "callback-blocks",
        edited(
            READER,
            ("self.get_logger()", "import time\n        time.sleep(3)\n        self.get_logger()"),
        ),
    ),
    right(
        "00b",
        "__call__ as the callback",
        """
    class SportsReporter(Node):
        def __init__(self):
            super().__init__("sports_reporter")
            self.out = self.create_publisher(String, "sports", 10)
            self.create_timer(2.0, self)

        def __call__(self):
            self.out.publish(String(data="Goal"))
 """,
    ),
    right(
        "00b",
        "a coin decides what, not whether",
        edited(
            REPORTER,
            ("class S", "import random\n\nclass S"),
            ('"What a match"', 'random.choice(["Won", "Lost"])'),
        ),
    ),
    right(
        "00b",
        "a numpy period",
        edited(
            REPORTER,
            ("class S", "import numpy as np\n\nclass S"),
            ("2.0", "float(np.mean([1.0, 3.0]))"),
        ),
    ),
    right(
        "00b",
        "a new line for an article with text",
        edited(REPORTER, ('"What a match"', '"\\nGoal\\n"')),
    ),
    either(
        "00b",
        "a coin decides whether",
        ("wrong-rate", "new-to-me"),
        edited(
            REPORTER,
            ("class S", "import random\n\nclass S"),
            (
                "self.publisher.publish",
                "if random.random() < 0.5:\n            self.publisher.publish",
            ),
        ),
    ),
    either(
        "00b",
        "two timers of four seconds",
        ("wrong-rate",),
        edited(
            REPORTER,
            (
                "self.timer = self.create_timer(2.0, self.write)",
                "self.a = self.create_timer(4.0, self.write)\n"
                "        self.b = self.create_timer(4.0, self.write)",
            ),
        ),
    ),
    either("00b", "a rate slowly drifting", ("wrong-rate",), edited(REPORTER, ("2.0", "2.001"))),
    either(
        "00b",
        "a line feed for an article",
        ("wrong-values",),
        edited(REPORTER, ('"What a match"', '"\\n"')),
    ),
    either(
        "00b",
        "it waits for a reader",
        ("never-published",),
        edited(
            REPORTER,
            (
                "self.publisher.publish",
                "if self.publisher.get_subscription_count():\n            self.publisher.publish",
            ),
        ),
    ),
    right(
        "00b",
        "the publisher is made when it is needed",
        edited(
            REPORTER,
            (
                'self.publisher = self.create_publisher(String, "sports", 10)',
                "self.publisher = None",
            ),
            (
                "self.publisher.publish(",
                'self.publisher = self.publisher or self.create_publisher(String, "sports", 10)\n'
                "        self.publisher.publish(",
            ),
        ),
    ),
)
