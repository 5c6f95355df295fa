"""13b, a greenhouse: wrong answers, and which requirements each of them misses."""

from bank.answer import edited, either, wrong
from bank.beyond.greenhouse_right import BASE, FOUR

_LIST = "[Guard, (VentControl, start), (PumpControl, start), (Reporter, start), Watch]"
_BELIEVE = "if low <= msg.data <= high:"
_MEAN = "sum(self.values) / len(self.values)"
_CHANGE = "if wanted != self.is_open:"
_HEAR_VENT = 'self.create_subscription(Bool, "vent", self.hear_vent, LATCHED)'
_RETURN = f"return {_LIST}"

#: Which requirements an answer misses, by its name.
MISSES: dict[str, set[str]] = {}


def _wrong(name, mistake, misses, *edits):
    MISSES[name] = set(misses.split())
    return wrong("13b", name, mistake, edited(BASE, *edits), "greenhouse")


def _either(name, mistakes, misses, *edits):
    MISSES[name] = set(misses.split())
    return either("13b", name, mistakes, edited(BASE, *edits), "greenhouse")


_OFFICE = """
    def __init__(self):
        super().__init__("watch")
        self.means = self.create_publisher(Float32, "report", 10)
        self.create_subscription(Float32, "checked/temperature", self.collect, 10)
        self.create_timer(10.0, self.report)
        self.values = []
"""


def _shared(name):
    MISSES[name] = {"R8", "R10", "R11"}
    text = edited(
        FOUR,
        ("class Vent(Node):", 'AIRING = {"now": False}\n\nclass Vent(Node):'),
        ("            self.open = wanted", '            self.open = AIRING["now"] = wanted'),
        ('        self.create_subscription(Bool, "vent", self.hear_vent, 10)\n', ""),
        ("        passed =", '        self.airing = AIRING["now"]\n        passed ='),
    )
    return wrong("13b", name, "shared-variable", text, "greenhouse")


