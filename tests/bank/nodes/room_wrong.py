"""03b, a living room: wrong answers."""

from bank.answer import edited, either, wrong
from bank.nodes.room_right import BASE

_SUPER = 'super().__init__("temperature_sensor")'
_MAKE = 'self.publisher_ = self.create_publisher(Float32, "temperature", 10)'
_TIMER = "self.timer = self.create_timer(1.0, self.publish_temperature)"
_STEP = "self.temperature += random.uniform(-0.3, 0.3)"
_CLAMP = "self.temperature = max(18.0, min(28.0, self.temperature))"
_SEND = "self.publisher_.publish(Float32(data=self.temperature))"


def _wrong(name, mistake, *edits):
    return wrong("03b", name, mistake, edited(BASE, *edits))


def _either(name, mistakes, *edits):
    return either("03b", name, mistakes, edited(BASE, *edits))


ANSWERS = (
    # The exercise's own mistakes.
    _wrong("the tutorial's limit", "other-limits", ("18.0", "10.2")),
    _wrong("no upper limit", "no-clamp",
           (_CLAMP, "self.temperature = max(18.0, self.temperature)")),
    _wrong("no lower limit", "no-clamp",
           (_CLAMP, "self.temperature = min(28.0, self.temperature)")),
    _wrong("no clamp", "no-clamp", (f"        {_CLAMP}\n", "")),
    _wrong("the clamp is not assigned", "no-clamp",
           (_CLAMP, "max(18.0, min(28.0, self.temperature))")),
    # Always 18.0, as if every step began at zero; only the other swap gives itself away.
    _either("min and max swapped", ("clamp-swapped", "never-changes"),
           (_CLAMP, "self.temperature = min(18.0, max(28.0, self.temperature))")),
    _wrong("the limits swapped", "clamp-swapped",
           (_CLAMP, "self.temperature = max(28.0, min(18.0, self.temperature))")),
    _wrong("the clamp before the step", "clamped-too-early",
           (f"{_STEP}\n        {_CLAMP}", f"{_CLAMP}\n        {_STEP}")),
    _wrong("published before the clamp", "clamped-too-early",
           (f"{_CLAMP}\n        {_SEND}", f"{_SEND}\n        {_CLAMP}")),
    _wrong("a clamped copy is published", "clamp-not-kept",
           (_CLAMP, "clamped = max(18.0, min(28.0, self.temperature))"),
           ("data=self.temperature", "data=clamped")),
    _wrong("clamped inside the message", "clamp-not-kept",
           (f"        {_CLAMP}\n", ""),
           ("data=self.temperature", "data=max(18.0, min(28.0, self.temperature))")),
    _wrong("an upper limit too low", "other-limits", ("28.0", "26.0")),
    _wrong("a lower limit too high", "other-limits", ("18.0", "20.0")),
    _wrong("an upper limit too high", "other-limits", ("28.0", "30.0")),
    _wrong("an upper limit a little too low", "other-limits", ("28.0", "27.8")),
    _wrong("a lower limit a little too high", "other-limits", ("18.0", "18.25")),
    _wrong("the page's step", "step-too-wide", ("(-0.3, 0.3)", "(-0.5, 0.5)")),
    _wrong("three degrees", "step-too-wide", ("(-0.3, 0.3)", "(-3.0, 3.0)")),
    _wrong("two steps", "step-too-wide", (_STEP, f"{_STEP}\n        {_STEP}")),
    _wrong("a tenth of the step", "step-too-small", ("(-0.3, 0.3)", "(-0.03, 0.03)")),
    _wrong("only up", "one-way", ("(-0.3, 0.3)", "(0.0, 0.3)")),
    _wrong("only down", "one-way", ("(-0.3, 0.3)", "(-0.3, 0.0)")),
    _wrong("a constant step", "one-way", (_STEP, "self.temperature += 0.3")),
    _wrong("no step", "never-changes", (_STEP, "pass")),
    _wrong("a step of nothing", "never-changes", ("random.uniform(-0.3, 0.3)", "0.0")),
    _wrong("the step is not added", "never-changes", (_STEP, "random.uniform(-0.3, 0.3)")),
    _either("the step in place of the value", ("forgets-itself", "never-changes"),
            ("self.temperature += random", "self.temperature = random")),
    _wrong("any number between the limits", "forgets-itself",
           (f"{_STEP}\n        {_CLAMP}", "self.temperature = random.uniform(18.0, 28.0)")),
    _either("always from 22", ("forgets-itself", "other-limits"),
            (_STEP, "self.temperature = 22.0 + random.uniform(-0.3, 0.3)")),
    _wrong("a local variable", "no-value-yet",
            (_STEP, "temperature += random.uniform(-0.3, 0.3)")),
    _either("a variable of the class's", ("forgets-itself", "never-changes", "other-limits"),
            (_STEP, "temperature = self.temperature + random.uniform(-0.3, 0.3)"),
            (_CLAMP, "temperature = max(18.0, min(28.0, temperature))"),
            ("data=self.temperature", "data=temperature")),
    _either("the first step drawn once", ("one-way", "never-changes"),
            ("self.temperature = 22.0",
             "self.temperature = 22.0\n        self.step = random.uniform(-0.3, 0.3)"),
            (_STEP, "self.temperature += self.step")),
    _either("rounded to whole degrees", ("wrong-values", "step-too-wide"),
            ("data=self.temperature", "data=float(round(self.temperature))")),
    _either("in Fahrenheit", ("wrong-unit", "no-clamp", "step-too-wide"),
            ("data=self.temperature", "data=self.temperature * 1.8 + 32")),
    # The thirty.
    _wrong("ints for limits", "not-a-float", ("18.0", "18"), ("28.0", "28")),
    _wrong("a text in the field", "not-a-float",
           ("data=self.temperature", 'data=f"{self.temperature:.2f}"')),
    _wrong("a number published", "number-published",
           ("Float32(data=self.temperature)", "self.temperature")),
    _wrong("the class published", "class-published", ("Float32(data=self.temperature)", "Float32")),
    _wrong("a value without a keyword", "field-without-name", ("data=self", "self")),
    _wrong("another keyword", "wrong-keyword", ("data=", "temperature=")),
    _wrong("another field", "wrong-field",
           (_SEND, "msg = Float32()\n        msg.temperature = self.temperature\n"
                   "        self.publisher_.publish(msg)")),
    _wrong("no depth", "depth-missing", ('"temperature", 10', '"temperature"')),
    _wrong("topic first", "arguments-swapped",
           ('Float32, "temperature"', '"temperature", Float32')),
    _wrong("float for a type", "not-a-message-type", ("Float32, ", "float, ")),
    _wrong("the callback called", "callback-called",
           (f"{_TIMER}\n        self.temperature = 22.0",
            f"self.temperature = 22.0\n        {_TIMER[:-1]}())")),
    _wrong("a callback with msg", "callback-parameters",
           ("temperature(self)", "temperature(self, msg)")),
    _wrong("no super", "super-missing", (f"        {_SUPER}\n", "")),
    _wrong("no name", "node-name-missing", ('"temperature_sensor"', "")),
    _wrong("a dot in the topic", "invalid-name", ('"temperature"', '"room.temperature"')),
    _wrong("a letter is missing", "topic-misspelled", ('"temperature"', '"temprature"')),
    _wrong("another topic", "wrong-topic", ('"temperature"', '"room"')),
    _wrong("Float64", "type-mismatch",
           ("class R", "from std_msgs.msg import Float64\n\nclass R"), ("Float32", "Float64")),
    _wrong("twice a second", "wrong-rate", ("1.0", "0.5")),
    _wrong("every two seconds", "wrong-rate", ("1.0", "2.0")),
    _wrong("no timer", "no-timer", (_TIMER, "pass")),
    _wrong("it does not publish", "never-published", (_SEND, "print(self.temperature)")),
    _wrong("no random", "name-error", ("random.uniform", "uniform")),
    _wrong("no self before the publisher", "name-error", (_SEND, _SEND.removeprefix("self."))),
    _wrong("a loop without end", "callback-blocks",
           (_STEP, "while self.temperature < 30.0:\n            pass")),
    _wrong("it exits", "exits", (_SEND, f"{_SEND}\n        exit()")),
    _wrong("no node", "no-node", ("(Node)", ""), (_SUPER, "pass")),
    _wrong("random, with a letter wrong", "wrong-attribute",
            ("random.uniform", "random.unifrom")),
    _wrong("the number comes too late", "wrong-attribute",
            ("\n        self.temperature = 22.0", "")),
    # Pairs.
    _either("int and step", ("not-a-float", "step-too-wide"),
            ("18.0", "18"), ("28.0", "28"), ("0.3", "0.5")),
    _either("no clamp and too wide a step", ("no-clamp", "step-too-wide"),
            (f"        {_CLAMP}\n", ""), ("0.3", "0.5")),
    _either("before the step, and too wide", ("clamped-too-early", "step-too-wide"),
            (f"{_STEP}\n        {_CLAMP}", f"{_CLAMP}\n        {_STEP}"), ("0.3", "0.5")),
    _either("a number published, no clamp", ("number-published", "no-clamp"),
            ("Float32(data=self.temperature)", "self.temperature"),
            (f"        {_CLAMP}\n", "")),
    _either("rate and limits", ("wrong-rate", "other-limits"), ("1.0", "2.0"), ("28.0", "26.0")),
    _either("copy and limits", ("clamp-not-kept", "other-limits"),
            (_CLAMP, "clamped = max(18.0, min(26.0, self.temperature))"),
            ("data=self.temperature", "data=clamped")),
    # Not random, or never filled in.
    _either("to and fro like a clock", ("one-way", "not-random", "new-to-me"),
            ("self.temperature = 22.0", "self.temperature, self.step = 22.0, 0.3"),
            (_STEP, "if not 18.3 <= self.temperature <= 27.7:\n            "
                    "self.step = -0.3 if self.temperature > 20 else 0.3\n        "
                    "self.temperature += self.step")),
    _either("a sine", ("one-way", "not-random", "new-to-me"),
            ("class R", "import math\n\nclass R"),
            ("self.temperature = 22.0", "self.n = 0"),
            (f"{_STEP}\n        {_CLAMP}",
             "self.n += 1\n        self.temperature = 23.0 + 5.0 * math.sin(0.06 * self.n)")),
    _either("the number is not put into the message", ("wrong-values", "never-changes"),
            (_SEND, "msg = Float32()\n        self.publisher_.publish(msg)")),
    _either("the same seed at each step", ("one-way", "not-random", "step-too-small"),
            (_STEP, f"random.seed(1)\n        {_STEP}")),
)  # fmt: skip
