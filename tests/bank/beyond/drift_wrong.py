"""11c, compare two sensors: wrong answers."""

from bank.answer import edited, either, wrong
from bank.beyond.drift_right import BASE

_SUPER = 'super().__init__("drift_watch")'
_REFERENCE = 'self.create_subscription(Float32, "reference", self.remember, 10)'
_TEMPERATURE = 'self.create_subscription(Float32, "temperature", self.compare, 10)'
_MAKE = 'self.alarms = self.create_publisher(String, "fault", 10)'
_SEND = 'self.alarms.publish(String(data="drift"))'
_DIFFERENCE = "difference = msg.data - self.reference"
_NAN = "if math.isnan(difference):"
_WINDOW = "[*self.last, difference][-10:]"
_FULL = "len(self.last) == 10 and abs(mean) > 1.0"
_IF = "if drifts and not self.drifts:"


def _wrong(name, mistake, *edits):
    return wrong("11c", name, mistake, edited(BASE, *edits))


def _either(name, mistakes, *edits):
    return either("11c", name, mistakes, edited(BASE, *edits))


ANSWERS = (
    _wrong("a limit a little too high", "other-limits", ("> 1.0", "> 1.1")),
    _wrong("back only at half a degree", "alert-missing",
           (_FULL, "len(self.last) == 10 and abs(mean) > (0.5 if self.drifts else 1.0)")),
    # The window.
    _wrong("nine pairs", "wrong-window", ("-10:", "-9:"), ("== 10", "== 9")),
    _wrong("eleven pairs", "wrong-window", ("-10:", "-11:"), ("== 10", "== 11")),
    _wrong("five pairs", "wrong-window", ("-10:", "-5:"), ("== 10", "== 5")),
    _wrong("the last pair", "wrong-window", (_FULL, "abs(difference) > 1.0")),
    _wrong("all pairs", "wrong-window", ("[-10:]", ""), (_FULL, "abs(mean) > 1.0")),
    _wrong("fewer than ten", "too-few-pairs", (_FULL, "abs(mean) > 1.0")),
    _wrong("the first ten", "wrong-window", ("[-10:]", "[:10]")),
    _either("the median", ("alert-missing", "alert-too-many", "wrong-window"),
            ("class D", "from statistics import median\n\nclass D"),
            ("sum(self.last) / len(self.last)", "median(self.last)")),
    # The mean.
    _wrong("sizes", "mean-of-sizes", ("= msg.data - self.reference",
                                      "= abs(msg.data - self.reference)")),
    _wrong("sizes in the sum", "mean-of-sizes", ("sum(self.last)", "sum(map(abs, self.last))")),
    _wrong("only upwards", "one-direction", ("abs(mean)", "mean")),
    _wrong("only downwards", "one-direction", ("abs(mean)", "-mean")),
    _wrong("a limit too high", "other-limits", ("> 1.0", "> 2.0")),
    _wrong("a limit too low", "other-limits", ("> 1.0", "> 0.5")),
    _either("a sum for a mean", ("alert-too-many", "other-limits"), (" / len(self.last)", "")),
    # NaN.
    _wrong("NaN goes in", "nan-spreads", (_NAN, "if len(self.last) > 99:"),
           ("self.reference = math.nan", "self.reference = None"),
           (_DIFFERENCE, "if self.reference is None:\n            return\n        " + _DIFFERENCE)),
    _wrong("compared with NaN", "nan-spreads", (_NAN, "if difference == math.nan:"),
           ("self.reference = math.nan", "self.reference = None"),
           (_DIFFERENCE, "if self.reference is None:\n            return\n        " + _DIFFERENCE)),
    wrong("11c", "a running sum with NaN in it", "nan-spreads", '''
        class Watch(Node):
            def __init__(self):
                super().__init__("watch")
                self.out = self.create_publisher(String, "fault", 10)
                self.create_subscription(Float32, "temperature", self.temperature, 10)
                self.create_subscription(Float32, "reference", self.remember, 10)
                self.ref, self.queue, self.total, self.bad = None, [], 0.0, False

            def remember(self, msg):
                self.ref = msg.data

            def temperature(self, msg):
                if self.ref is None:
                    return
                self.queue.append(msg.data - self.ref)
                self.total += self.queue[-1]
                if len(self.queue) > 10:
                    self.total -= self.queue.pop(0)
                bad = len(self.queue) == 10 and abs(self.total / 10) > 1
                if bad and not self.bad:
                    self.out.publish(String(data="drift"))
                self.bad = bad
    '''),
    # The pairs.
    _wrong("a reference of 0", "wrong-start", ("math.nan", "0.0")),
    _wrong("a reference of 22", "wrong-start", ("math.nan", "22.0")),
    wrong("11c", "two lists", "pairs-mixed-up", '''
        class Watch(Node):
            def __init__(self):
                super().__init__("watch")
                self.out = self.create_publisher(String, "fault", 10)
                self.create_subscription(Float32, "temperature", self.temperature, 10)
                self.create_subscription(Float32, "reference", self.reference, 10)
                self.temperatures, self.references, self.bad = [], [], False

            def temperature(self, msg):
                self.temperatures.append(msg.data)
                self.look()

            def reference(self, msg):
                self.references.append(msg.data)
                self.look()

            def look(self):
                pairs = zip(self.temperatures, self.references)
                off = [a - b for a, b in pairs if not math.isnan(a - b)][-10:]
                bad = len(off) == 10 and abs(sum(off) / 10) > 1
                if bad and not self.bad:
                    self.out.publish(String(data="drift"))
                self.bad = bad
    '''),
    _wrong("a fixed reference", "no-subscription",
            (_REFERENCE, "self.reference = 22.0"), ("self.reference = math.nan", "pass")),
    # When it speaks.
    _wrong("again and again", "status-repeated", (_IF, "if drifts:")),
    _wrong("only once", "never-reset",
           ("self.drifts = drifts", "self.drifts = self.drifts or drifts")),
    _either("it also says that all is well", ("wrong-word",),
            ("self.drifts = drifts", 'if self.drifts and not drifts:\n'
                                     '            self.alarms.publish(String(data="well"))\n'
                                     "        self.drifts = drifts")),
    _wrong("twice", "alert-too-many", (_SEND, f"{_SEND}\n            {_SEND}")),
    _wrong("upside down", "alert-missing", (_IF, "if not drifts and self.drifts:")),
    _either("a timer looks", ("alert-missing", "alert-too-many"),
            ("self.drifts = False", "self.drifts = self.bad = False\n"
                                    "        self.create_timer(3.0, self.look)"),
            (_IF, "self.bad = drifts\n\n    def look(self):\n        drifts = self.bad\n"
                  f"        {_IF}")),
    # Words, and where they go.
    _wrong("another word", "wrong-word", ('"drift")', '"drifts")')),
    _wrong("the topic's plural", "topic-misspelled", ('"fault"', '"faults"')),
    _wrong("another topic", "wrong-topic", ('"fault"', '"drift"')),
    _wrong("deaf on one ear", "topic-misspelled", ('"reference"', '"referense"')),
    _wrong("it hears only itself", "topic-misspelled", ('"temperature"', '"temperatur"')),
    _wrong("it publishes a number", "type-mismatch", ("(String, ", "(Float32, "),
           ('String(data="drift")', "Float32(data=mean)")),
    _wrong("it only logs", "never-published", (_SEND, 'self.get_logger().error("drift")')),
    _wrong("nothing to publish with", "no-publisher", (_MAKE, "pass"), (_SEND, "pass")),
    _wrong("a text published", "number-published", ('String(data="drift")', '"drift"')),
    _wrong("callbacks called", "callback-called", ("self.compare, 10", "self.compare(), 10")),
    _wrong("no depth", "depth-missing", ("self.remember, 10", "self.remember")),
    _wrong("the reference as a message", "message-for-value",
           ("        self.reference = msg.data", "        self.reference = msg"),
           ("msg.data - self.reference", "0.0 if self.reference != self.reference else "
                                         "msg.data - self.reference")),
    # What a beginner writes.
    _wrong("only the temperature is asked for NaN", "nan-spreads",
           (_NAN, "if math.isnan(msg.data) or self.reference is math.nan:")),
    _wrong("each pair alone, again and again", "wrong-window",
           (_FULL, "abs(difference) > 1.0"), (_IF, "if drifts:")),
    _wrong("the reference makes the pair", "pairs-mixed-up",
           ('"reference", self.remember', '"temperature", self.remember'),
           ('"temperature", self.compare', '"reference", self.compare'),
           ("= msg.data - self.reference", "= self.reference - msg.data")),
    _wrong("NaN asked of None", "none-used", ("self.reference = math.nan", "self.reference = None"),
           ("difference = msg", "math.isnan(self.reference)\n        difference = msg")),
    # Two.
    _either("sizes, again and again", ("mean-of-sizes", "status-repeated", "alert-too-many"),
            ("= msg.data - self.reference", "= abs(msg.data - self.reference)"),
            (_IF, "if drifts:")),
    _either("only upwards, too few pairs", ("one-direction", "too-few-pairs"),
            (_FULL, "mean > 1.0")),
    _either("nine pairs, only once", ("wrong-window", "never-reset"),
            ("-10:", "-9:"), ("== 10", "== 9"),
            ("self.drifts = drifts", "self.drifts = self.drifts or drifts")),
    _either("a word, and the topic", ("wrong-word", "topic-misspelled"),
            ('"drift")', '"Drifting")'), ('"fault"', '"faults"')),
)  # fmt: skip
