"""Page 12: more answers, written from the page alone."""

from bank.answer import edited, either, right, wrong
from bank.beyond import heat_right, high_right, limits_right

_SERVICE = 'self.create_service(BasicTypes, "set_high", self.set_high)'
_HEAD = high_right.BASE[: high_right.BASE.index("        def set_high")]
_UPDATE = "new.update({parameter.name: parameter.value for parameter in parameters})"
_GOOD = 'good = new["high"] > new["low"]'
_WHY = 'reason="" if good else "not above low"'
_BACK = f"return SetParametersResult(successful=good, {_WHY})"


def _lines(text, depth):
    return "".join(f"{' ' * depth}{line}\n" if line else "\n" for line in text.splitlines())


def _high(name, body, mistake=""):
    text = _HEAD + "        def set_high(self, request, response):\n" + _lines(body, 12)
    return wrong("12a", name, mistake, text) if mistake else right("12a", name, text)


def _limits(name, edits, mistake=""):
    text = edited(limits_right.BASE, *edits)
    return wrong("12b", name, mistake, text) if mistake else right("12b", name, text)


def _heat(name, body, mistake="", *edits):
    text = edited(heat_right.HEAD + _lines(body, 12), *edits)
    return wrong("12c", name, mistake, text) if mistake else right("12c", name, text)


_A_SERVICE = (
    _high(
        "a text beside each answer",
        """good = 10 <= request.float32_value <= 40
if good:
    self.high = request.float32_value
response.bool_value = good
response.string_value = f"high is now {self.high:g}" if good else "a threshold is from 10 to 40"
return response""",
    ),
    right(
        "12a",
        "a setter that raises",
        edited(
            high_right.BASE,
            ("response.bool_value = 10.0 <= request.float32_value <= 40.0",
             "try:\n            self.limit = request.float32_value\n"
             "            response.bool_value = True\n        except ValueError as error:\n"
             '            response.string_value = f"refused: {error}"\n        return response'),
            ("    def listen",
             "    @property\n    def limit(self):\n        return self.high\n\n"
             "    @limit.setter\n    def limit(self, value):\n        if not 10 <= value <= 40:\n"
             "            raise ValueError(value)\n        self.high = value\n\n    def listen"),
        ),
    ),
    _high(
        "numpy",
        """import numpy as np
value = np.float32(request.float32_value)
response.bool_value = bool(np.isfinite(value) and np.clip(value, 10, 40) == value)
self.high = float(value) if response.bool_value else self.high
response.string_value = "" if response.bool_value else "out of range"
return response""",
    ),
    right(
        "12a",
        "a parent, a dataclass and a lambda",
        """
        from dataclasses import dataclass

        @dataclass
        class Range:
            low: float = 10.0
            high: float = 40.0

            def __contains__(self, value):
                return self.low <= value <= self.high

        class Server(Node):
            allowed = Range()

            def serve(self, kind, name):
                answer = lambda request, response: self.answer(request.float32_value, response)
                return self.create_service(kind, name, answer)

            def answer(self, value, response):
                response.bool_value = value in self.allowed
                if response.bool_value:
                    self.keep(value)
                else:
                    response.string_value = f"{value} is not in {self.allowed}"
                return response

        class Monitor(Server):
            def __init__(self):
                super().__init__("monitor")
                self.out = self.create_publisher(String, "status", 10)
                self.create_subscription(
                    Float32, "temperature",
                    lambda msg: self.out.publish(String(data=self.word(msg.data))), 10,
                )
                self.serve(BasicTypes, "set_high")
                self.keep(26.0)

            def keep(self, value):
                self.threshold = value

            def word(self, value):
                return ("Normal", "High")[value > self.threshold]
        """,
        "Monitor",
    ),
    wrong(
        "12a",
        "the callback called, by its keyword",
        "callback-called",
        edited(
            high_right.BASE,
            (_SERVICE, 'self.create_service(BasicTypes, "set_high", callback=self.set_high())'),
        ),
    ),
    _high(
        "a whole number in a range",
        """response.bool_value = request.float32_value in range(10, 41)
if response.bool_value:
    self.high = request.float32_value
else:
    response.string_value = "10 to 40"
return response""",
        "good-value-refused",
    ),
    _high(
        "or for and",
        """value = request.float32_value
response.bool_value = 10 <= value or value <= 40
if response.bool_value:
    self.high = value
else:
    response.string_value = "10 to 40"
return response""",
        "nonsense-accepted",
    ),
    _high(
        "the request is filled in",
        """request.bool_value = 10 <= request.float32_value <= 40
if request.bool_value:
    self.high = request.float32_value
else:
    response.string_value = "10 to 40"
return response""",
        "response-not-filled",
    ),
    _high(
        "the reason for the wrong outcome",
        """response.bool_value = 10 <= request.float32_value <= 40
if response.bool_value:
    self.high = request.float32_value
    response.string_value = "10 to 40"
return response""",
        "reason-missing",
    ),
    _high(
        "returns only if it is good",
        """if 10 <= request.float32_value <= 40:
    self.high = request.float32_value
    response.bool_value = True
    return response
response.string_value = "10 to 40" """,
        "response-missing",
    ),
    _high(
        "a local name hides the threshold",
        """high = self.high
response.bool_value = 10 <= request.float32_value <= 40
if response.bool_value:
    high = request.float32_value
else:
    response.string_value = "10 to 40"
return response""",
        "accepted-and-lost",
    ),
    either(
        "12a",
        "the callback called with two messages",
        ("callback-called", "wrong-argument"),
        edited(
            high_right.BASE,
            ("self.set_high)", "self.set_high(BasicTypes.Request(), BasicTypes.Response()))"),
        ),
    ),
)  # fmt: skip

