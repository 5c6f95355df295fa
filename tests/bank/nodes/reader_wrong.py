"""00a, read the weather: wrong answers."""

from bank.answer import edited, either, wrong

BASE = """
    class WeatherReader(Node):
        def __init__(self):
            super().__init__("weather_reader")
            self.create_subscription(String, "weather", self.read, 10)

        def read(self, msg):
            self.get_logger().info(f"I read: {msg.data}")
"""
_CALL = 'self.create_subscription(String, "weather", self.read, 10)'
_SUPER = 'super().__init__("weather_reader")'
_LOG = 'self.get_logger().info(f"I read: {msg.data}")'


def _wrong(name, mistake, *edits):
    return wrong("00a", name, mistake, edited(BASE, *edits))


def _either(name, mistakes, *edits):
    return either("00a", name, mistakes, edited(BASE, *edits))


ANSWERS = (
    _wrong("a field that is not there", "wrong-field", ("msg.data", "msg.text")),
    _wrong("no depth", "depth-missing", ("self.read, 10", "self.read")),
    _wrong("no callback", "callback-missing", ("self.read, 10", "10")),
    _wrong("topic first", "arguments-swapped", ('String, "weather"', '"weather", String')),
    _wrong("callback before topic", "arguments-swapped",
           ('"weather", self.read', 'self.read, "weather"')),
    _wrong("depth before callback", "arguments-swapped", ("self.read, 10", "10, self.read")),
    _wrong("str for a type", "not-a-message-type", ("String, ", "str, ")),
    _wrong("the type as a text", "not-a-message-type", ("String, ", '"String", ')),
    _wrong("a module for a type", "not-a-message-type",
           (_SUPER, _SUPER + "\n        import std_msgs.msg"), ("String, ", "std_msgs.msg, ")),
    _wrong("the callback called", "callback-called", ("self.read,", "self.read(),")),
    _wrong("the callback called with a text", "callback-called",
           ("self.read,", 'self.read("weather"),'), (_LOG, "print(msg)")),
    _wrong("a callback without msg", "callback-parameters", ("(self, msg)", "(self)")),
    _wrong("a callback without self", "callback-parameters", ("(self, msg)", "(msg)")),
    _wrong("a callback with three parameters", "callback-parameters",
           ("(self, msg)", "(self, topic, name, msg)")),
    _wrong("no super", "super-missing", (f"        {_SUPER}\n", "")),
    _wrong("super comes last", "super-missing",
           (f"{_SUPER}\n        {_CALL}", f"{_CALL}\n        {_SUPER}")),
    _wrong("no name", "node-name-missing", ('"weather_reader"', "")),
    _wrong("a space in the node's name", "invalid-name", ("weather_reader", "weather reader")),
    _wrong("a hyphen in the node's name", "invalid-name", ("weather_reader", "weather-reader")),
    _wrong("a slash at the topic's end", "invalid-name", ('"weather"', '"weather/"')),
    _wrong("a space in the topic", "invalid-name", ('"weather"', '"the weather"')),
    _wrong("a digit at the topic's beginning", "invalid-name", ('"weather"', '"1weather"')),
    _wrong("a letter is missing", "topic-misspelled", ('"weather"', '"wether"')),
    _wrong("a capital letter", "topic-misspelled", ('"weather"', '"Weather"')),
    _wrong("one letter too many", "topic-misspelled", ('"weather"', '"weathers"')),
    _wrong("a private name", "topic-misspelled", ('"weather"', '"~/weather"')),
    _wrong("a namespace", "topic-misspelled",
           ('"weather_reader"', '"weather_reader", namespace="ben"')),
    _wrong("another topic", "wrong-topic", ('"weather"', '"sports"')),
    _wrong("more topics than one", "wrong-topic",
           (_CALL, f'for topic in ("weather", "sports", "politics"):\n            '
                   f'{_CALL.replace(chr(34) + "weather" + chr(34), "topic")}')),
    _wrong("stored messages wanted", "qos-mismatch",
           ("class Weather", "from rclpy.qos import DurabilityPolicy, QoSProfile\n\n"
                             "class Weather"),
           ("self.read, 10", "self.read, "
            "QoSProfile(depth=10, durability=DurabilityPolicy.TRANSIENT_LOCAL)")),
    _wrong("another type", "type-mismatch", ("String,", "Float32,")),
    _wrong("no quotes", "name-error", ('"weather"', "weather")),
    _wrong("no self before the method", "name-error", ("self.read,", "read,")),
    _wrong("no self before create_subscription", "name-error",
           ("self.create_subscription", "create_subscription")),
    _wrong("nothing that listens", "no-subscription", (_CALL, "pass")),
    _wrong("a method nobody calls", "no-subscription",
           (f"    {_CALL}", f"\n    def subscribe(self):\n        {_CALL}")),
    _wrong("no node", "no-node", ("(Node)", ""), (_SUPER, "pass")),
    _wrong("it exits", "exits", (_LOG, "import sys\n        sys.exit()")),
    _wrong("a loop without end", "callback-blocks", (_LOG, "while True:\n            pass")),
    _wrong("a loop without end in the constructor", "constructor-blocks",
           (_CALL, f"{_CALL}\n        while True:\n            pass")),
    _wrong("it sleeps for ever", "callback-blocks",
           (_LOG, "import time\n        time.sleep(10_000)")),
    _either("it spins in the constructor", ("not-spun", "callback-blocks"),
            ("class Weather", "import rclpy\n\nclass Weather"),
            (_CALL, f"{_CALL}\n        rclpy.spin(self)")),
    _either("it shuts ROS down", ("shut-down-twice", "not-initialised", "new-to-me"),
            ("class Weather", "import rclpy\n\nclass Weather"),
            (_LOG, "rclpy.shutdown()")),
    wrong("00a", "the class's name in quotes", "no-node", BASE, handed='"WeatherReader"'),
    wrong("00a", "a number", "no-node", BASE, handed="10"),
    wrong("00a", "another class", "no-node", BASE, handed="String"),
    # Pairs.
    _either("a letter and the depth", ("topic-misspelled", "depth-missing"),
            ('"weather"', '"wether"'), ("self.read, 10", "self.read")),
    _either("called, and without msg", ("callback-called", "callback-parameters", "name-error"),
            ("self.read,", "self.read(),"), ("(self, msg)", "(self)")),
    _either("swapped, and str", ("arguments-swapped", "not-a-message-type"),
            ('String, "weather"', '"weather", str')),
    _either("no super and a wrong topic", ("super-missing", "topic-misspelled"),
            (f"        {_SUPER}\n", ""), ('"weather"', '"wether"')),
    _either("a bad name and a wrong type", ("invalid-name", "type-mismatch"),
            ("weather_reader", "weather reader"), ("String,", "Float32,")),
    _either("a wrong topic and a wrong field", ("wrong-topic", "wrong-field"),
            ('"weather"', '"sports"'), ("msg.data", "msg.article")),
)  # fmt: skip
