"""Page 13: more answers, written from the page alone."""

from bank.answer import edited, right, wrong
from bank.beyond.greenhouse_right import BASE as GREENHOUSE
from bank.beyond.vent_alone import BASE as VENT

_VENT_HEAD = VENT[: VENT.index("            if msg.data > above")]

#: Which requirements a greenhouse misses, by its name.
MISSES: dict[str, set[str]] = {}


def _vent(name, body, mistake="", *edits):
    lines = "".join(f"        {line}\n" for line in body.splitlines())
    text = edited(_VENT_HEAD, *edits) + lines
    return wrong("13a", name, mistake, text) if mistake else right("13a", name, text)


def _greenhouse(name, edits, mistake="", misses=""):
    MISSES[name] = set(misses.split())
    text = edited(GREENHOUSE, *edits)
    if mistake:
        return wrong("13b", name, mistake, text, "greenhouse")
    return right("13b", name, text, "greenhouse")


_TELL = """
if wanted != self.is_open:
    self.is_open = wanted
    self.publisher_.publish(Bool(data=wanted))"""
_DEFAULT = ("self.is_open = False", "self.is_open = True")

_A_VENT = (
    _vent("open until something else is known", "wanted = self.is_open\n"
          "wanted = msg.data > above or (wanted and msg.data >= below)" + _TELL, "wrong-state",
          _DEFAULT),
    _vent("match", """\
match (msg.data > above, msg.data < below, self.is_open):
    case (True, _, False):
        self.is_open = True
    case (_, True, True):
        self.is_open = False
    case _:
        return
self.publisher_.publish(Bool(data=self.is_open))"""),
    _vent("numpy", "import numpy as np\n"
          "moved = np.where(msg.data > above, True, self.is_open)\n"
          "wanted = bool(np.where(msg.data < below, False, moved))" + _TELL),
    _vent("a dict of zones", "zone = (msg.data > above) - (msg.data < below)\n"
          "wanted = {1: True, -1: False}.get(zone, self.is_open)" + _TELL),
    right("13a", "a dataclass, a property and a parent", """
        from dataclasses import dataclass

        @dataclass
        class Thresholds:
            on: float
            off: float
            state: bool = False

            def fed(self, value):
                before, limit = self.state, self.off if self.state else self.on
                self.state = value >= limit if before else value > limit
                return self.state is not before

        class Actuator(Node):
            topic = ""

            def __init__(self):
                super().__init__(f"{self.topic}_actuator")
                self.commands = self.create_publisher(Bool, self.topic, 5)

            @property
            def command(self):
                return None

            @command.setter
            def command(self, is_on):
                self.commands.publish(Bool(data=is_on))

        class Vent(Actuator):
            topic = "vent"

            def __init__(self):
                super().__init__()
                self.memory = Thresholds(28.0, 26.0)
                self.create_subscription(Float32, "temperature", self.hear, 10)

            def hear(self, msg):
                if self.memory.fed(msg.data):
                    self.command = self.memory.state
    """, "Vent"),
    _vent("whole degrees", "value = int(msg.data)\n"
          "wanted = value > above or (self.is_open and value >= below)" + _TELL, "wrong-state"),
    _vent("rounded", "value = round(msg.data)\n"
          "wanted = value > above or (self.is_open and value >= below)" + _TELL, "wrong-state"),
    _vent("the limits swapped", "above, below = below, above\n"
          "wanted = msg.data > above or (self.is_open and msg.data >= below)" + _TELL,
          "no-hysteresis"),
    _vent("above and below in one condition", "wanted = below < msg.data > above" + _TELL,
          "no-hysteresis"),
    _vent("told at each change of temperature", """\
wanted = msg.data > above or (self.is_open and msg.data >= below)
if msg.data != getattr(self, "last", None):
    self.publisher_.publish(Bool(data=wanted))
self.last, self.is_open = msg.data, wanted""", "status-repeated"),
    _vent("a timer that repeats the state", "self.is_open = "
          "msg.data > above or (self.is_open and msg.data >= below)", "status-repeated",
          ("self.is_open = False",
           "self.is_open = False\n        self.create_timer(1.0, lambda: "
           "self.publisher_.publish(Bool(data=self.is_open)))")),
    _vent("the callback called", "pass", "callback-called",
          ("self.temperature_callback, 10", "self.temperature_callback(), 10")),
)  # fmt: skip

