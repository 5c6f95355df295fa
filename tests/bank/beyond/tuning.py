"""07b, limits to turn: right and wrong answers."""

from bank.answer import edited, either, right, wrong

BASE = """
    class TunableMonitor(Node):
        def __init__(self):
            super().__init__("tunable_monitor")
            self.declare_parameter("low", 20.0)
            self.declare_parameter("high", 26.0)
            self.statuses = self.create_publisher(String, "status", 10)
            self.create_subscription(Float32, "temperature", self.listen, 10)

        def listen(self, msg):
            low = self.get_parameter("low").value
            high = self.get_parameter("high").value
            status = "High" if msg.data > high else "Low" if msg.data < low else "Normal"
            self.statuses.publish(String(data=status))
"""
_SUPER = 'super().__init__("tunable_monitor")'
_LOW, _HIGH = 'self.declare_parameter("low", 20.0)', 'self.declare_parameter("high", 26.0)'
_GET_LOW, _GET_HIGH = 'self.get_parameter("low").value', 'self.get_parameter("high").value'
_READ = f"low = {_GET_LOW}\n        high = {_GET_HIGH}"
_DECIDE = 'status = "High" if msg.data > high else "Low" if msg.data < low else "Normal"'
_SEND = "self.statuses.publish(String(data=status))"
_LISTEN = 'self.create_subscription(Float32, "temperature", self.listen, 10)'
_MAKE = 'self.statuses = self.create_publisher(String, "status", 10)'

SECRETS = ('declare_parameter("low"', 'declare_parameter("high"', 'get_parameter("', ").value")


def _right(name, *edits):
    return right("07b", name, edited(BASE, *edits))


def _wrong(name, mistake, *edits):
    return wrong("07b", name, mistake, edited(BASE, *edits))


def _either(name, mistakes, *edits):
    return either("07b", name, mistakes, edited(BASE, *edits))


RIGHT = (
    _right("as on the page"),
    _right("both declared in one call",
           (f"{_LOW}\n        {_HIGH}",
            'self.declare_parameters("", [("low", 20.0), ("high", 26.0)])')),
    _right("with keywords", (_LOW, 'self.declare_parameter(name="low", value=20.0)')),
    _right("declared last",
           (f"{_LOW}\n        {_HIGH}\n        ", ""),
           (_LISTEN, f"{_LISTEN}\n        {_LOW}\n        {_HIGH}")),
    _right("the parameters kept, and asked",
           (_LOW, f"self.low = {_LOW}"), (_READ, f"low = {_GET_LOW}\n        high = {_GET_HIGH}")),
    _right("values through the message",
           (_GET_LOW, 'self.get_parameter("low").get_parameter_value().double_value')),
    _right("both at once",
           (_READ, 'low, high = (p.value for p in self.get_parameters(["low", "high"]))')),
    _right("get_parameter_or", (_GET_LOW, 'self.get_parameter_or("low", None).value')),
    _right("a descriptor",
           ("class T", "from rcl_interfaces.msg import FloatingPointRange, ParameterDescriptor\n\n"
                       "class T"),
           (_LOW, 'self.declare_parameter("low", 20.0, ParameterDescriptor(\n'
                  '            description="below it is Low",\n'
                  "            floating_point_range=[FloatingPointRange(from_value=-50.0, "
                  "to_value=50.0)]))")),
    _right("dynamic typing",
           ("class T", "from rcl_interfaces.msg import ParameterDescriptor\n\nclass T"),
           (_LOW, 'self.declare_parameter("low", 20.0, ParameterDescriptor(dynamic_typing=True))')),
    _right("it logs, too", (_SEND, f"{_SEND}\n        self.get_logger().info(status)")),
    _right("more parameters", (_LOW, f'{_LOW}\n        self.declare_parameter("unit", "C")')),
    right("07b", "a callback for changes", '''
        from rcl_interfaces.msg import SetParametersResult

        class TunableMonitor(Node):
            def __init__(self):
                super().__init__("monitor")
                self.limits = {}
                for name, value in (("low", 20.0), ("high", 26.0)):
                    self.limits[name] = self.declare_parameter(name, value).value
                self.add_on_set_parameters_callback(self.changed)
                self.out = self.create_publisher(String, "status", 10)
                self.create_subscription(Float32, "temperature", self.check, 10)

            def changed(self, parameters):
                for one in parameters:
                    self.limits[one.name] = one.value
                return SetParametersResult(successful=True)

            def check(self, msg):
                if msg.data > self.limits["high"]:
                    text = "High"
                elif msg.data < self.limits["low"]:
                    text = "Low"
                else:
                    text = "Normal"
                self.out.publish(String(data=text))
    '''),
    right("07b", "properties", '''
        class TunableMonitor(Node):
            def __init__(self):
                super().__init__("monitor")
                self.declare_parameter("low", 20.0)
                self.declare_parameter("high", 26.0)
                self.out = self.create_publisher(String, "status", 10)
                self.create_subscription(Float32, "temperature", self.check, 10)

            @property
            def low(self):
                return self.get_parameter("low").value

            @property
            def high(self):
                return self.get_parameter("high").value

            def check(self, msg):
                words = {(True, False): "High", (False, True): "Low"}
                key = msg.data > self.high, msg.data < self.low
                self.out.publish(String(data=words.get(key, "Normal")))
    '''),
    right("07b", "a timer reads them ten times a second", '''
        class TunableMonitor(Node):
            def __init__(self):
                super().__init__("monitor")
                self.declare_parameter("low", 20.0)
                self.declare_parameter("high", 26.0)
                self.out = self.create_publisher(String, "status", 10)
                self.create_subscription(Float32, "temperature", self.check, 10)
                self.create_timer(0.1, self.read)
                self.read()

            def read(self):
                self.low, self.high = [
                    self.get_parameter(name).value for name in ("low", "high")
                ]

            def check(self, msg):
                status = "Normal"
                if msg.data > self.high:
                    status = "High"
                if msg.data < self.low:
                    status = "Low"
                self.out.publish(String(data=status))
    '''),
    right("07b", "post-set callback and a base class", '''
        class Tuned(Node):
            defaults = {"low": 20.0, "high": 26.0}

            def __init__(self, name):
                super().__init__(name)
                self.values = dict(self.defaults)
                self.add_post_set_parameters_callback(self.keep)
                for key, value in self.defaults.items():
                    self.declare_parameter(key, value)

            def keep(self, parameters):
                self.values.update({one.name: one.value for one in parameters})

        class TunableMonitor(Tuned):
            def __init__(self):
                super().__init__("monitor")
                out = self.create_publisher(String, "status", 10)

                def check(msg):
                    low, high = self.values["low"], self.values["high"]
                    word = "Normal" if low <= msg.data <= high else "Low"
                    out.publish(String(data="High" if msg.data > high else word))

                self.create_subscription(Float32, "temperature", check, 10)
    '''),
)  # fmt: skip

