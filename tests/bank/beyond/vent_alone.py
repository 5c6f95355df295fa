"""13a, the vent alone: answers."""

from bank.answer import edited, either, right, wrong

BASE = """
    LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)

    class VentControl(Node):
        def __init__(self):
            super().__init__("vent_control")
            self.declare_parameter("open_above", 28.0)
            self.declare_parameter("close_below", 26.0)
            self.publisher_ = self.create_publisher(Bool, "vent", LATCHED)
            self.create_subscription(Float32, "temperature", self.temperature_callback, 10)
            self.is_open = False

        def temperature_callback(self, msg):
            above = self.get_parameter("open_above").value
            below = self.get_parameter("close_below").value
            if msg.data > above:
                wanted = True
            elif msg.data < below:
                wanted = False
            else:
                wanted = self.is_open
            if wanted != self.is_open:
                self.is_open = wanted
                self.publisher_.publish(Bool(data=wanted))
"""
_IF = "if wanted != self.is_open:"


def _right(name, *edits):
    return right("13a", name, edited(BASE, *edits))


def _wrong(name, mistake, *edits):
    return wrong("13a", name, mistake, edited(BASE, *edits))


def _either(name, mistakes, *edits):
    return either("13a", name, mistakes, edited(BASE, *edits))


ANSWERS = (
    _right("base"),
    _right("no parameters", ('self.get_parameter("open_above").value', "28.0"),
           ('self.get_parameter("close_below").value', "26.0")),
    _right("volatile", ("LATCHED)", "10)")),
    _right("says at the beginning that it is closed",
           ("self.is_open = False", "self.is_open = False\n"
                                    "        self.publisher_.publish(Bool(data=False))")),
    right("13a", "two ifs, each with its own state", """
        class Window(Node):
            def __init__(self):
                super().__init__("w")
                self.out = self.create_publisher(Bool, "/vent", 1)
                self.create_subscription(Float32, "/temperature", self.on, 1)
                self.now = False

            def on(self, msg):
                if not self.now and msg.data > 28:
                    self.tell(True)
                if self.now and msg.data < 26:
                    self.tell(False)

            def tell(self, opened):
                self.now = opened
                self.out.publish(Bool(data=opened))
    """),
    right("13a", "a closure and a dict", """
        def make():
            node, memory = Node("vent"), {"open": False}
            out = node.create_publisher(Bool, "vent", 10)

            def hear(msg):
                wanted = msg.data > 28 or (memory["open"] and not msg.data < 26)
                if wanted is not memory["open"]:
                    memory["open"] = wanted
                    out.publish(Bool(data=wanted))

            node.create_subscription(Float32, "temperature", hear, 10)
            return node
    """),
    right("13a", "a timer that decides", """
        class Slow(Node):
            def __init__(self):
                super().__init__("slow")
                self.out = self.create_publisher(Bool, "vent", 10)
                self.create_subscription(Float32, "temperature", self.keep, 10)
                self.create_timer(0.5, self.decide)
                self.last, self.open = 20.0, False

            def keep(self, msg):
                self.last = msg.data

            def decide(self):
                limit = 26.0 if self.open else 28.0
                wanted = self.last >= limit if self.open else self.last > limit
                if wanted != self.open:
                    self.out.publish(Bool(data=wanted))
                self.open = wanted
    """),
    _right("a median of three", ("self.is_open = False", "self.is_open, self.three = False, []"),
           ("def temperature_callback(self, msg):",
            "def temperature_callback(self, msg):\n"
            "        self.three = [*self.three, msg.data][-3:]\n"
            "        msg.data = sorted(self.three)[len(self.three) // 2]")),
    # One mistake.
    _wrong("28 opens", "boundary", ("msg.data > above", "msg.data >= above")),
    _wrong("26 closes", "boundary", ("msg.data < below", "msg.data <= below")),
    _wrong("one limit", "no-hysteresis", ("wanted = self.is_open", "wanted = False")),
    _wrong("the other way in between", "no-hysteresis",
           ("wanted = self.is_open", "wanted = not self.is_open")),
    _wrong("opens in between", "no-hysteresis", ("wanted = self.is_open", "wanted = True")),
    _wrong("upside down", "wrong-state", ("Bool(data=wanted)", "Bool(data=not wanted)")),
    _wrong("never closes", "wrong-state", ("wanted = False", "wanted = self.is_open")),
    _wrong("other limits", "wrong-state", ("28.0", "30.0")),
    _wrong("a command for each reading", "status-repeated", (_IF, "if True:")),
    _wrong("the state is not kept", "status-repeated", ("            self.is_open = wanted\n", "")),
    _wrong("a message that is no Bool", "type-mismatch", ("(Bool, ", "(Float32, "),
           ("Bool(data=wanted)", "Float32(data=float(wanted))")),
    _wrong("another topic to say", "topic-misspelled", ('"vent",', '"vents",')),
    _wrong("another topic to hear", "topic-misspelled", ('"temperature"', '"temprature"')),
    _wrong("a bool published", "number-published", ("Bool(data=wanted)", "wanted")),
    _wrong("an int in the field", "not-a-float", ("data=wanted", "data=int(wanted)")),
    _wrong("no publish", "never-published",
           ("self.publisher_.publish(Bool(data=wanted))", "pass")),
    _wrong("a parameter that was not declared", "parameter-undeclared",
           ('        self.declare_parameter("close_below", 26.0)\n', "")),
    # Two.
    _either("28 opens, 26 closes", ("boundary", "wrong-state"),
            ("> above", ">= above"), ("< below", "<= below")),
    _either("one limit, and always said", ("no-hysteresis", "status-repeated"),
            ("wanted = self.is_open", "wanted = False"), (_IF, "if True:")),
    _either("another topic, and no publish", ("never-published", "topic-misspelled"),
            ('"vent",', '"vents",'), ("self.publisher_.publish(Bool(data=wanted))", "pass")),
)  # fmt: skip