_MEAN = "sum(self.values) / len(self.values)"
_EMPTY = f"{_MEAN}))\n        self.values = []\n"
_CLEARED = "float(np.mean(self.values))))\n        self.values.clear()\n"
_WATCH = GREENHOUSE[GREENHOUSE.index("class Watch") : GREENHOUSE.index("def greenhouse")]
_EGG_TIMERS = '''class Watch(Node):
    """Has a timer for each sensor, which each message winds up again."""

    def __init__(self):
        super().__init__("watch")
        self.alarms = self.create_publisher(String, "alarm", 10)
        self.is_silent, self.timers_ = {}, {}
        for sensor in ("temperature", "humidity"):
            self.is_silent[sensor] = False
            self.timers_[sensor] = self.create_timer(5.0, lambda s=sensor: self.tell(s, True))
            self.create_subscription(Float32, sensor, lambda _, s=sensor: self.hear(s), 10)

    def hear(self, sensor):
        self.timers_[sensor].reset()
        self.tell(sensor, False)

    def tell(self, sensor, is_silent):
        if self.is_silent[sensor] != is_silent:
            self.is_silent[sensor] = is_silent
            word = "silent" if is_silent else "back"
            self.alarms.publish(String(data=f"{sensor.title()} {word}!"))


'''
_A_GREENHOUSE = (
    _greenhouse("egg timers, and other words around", ((_WATCH, _EGG_TIMERS),)),
    _greenhouse("numpy, and a list that is cleared",
                ((_EMPTY, _CLEARED),
                 ("class Guard", "import numpy as np\n\n\nclass Guard"))),
    _greenhouse("limits that are read once, and a pump that is not latched",
                (('msg.data < self.get_parameter("dry_below").value', "msg.data < self.limit"),
                 ('self.declare_parameter("dry_below", 40.0)',
                  'self.limit = self.declare_parameter("dry_below", 40.0).value'),
                 ('(Bool, "pump", LATCHED)', '(Bool, "pump", 10)')), "", "R10"),
    _greenhouse("the rest is counted from the start",
                (("            self.run_time.reset()\n",
                  "            self.run_time.reset()\n            self.rest_time.reset()\n"),
                 ('            self.state = "resting"\n            self.rest_time.reset()\n',
                  '            self.state = "resting"\n')), "rest-too-short", "R2"),
    _greenhouse("the median", ((_MEAN, "sorted(self.values)[len(self.values) // 2]"),),
                "wrong-window", "R6"),
    _greenhouse("divided by ten in any case", ((_MEAN, "sum(self.values) / 10"),),
                "wrong-window", "R6"),
    _greenhouse("the mean since the start",
                ((_EMPTY, _EMPTY.replace("        self.values = []\n", "")),),
                "wrong-window", "R6"),
    _greenhouse("one alarm for both sensors",
                (('f"{topic} silent"', '"a sensor is silent"'),), "wrong-word", "R4"),
    _greenhouse("the vent's commands on another topic",
                (('create_publisher(Bool, "vent", LATCHED)',
                  'create_publisher(Bool, "window", LATCHED)'),), "no-publisher",
                "R1 R3 R5 R7 R8 R9 R10 R11"),
    _greenhouse("the pump hears the vent by another name",
                (('(Bool, "vent", self.hear_vent', '(Bool, "vents", self.hear_vent'),),
                "no-interlock", "R3"),
)  # fmt: skip

ANSWERS = (*_A_VENT, *_A_GREENHOUSE)
RIGHT = tuple(one for one in _A_GREENHOUSE if one.status == "passed")
WRONG = tuple(one for one in _A_GREENHOUSE if one.status == "failed")