_PARAMETERS = (
    _limits(
        "a chain of maps",
        ((_UPDATE, "from collections import ChainMap\n"
                   "        new = ChainMap({p.name: p.value for p in parameters}, new)"),),
    ),
    _limits(
        "numpy, and a text beside each answer",
        ((_GOOD, "import numpy as np\n"
                 '        good = bool(np.diff([new["low"], new["high"]])[0] > 0)'),
         (_WHY, 'reason="fine" if good else "high has to be above low"')),
    ),
    _limits(
        "a value at a time from a generator",
        ((_UPDATE, "def last(name):\n"
                   "            return next((p.value for p in parameters if p.name == name), "
                   "new[name])"),
         (_GOOD, 'good = last("low") < last("high")')),
    ),
    _limits(
        "an early return, and parameters as typed values",
        ((_UPDATE, "for parameter in parameters:\n"
                   "            new[parameter.name] = "
                   "parameter.get_parameter_value().double_value"),
         (_BACK, "if not good:\n"
                 "            why = f'{new[\"high\"]} is not above {new[\"low\"]}'\n"
                 "            return SetParametersResult(successful=False, reason=why)\n"
                 "        return SetParametersResult(successful=True)")),
    ),
    _limits(
        "only a list of both is looked at",
        ((_GOOD, 'good = len(parameters) < 2 or new["high"] > new["low"]'),),
        "nonsense-accepted",
    ),
    _limits("texts are compared", ((_GOOD, 'good = str(new["high"]) > str(new["low"])'),),
            "nan-accepted"),
    _limits("put in order first",
            ((_GOOD, 'good = max(new.values()) >= min(new.values())'),), "not-validated"),
    _limits("a reason, and successful all the same",
            (("successful=good", "successful=True"),), "not-validated"),
    _limits("a dict for a result", ((_BACK, 'return {"successful": good, "reason": "no"}'),),
            "result-of-another-kind"),
)  # fmt: skip

