"""00b, report on sports: wrong answers."""

from bank.answer import edited, either, wrong

BASE = """
    class SportsReporter(Node):
        def __init__(self):
            super().__init__("sports_reporter")
            self.publisher = self.create_publisher(String, "sports", 10)
            self.timer = self.create_timer(2.0, self.write)

        def write(self):
            self.publisher.publish(String(data="What a match"))
"""
_SUPER = 'super().__init__("sports_reporter")'
_MAKE = 'self.publisher = self.create_publisher(String, "sports", 10)'
_TIMER = "self.timer = self.create_timer(2.0, self.write)"
_SEND = 'self.publisher.publish(String(data="What a match"))'
_IN_STEPS = "msg = String()\n        {}\n        self.publisher.publish(msg)"


def _wrong(name, mistake, *edits):
    return wrong("00b", name, mistake, edited(BASE, *edits))


def _either(name, mistakes, *edits):
    return either("00b", name, mistakes, edited(BASE, *edits))


ANSWERS = (
    _wrong("a number in the field", "not-a-float", ('"What a match"', "3")),
    _wrong("None in the field", "not-a-float", (_SEND, _IN_STEPS.format("msg.data = None"))),
    _wrong("bytes in the field", "not-a-float", ('"What a match"', 'b"What a match"')),
    _wrong("a text published", "number-published", ('String(data="What a match")', '"Goal"')),
    _wrong("the class published", "class-published", ('String(data="What a match")', "String")),
    _wrong("another keyword", "wrong-keyword", ("data=", "text=")),
    _wrong("another field", "wrong-field", (_SEND, _IN_STEPS.format('msg.text = "Goal"'))),
    _wrong("no depth", "depth-missing", ('"sports", 10', '"sports"')),
    _wrong("a timer without a callback", "callback-missing", ("2.0, self.write", "2.0")),
    _wrong("topic first", "arguments-swapped", ('String, "sports"', '"sports", String')),
    _wrong("depth before topic", "arguments-swapped", ('"sports", 10', '10, "sports"')),
    _wrong("callback before period", "arguments-swapped", ("2.0, self.write", "self.write, 2.0")),
    _wrong("str for a type", "not-a-message-type", ("(String, ", "(str, ")),
    _wrong("the type as a text", "not-a-message-type", ("(String, ", '("String", ')),
    _wrong("an object of the type", "not-a-message-type", ("(String, ", "(String(), ")),
    _wrong("the callback called", "callback-called", ("self.write)", "self.write())")),
    _wrong("a callback with msg", "callback-parameters", ("write(self)", "write(self, msg)")),
    _wrong("a callback without self", "callback-parameters",
           ("write(self)", "write()"), (_SEND, "pass")),
    _wrong("no super", "super-missing", (f"        {_SUPER}\n", "")),
    _wrong("super in the middle", "super-missing",
           (f"{_SUPER}\n        {_MAKE}", f"{_MAKE}\n        {_SUPER}")),
    _wrong("no name", "node-name-missing", ('"sports_reporter"', "")),
    _wrong("a hyphen in the node's name", "invalid-name", ("sports_reporter", "sports-reporter")),
    _wrong("a space in the topic", "invalid-name", ('"sports"', '"our sports"')),
    _wrong("an umlaut in the topic", "invalid-name", ('"sports"', '"spört"')),
    _wrong("an empty topic", "invalid-name", ('"sports"', '""')),
    _wrong("the topic in the singular", "topic-misspelled", ('"sports"', '"sport"')),
    _wrong("a capital letter", "topic-misspelled", ('"sports"', '"Sports"')),
    _wrong("letters in another order", "topic-misspelled", ('"sports"', '"spotrs"')),
    _wrong("a namespace", "topic-misspelled",
           ('"sports_reporter"', '"sports_reporter", namespace="news"')),
    _wrong("another topic", "wrong-topic", ('"sports"', '"weather"')),
    _wrong("another type", "type-mismatch", ("(String, ", "(Float32, "),
           ('String(data="What a match")', "Float32(data=3.0)")),
    _either("one type declared, another published", ("number-published", "type-mismatch"),
            ('String(data="What a match")', "Float32(data=3.0)")),
    _wrong("every second", "wrong-rate", ("2.0", "1.0")),
    _wrong("twice a second", "wrong-rate", ("2.0", "0.5")),
    _wrong("milliseconds", "wrong-rate", ("2.0", "2000")),
    _wrong("nearly", "wrong-rate", ("2.0", "1.9")),
    _wrong("every beat counts twice", "wrong-rate", (_SEND, f"{_SEND}\n        {_SEND}")),
    _wrong("two timers", "wrong-rate", (_TIMER, f"{_TIMER}\n        {_TIMER}")),
    _wrong("no quotes", "name-error", ('"sports"', "sports")),
    _wrong("no self before the method", "name-error", (", self.write", ", write")),
    _wrong("no self before the publisher", "name-error",
           ("self.publisher.publish", "publisher.publish")),
    _wrong("a type that is not imported", "name-error", ("(String, ", "(Int32, ")),
    _wrong("nothing to publish with", "no-publisher", (_MAKE, "pass"), (_SEND, "pass")),
    _wrong("a publisher that is never used", "never-published", (_SEND, "pass")),
    _wrong("it logs and does not publish", "never-published",
           (_SEND, 'self.get_logger().info("What a match")')),
    _wrong("the method is not called", "never-published",
           (_SEND, "self.publisher.publish"), ),
    _wrong("no timer", "no-timer", (_TIMER, "pass")),
    _either("it publishes once, in the constructor", ("no-timer", "first-messages-lost"),
            (_TIMER, "self.write()")),
    _either("a loop instead of a timer", ("no-timer", "first-messages-lost"),
            (_TIMER, "for n in range(4):\n            self.write()")),
    _wrong("a loop without end", "callback-blocks",
           (_SEND, f"while True:\n            {_SEND}\n            import time; time.sleep(2)")),
    _wrong("it sleeps for ever", "callback-blocks",
           (_SEND, f"{_SEND}\n        import time\n        time.sleep(10_000)")),
    _wrong("it exits", "exits", (_SEND, f"{_SEND}\n        quit()")),
    _wrong("no node", "no-node", ("(Node)", ""), (_SUPER, "pass")),
    wrong("00b", "a function that returns nothing", "no-node",
          edited(BASE) + "\ndef make():\n    SportsReporter()\n"),
    _either("rclpy.init twice, and the topic", ("initialised-twice", "topic-misspelled"),
            (_SUPER, f"import rclpy\n        rclpy.init()\n        rclpy.init()\n        {_SUPER}"),
            ('"sports"', '"sport"')),
    _wrong("an attribute of another name", "wrong-attribute",
            ("self.publisher.publish", "self.publisher_.publish")),
    _wrong("a division by zero", "division-by-zero", (_SEND, "1 / 0")),
    # Pairs.
    _either("topic and rate", ("topic-misspelled", "wrong-rate"),
            ('"sports"', '"sport"'), ("2.0", "1.0")),
    _either("called, and no depth", ("callback-called", "depth-missing"),
            ("self.write)", "self.write())"), ('"sports", 10', '"sports"')),
    _either("swapped, and a text published", ("arguments-swapped", "number-published"),
            ('String, "sports"', '"sports", String'),
            ('String(data="What a match")', '"Goal"')),
    _either("a wrong rate and a number in the field", ("wrong-rate", "not-a-float"),
            ("2.0", "1.0"), ('"What a match"', "3")),
    _either("no timer and a wrong topic", ("no-timer", "topic-misspelled"),
            (_TIMER, "pass"), ('"sports"', '"sport"')),
    _either("a bad name and no timer", ("invalid-name", "no-timer"),
            ("sports_reporter", "sports reporter"), (_TIMER, "pass")),
)  # fmt: skip