WRONG = (
    _wrong("read once, in the constructor", "parameter-frozen",
           (_HIGH, f"{_HIGH}\n        self.low, self.high = {_GET_LOW}, {_GET_HIGH}"),
           (_READ, "low, high = self.low, self.high")),
    _wrong("low read once", "parameter-frozen",
           (_LOW, f"{_LOW}\n        self.low = {_GET_LOW}"),
           (_READ, f"low = self.low\n        high = {_GET_HIGH}")),
    _wrong("high read once", "parameter-frozen",
           (_HIGH, f"self.high = {_HIGH}.value"), (_GET_HIGH, "self.high")),
    _wrong("the parameter kept as it was", "parameter-frozen",
           (_HIGH, f"self.high = {_HIGH}"), (_GET_HIGH, "self.high.value")),
    _wrong("read at the first reading only", "parameter-frozen",
           (_SUPER, f"{_SUPER}\n        self.limits = None"),
           (_READ, f"if self.limits is None:\n            self.limits = {_GET_LOW}, {_GET_HIGH}\n"
                   "        low, high = self.limits")),
    _wrong("numbers in the code", "parameter-frozen", (_READ, "low, high = 20.0, 26.0")),
    _wrong("read after the decision", "parameter-late",
           (_SUPER, f"{_SUPER}\n        self.low, self.high = 20.0, 26.0"),
           (_READ, "low, high = self.low, self.high"),
           (_SEND, f"{_SEND}\n        self.low, self.high = {_GET_LOW}, {_GET_HIGH}")),
    _wrong("nothing declared", "parameter-undeclared", (_LOW, "pass"), (_HIGH, "pass")),
    _wrong("one not declared", "parameter-undeclared", (_HIGH, "pass")),
    _wrong("another name declared", "parameter-undeclared", ('eter("high", 26', 'eter("hi", 26')),
    _wrong("another name, in both places", "parameter-undeclared", ('"high"', '"upper"')),
    _wrong("a capital", "parameter-undeclared", ('"low"', '"Low"')),
    _wrong("a prefix", "parameter-undeclared", ('"low"', '"limits.low"')),
    _wrong("declared in the callback", "parameter-twice",
           (f"{_LOW}\n        {_HIGH}", "pass"),
           (_READ, f"{_LOW}\n        {_HIGH}\n        {_READ}")),
    _wrong("declared twice", "parameter-twice", (_LOW, f"{_LOW}\n        {_LOW}")),
    _wrong("a whole number", "parameter-type", ("26.0)", "26)")),
    _wrong("whole numbers", "parameter-type", ("26.0)", "26)"), ("20.0)", "20)")),
    _wrong("a text", "parameter-type", ("26.0)", '"26.0")'), (_GET_HIGH, f"float({_GET_HIGH})")),
    _wrong("a type for a value", "parameter-type", ("26.0)", "float)")),
    _wrong("the value forgotten", "parameter-for-value", (_GET_HIGH, 'self.get_parameter("high")')),
    _wrong("the message of the value", "parameter-for-value",
           (_GET_HIGH, 'self.get_parameter("high").get_parameter_value()')),
    _wrong("value called", "not-callable", (_GET_HIGH, f"{_GET_HIGH}()")),
    _wrong("another default for low", "other-default", ("20.0)", "18.0)")),
    _wrong("another default for high", "other-default", ("26.0)", "25.0)")),
    _either("defaults swapped", ("other-default", "parameters-swapped"),
            ("20.0)", "x)"), ("26.0)", "20.0)"), ("x)", "26.0)")),
    _wrong("low for high", "parameters-swapped",
           (_READ, f"high = {_GET_LOW}\n        low = {_GET_HIGH}")),
    _wrong("26.0 is high", "boundary", ("> high", ">= high")),
    _wrong("20.0 is low", "boundary", ("< low", "<= low")),
    _wrong("both limits", "boundary", ("> high", ">= high"), ("< low", "<= low")),
    _wrong("another word", "wrong-word", ('"Normal"', '"Fine"')),
    _wrong("small letters", "wrong-word", ('"High"', '"high"'), ('("high"', '("high"')),
    _wrong("High never", "wrong-state", ("msg.data > high", "False")),
    _wrong("upside down", "wrong-state", ("> high", "< high"), ("< low else", "> low else")),
    _wrong("only changes", "wrong-rate",
           (_SUPER, f"{_SUPER}\n        self.last = None"),
           (_SEND, f"if status != self.last:\n            {_SEND}\n        self.last = status")),
    _wrong("twice", "wrong-rate", (_SEND, f"{_SEND}\n        {_SEND}")),
    _wrong("never published", "never-published", (_SEND, "pass")),
    _wrong("no publisher", "no-publisher", (_MAKE, "pass"), (_SEND, "pass")),
    _wrong("no subscription", "no-subscription", (_LISTEN, "pass")),
    _wrong("a topic misspelled", "topic-misspelled", ('"temperature"', '"temprature"')),
    _wrong("the status misspelled", "topic-misspelled", ('"status"', '"statuses"')),
    _wrong("a number as a status", "type-mismatch",
           ("(String, ", "(Float32, "), (_SEND, "self.statuses.publish(msg)")),
    _wrong("every value refused", "parameter-refused",
           ("class T", "from rcl_interfaces.msg import SetParametersResult\n\nclass T"),
           (_LISTEN, f"{_LISTEN}\n        self.add_on_set_parameters_callback(\n"
                     "            lambda changed: SetParametersResult(successful=False))")),
    _wrong("read-only", "parameter-refused",
           ("class T", "from rcl_interfaces.msg import ParameterDescriptor\n\nclass T"),
           (_LOW, 'self.declare_parameter("low", 20.0, ParameterDescriptor(read_only=True))')),
    _wrong("no self", "name-error", (_GET_LOW, _GET_LOW.removeprefix("self."))),
    _wrong("a method of another name", "wrong-attribute",
           (_GET_LOW, 'self.get_param("low").value')),
    _wrong("no quotes", "name-error", ('eter("low", 20', "eter(low, 20")),
    _wrong("no quotes where it is asked for", "no-value-yet", ('eter("low").', "eter(low).")),
    _wrong("a first value where it is asked for", "wrong-argument",
           ('eter("low").', 'eter("low", 20.0).')),
    _wrong("no first value", "none-used", (_LOW, 'self.declare_parameter("low")')),
    _wrong("the value before the name", "arguments-swapped", ('"low", 20.0', '20.0, "low"')),
    _wrong("no super", "super-missing", (f"        {_SUPER}\n", "")),
    _wrong("the message compared", "message-for-value", ("msg.data > high", "msg > high")),
    _either("frozen, and a limit", ("parameter-frozen", "boundary", "wrong-state"),
            (_HIGH, f"self.high = {_HIGH}.value"), (_GET_HIGH, "self.high"), ("> high", ">= high")),
    _either("another default, and frozen", ("parameter-frozen", "other-default", "wrong-state"),
            (_HIGH, 'self.high = self.declare_parameter("high", 24.0).value'),
            (_GET_HIGH, "self.high")),
    _either("a whole number, and swapped", ("parameter-type", "parameters-swapped"),
            ("26.0)", "26)"), (_READ, f"high = {_GET_LOW}\n        low = {_GET_HIGH}")),
    _either("not declared, and a topic", ("parameter-undeclared", "topic-misspelled"),
            (_LOW, "pass"), ('"temperature"', '"temprature"')),
)  # fmt: skip

