"""11b, notice a sick sensor: wrong answers."""

from bank.answer import edited, either, wrong
from bank.beyond.watchdog_right import BASE

_SUPER = 'super().__init__("watchdog")'
_CALL = 'self.create_subscription(Float32, "temperature", self.listen, 10)'
_MAKE = 'self.faults = self.create_publisher(String, "fault", 10)'
_SEND = "self.faults.publish(String(data=word))"
_NAN = "if math.isnan(msg.data):"
_SAY_NAN = 'self.say("nan")\n            return'
_JUMP = "if self.last is not None and abs(msg.data - self.last) > 5.0:"
_ROW = "self.equal = self.equal + 1 if msg.data == self.last else 1"
_FIVE = "if self.equal == 5:"
_STUCK = 'self.say("stuck")'
_KEEP = "self.last = msg.data"


def _wrong(name, mistake, *edits):
    return wrong("11b", name, mistake, edited(BASE, *edits))


def _either(name, mistakes, *edits):
    return either("11b", name, mistakes, edited(BASE, *edits))


ANSWERS = (
    # NaN.
    _wrong("equal to NaN", "nan-compared", (_NAN, "if msg.data == math.nan:")),
    _wrong("equal to a NaN of its own", "nan-compared", (_NAN, 'if msg.data == float("nan"):')),
    _wrong("is NaN", "nan-compared", (_NAN, "if msg.data is math.nan:")),
    _wrong("in a list of NaN", "nan-compared", (_NAN, "if msg.data in [math.nan]:")),
    _wrong("NaN is None", "nan-compared", (_NAN, "if msg.data is None:")),
    _wrong("nobody asks for NaN", "nan-compared", (f"{_NAN}\n            {_SAY_NAN}", "pass")),
    _wrong("NaN is left out in silence", "nan-compared", (_SAY_NAN, "return")),
    _wrong("NaN is kept", "nan-kept", (_SAY_NAN, f'self.say("nan")\n            {_KEEP}\n'
                                                 "            return")),
    _wrong("no return after NaN", "nan-kept", (_SAY_NAN, 'self.say("nan")')),
    _either("NaN only once", ("alert-missing",),
            (_SUPER, f"{_SUPER}\n        self.told = False"),
            (_NAN, f"{_NAN}\n            if self.told:\n                return\n"
                   "            self.told = True")),
    _either("infinite counts, NaN does not", ("nan-compared",), ("math.isnan", "math.isinf")),
    # Jumps.
    _wrong("5 degrees are a jump", "boundary", ("> 5.0", ">= 5.0")),
    _wrong("only upwards", "one-direction", ("abs(msg.data - self.last)", "msg.data - self.last")),
    _wrong("only downwards", "one-direction",
           ("abs(msg.data - self.last)", "self.last - msg.data")),
    _wrong("a limit too high", "other-limits", ("> 5.0", "> 10.0")),
    _wrong("a limit too low", "other-limits", ("> 5.0", "> 0.5")),
    _wrong("it begins with 0", "alarm-at-start", ("self.last = None", "self.last = 0.0")),
    _wrong("it begins with 22", "alarm-at-start", ("self.last = None", "self.last = 22.0")),
    _wrong("with the first reading", "other-reading",
           ("self.equal = 1", "self.equal = 1\n        self.first = None"),
           (_JUMP, "if self.first is None:\n            self.first = msg.data\n"
                   "        if abs(msg.data - self.first) > 5.0:")),
    _wrong("with the last good one", "other-reading",
           ("self.equal = 1", "self.equal = 1\n        self.good = None"),
           (_JUMP, "if self.good is None or abs(msg.data - self.good) <= 5.0:\n"
                   "            self.good = msg.data\n        else:")),
    _wrong("no jumps", "alert-missing", (_JUMP, "if False:")),
    _wrong("the truth of a number", "alert-missing", ("self.last is not None", "self.last")),
    # Hangs.
    _wrong("the fourth", "counted-wrong", (_FIVE, "if self.equal == 4:")),
    _wrong("the sixth", "counted-wrong", (_FIVE, "if self.equal == 6:")),
    _wrong("it counts from 0", "counted-wrong", ("self.equal = 1", "self.equal = 0"),
           ("else 1", "else 0")),
    _wrong("again and again", "status-repeated", (_FIVE, "if self.equal >= 5:")),
    _wrong("each fifth", "status-repeated", (_FIVE, "if self.equal % 5 == 0:")),
    _wrong("the count is emptied", "status-repeated",
           (_STUCK, f"{_STUCK}\n            self.equal = 0")),
    _wrong("the count is never reset", "never-reset",
           (_ROW, "self.equal += msg.data == self.last")),
    _wrong("only once in a life", "never-reset",
           (_SUPER, f"{_SUPER}\n        self.told = False"),
           (_FIVE, "if self.equal == 5 and not self.told:\n            self.told = True")),
    _wrong("rounded", "nearly-equal",
           ("msg.data == self.last",
            "self.last is not None and round(msg.data, 2) == round(self.last, 2)")),
    _wrong("nearly equal", "nearly-equal",
           ("msg.data == self.last",
            "self.last is not None and abs(msg.data - self.last) < 0.01")),
    _wrong("close", "nearly-equal",
           ("msg.data == self.last",
            "self.last is not None and math.isclose(msg.data, self.last, abs_tol=0.01)")),
    _wrong("no hangs", "alert-missing", (_FIVE, "if False:")),
    wrong("11b", "a window that is not full", "alarm-at-start", edited(
        BASE,
        ("self.equal = 1", "self.window = []\n        self.told = False"),
        (_ROW, "self.window = [*self.window, msg.data][-5:]"),
        (_FIVE, "hangs, before = len(set(self.window)) == 1, self.told\n"
                "        self.told = hangs\n        if hangs and not before:"))),
    # Words, and where they go.
    _wrong("in capitals", "wrong-word", ("String(data=word)", "String(data=word.upper())")),
    _wrong("with a blank", "wrong-word", ("String(data=word)", 'String(data=word + " ")')),
    _wrong("another word", "wrong-word", ('"stuck"', '"hangs"')),
    _wrong("a sentence", "wrong-word", ('self.say("jump")', 'self.say("a jump")')),
    _wrong("a spelling", "wrong-word", ('"nan"', '"not a number"')),
    _wrong("two words swapped", "wrong-word", ('"jump"', '"x"'), ('"stuck"', '"jump"'),
           ('"x"', '"stuck"')),
    _wrong("twice", "alert-too-many", (_SEND, f"{_SEND}\n        {_SEND}")),
    _wrong("the plural", "topic-misspelled", ('"fault"', '"faults"')),
    _wrong("another topic", "wrong-topic", ('"fault"', '"alert"')),
    _wrong("deaf", "topic-misspelled", ('"temperature"', '"temperatur"')),
    _wrong("it hears another type", "type-mismatch", ("(Float32, ", "(String, ")),
    _wrong("it only logs", "never-published", (_SEND, "self.get_logger().error(word)")),
    _wrong("nothing to publish with", "no-publisher", (_MAKE, "pass"), (_SEND, "pass")),
    _wrong("nothing that listens", "no-subscription", (_CALL, "pass")),
    _wrong("a text published", "number-published", ("String(data=word)", "word")),
    _wrong("the callback called", "callback-called", ("self.listen, 10", "self.listen(), 10")),
    _wrong("no depth", "depth-missing", ("self.listen, 10", "self.listen")),
    _wrong("no super", "super-missing", (f"            {_SUPER}\n".replace("    ", "", 1), "")),
    _wrong("the message is compared", "message-for-value", ("abs(msg.data - ", "abs(msg - ")),
    _wrong("None is subtracted", "none-used", ("self.last is not None and ", "")),
    # What a beginner writes.
    _wrong("after a jump it counts on", "never-reset",
           (_ROW, "if self.last is None or abs(msg.data - self.last) <= 5.0:\n"
                  f"            {_ROW}")),
    _wrong("kept before it is compared", "other-reading", (_JUMP, f"{_KEEP}\n        {_JUMP}")),
    _wrong("the count begins with 1 again", "status-repeated",
           (_STUCK, f"{_STUCK}\n            self.equal = 1")),
    # Two.
    _either("NaN compared, 5 degrees are a jump", ("nan-compared", "boundary"),
            (_NAN, "if msg.data == math.nan:"), ("> 5.0", ">= 5.0")),
    _either("only upwards, again and again", ("one-direction", "status-repeated"),
            ("abs(msg.data - self.last)", "msg.data - self.last"), (_FIVE, "if self.equal >= 5:")),
    _either("it begins with 0, rounded", ("alarm-at-start", "nearly-equal"),
            ("self.last = None", "self.last = 0.0"),
            ("msg.data == self.last", "round(msg.data, 1) == round(self.last, 1)")),
    _either("the fourth, never reset", ("counted-wrong", "never-reset", "alert-too-many"),
            (_ROW, "self.equal += msg.data == self.last"), (_FIVE, "if self.equal == 4:")),
    _either("the topic, and a word", ("topic-misspelled", "wrong-word"),
            ('"fault"', '"faults"'), ('"nan"', '"NaN!"')),
)  # fmt: skip
