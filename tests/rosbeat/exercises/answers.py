"""Right answers to the first exercises, as texts to edit, and a way to make one."""

from textwrap import dedent

from bank.running import namespace_of

READER = """
    class WeatherReader(Node):
        def __init__(self):
            super().__init__("weather_reader")
            self.create_subscription(String, "weather", self.read, 10)

        def read(self, msg):
            self.get_logger().info(msg.data)
"""
REPORTER = """
    class SportsReporter(Node):
        def __init__(self):
            super().__init__("sports_reporter")
            self.articles = self.create_publisher(String, "sports", 10)
            self.create_timer(2.0, self.write)

        def write(self):
            self.articles.publish(String(data="Goal"))
"""
HUMIDITY = """
    class HumiditySensor(Node):
        def __init__(self):
            super().__init__("humidity_sensor")
            self.publisher_ = self.create_publisher(Float32, "humidity", 5)
            self.create_timer(0.5, self.publish_humidity)

        def publish_humidity(self):
            self.publisher_.publish(Float32(data=45.0))
"""


def edited(text, *edits):
    """Return a text, dedented, with something else in the place of what is in it.

    Raises:
        ValueError: If a text to replace is not there.
    """
    text = dedent(text).lstrip("\n")
    for old, new in edits:
        if old not in text:
            raise ValueError(f"{old!r} is not in:\n{text}")
        text = text.replace(old, new)
    return text


def subject(text):
    """Return the name of the first class in a text."""
    return text.split("class ")[1].split("(")[0]


def made(exercise, text, *edits):
    """Return the class that a cell of an exercise's page makes, after some edits."""
    text = edited(text, *edits)
    return namespace_of(exercise, text, f"<{exercise}>")[subject(text)]