_NAMED = edited(
    BASE, ("class TunableMonitor(", "class MonitorNode("), ("(self):", "(self, node_name):"),
    (_SUPER, "super().__init__(node_name)"),
)  # fmt: skip

#: Written from the page alone.
FRESH = (
    right("07b", "a dataclass of limits", """
        from dataclasses import dataclass

        @dataclass
        class Limits:
            low: float
            high: float

            def word(self, value: float) -> str:
                return ("Low", "Normal", "High")[(value >= self.low) + (value > self.high)]

        class TunableMonitor(Node):
            def __init__(self):
                super().__init__("monitor")
                self.declare_parameters(namespace="", parameters=[("low", 20.0), ("high", 26.0)])
                self.out = self.create_publisher(String, "status", 10)
                self.create_subscription(Float32, "temperature", self.on_reading, 10)

            @property
            def limits(self) -> Limits:
                return Limits(*(one.value for one in self.get_parameters(["low", "high"])))

            def on_reading(self, reading: Float32) -> None:
                self.out.publish(String(data=self.limits.word(reading.data)))
    """),
    right("07b", "numpy decides", """
        import numpy as np

        class TunableMonitor(Node):
            def __init__(self):
                super().__init__("monitor")
                for name, first in {"low": 20.0, "high": 26.0}.items():
                    self.declare_parameter(name, first)
                out = self.create_publisher(String, "status", 10)

                def listen(msg):
                    low, high = (self.get_parameter(n).value for n in ("low", "high"))
                    word = np.select([msg.data > high, msg.data < low], ["High", "Low"], "Normal")
                    out.publish(String(data=f"{word}"))

                self.create_subscription(Float32, "temperature", listen, 10)
    """),
    right("07b", "parameter events", """
        from rclpy.parameter import parameter_value_to_python
        from rclpy.parameter_event_handler import ParameterEventHandler

        class TunableMonitor(Node):
            def __init__(self):
                super().__init__("monitor")
                self.limits = {"low": 20.0, "high": 26.0}
                self.events = ParameterEventHandler(self)
                self.handles = []
                for name, value in self.limits.items():
                    self.declare_parameter(name, value)
                    self.handles.append(self.events.add_parameter_callback(
                        name, self.get_fully_qualified_name(), self.changed))
                self.out = self.create_publisher(String, "status", 10)
                self.create_subscription(Float32, "temperature", self.listen, 10)

            def changed(self, parameter):
                self.limits[parameter.name] = parameter_value_to_python(parameter.value)

            def listen(self, msg):
                if msg.data > self.limits["high"]:
                    self.out.publish(String(data="High"))
                    return
                self.out.publish(String(data="Low" if msg.data < self.limits["low"] else "Normal"))
    """),
    right("07b", "a mixin, match and async", """
        class Limited:
            def limit(self, name):
                return self.get_parameter(name).get_parameter_value().double_value

        class TunableMonitor(Limited, Node):
            def __init__(self):
                Node.__init__(self, "monitor")
                self.declare_parameter("low", value=20.0)
                self.declare_parameter("high", value=26.0)
                self._out = self.create_publisher(String, "/status", 1)
                self._sub = self.create_subscription(
                    callback=self._listen, topic="/temperature", msg_type=Float32, qos_profile=5)

            async def _listen(self, msg):
                match msg.data:
                    case value if value > self.limit("high"):
                        word = "High"
                    case value if value < self.limit("low"):
                        word = "Low"
                    case _:
                        word = "Normal"
                self._out.publish(String(data=word))
    """),
    right("07b", "a helper object with the parameters", """
        class Knob:
            def __init__(self, node, name, first):
                self.node, self.name = node, name
                node.declare_parameter(name, first)

            def __float__(self):
                return float(self.node.get_parameter(self.name).value)

        class TunableMonitor(Node):
            def __init__(self):
                super().__init__("monitor")
                self.low, self.high = Knob(self, "low", 20.0), Knob(self, "high", 26.0)
                self.out = self.create_publisher(String, "status", 10)
                self.create_subscription(
                    Float32, "temperature",
                    lambda msg: self.out.publish(String(data=self.word(msg.data))), 10)

            def word(self, value):
                clipped = min(max(value, float(self.low)), float(self.high))
                if clipped == value:
                    return "Normal"
                return "High" if clipped < value else "Low"
    """),
    right("07b", "it publishes the status again once a minute", """
        class TunableMonitor(Node):
            def __init__(self):
                super().__init__("monitor")
                self.declare_parameter("low", 20.0)
                self.declare_parameter("high", 26.0)
                self.out = self.create_publisher(String, "status", 10)
                self.word = "Normal"
                self.create_timer(60.0, self.say)
                self.create_subscription(Float32, "temperature", self.listen, 10)

            def say(self):
                msg = String()
                msg.data = self.word
                self.out.publish(msg)

            def listen(self, msg):
                checks = {"High": msg.data > self.get_parameter("high").value,
                          "Low": msg.data < self.get_parameter("low").value, "Normal": True}
                self.word = next(word for word, is_true in checks.items() if is_true)
                self.say()
    """),
    right("07b", "parameters checked before they are taken", """
        from rcl_interfaces.msg import SetParametersResult

        class TunableMonitor(Node):
            def __init__(self):
                super().__init__("monitor")
                self.add_on_set_parameters_callback(self.validate)
                self.declare_parameter("low", 20.0)
                self.declare_parameter("high", 26.0)
                self.out = self.create_publisher(String, "status", 10)
                self.create_subscription(Float32, "temperature", self.listen, 10)

            def validate(self, parameters):
                bad = [one for one in parameters if one.name in ("low", "high")
                       and not -100.0 < one.value < 100.0]
                return SetParametersResult(successful=not bad, reason="too far" if bad else "")

            def listen(self, msg):
                low, high = map(self.value_of, ("low", "high"))
                status = "Normal" if low <= msg.data <= high else ["Low", "High"][msg.data > high]
                self.out.publish(String(data=status))

            def value_of(self, name):
                return self.get_parameter(name).value
    """),
    _wrong("a callback that gives nothing back", "result-of-another-kind",
           (_LISTEN, f"{_LISTEN}\n        self.add_on_set_parameters_callback(self.changed)"),
           ("    def listen", "    def changed(self, parameters):\n"
                              "        for one in parameters:\n"
                              "            setattr(self, one.name, one.value)\n\n    def listen")),
    _wrong("a callback that gives True back", "result-of-another-kind",
           (_LISTEN, f"{_LISTEN}\n        self.add_on_set_parameters_callback(lambda all: True)")),
    _wrong("a callback that gives back a list of results", "result-of-another-kind",
           ("class T", "from rcl_interfaces.msg import SetParametersResult\n\nclass T"),
           (_LISTEN, f"{_LISTEN}\n        self.add_on_set_parameters_callback(\n"
                     "            lambda all: [SetParametersResult(successful=True)] * len(all))")),
    _wrong("a refusal that speaks of types", "parameter-refused",
           ("class T", "from rcl_interfaces.msg import SetParametersResult\n\nclass T"),
           (_LISTEN, f"{_LISTEN}\n        self.add_on_set_parameters_callback(\n"
                     "            lambda changed: SetParametersResult(\n"
                     "                successful=False, reason='typed too fast'))")),
    _wrong("only lower limits are taken", "parameter-refused",
           ("class T", "from rcl_interfaces.msg import SetParametersResult\n\nclass T"),
           (_LISTEN, f"{_LISTEN}\n        self.add_on_set_parameters_callback(lambda all:\n"
                     "            SetParametersResult(successful=all[0].name == 'low'))")),
    _wrong("asked for every five seconds", "parameter-late",
           (_LISTEN, f"{_LISTEN}\n        self.create_timer(5.0, self.read)\n        self.read()"),
           (_READ, "low, high = self.low, self.high"),
           ("    def listen", f"    def read(self):\n        self.low = {_GET_LOW}\n"
                              f"        self.high = {_GET_HIGH}\n\n    def listen")),
    _wrong("a parameter callback that is called", "callback-called",
           (_LISTEN,
            f"{_LISTEN}\n        self.add_on_set_parameters_callback(self.changed())"),
           ("    def listen",
            "    def changed(self, parameters):\n        pass\n\n    def listen")),
    wrong("07b", "a class that ends in Node and wants a name", "constructor-parameters", _NAMED),
    wrong("07b", "an heir of it that gives no name", "node-name-missing", _NAMED + """
class TunableMonitor(MonitorNode):
    def __init__(self):
        super().__init__()
"""),
    right("07b", "an heir of it that gives a name", _NAMED + """
class TunableMonitor(MonitorNode):
    def __init__(self):
        super().__init__("monitor")
"""),
    _wrong("numbers of another type on its ear", "type-mismatch",
           ("(Float32, ", "(Float64, "),
           ("class T", "from std_msgs.msg import Float64\n\nclass T")),
    _wrong("whole limits", "decimals-lost",
           (_GET_LOW, f"int({_GET_LOW})"), (_GET_HIGH, f"int({_GET_HIGH})")),
    _wrong("a rounded upper limit", "decimals-lost", (_GET_HIGH, f"round({_GET_HIGH})")),
    _wrong("whole readings", "decimals-lost",
           (_DECIDE, f"value = int(msg.data)\n        {_DECIDE.replace('msg.data', 'value')}")),
    _wrong("silent while all is normal", "wrong-rate",
           (_SEND, f'if status != "Normal":\n            {_SEND}')),
    _wrong("the status before last", "wrong-state",
           (_SUPER, f'{_SUPER}\n        self.last = "Normal"'),
           (_SEND, "self.statuses.publish(String(data=self.last))\n        self.last = status")),
    _wrong("two ifs and one else", "wrong-state",
           (_DECIDE, 'status = "High" if msg.data > high else "Normal"\n'
                     '        status = "Low" if msg.data < low else "Normal"')),
    _wrong("normal comes first", "wrong-state",
           (_DECIDE, 'status = "Normal" if msg.data <= high else "High"\n'
                     '        status = "Low" if status not in ("Normal", "High") else status')),
    _wrong("between the limits, without them", "boundary",
           (_DECIDE, 'status = "Normal" if low < msg.data < high else "Low"\n'
                     '        status = "High" if msg.data >= high else status')),
    _wrong("both defaults are others", "other-default", ("20.0)", "18.0)"), ("26.0)", "28.0)")),
    _wrong("a timer speaks", "wrong-rate",
           (_LISTEN, f'{_LISTEN}\n        self.status = "Normal"\n'
                     "        self.create_timer(0.5, self.tell)"),
           (_SEND, "self.status = status\n\n    def tell(self):\n"
                   "        self.statuses.publish(String(data=self.status))")),
    _wrong("each change forgets the other one", "wrong-state",
           ("class T", "from rcl_interfaces.msg import SetParametersResult\n\nclass T"),
           (_LISTEN, f"{_LISTEN}\n        self.changed([])\n"
                     "        self.add_on_set_parameters_callback(self.changed)"),
           (_READ, 'low, high = self.limits["low"], self.limits["high"]'),
           ("    def listen", '    def changed(self, all):\n        self.limits = {"low": 20.0, '
                              '"high": 26.0} | {one.name: one.value for one in all}\n'
                              "        return SetParametersResult(successful=True)\n\n"
                              "    def listen")),
    _wrong("the upper limit for both", "wrong-state", (_GET_LOW, _GET_HIGH)),
    _wrong("Low unless High", "wrong-state",
           (_DECIDE, 'status = "High" if msg.data > high else "Low"')),
    _wrong("the words of page 04", "wrong-word",
           (_DECIDE, _DECIDE.replace("High", "Warm").replace("Low", "Frost"))),
    _wrong("a blank in a word", "wrong-word", (_DECIDE, _DECIDE.replace('"High"', '"Too high"'))),
)  # fmt: skip

ANSWERS = (*RIGHT, *WRONG, *FRESH)
