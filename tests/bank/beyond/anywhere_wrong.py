"""09c, a monitor for any place: wrong answers."""

from bank.answer import edited, either, wrong
from bank.beyond.anywhere_right import _TEXT, BASE

_LOW = 'self.declare_parameter("low", 20.0)'
_HIGH = 'self.declare_parameter("high", 26.0)'
_UNIT = 'self.declare_parameter("unit", "C")'
_SEND = "self.statuses.publish(String(data=text))"
_SUBSCRIBE = 'self.create_subscription(Float32, "reading", self.hear, 10)'
_OF_LOW, _OF_HIGH = 'self.value_of("low")', 'self.value_of("high")'

SHARED = """
    class AnyMonitor(Node):
        low, high, unit = 20.0, 26.0, "C"

        def __init__(self):
            super().__init__("any_monitor")
            AnyMonitor.low = self.declare_parameter("low", 20.0).value
            AnyMonitor.high = self.declare_parameter("high", 26.0).value
            AnyMonitor.unit = self.declare_parameter("unit", "C").value
            self.out = self.create_publisher(String, "status", 10)
            self.create_subscription(Float32, "reading", self.hear, 10)

        def hear(self, msg):
            word = "High" if msg.data > self.high else "Low" if msg.data < self.low else "Normal"
            self.out.publish(String(data=f"{word} {msg.data:.1f} {self.unit}"))
"""


def _wrong(name, mistake, *edits, base=BASE):
    return wrong("09c", name, mistake, edited(base, *edits))


def _either(name, mistakes, *edits, base=BASE):
    return either("09c", name, mistakes, edited(base, *edits))


