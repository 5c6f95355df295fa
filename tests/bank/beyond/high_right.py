"""12a, a threshold behind a service: right answers, in many styles."""

from bank.answer import edited, right

BASE = """
    class AdjustableMonitor(Node):
        def __init__(self):
            super().__init__("temperature_monitor")
            self.high = 26.0
            self.create_subscription(Float32, "temperature", self.listen, 10)
            self.statuses = self.create_publisher(String, "status", 10)
            self.create_service(BasicTypes, "set_high", self.set_high)

        def listen(self, msg):
            status = "High" if msg.data > self.high else "Normal"
            self.statuses.publish(String(data=status))

        def set_high(self, request, response):
            response.bool_value = 10.0 <= request.float32_value <= 40.0
            if response.bool_value:
                self.high = request.float32_value
            else:
                response.string_value = "a threshold is from 10 to 40 degrees"
            return response
"""
BODY = BASE[BASE.index("            response.bool_value = 10") :]
_CALLBACK = BASE[BASE.index("        def set_high") :]
_MAKE = 'self.create_service(BasicTypes, "set_high", self.set_high)'
_HEAD = BASE[: BASE.index("        def set_high")]


def _right(name, *edits):
    return right("12a", name, edited(BASE, *edits))


def _body(name, body):
    lines = "".join(f"            {line}\n" if line else "\n" for line in body.splitlines())
    return right("12a", name, _HEAD + "        def set_high(self, request, response):\n" + lines)


ANSWERS = (
    _right("as on the page"),
    _right("absolute name", ('"set_high"', '"/set_high"')),
    _right(
        "keywords",
        (
            _MAKE,
            "self.create_service(srv_type=BasicTypes, srv_name='set_high', callback=self.set_high)",
        ),
    ),
    _right("kept in an attribute", (_MAKE, f"self.service = {_MAKE}")),
    _body(
        "an early return",
        """value = request.float32_value
if not 10.0 <= value <= 40.0:
    response.bool_value = False
    response.string_value = f"{value} is not from 10 to 40"
    return response
self.high = value
response.bool_value = True
return response""",
    ),
    _body(
        "a response of its own",
        """good = 10 <= request.float32_value <= 40
if good:
    self.high = request.float32_value
return BasicTypes.Response(bool_value=good, string_value="" if good else "out of range")""",
    ),
    _body(
        "isnan",
        """import math
value = request.float32_value
if math.isnan(value) or value < 10 or value > 40:
    response.string_value = "refused"
else:
    self.high, response.bool_value = value, True
return response""",
    ),
    _body(
        "isfinite, min and max",
        """import math
value = request.float32_value
response.bool_value = math.isfinite(value) and min(40.0, max(10.0, value)) == value
if not response.bool_value:
    response.string_value = "nonsense"
    return response
self.high = value
return response""",
    ),
    _body(
        "the distance from the middle",
        """if abs(request.float32_value - 25.0) <= 15.0:
    self.high = float(request.float32_value)
    response.bool_value = True
else:
    response.string_value = "too far away"
return response""",
    ),
    _body(
        "try and raise",
        """try:
    if not (request.float32_value >= 10 and request.float32_value <= 40):
        raise ValueError("10 to 40, please")
    self.high = request.float32_value
    response.bool_value = True
except ValueError as error:
    response.string_value = str(error)
return response""",
    ),
    right(
        "12a",
        "a local function",
        _HEAD.replace(
            _MAKE,
            """
            def answer(request, response):
                response.bool_value = 10.0 <= request.float32_value <= 40.0
                if response.bool_value:
                    self.high = request.float32_value
                else:
                    response.string_value = "no"
                return response

            self.create_service(BasicTypes, "set_high", answer)""",
        ),
    ),
    right("12a", "async", edited(BASE, ("def set_high", "async def set_high"))),
    right(
        "12a",
        "a dict of limits, and log lines",
        edited(
            BASE,
            ("self.high = 26.0", 'self.limits = {"high": 26.0}'),
            ("self.high else", 'self.limits["high"] else'),
            ("self.high = request", 'self.limits["high"] = request'),
            ("return response", 'self.get_logger().info("asked")\n        return response'),
        ),
    ),
)