_ACTION = (
    _heat(
        "a helper that awaits, and a set for the range",
        """feedback = Fibonacci.Feedback()
self.switch(True)
while await self.step(goal_handle, feedback):
    pass
self.switch(False)
(goal_handle.canceled if goal_handle.is_cancel_requested else goal_handle.succeed)()
return Fibonacci.Result(sequence=feedback.sequence)""",
        "",
        (
            "    async def heat",
            "    def switch(self, on):\n        self.heater.publish(Bool(data=on))\n\n"
            "    async def step(self, goal_handle, feedback):\n"
            "        feedback.sequence.append(await self.reading)\n"
            "        goal_handle.publish_feedback(feedback)\n"
            "        is_cold = feedback.sequence[-1] < goal_handle.request.order\n"
            "        return is_cold and not goal_handle.is_cancel_requested\n\n"
            "    async def heat",
        ),
        ("if 10 <= goal.order <= 26", "if goal.order in set(range(10, 27))"),
    ),
    _heat(
        "numpy integers",
        """import numpy as np
degrees = np.array([], dtype=np.int32)
self.heater.publish(Bool(data=True))
while not goal_handle.is_cancel_requested:
    degrees = np.append(degrees, np.int32(await self.reading))
    goal_handle.publish_feedback(Fibonacci.Feedback(sequence=degrees))
    if degrees[-1] >= goal_handle.request.order:
        break
self.heater.publish(Bool(data=False))
if goal_handle.is_cancel_requested:
    goal_handle.canceled()
else:
    goal_handle.succeed()
return Fibonacci.Result(sequence=degrees)""",
    ),
    _heat(
        "the number of degrees is counted",
        """degrees = [await self.reading]
goal_handle.publish_feedback(Fibonacci.Feedback(sequence=degrees))
for _ in range(goal_handle.request.order - degrees[0]):
    self.heater.publish(Bool(data=True))
    degrees += [await self.reading]
    goal_handle.publish_feedback(Fibonacci.Feedback(sequence=degrees))
    if goal_handle.is_cancel_requested:
        break
self.heater.publish(Bool(data=False))
goal_handle.canceled() if goal_handle.is_cancel_requested else goal_handle.succeed()
return Fibonacci.Result(sequence=degrees)""",
    ),
    wrong(
        "12c", "a range without its end", "boundary",
        edited(heat_right.BASE, ("if 10 <= goal.order <= 26", "if goal.order in range(10, 26)")),
    ),
    _heat(
        "switched off behind the return",
        """degrees = []
self.heater.publish(Bool(data=True))
while not degrees or degrees[-1] < goal_handle.request.order:
    degrees.append(await self.reading)
    goal_handle.publish_feedback(Fibonacci.Feedback(sequence=degrees))
    if goal_handle.is_cancel_requested:
        goal_handle.canceled()
        return Fibonacci.Result(sequence=degrees)
goal_handle.succeed()
return Fibonacci.Result(sequence=degrees)
self.heater.publish(Bool(data=False))""",
        "left-on",
    ),
    _heat(
        "feedback before the reading",
        """degrees = []
self.heater.publish(Bool(data=True))
while not degrees or degrees[-1] < goal_handle.request.order:
    goal_handle.publish_feedback(Fibonacci.Feedback(sequence=degrees))
    degrees.append(await self.reading)
    if goal_handle.is_cancel_requested:
        break
self.heater.publish(Bool(data=False))
goal_handle.canceled() if goal_handle.is_cancel_requested else goal_handle.succeed()
return Fibonacci.Result(sequence=degrees)""",
        "wrong-values",
    ),
    _heat(
        "one list for all goals",
        """degrees = self.degrees
self.heater.publish(Bool(data=True))
while True:
    degrees.append(await self.reading)
    goal_handle.publish_feedback(Fibonacci.Feedback(sequence=degrees))
    if goal_handle.is_cancel_requested or degrees[-1] >= goal_handle.request.order:
        break
self.heater.publish(Bool(data=False))
goal_handle.canceled() if goal_handle.is_cancel_requested else goal_handle.succeed()
return Fibonacci.Result(sequence=degrees)""",
        "result-wrong",
        ("self.reading = Future()\n        self.server", "self.reading = Future()\n"
         "        self.degrees = []\n        self.server"),
    ),
    _heat(
        "the canceled way gives nothing back",
        """degrees = []
self.heater.publish(Bool(data=True))
while not degrees or degrees[-1] < goal_handle.request.order:
    degrees.append(await self.reading)
    goal_handle.publish_feedback(Fibonacci.Feedback(sequence=degrees))
    if goal_handle.is_cancel_requested:
        self.heater.publish(Bool(data=False))
        goal_handle.canceled()
        return
self.heater.publish(Bool(data=False))
goal_handle.succeed()
return Fibonacci.Result(sequence=degrees)""",
        "result-missing",
    ),
)  # fmt: skip

ANSWERS = (*_A_SERVICE, *_PARAMETERS, *_ACTION)
