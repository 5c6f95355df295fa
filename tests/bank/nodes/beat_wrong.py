"""03a, another sensor: wrong answers."""

from bank.answer import edited, either, wrong

BASE = """
    class HumiditySensor(Node):
        def __init__(self):
            super().__init__("humidity_sensor")
            self.publisher_ = self.create_publisher(Float32, "humidity", 5)
            self.timer = self.create_timer(0.5, self.publish_humidity)

        def publish_humidity(self):
            self.publisher_.publish(Float32(data=45.0))
"""
_SUPER = 'super().__init__("humidity_sensor")'
_MAKE = 'self.publisher_ = self.create_publisher(Float32, "humidity", 5)'
_TIMER = "self.timer = self.create_timer(0.5, self.publish_humidity)"
_SEND = "self.publisher_.publish(Float32(data=45.0))"
_IN_STEPS = "msg = Float32()\n        {}\n        self.publisher_.publish(msg)"


def _wrong(name, mistake, *edits):
    return wrong("03a", name, mistake, edited(BASE, *edits))


def _either(name, mistakes, *edits):
    return either("03a", name, mistakes, edited(BASE, *edits))


ANSWERS = (
    _wrong("an int in the field", "not-a-float", ("45.0", "45")),
    _wrong("a text in the field", "not-a-float", ("45.0", '"45.0"')),
    _wrong("None in the field", "not-a-float", (_SEND, _IN_STEPS.format("msg.data = None"))),
    _wrong("a number published", "number-published", ("Float32(data=45.0)", "45.0")),
    _wrong("the class published", "class-published", ("Float32(data=45.0)", "Float32")),
    _wrong("a keyword with a letter too few", "wrong-keyword", ("data=", "dat=")),
    _wrong("the topic as a keyword", "wrong-keyword", ("data=", "humidity=")),
    _wrong("another field", "wrong-field", (_SEND, _IN_STEPS.format("msg.value = 45.0"))),
    _wrong("a capital in the field", "wrong-field", (_SEND, _IN_STEPS.format("msg.Data = 45.0"))),
    _wrong("no depth", "depth-missing", ('"humidity", 5', '"humidity"')),
    _wrong("a timer without a callback", "callback-missing", ("0.5, self.publish_humidity", "0.5")),
    _wrong("topic first", "arguments-swapped", ('Float32, "humidity"', '"humidity", Float32')),
    _wrong("depth before topic", "arguments-swapped", ('"humidity", 5', '5, "humidity"')),
    _wrong("callback before period", "arguments-swapped",
           ("0.5, self.publish_humidity", "self.publish_humidity, 0.5")),
    _wrong("float for a type", "not-a-message-type", ("Float32, ", "float, ")),
    _wrong("a module for a type", "not-a-message-type",
           ("class H", "import std_msgs.msg\n\nclass H"), ("Float32, ", "std_msgs.msg, ")),
    _wrong("the callback called", "callback-called",
           ("self.publish_humidity)", "self.publish_humidity())")),
    _wrong("the callback's name as a text", "wrong-argument",
           ("self.publish_humidity)", '"publish_humidity")')),
    _wrong("a callback with msg", "callback-parameters", ("humidity(self)", "humidity(self, msg)")),
    _wrong("a callback without self", "callback-parameters",
           ("publish_humidity(self)", "publish_humidity()")),
    _wrong("no super", "super-missing", (f"        {_SUPER}\n", "")),
    _wrong("super comes last", "super-missing",
           (f"{_SUPER}\n        {_MAKE}", _MAKE), (_TIMER, f"{_TIMER}\n        {_SUPER}")),
    _wrong("no name", "node-name-missing", ('"humidity_sensor"', "")),
    _wrong("a hyphen in the node's name", "invalid-name", ("humidity_sensor", "humidity-sensor")),
    _wrong("a slash at the topic's end", "invalid-name", ('"humidity"', '"humidity/"')),
    _wrong("a hash in the topic", "invalid-name", ('"humidity"', '"humidity#1"')),
    _wrong("a letter too many", "topic-misspelled", ('"humidity"', '"hummidity"')),
    _wrong("a capital letter", "topic-misspelled", ('"humidity"', '"Humidity"')),
    _wrong("letters in another order", "topic-misspelled", ('"humidity"', '"humidtiy"')),
    _wrong("a private name", "topic-misspelled", ('"humidity"', '"~/humidity"')),
    _wrong("the other sensor's topic", "wrong-topic", ('"humidity"', '"temperature"')),
    _wrong("Float64", "type-mismatch",
           ("class H", "from std_msgs.msg import Float64\n\nclass H"), ("Float32", "Float64")),
    _wrong("a text", "type-mismatch",
           ("class H", "from std_msgs.msg import String\n\nclass H"),
           ("Float32, ", "String, "), ("Float32(data=45.0)", 'String(data="45")')),
    _wrong("once a second", "wrong-rate", ("0.5", "1.0")),
    _wrong("every two seconds", "wrong-rate", ("0.5", "2")),
    _wrong("four times a second", "wrong-rate", ("0.5", "0.25")),
    _wrong("milliseconds", "wrong-rate", ("0.5", "500")),
    _wrong("no period at all", "wrong-rate", ("0.5", "0.0")),
    _wrong("a negative period", "wrong-rate", ("0.5", "-0.5")),
    _wrong("two messages a beat", "wrong-rate", (_SEND, f"{_SEND}\n        {_SEND}")),
    _wrong("two timers", "wrong-rate", (_TIMER, f"{_TIMER}\n        {_TIMER}")),
    _wrong("the first at once", "wrong-rate",
           (_TIMER, f"{_TIMER}\n        self.publish_humidity()")),
    _wrong("the usual depth", "wrong-depth", ('"humidity", 5', '"humidity", 10')),
    _wrong("a depth of one", "wrong-depth", ('"humidity", 5', '"humidity", 1')),
    _wrong("all are kept", "wrong-depth",
           ("class H", "from rclpy.qos import HistoryPolicy, QoSProfile\n\nclass H"),
           ('"humidity", 5', '"humidity", QoSProfile(history=HistoryPolicy.KEEP_ALL)')),
    _wrong("no quotes", "name-error", ('"humidity"', "humidity")),
    _wrong("no self before the method", "name-error",
           (", self.publish_humidity", ", publish_humidity")),
    _wrong("no self before the publisher", "name-error", (_SEND, _SEND.removeprefix("self."))),
    _wrong("a type with a letter wrong", "name-error", ("(Float32,", "(Flaot32,")),
    _wrong("nothing to publish with", "no-publisher", (_MAKE, "pass"), (_SEND, "pass")),
    _wrong("a publisher that is never used", "never-published",
           (_SEND, 'self.get_logger().info("45.0")')),
    _wrong("no timer", "no-timer", (_TIMER, "pass")),
    _either("it publishes in the constructor", ("no-timer", "first-messages-lost"),
            (_TIMER, "for _ in range(10):\n            self.publish_humidity()")),
    _wrong("it sleeps for ever", "callback-blocks",
           (_SEND, f"{_SEND}\n        import time\n        time.sleep(10_000)")),
    _wrong("a loop without end in the constructor", "constructor-blocks",
           (_TIMER, f"while True:\n            {_SEND}")),
    _wrong("it exits", "exits", (_SEND, f"{_SEND}\n        raise SystemExit(0)")),
    _wrong("no node", "no-node", ("(Node)", ""), (_SUPER, "pass")),
    _wrong("Object for Node", "no-node", ("(Node)", "(object)"), (_SUPER, "pass")),
    wrong("03a", "main is handed over", "no-node", edited(BASE) + '''
def main(args=None):
    with rclpy.init(args=args):
        node = HumiditySensor()
        rclpy.spin(node)
''', handed='"main"'),
    wrong("03a", "rclpy.init in a with statement", "init-in-with", edited(BASE) + '''
def main(args=None):
    with rclpy.init(args=args):
        return HumiditySensor()
'''),
    _wrong("an attribute of another name", "wrong-attribute",
            (_SEND, _SEND.replace("publisher_", "publisher"))),
    _wrong("a misspelled method", "wrong-attribute",
            ("create_publisher", "create_publihser")),
    _wrong("a depth as a text", "wrong-depth",
            ('"humidity", 5', '"humidity", "5"')),
    _wrong("a negative depth", "wrong-depth", ('"humidity", 5', '"humidity", -5')),
    # Pairs.
    _either("rate and depth", ("wrong-rate", "wrong-depth"),
            ("0.5", "2.0"), ('"humidity", 5', '"humidity", 10')),
    _either("topic and depth", ("topic-misspelled", "wrong-depth"),
            ('"humidity", 5', '"humidty", 10')),
    _either("called, and an int", ("callback-called", "not-a-float"),
            ("self.publish_humidity)", "self.publish_humidity())"), ("45.0", "45")),
    _either("swapped, and no depth", ("arguments-swapped", "depth-missing"),
            ('Float32, "humidity", 5', '"humidity", Float32')),
    _either("no super and float", ("super-missing", "not-a-message-type"),
            (f"        {_SUPER}\n", ""), ("Float32, ", "float, ")),
    _either("a number published, too slowly", ("number-published", "wrong-rate"),
            ("Float32(data=45.0)", "45.0"), ("0.5", "2.0")),
)  # fmt: skip
