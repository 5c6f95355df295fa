"""04b, raise the alarm: wrong answers."""

from bank.answer import edited, either, wrong
from bank.nodes.alarm_right import BASE

_SUPER = 'super().__init__("alarm")'
_CALL = 'self.create_subscription(Float32, "temperature", self.temperature_callback, 10)'
_MAKE = 'self.alerts = self.create_publisher(String, "alert", 10)'
_IF = "if msg.data > 26.0 or msg.data < 20.0:"
_TEXT = 'f"{msg.data:.1f} degrees"'
_SEND = f"self.alerts.publish(String(data={_TEXT}))"


def _wrong(name, mistake, *edits):
    return wrong("04b", name, mistake, edited(BASE, *edits))


def _either(name, mistakes, *edits):
    return either("04b", name, mistakes, edited(BASE, *edits))


ANSWERS = (
    # The exercise's own mistakes.
    _wrong("26.0 alarms", "boundary", ("> 26.0", ">= 26.0")),
    _wrong("20.0 alarms", "boundary", ("< 20.0", "<= 20.0")),
    _wrong("both limits alarm", "boundary", ("> 26.0", ">= 26.0"), ("< 20.0", "<= 20.0")),
    # To whoever only watches, a condition that is never true looks like a missing publish.
    _either("and for or", ("never-published",), (" or ", " and ")),
    _wrong("only hot", "alert-missing", (" or msg.data < 20.0", "")),
    _wrong("only cold", "alert-missing", ("msg.data > 26.0 or ", "")),
    _wrong("always", "alert-too-many", (_IF, "if True:")),
    _wrong("a number behind or", "alert-too-many",
           ("msg.data > 26.0 or", "msg.data > 26.0 or 20.0 or")),
    _wrong("upside down", "alert-too-many", (_IF, "if msg.data < 26.0 or msg.data > 20.0:")),
    _wrong("between", "alert-too-many", (_IF, "if 20.0 <= msg.data <= 26.0:")),
    _wrong("twice", "alert-too-many", (_SEND, f"{_SEND}\n            {_SEND}")),
    _wrong("an upper limit too high", "alert-missing", ("26.0", "27.0")),
    _wrong("a lower limit too low", "alert-missing", ("20.0", "18.0")),
    _wrong("limits a little off", "alert-missing", ("> 26.0", "> 26.1"), ("< 20.0", "< 19.9")),
    _wrong("nothing above 28", "alert-missing", ("> 26.0", "> 26.0 and msg.data < 28.0")),
    _wrong("an upper limit too low", "alert-too-many", ("> 26.0", "> 21.0")),
    _wrong("a lower limit too high", "alert-too-many", ("< 20.0", "< 23.0")),
    _wrong("only the first time", "alert-missing",
           (_SUPER, f"{_SUPER}\n        self.told = False"),
           (_IF, "if (msg.data > 26.0 or msg.data < 20.0) and not self.told:\n"
                 "            self.told = True")),
    _either("one alert for each change", ("alert-missing",),
            (_SUPER, f"{_SUPER}\n        self.before = False"),
            (f"{_IF}\n            {_SEND}",
             "now = msg.data > 26.0 or msg.data < 20.0\n"
             f"        if now and not self.before:\n            {_SEND}\n"
             "        self.before = now")),
    _either("one message too late", ("alert-missing", "alert-too-many", "boundary"),
            (_SUPER, f"{_SUPER}\n        self.last = 22.0"),
            (f"{_IF}\n            {_SEND}",
             f"if self.last > 26.0 or self.last < 20.0:\n            {_SEND}\n"
             "        self.last = msg.data")),
    _either("a timer looks instead", ("alert-missing", "alert-too-many", "wrong-rate", "boundary"),
            (_SUPER, f"{_SUPER}\n        self.last = 22.0\n"
                     "        self.create_timer(2.0, self.look)"),
            (f"{_IF}\n            {_SEND}",
             "self.last = msg.data\n\n    def look(self):\n"
             "        if self.last > 26.0 or self.last < 20.0:\n"
             '            self.alerts.publish(String(data="alarm"))')),
    # The thirty.
    _wrong("a number in the field", "not-a-float", (f"data={_TEXT}", "data=msg.data")),
    _wrong("a number published", "number-published", (f"String(data={_TEXT})", "msg.data")),
    _wrong("a text published", "number-published", (f"String(data={_TEXT})", '"Alarm"')),
    _wrong("the class published", "class-published", (f"String(data={_TEXT})", "String")),
    _wrong("another keyword", "wrong-keyword", ("String(data=", "String(text=")),
    _wrong("another field to write", "wrong-field",
           (_SEND, 'out = String()\n            out.text = "hot"\n'
                   "            self.alerts.publish(out)")),
    _wrong("another field to read", "wrong-field", ("msg.data", "msg.temp")),
    _wrong("no depth at the publisher", "depth-missing", ('"alert", 10', '"alert"')),
    _wrong("no depth at the subscription", "depth-missing", ("callback, 10", "callback")),
    _wrong("no callback", "callback-missing",
           ("self.temperature_callback, 10", "10")),
    _wrong("topic first at the publisher", "arguments-swapped",
           ('String, "alert"', '"alert", String')),
    _wrong("topic first at the subscription", "arguments-swapped",
           ('Float32, "temperature"', '"temperature", Float32')),
    _wrong("str for a type", "not-a-message-type", ("(String, ", "(str, ")),
    _wrong("the callback called", "callback-called",
           ("self.temperature_callback, 10", "self.temperature_callback(), 10")),
    _wrong("a callback without msg", "callback-parameters", ("(self, msg)", "(self)")),
    _wrong("no super", "super-missing", (f"        {_SUPER}\n", "")),
    _wrong("no name", "node-name-missing", ('"alarm"', "")),
    _wrong("an exclamation mark in the node's name", "invalid-name", ('"alarm"', '"alarm!"')),
    _wrong("a space in the topic", "invalid-name", ('"alert"', '"an alert"')),
    _wrong("the plural", "topic-misspelled", ('"alert"', '"alerts"')),
    _wrong("a letter wrong", "topic-misspelled", ('"alert"', '"alter"')),
    _wrong("a letter wrong where it listens", "topic-misspelled",
           ('"temperature"', '"temparature"')),
    _wrong("another topic", "wrong-topic", ('"alert"', '"status"')),
    _wrong("it publishes where it listens", "type-mismatch", ('"alert"', '"temperature"')),
    _wrong("it hears another type", "type-mismatch", ("(Float32, ", "(String, ")),
    _wrong("alerts of another type", "type-mismatch",
           ("(String, ", "(Float32, "), (f"String(data={_TEXT})", "msg")),
    _either("another type than declared", ("number-published", "type-mismatch"),
            ("(String, ", "(Float32, ")),
    _either("the reading passed on", ("number-published", "type-mismatch"),
            (f"String(data={_TEXT})", "msg")),
    _wrong("stored readings wanted", "qos-mismatch",
           ("class A", "from rclpy.qos import DurabilityPolicy, QoSProfile\n\nclass A"),
           ("callback, 10",
            "callback, QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)")),
    _wrong("no quotes", "name-error", ('"alert"', "alert")),
    _wrong("no self before the publisher", "name-error", (_SEND, _SEND.removeprefix("self."))),
    _wrong("a variable of another method", "name-error", (_IF, "if temp > 26.0 or temp < 20.0:")),
    _wrong("nothing to publish with", "no-publisher", (_MAKE, "pass"), (_SEND, "pass")),
    _wrong("it logs only", "never-published", (_SEND, f"self.get_logger().info({_TEXT})")),
    _wrong("nothing that listens", "no-subscription", (_CALL, "pass")),
    _wrong("it waits in the callback", "callback-blocks",
           (_IF, "while msg.data > 26.0:\n            pass\n        if msg.data < 20.0:")),
    _wrong("it exits", "exits", (_SEND, f"{_SEND}\n            quit()")),
    _wrong("no node", "no-node", ("(Node)", ""), (_SUPER, "pass")),
    _wrong("the message is compared", "message-for-value",
            (_IF, "if msg > 26.0 or msg < 20.0:")),
    _wrong("text plus number", "text-and-number",
            (_TEXT, '"Alarm: " + msg.data')),
    _wrong("an attribute of another name", "wrong-attribute",
            ("self.alerts.publish", "self.alert.publish")),
    # Pairs.
    _either("a limit, and the topic", ("boundary", "topic-misspelled"),
            ("> 26.0", ">= 26.0"), ('"alert"', '"alerts"')),
    _either("deaf and dumb", ("topic-misspelled", "never-published"),
            ('"temperature"', '"temprature"'), (_SEND, "pass")),
    _either("and, and a text published", ("never-published", "number-published"),
            (" or ", " and "), (f"String(data={_TEXT})", _TEXT)),
    _either("only hot, at 26.0 already", ("boundary", "alert-missing"),
            (_IF, "if msg.data >= 26.0:")),
    _either("no depth, twice", ("depth-missing", "callback-called"),
            ("self.temperature_callback, 10", "self.temperature_callback()"),
            ('"alert", 10', '"alert"')),
    # Python sees a node that has no data, for the node takes the message's place.
    _either("called, and no self", ("callback-called", "callback-parameters", "wrong-attribute"),
            ("self.temperature_callback, 10", "self.temperature_callback(), 10"),
            ("(self, msg)", "(msg)")),
    # Limits that are nearly right.
    _wrong("a lower limit one too high", "alert-too-many", ("20.0", "21.0")),
    _wrong("an upper limit one too low", "alert-too-many", ("26.0", "25.0")),
    _wrong("whole degrees", "alert-missing", (_IF, "if int(msg.data) > 26 or int(msg.data) < 20:")),
)  # fmt: skip
