"""03c, a greenhouse: wrong answers."""

from bank.answer import edited, either, wrong
from bank.nodes.greenhouse_right import BASE

_SUPER = 'super().__init__("greenhouse_sensor")'
_MAKE = 'self.publisher_ = self.create_publisher(Float32, "greenhouse/temperature", 10)'
_TIMER = "self.timer = self.create_timer(0.25, self.publish_temperature)"
_STEP = "self.temperature += random.uniform(-0.5, 0.5)"
_CLAMP = "self.temperature = max(10.2, min(28.0, self.temperature))"
_CONVERT = "fahrenheit = self.temperature * 9 / 5 + 32"
_SEND = "self.publisher_.publish(Float32(data=fahrenheit))"


def _wrong(name, mistake, *edits):
    return wrong("03c", name, mistake, edited(BASE, *edits))


def _either(name, mistakes, *edits):
    return either("03c", name, mistakes, edited(BASE, *edits))


ANSWERS = (
    # The exercise's own mistakes.
    _wrong("still in Celsius", "wrong-unit", (_CONVERT, "fahrenheit = self.temperature")),
    _wrong("the formula upside down", "wrong-unit", ("* 9 / 5", "* 5 / 9")),
    _wrong("the other direction", "wrong-unit",
           ("self.temperature * 9 / 5 + 32", "(self.temperature - 32) * 5 / 9")),
    _wrong("brackets in the formula", "wrong-unit",
           ("self.temperature * 9 / 5 + 32", "(self.temperature + 32) * 9 / 5")),
    _wrong("no 32", "wrong-unit", (" + 32", "")),
    _wrong("minus 32", "wrong-unit", ("+ 32", "- 32")),
    _wrong("Kelvin", "wrong-unit", ("* 9 / 5 + 32", "+ 273.15")),
    _wrong("a whole division", "wrong-unit", ("* 9 / 5", "* (9 // 5)")),
    _wrong("times two plus thirty", "wrong-unit", ("* 9 / 5 + 32", "* 2 + 30")),
    _wrong("the converted number is kept", "converted-back",
           (_CONVERT, "self.temperature = self.temperature * 9 / 5 + 32"),
           ("data=fahrenheit", "data=self.temperature")),
    _wrong("converted before the clamp, and kept", "converted-back",
           (f"{_CLAMP}\n        {_CONVERT}\n        {_SEND}",
            f"{_CLAMP}\n        {_SEND.replace('fahrenheit', 'self.convert()')}\n\n"
            "    def convert(self):\n"
            "        self.temperature = self.temperature * 9 / 5 + 32\n"
            "        return self.temperature")),
    _either("Celsius limits on Fahrenheit", ("wrong-unit", "converted-back", "clamp-swapped",
                                             "other-limits"),
            (f"{_CLAMP}\n        {_CONVERT}",
             f"{_CONVERT}\n        fahrenheit = max(10.2, min(28.0, fahrenheit))")),
    _either("a step of half a degree Fahrenheit", ("step-too-small",),
            ("self.temperature = 22.0", "self.temperature = 71.6"),
            ("max(10.2, min(28.0, ", "max(50.36, min(82.4, "), (" * 9 / 5 + 32", "")),
    _either("it starts at 22 Fahrenheit", ("wrong-unit", "no-clamp", "wrong-start", "other-limits"),
            ("(-0.5, 0.5)", "(-0.9, 0.9)"), ("max(10.2, min(28.0, ", "max(10.2, min(82.4, "),
            (" * 9 / 5 + 32", "")),
    # The limits give away that the formula is right.
    _either("it starts elsewhere", ("wrong-values", "wrong-start"), ("= 22.0", "= 15.0")),
    _either("it starts nearly there", ("wrong-values", "wrong-start"), ("= 22.0", "= 23.0")),
    _wrong("an upper limit far too low", "other-limits", ("min(28.0", "min(14.0")),
    _wrong("a step that is wide upwards", "step-too-wide", ("(-0.5, 0.5)", "(-0.5, 1.5)")),
    _either("min for max", ("no-clamp", "clamp-swapped"), ("max(10.2", "min(10.2")),
    _either("whole degrees", ("step-too-wide", "wrong-values", "step-too-small", "no-clamp"),
            ("data=fahrenheit", "data=float(round(fahrenheit))")),
    _wrong("once a second", "wrong-rate", ("0.25", "1.0")),
    _wrong("every four seconds", "wrong-rate", ("0.25", "4.0")),
    _wrong("nearly four a second", "wrong-rate", ("0.25", "0.3")),
    _wrong("milliseconds", "wrong-rate", ("0.25", "250")),
    _wrong("four messages a second, all at once", "wrong-rate",
           ("0.25", "1.0"), (_SEND, f"for _ in range(4):\n            {_SEND}")),
    _wrong("four walkers", "wrong-rate",
           (_TIMER, "self.timers_ = [self.create_timer(1.0, self.publish_temperature)"
                    " for _ in range(4)]")),
    _wrong("no clamp", "no-clamp", (f"        {_CLAMP}\n", "")),
    _wrong("no upper limit", "no-clamp", ("min(28.0, self.temperature)", "self.temperature")),
    _wrong("a lower limit too low", "other-limits", ("10.2", "0.2")),
    _wrong("the living room's limit", "other-limits", ("10.2", "18.0")),
    _either("min and max swapped", ("clamp-swapped", "never-changes"),
            ("max(10.2, min(28.0,", "min(10.2, max(28.0,")),
    _wrong("the limits swapped", "clamp-swapped",
           ("max(10.2, min(28.0,", "max(28.0, min(10.2,")),
    _wrong("the clamp before the step", "clamped-too-early",
           (f"{_STEP}\n        {_CLAMP}", f"{_CLAMP}\n        {_STEP}")),
    _wrong("the clamped copy", "clamp-not-kept",
           (_CLAMP, "clamped = max(10.2, min(28.0, self.temperature))"),
           ("fahrenheit = self.temperature *", "fahrenheit = clamped *")),
    _wrong("a wide step", "step-too-wide", ("(-0.5, 0.5)", "(-1.0, 1.0)")),
    _wrong("a small step", "step-too-small", ("(-0.5, 0.5)", "(-0.1, 0.1)")),
    _wrong("only up", "one-way", ("(-0.5, 0.5)", "(0, 0.5)")),
    _wrong("no step", "never-changes", (_STEP, "pass")),
    _wrong("no memory", "forgets-itself",
           (_STEP, "self.temperature = random.uniform(10.2, 28.0)")),
    # The thirty.
    _wrong("a text in the field", "not-a-float", ("data=fahrenheit", 'data=f"{fahrenheit:.1f}"')),
    _wrong("a whole number in the field", "not-a-float",
           ("data=fahrenheit", "data=round(fahrenheit)")),
    _wrong("a number published", "number-published", ("Float32(data=fahrenheit)", "fahrenheit")),
    _wrong("the class published", "class-published", ("Float32(data=fahrenheit)", "Float32")),
    _wrong("another keyword", "wrong-keyword", ("data=", "fahrenheit=")),
    _wrong("another field", "wrong-field",
           (_SEND, "msg = Float32()\n        msg.fahrenheit = fahrenheit\n"
                   "        self.publisher_.publish(msg)")),
    _wrong("no depth", "depth-missing", ('temperature", 10', 'temperature"')),
    _wrong("a timer without a callback", "callback-missing",
           ("0.25, self.publish_temperature", "0.25")),
    _wrong("topic first", "arguments-swapped",
           ('Float32, "greenhouse/temperature"', '"greenhouse/temperature", Float32')),
    _wrong("float for a type", "not-a-message-type", ("Float32, ", "float, ")),
    _wrong("the callback called", "callback-called",
           (_TIMER, ""), ("= 22.0", f"= 22.0\n        {_TIMER.replace('ature)', 'ature())')}")),
    _wrong("a callback without self", "callback-parameters",
           ("publish_temperature(self)", "publish_temperature()")),
    _wrong("no super", "super-missing", (f"        {_SUPER}\n", "")),
    _wrong("no name", "node-name-missing", ('"greenhouse_sensor"', "")),
    _wrong("a slash in the node's name", "invalid-name",
           ("greenhouse_sensor", "greenhouse/sensor")),
    _wrong("a space in the topic", "invalid-name", ('"greenhouse/', '"green house/')),
    _wrong("two slashes", "invalid-name", ("greenhouse/temp", "greenhouse//temp")),
    _wrong("a letter is missing", "topic-misspelled", ("greenhouse/temp", "grenhouse/temp")),
    _wrong("an underscore for the slash", "topic-misspelled",
           ("greenhouse/temp", "greenhouse_temp")),
    _wrong("without the greenhouse", "topic-misspelled", ("greenhouse/temp", "temp")),
    _wrong("the namespace twice", "topic-misspelled",
           ('"greenhouse_sensor"', '"sensor", namespace="greenhouse"')),
    _wrong("another topic", "wrong-topic", ('"greenhouse/temperature"', '"humidity"')),
    _wrong("Float64", "type-mismatch",
           ("class G", "from std_msgs.msg import Float64\n\nclass G"), ("Float32", "Float64")),
    _wrong("no timer", "no-timer", (_TIMER, "pass")),
    _wrong("it does not publish", "never-published", (_SEND, "pass")),
    _wrong("no publisher", "no-publisher", (_MAKE, "pass"), (_SEND, "pass")),
    _wrong("a name that is not there", "name-error",
           ("data=fahrenheit", "data=farenheit")),
    _wrong("no brackets at self", "name-error",
           (_CONVERT, "fahrenheit = temperature * 9 / 5 + 32")),
    _wrong("a loop instead of a timer", "constructor-blocks",
           (_TIMER, "self.temperature = 22.0\n        import time\n        while True:\n"
                    "            self.publish_temperature()\n            time.sleep(0.25)")),
    _wrong("it exits", "exits", (_SEND, f"{_SEND}\n        raise SystemExit")),
    _wrong("no node", "no-node", ("(Node)", ""), (_SUPER, "pass")),
    # Pairs.
    _either("unit and rate", ("wrong-unit", "wrong-rate"),
            (_CONVERT, "fahrenheit = self.temperature"), ("0.25", "1.0")),
    _either("topic and unit", ("topic-misspelled", "wrong-unit"),
            ("greenhouse/temp", "temp"), (_CONVERT, "fahrenheit = self.temperature")),
    _either("kept, and no clamp", ("converted-back", "no-clamp", "wrong-values", "step-too-wide"),
            (f"        {_CLAMP}\n", ""), ("fahrenheit = ", "self.temperature = fahrenheit = ")),
    _either("limits and step", ("other-limits", "step-too-small"),
            ("10.2", "18.0"), ("(-0.5, 0.5)", "(-0.3, 0.3)")),
    _either("topic first, and float", ("arguments-swapped", "not-a-message-type"),
            ('Float32, "greenhouse/temperature"', '"greenhouse/temperature", float')),
    _either("a whole number, too slowly", ("not-a-float", "wrong-rate"),
            ("data=fahrenheit", "data=int(fahrenheit)"), ("0.25", "0.5")),
)  # fmt: skip