ANSWERS = (
    # The exercise's own mistakes.
    _wrong("an absolute name to listen to", "absolute-name", ('"reading"', '"/reading"')),
    _wrong("an absolute name to speak on", "absolute-name", ('"status"', '"/status"')),
    _wrong("both absolute", "absolute-name",
           ('"reading"', '"/reading"'), ('"status"', '"/status"')),
    _wrong("limits in the code", "limits-fixed", (_OF_LOW, "20.0"), (_OF_HIGH, "26.0")),
    _wrong("an upper limit in the code", "limits-fixed", (_OF_HIGH, "26.0")),
    _wrong("a lower limit in the code", "limits-fixed", (_OF_LOW, "20.0")),
    _wrong("parameters of other names", "limits-fixed",
           ('"low"', '"minimum"'), ('"high"', '"maximum"')),
    _wrong("a capital letter", "limits-fixed", ('"high"', '"High"')),
    _wrong("a parameter set by hand", "limits-fixed",
           (_LOW, f'{_LOW}\n        self.set_parameters([Parameter("low", value=20.0)])'),
           ("class A", "from rclpy.parameter import Parameter\n\nclass A")),
    _wrong("all nodes share their limits", "limits-fixed", base=SHARED),
    _wrong("a unit in the code", "unit-fixed", ("{self.value_of('unit')}", "C")),
    _wrong("a unit of another name", "unit-fixed", ('"unit"', '"units"'), ("'unit'", "'units'")),
    _wrong("no unit", "wrong-unit", (" {self.value_of('unit')}", "")),
    _wrong("no reading", "wrong-values", (" {msg.data:.1f}", "")),
    _wrong("a whole number", "decimals-lost", ("{msg.data:.1f}", "{int(msg.data)}")),
    _wrong("26.0 is high", "boundary", ("msg.data > ", "msg.data >= ")),
    _wrong("20.0 is low", "boundary", ("msg.data < ", "msg.data <= ")),
    _wrong("rounded before it is compared", "wrong-state",
           ("if msg.data > ", "if round(msg.data, 1) > "),
           ("elif msg.data < ", "elif round(msg.data, 1) < ")),
    _wrong("the wrong way round", "wrong-state", ('word = "High"', 'word = "?"'),
           ('word = "Low"', 'word = "High"'), ('word = "?"', 'word = "Low"')),
    _wrong("limits swapped", "wrong-state",
           (_OF_LOW, "self.value_of('?')"), (_OF_HIGH, 'self.value_of("low")'),
           ("self.value_of('?')", 'self.value_of("high")')),
    _wrong("another default", "other-default", ("20.0", "18.0")),
    _wrong("another default above", "other-default", ("26.0", "28.0")),
    _wrong("other words", "wrong-word", ('"Normal"', '"OK"')),
    _wrong("capital letters", "wrong-word", ("{word}", "{word.upper()}")),
    _wrong("small letters", "wrong-word", ("{word}", "{word.lower()}")),
    _either("the reading first, degrees, capital letters", ("wrong-word", "wrong-form"),
            (_TEXT, "text = f\"{msg.data:.2f} °{self.value_of('unit')} is {word.upper()}\"")),
    _wrong("a colon, and no space before the unit", "wrong-form",
           (_TEXT, "text = f\"{word}: {msg.data:.1f}{self.value_of('unit')}\"")),
    _wrong("no space before the unit", "wrong-form", (".1f} {", ".1f}{")),
    _wrong("the unit before the reading", "wrong-form",
           (_TEXT, "text = f\"{word} {self.value_of('unit')} {msg.data:.1f}\"")),
    _wrong("the unit twice", "wrong-form",
           (_TEXT, _TEXT[:-1] + " {self.value_of('unit')}\"")),
    _wrong("the reading twice", "wrong-form", (":.1f}", ":.1f} {msg.data:.2f}")),
    _wrong("the reading first", "wrong-form",
           (_TEXT, "text = f\"{msg.data:.1f} {self.value_of('unit')} {word}\"")),
    _wrong("no decimal", "decimals-lost", (":.1f", ":.0f")),
    _wrong("only what is not normal", "wrong-rate",
           (_SEND, f'if word != "Normal":\n            {_SEND}')),
    _wrong("only changes", "wrong-rate",
           (_SEND, f'if word != getattr(self, "word", ""):\n            {_SEND}\n'
                   "        self.word = word")),
    _wrong("twice", "wrong-rate", (_SEND, f"{_SEND}\n        {_SEND}")),
    # Parameters.
    _wrong("a whole number as the default", "parameter-type", ("20.0", "20")),
    _wrong("a text as the default", "parameter-type", ("26.0", '"26.0"')),
    _wrong("a parameter that is not declared", "parameter-undeclared", (_HIGH, "pass")),
    _wrong("declared twice", "parameter-twice", (_LOW, f"{_LOW}\n        {_LOW}")),
    _wrong("a parameter compared", "parameter-for-value",
           ("return self.get_parameter(name).value", "return self.get_parameter(name)")),
    # The thirty.
    _wrong("a letter wrong", "topic-misspelled", ('"status"', '"staus"')),
    _wrong("a letter wrong where it listens", "topic-misspelled", ('"reading"', '"readings"')),
    _wrong("another topic to listen to", "wrong-topic", ('"reading"', '"temperature"')),
    _wrong("another topic to speak on", "wrong-topic", ('"status"', '"alarm"')),
    _wrong("names under the node's own", "topic-misspelled", ('"reading"', '"~/reading"')),
    _wrong("it hears another type", "type-mismatch", ("(Float32, ", "(String, ")),
    _wrong("a number for a text", "type-mismatch",
           ("(String, ", "(Float32, "), ("String(data=text)", "msg")),
    _wrong("a text published", "number-published", ("String(data=text)", "text")),
    _wrong("no depth", "depth-missing", ('"status", 10', '"status"')),
    _wrong("the callback called", "callback-called", ("self.hear, 10", "self.hear(), 10")),
    _wrong("nothing that listens", "no-subscription", (_SUBSCRIBE, "pass")),
    _wrong("it logs only", "never-published", (_SEND, "self.get_logger().info(text)")),
    _wrong("a text and a number put together", "text-and-number",
           (_TEXT, 'text = word + " " + msg.data + self.value_of("unit")')),
    # Pairs.
    _either("an absolute name, and limits in the code", ("absolute-name", "limits-fixed"),
            ('"reading"', '"/reading"'), (_OF_LOW, "20.0"), (_OF_HIGH, "26.0")),
    _either("limits and unit in the code", ("limits-fixed", "unit-fixed"),
            (_OF_LOW, "20.0"), (_OF_HIGH, "26.0"), ("{self.value_of('unit')}", "C")),
    _either("at the limit, and a unit in the code", ("boundary", "unit-fixed"),
            ("msg.data > ", "msg.data >= "), ("{self.value_of('unit')}", "C")),
    _either("an absolute output, and no unit", ("absolute-name", "wrong-unit"),
            ('"status"', '"/status"'), (" {self.value_of('unit')}", "")),
)  # fmt: skip
