"""12b, parameters that are checked: right answers, in many styles."""

from bank.answer import edited, right

BASE = """
    class CarefulMonitor(Node):
        def __init__(self):
            super().__init__("temperature_monitor")
            self.declare_parameter("low", 20.0)
            self.declare_parameter("high", 26.0)
            self.add_on_set_parameters_callback(self.look)
            self.create_subscription(Float32, "temperature", self.listen, 10)
            self.statuses = self.create_publisher(String, "status", 10)

        def limits(self):
            return {name: self.get_parameter(name).value for name in ("low", "high")}

        def listen(self, msg):
            now = self.limits()
            high, low = now["high"], now["low"]
            status = "High" if msg.data > high else "Low" if msg.data < low else "Normal"
            self.statuses.publish(String(data=status))

        def look(self, parameters):
            new = self.limits()
            new.update({parameter.name: parameter.value for parameter in parameters})
            good = new["high"] > new["low"]
            return SetParametersResult(successful=good, reason="" if good else "not above low")
"""
_HEAD = BASE[: BASE.index("            new = self.limits()\n")]


def _right(name, *edits):
    return right("12b", name, edited(BASE, *edits))


def _body(name, body):
    return right("12b", name, _HEAD + "".join(f"            {one}\n" for one in body.splitlines()))


ANSWERS = (
    _right("as on the page"),
    _body(
        "a loop",
        """new = self.limits()
for parameter in parameters:
    new[parameter.name] = parameter.value
if not new["low"] < new["high"]:
    return SetParametersResult(successful=False, reason="high must be above low")
return SetParametersResult(successful=True)""",
    ),
    _body(
        "a result that is filled",
        """result = SetParametersResult()
new = {**self.limits(), **{one.name: one.value for one in parameters}}
result.successful = new["low"] < new["high"]
if not result.successful:
    result.reason = f"{new['high']} is not above {new['low']}"
return result""",
    ),
    _body(
        "two variables",
        """low = self.get_parameter("low").value
high = self.get_parameter("high").value
for parameter in parameters:
    if parameter.name == "low":
        low = parameter.value
    elif parameter.name == "high":
        high = parameter.value
if high > low:
    return SetParametersResult(successful=True)
return SetParametersResult(successful=False, reason="high must be above low")""",
    ),
    _body(
        "next",
        """new = self.limits()
low = next((p.value for p in parameters if p.name == "low"), new["low"])
high = next((p.value for p in parameters if p.name == "high"), new["high"])
if not low < high:
    return SetParametersResult(successful=False, reason="swapped")
return SetParametersResult(successful=True)""",
    ),
    _body(
        "the difference",
        """new = dict(self.limits())
for one in parameters:
    new[one.name] = one.get_parameter_value().double_value
return SetParametersResult(
    successful=new["high"] - new["low"] > 0, reason="" if new["high"] > new["low"] else "no room"
)""",
    ),
    _body(
        "try and raise",
        """try:
    new = self.limits()
    new |= {p.name: p.value for p in parameters}
    if not new["high"] > new["low"]:
        raise ValueError("high must be above low")
except ValueError as error:
    return SetParametersResult(successful=False, reason=str(error))
return SetParametersResult(successful=True)""",
    ),
    right(
        "12b",
        "kept in attributes",
        """
        class CarefulMonitor(Node):
            def __init__(self):
                super().__init__("careful")
                self.low = self.declare_parameter("low", 20.0).value
                self.high = self.declare_parameter("high", 26.0).value
                self.add_on_set_parameters_callback(self.look)
                self.create_subscription(Float32, "temperature", self.listen, 10)
                self.statuses = self.create_publisher(String, "status", 10)

            def listen(self, msg):
                status = "Normal"
                if msg.data > self.high:
                    status = "High"
                if msg.data < self.low:
                    status = "Low"
                self.statuses.publish(String(data=status))

            def look(self, parameters):
                low, high = self.low, self.high
                for parameter in parameters:
                    if parameter.name == "low":
                        low = parameter.value
                    if parameter.name == "high":
                        high = parameter.value
                if not low < high:
                    return SetParametersResult(successful=False, reason="low >= high")
                self.low, self.high = low, high
                return SetParametersResult(successful=True)
    """,
    ),
    right(
        "12b",
        "kept after the set",
        """
        class CarefulMonitor(Node):
            def __init__(self):
                super().__init__("careful")
                self.now = {}
                for name, value in (("low", 20.0), ("high", 26.0)):
                    self.now[name] = self.declare_parameter(name, value).value
                self.add_on_set_parameters_callback(self.look)
                self.add_post_set_parameters_callback(self.keep)
                self.create_subscription(Float32, "temperature", self.listen, 10)
                self.statuses = self.create_publisher(String, "status", 10)

            def listen(self, msg):
                words = ("Low", "Normal", "High")
                place = 1 + (msg.data > self.now["high"]) - (msg.data < self.now["low"])
                self.statuses.publish(String(data=words[place]))

            def look(self, parameters):
                new = self.now | {p.name: p.value for p in parameters}
                if new["low"] < new["high"]:
                    return SetParametersResult(successful=True)
                return SetParametersResult(successful=False, reason="high must be above low")

            def keep(self, parameters):
                self.now.update({p.name: p.value for p in parameters})
    """,
    ),
    _right(
        "a local function",
        (
            "self.add_on_set_parameters_callback(self.look)",
            "self.add_on_set_parameters_callback(lambda parameters: self.look(parameters))",
        ),
    ),
    _right(
        "a reason in any case, which ROS drops",
        (  # rclpy makes a result of its own then
            'reason="" if good else "not above low"',
            'reason="high must be above low"',
        ),
    ),
    _right(
        "registered last",
        ("        self.add_on_set_parameters_callback(self.look)\n", ""),
        (
            'self.create_publisher(String, "status", 10)',
            'self.create_publisher(String, "status", 10)\n'
            "        self.add_on_set_parameters_callback(self.look)",
        ),
    ),
)