ANSWERS = (
    # R1
    _wrong("exactly 28 opens", "boundary", "R1", ("msg.data > above", "msg.data >= above")),
    _wrong("exactly 26 closes", "boundary", "R1", ("msg.data < below", "msg.data <= below")),
    _wrong("no hysteresis", "no-hysteresis", "R1 R11",
           ("wanted = self.is_open\n", "wanted = False\n")),
    _wrong("other limits", "wrong-state", "R1", ("open_above\", 28.0", "open_above\", 29.0")),
    # R2
    _wrong("runs for 8 s", "wrong-duration", "R2", ("create_timer(5.0", "create_timer(8.0")),
    _wrong("runs until its timer happens to tick", "wrong-duration", "R2 R11",
           ("            self.run_time.reset()\n", ""), ("create_timer(5.0", "create_timer(9.0")),
    _wrong("rests for 10 s", "rest-too-short", "R2", ("create_timer(20.0", "create_timer(10.0")),
    _wrong("does not rest", "rest-too-short", "R2",
           ('self.state = "resting"', 'self.state = "ready"')),
    _wrong("rests for ever", "never-switched-on", "R2 R3",
           ('            self.state = "ready"', "            pass")),
    _wrong("exactly 40 is dry", "boundary", "R2", ("msg.data < self", "msg.data <= self")),
    _wrong("never dry", "never-published", "R2 R3 R5 R7 R10 R11",
           ("is_dry and not", "is_dry and False and not")),
    # R3
    _wrong("no look at the vent", "no-interlock", "R3", (" and not self.vent_is_open", "")),
    _wrong("a look at the vent only at the start", "no-interlock", "R3",
           ("        if msg.data:\n            self.stop()\n", "")),
    _wrong("no word from the vent", "no-interlock", "R3", (f"        {_HEAR_VENT}\n", "")),
    _wrong("the pump sleeps while it runs", "no-interlock", "R3",
           ("            self.run_time.reset()\n            self.pump.publish(Bool(data=True))",
            "            self.pump.publish(Bool(data=True))\n            import time\n"
            "            time.sleep(5)\n            self.stop()")),
    # R4
    _wrong("an alarm at each look", "alert-too-many", "R4",
           ("                self.silent.add(topic)\n", "")),
    _wrong("an alarm after 3 s", "alarm-too-early", "R4", ("5e9", "3.5e9")),
    _wrong("an alarm after 9 s", "alert-missing", "R4", ("5e9", "9e9")),
    _wrong("never back", "alert-missing", "R4",
           ('                self.alarms.publish(String(data=f"{topic} back"))\n', "")),
    _wrong("back at each message", "alert-too-many", "R4",
           ("            if topic in self.silent:\n                self.silent.remove(topic)\n"
            "                self.alarms",
            "            if True:\n                self.silent.discard(topic)\n"
            "                self.alarms")),
    _wrong("another word", "wrong-word", "R4", ('{topic} silent"', '{topic} is lost"')),
    _wrong("one sensor only", "alert-missing", "R4",
           ('("humidity", "temperature"):\n            self.last',
            '("temperature",):\n            self.last')),
    _wrong("only the other sensor's messages find a silence", "alert-missing", "R4",
           ("        self.create_timer(0.5, self.look)\n", ""),
           ("        def hear(msg):\n", "        def hear(msg):\n            self.look()\n")),
    # R5
    _wrong("everything can be", "nonsense-believed", "R5", (_BELIEVE, "if True:")),
    _wrong("only NaN cannot be", "nonsense-believed", "R5", (_BELIEVE, "if msg.data == msg.data:")),
    _wrong("any number can be", "nonsense-believed", "R5",
           (_BELIEVE, "if abs(msg.data) < float('inf'):")),
    _wrong("brought into range", "nonsense-believed", "R5",
           (_BELIEVE, "if msg.data == msg.data:\n"
                      "                msg.data = max(low, min(high, msg.data))")),
    _wrong("only temperatures are looked at", "nonsense-believed", "R5",
           (_BELIEVE, 'if topic == "humidity" or low <= msg.data <= high:')),
    _wrong("the report is not guarded", "nonsense-believed", "R5",
           ("(Reporter, start)", "Reporter")),
    # R6
    _wrong("a report every 5 s", "wrong-rate", "R6", ("create_timer(10.0", "create_timer(5.0")),
    _wrong("the mean of all", "wrong-window", "R6",
           ("        self.values = []\n\n\nclass Pump", "\n\nclass Pump")),
    _wrong("the last one", "wrong-window", "R6", (_MEAN, "self.values[-1]")),
    _wrong("the sum", "wrong-window", "R6", (_MEAN, "sum(self.values)")),
    _wrong("a mean of humidities", "wrong-window", "R6",
           ('self.create_subscription(Float32, "temperature", self.collect, 10)',
            'self.create_subscription(Float32, "humidity", self.collect, 10)')),
    _wrong("no readings, no mean", "division-by-zero", "",
           ("        if self.values:\n            self.means", "        self.means")),
    # R7
    _wrong("a command for each temperature", "status-repeated", "R7", (_CHANGE, "if True:")),
    _wrong("the pump is told twice", "status-repeated", "R7",
           ("self.pump.publish(Bool(data=True))",
            "self.pump.publish(Bool(data=True))\n            self.pump.publish(Bool(data=True))")),
    # R8
    _wrong("one node reports and alarms", "two-tasks", "R8",
           ("class Watch(Node):", "class Watch(Reporter):"),
           ('    def __init__(self):\n        super().__init__("watch")\n',
            _OFFICE.replace("super().__init__", "Node.__init__").replace(
                '__init__("watch")', '__init__(self, "watch")').lstrip("\n")),
           (" (Reporter, start),", "")),
    _wrong("a second node that might close the vent", "two-controllers", "R8",
           (_RETURN, _RETURN.replace("Watch]", "Watch, Rain]")),
           ("def greenhouse", 'class Rain(Node):\n    def __init__(self):\n'
            '        super().__init__("rain")\n'
            '        self.out = self.create_publisher(Bool, "vent", LATCHED)\n\n\ndef greenhouse')),
    _shared("a shared variable"),
    _wrong("two guards of one name", "run-twice", "R8", ("[Guard,", "[Guard, Guard,")),
    # R9
    _wrong("the vent lives on what the reporter passes on", "falls-together", "R9",
           ("        self.values.append(msg.data)",
            "        self.values.append(msg.data)\n        self.relay.publish(msg)"),
           ('        super().__init__("reporter")\n',
            '        super().__init__("reporter")\n'
            '        self.relay = self.create_publisher(Float32, "relay", 10)\n'),
           ("(VentControl, start)", '(VentControl, {"remappings": {"temperature": "relay"}})')),
    # What nodes are, and what a list is.
    _wrong("no reporter", "no-publisher", "R5 R6 R8 R9", (" (Reporter, start),", "")),
    _wrong("another topic for alarms", "topic-misspelled", "R4 R8 R9", ('"alarm"', '"alarms"')),
    _wrong("another type for reports", "type-mismatch", "R5 R6",
           ('(Float32, "report", 10)', '(String, "report", 10)'),
           (f"Float32(data={_MEAN})", f"String(data=str({_MEAN}))")),
    _wrong("no depth", "depth-missing", "R4 R8 R9", ('String, "alarm", 10', 'String, "alarm"')),
    _wrong("a number published", "number-published", "R5 R6",
           (f"Float32(data={_MEAN})", _MEAN)),
    _wrong("a text published, from a lambda", "number-published", "R4",
           ("create_timer(0.5, self.look)", "create_timer(0.5, lambda: self.look())"),
           ('String(data=f"{topic} silent")', 'f"{topic} silent"')),
    _wrong("remappings misspelt", "no-system", "",
           ('{"remappings": checked}', '{"remapping": checked}')),
    _wrong("renamed where nobody speaks", "never-published", "R1 R3 R5 R6 R7 R9 R10 R11",
           ('{"remappings": checked}', '{"remappings": {"temperature": "check/temperature", '
                                       '"humidity": "checked/humidity"}}')),
    _wrong("one class", "no-system", "", (_RETURN, "return VentControl")),
    _wrong("no return", "no-system", "", (_RETURN, _LIST)),
    _wrong("names in quotes", "no-node", "R4 R8 R9", (", Watch]", ', "Watch"]')),
    _wrong("an empty list", "no-system", "", (_RETURN, "return []")),
    _wrong("a pair with a text", "no-system", "", ("(Reporter, start)", '(Reporter, "checked")')),
    _wrong("a class that is not there", "name-error", "", (", Watch]", ", Watcher]")),
    _wrong("a callback that does not return", "callback-blocks", "",
           ("        self.values.append(msg.data)", "        while True:\n            pass")),
    # Two.
    _either("one node does it all", ("two-tasks", "two-controllers", "no-publisher"),
            "R2 R3 R4 R5 R6 R7 R8 R9 R10 R11", (_RETURN, "return [VentControl]")),
    _either("28 opens, and no word from the vent", ("boundary", "no-interlock"), "R1 R3",
            ("msg.data > above", "msg.data >= above"), (f"        {_HEAR_VENT}\n", "")),
    _either("runs for 8 s and reports sums", ("wrong-duration", "wrong-window"), "R2 R6",
            ("create_timer(5.0", "create_timer(8.0"), (_MEAN, "sum(self.values)")),
    _either("believes all and repeats itself", ("nonsense-believed", "status-repeated"), "R5 R7",
            (_BELIEVE, "if True:"), (_CHANGE, "if True:")),
)  # fmt: skip
