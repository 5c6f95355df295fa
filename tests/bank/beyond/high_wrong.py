"""12a, a threshold behind a service: wrong answers."""

from bank.answer import edited, either, wrong
from bank.beyond.high_right import BASE

_MAKE = 'self.create_service(BasicTypes, "set_high", self.set_high)'
_TEST = "response.bool_value = 10.0 <= request.float32_value <= 40.0"
_KEEP = "self.high = request.float32_value"
_WHY = 'response.string_value = "a threshold is from 10 to 40 degrees"'
_IF = "if response.bool_value:"
_BACK = "return response"


def _wrong(name, mistake, *edits):
    return wrong("12a", name, mistake, edited(BASE, *edits))


def _either(name, mistakes, *edits):
    return either("12a", name, mistakes, edited(BASE, *edits))


ANSWERS = (
    _wrong("no return", "response-missing", (_BACK, "pass")),
    _wrong("a bare return", "response-missing", (_BACK, "return")),
    _wrong("returns True", "response-wrong", (_BACK, "return True")),
    _wrong("returns the request", "response-wrong", (_BACK, "return request")),
    _wrong("returns the class", "response-wrong", (_BACK, "return BasicTypes.Response")),
    _wrong("returns the value", "response-wrong", (_BACK, "return response.bool_value")),
    _wrong("another name", "service-misspelled", ('"set_high"', '"set_hihg"')),
    _wrong("quite another name", "service-misspelled", ('"set_high"', '"threshold"')),
    _wrong(
        "another type",
        "type-mismatch",
        (_MAKE, f"from std_srvs.srv import SetBool\n        {_MAKE}"),
        ("create_service(BasicTypes", "create_service(SetBool"),
    ),
    _wrong("no service", "no-service", (_MAKE, "pass")),
    _wrong("a client", "no-service", (_MAKE, 'self.create_client(BasicTypes, "set_high")')),
    _wrong("the callback called", "callback-called", ("self.set_high)", "self.set_high())")),
    _wrong("a message type", "wrong-argument", ("service(BasicTypes", "service(Float32")),
    _wrong(
        "the request's type", "wrong-argument", ("service(BasicTypes", "service(BasicTypes.Request")
    ),
    _wrong("a depth", "wrong-argument", ("self.set_high)", "self.set_high, 10)")),
    _wrong("no callback", "callback-missing", (", self.set_high)", ")")),
    _wrong(
        "no response parameter",
        "callback-parameters",
        (
            "def set_high(self, request, response):",
            "def set_high(self, request):\n        response = BasicTypes.Response()",
        ),
    ),
    _wrong(
        "no self",
        "callback-parameters",
        ("def set_high(self, request, response)", "def set_high(request, response)"),
    ),
    _wrong(
        "NaN passes",
        "nan-accepted",
        (
            _TEST,
            "response.bool_value = not (request.float32_value < 10.0 or "
            "request.float32_value > 40.0)",
        ),
    ),
    _wrong("everything passes", "nonsense-accepted", (_TEST, "response.bool_value = True")),
    _wrong(
        "only too high is refused",
        "nonsense-accepted",
        ("10.0 <= request.float32_value <= 40.0", "-100.0 <= request.float32_value <= 40.0"),
    ),
    _wrong(
        "only too low is refused",
        "nonsense-accepted",
        ("10.0 <= request.float32_value <= 40.0", "request.float32_value >= 10.0"),
    ),
    _wrong(
        "the limits are refused",
        "good-value-refused",
        ("10.0 <= request.float32_value <= 40.0", "10.0 < request.float32_value < 40.0"),
    ),
    _wrong("40 is refused", "good-value-refused", ("<= 40.0", "< 40.0")),
    _wrong("a range too narrow", "good-value-refused", ("10.0 <=", "20.0 <=")),
    _wrong("upside down", "good-value-refused", (_TEST, f"{_TEST.replace('= 10', '= not 10')}")),
    _wrong("cut to a whole number", "other-limits", (_KEEP, f"{_KEEP} // 1")),
    _wrong("rounded", "other-limits", (_KEEP, "self.high = float(round(request.float32_value))")),
    _wrong("not kept", "accepted-and-lost", (_KEEP, "high = request.float32_value")),
    _wrong(
        "kept under another name",
        "accepted-and-lost",
        (_KEEP, "self.threshold = request.float32_value"),
    ),
    _wrong("kept before it is looked at", "refused-and-kept", (_TEST, f"{_KEEP}\n        {_TEST}")),
    _wrong(
        "nonsense is clamped",
        "refused-and-kept",
        (_WHY, f"{_WHY}\n            self.high = min(40.0, max(10.0, request.float32_value))"),
    ),
    _wrong("no reason", "reason-missing", (_WHY, "pass")),
    _wrong(
        "the answer is left empty",
        "response-not-filled",
        (_TEST, "good = 10.0 <= request.float32_value <= 40.0"),
        (_IF, "if good:"),
    ),
    _wrong(
        "a field that is not there",
        "wrong-attribute",
        ("request.float32_value", "request.float_value"),
    ),
    _wrong(
        "the response's other field",
        "wrong-attribute",
        (_WHY, 'response.message = "10 to 40 degrees"'),
    ),
    _wrong("a number for a text", "not-a-float", (_WHY, "response.string_value = 10")),
    _wrong("None for a truth", "not-a-float", (_TEST, "response.bool_value = None")),
    _either(
        "an int as the limit, and the limits are refused",
        ("good-value-refused",),
        ("10.0 <= request.float32_value <= 40.0", "10 < request.float32_value < 40"),
    ),
    _either(
        "not kept, and no reason",
        ("accepted-and-lost", "reason-missing"),
        (_KEEP, "pass"),
        (_WHY, "pass"),
    ),
    _either(
        "no return, and another name",
        ("response-missing", "service-misspelled"),
        (_BACK, "pass"),
        ('"set_high"', '"set_hight"'),
    ),
    _either(
        "NaN passes, and no reason",
        ("nan-accepted", "reason-missing"),
        (
            _TEST,
            "response.bool_value = not (request.float32_value < 10.0 or "
            "request.float32_value > 40.0)",
        ),
        (_WHY, "pass"),
    ),
    _either(
        "a callback that waits for ever",
        ("callback-blocks",),
        (_IF, f"while True:\n            pass\n        {_IF}"),
    ),
)
