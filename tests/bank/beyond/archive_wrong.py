"""08b, listen to everybody: wrong answers."""

from bank.answer import edited, either, wrong
from bank.beyond.archive_right import BASE

_QOS = "qos = QoSProfile(depth=16, reliability=ReliabilityPolicy.BEST_EFFORT)"
_CALL = 'self.create_subscription(Float32, "reading", self.copy, qos)'
_MAKE = 'self.copies = self.create_publisher(Float32, "archive", 10)'
_SEND = "self.copies.publish(msg)"


def _wrong(name, mistake, *edits):
    return wrong("08b", name, mistake, edited(BASE, *edits))


def _either(name, mistakes, *edits):
    return either("08b", name, mistakes, edited(BASE, *edits))


ANSWERS = (
    # Quality of service.
    _wrong("reliable by default", "qos-mismatch", (_QOS, "qos = 16")),
    _wrong("reliable in so many words", "qos-mismatch", ("BEST_EFFORT", "RELIABLE")),
    _wrong("a profile with a depth alone", "qos-mismatch", (_QOS, "qos = QoSProfile(depth=20)")),
    _wrong("stored readings wanted", "qos-mismatch",
           ("depth=16,", "depth=16, durability=DurabilityPolicy.TRANSIENT_LOCAL,")),
    _wrong("a deadline that nobody offers", "qos-mismatch",
           ("depth=16,", "depth=16, deadline=Duration(seconds=2),")),
    _wrong("a profile on the wrong side", "qos-mismatch",
           ("self.copy, qos", "self.copy, 16"), ('"archive", 10', '"archive", qos')),
    _wrong("the profile of sensors", "queue-too-short", (_QOS, "qos = qos_profile_sensor_data")),
    _wrong("one sensor counted", "queue-too-short", ("depth=16", "depth=8")),
    _wrong("one too few", "queue-too-short", ("depth=16", "depth=15")),
    _wrong("ten", "queue-too-short", ("depth=16", "depth=10")),
    _wrong("the depth at the other end", "queue-too-short",
           ("depth=16", "depth=1"), ('"archive", 10', '"archive", 100')),
    _wrong("a subscription for each", "heard-twice",
           (_CALL, f"{_CALL}\n        "
                   'self.create_subscription(Float32, "reading", self.copy, 16)')),
    _wrong("a policy without its underline", "wrong-attribute", ("BEST_EFFORT", "BESTEFFORT")),
    _wrong("a depth as a text", "wrong-argument", ("depth=16", 'depth="16"')),
    # What it does with the readings.
    _wrong("said twice", "wrong-values", (_SEND, f"{_SEND}\n        {_SEND}")),
    _wrong("rounded", "wrong-values", (_SEND, "self.copies.publish("
                                              "Float32(data=float(round(msg.data))))")),
    _wrong("only warm ones", "wrong-values", (_SEND, f"if msg.data > 20.5:\n            {_SEND}")),
    _wrong("the newest first", "wrong-values",
           (_MAKE, f"{_MAKE}\n        self.waiting = []\n"
                   "        self.create_timer(30.5, self.write)"),
           (_SEND, "self.waiting.append(msg)\n"
                   "        if len(self.waiting) == 40:\n            self.write()\n\n"
                   "    def write(self):\n        while self.waiting:\n"
                   "            self.copies.publish(self.waiting.pop())")),
    _wrong("a number of its own", "wrong-values", (_SEND, "self.copies.publish(Float32())")),
    # The thirty.
    _wrong("the plural", "topic-misspelled", ('"reading"', '"readings"')),
    _wrong("the archive misspelt", "topic-misspelled", ('"archive", 10', '"archives", 10')),
    _wrong("another topic", "wrong-topic", ('"reading"', '"temperature"')),
    _wrong("numbers of another type", "type-mismatch",
           ('(Float32, "reading"', '(Int32, "reading"')),
    _wrong("copies of another type", "type-mismatch",
           ('(Float32, "archive"', '(Int32, "archive"'),
           (_SEND, "self.copies.publish(Int32(data=int(msg.data)))")),
    _wrong("no copies", "never-published", (_SEND, "self.get_logger().info(str(msg.data))")),
    _wrong("nothing to publish with", "no-publisher", (_MAKE, "pass"), (_SEND, "pass")),
    _wrong("nothing that listens", "no-subscription", (_CALL, "pass")),
    _wrong("no depth", "depth-missing", (", qos)", ")")),
    _wrong("the callback called", "callback-called", ("self.copy, qos", "self.copy(), qos")),
    _wrong("a callback without msg", "callback-parameters",
           ("copy(self, msg)", "copy(self)"), (_SEND, "pass")),
    _wrong("a number published", "number-published", (_SEND, "self.copies.publish(msg.data)")),
    _wrong("the publisher comes too late", "wrong-attribute",
           (f"        {_MAKE}\n", ""), (_SEND, _SEND)),
    _wrong("a policy and no profile", "qos-mismatch",
           (_QOS, "qos = ReliabilityPolicy.BEST_EFFORT")),
    # Pairs.
    _either("ten, as ever", ("qos-mismatch", "queue-too-short"), (_QOS, "qos = 10")),
    _either("stored, and a short queue", ("qos-mismatch", "queue-too-short"),
            ("depth=16,", "depth=8, durability=DurabilityPolicy.TRANSIENT_LOCAL,")),
    _either("a short queue, and rounded", ("queue-too-short", "wrong-values"),
            ("depth=16", "depth=10"),
            (_SEND, "self.copies.publish(Float32(data=float(round(msg.data))))")),
    _either("reliable, and misspelt", ("qos-mismatch", "topic-misspelled"),
            (_QOS, "qos = 16"), ('"archive", 10', '"archives", 10')),
)  # fmt: skip
