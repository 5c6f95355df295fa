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
)
