"""Exceptions and the mistakes they come from, without ROS: by text, by call, and by neither."""

import ast
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from failed_calls import failed_call
from rosbeat import diagnosis
from rosbeat.diagnosis.calls import written_call
from rosbeat.diagnosis.exceptions import diagnose_fault, first_sentence
from rosbeat.diagnosis.mistakes import MISTAKES
from rosbeat.diagnosis.programs import diagnose_output
from rosbeat.records import Fault


def fault(kind, text, code="", asked="", callback="tick", line=4):
    return Fault(0, "/sensor", callback, kind, text, line if code else 0, code, failed_call(asked))


def named(*arguments, **more):
    found = diagnose_fault(fault(*arguments, **more))
    return found and found.mistake


EXPECTED = "Expected <class 'std_msgs.msg._float32.Float32'>, got "
FIELD = "The 'data' field must be of type 'float'"
#: What the bank and broken nodes do not make, or what other versions of Python and ROS say.
KNOWN = [
    ("number-published", "TypeError", f"{EXPECTED}<class 'float'>"),
    ("not-a-message-type", "AttributeError", "type object 'type' has no attribute '_TYPE_SUPPORT' "
     "This might be a ROS 1 message type but it should be a ROS 2 message type."),
    ("type-mismatch", "RCLError", "Failed to create subscription: invalid allocator, at /x.c:261"),
    ("depth-missing", "TypeError", "Node.create_publisher() missing 1 required positional "
     "argument: 'qos_profile'"),
    ("argument-missing", "TypeError", "Node.create_subscription() missing 1 required positional "
     "argument: 'qos_profile'"),
    ("super-missing", "AttributeError", "'S' object has no attribute '_Node__node'"),
    ("exits", "SystemExit", ""),
    ("no-value-yet", "UnboundLocalError", "local variable 'status' referenced before assignment"),
    ("name-taken", "AttributeError", "can't set attribute 'publishers'"),
    ("message-for-value", "TypeError",
     "float() argument must be a string or a number, not 'Float32'"),
    ("none-used", "TypeError", "'NoneType' object cannot be interpreted as an integer"),
    ("index-error", "IndexError", "pop from an empty deque"),
    ("wrong-rate", "EndlessChainError", "A timer of /s fired 10000 times while no time passed."),
    ("endless-chain", "EndlessChainError",
     "Callbacks trigger each other in an endless loop: a -> b -> a."),
    ("constructor-parameters", "TypeError",
     "AlarmNode.__init__() missing 1 required positional argument: 'node_name'"),
]  # fmt: skip


@pytest.mark.parametrize(("mistake", "kind", "text"), KNOWN)
def test_by_its_text(mistake, kind, text):
    assert named(kind, text) == mistake


BY_CALL = [
    ("depth-missing", "create_subscription(message_type[Float32], str, callback=partial)"),
    ("callback-missing", "create_subscription(message_type[Float32], str, qos_profile=QoSProfile)"),
    ("callback-missing", "create_timer(float)"),
    ("argument-missing", "create_timer(method[tick(self)])"),
    ("argument-missing", "create_subscription(message_type[Float32], str)"),
    ("arguments-swapped", "create_publisher(str, message_type[Float32], int)"),
    ("not-a-message-type", "create_publisher(type[float], str, int)"),
    ("wrong-depth", "create_publisher(message_type[Float32], str, str)"),
    ("wrong-argument", "create_publisher(message_type[Float32], list, int)"),
    ("callback-called", "create(called[tick])"),
]


@pytest.mark.parametrize(("mistake", "asked"), BY_CALL)
def test_by_the_call_that_failed(mistake, asked):
    assert named("TypeError", "whatever it says", "x()", asked) == mistake


TUPLE = "In Python, 22,5 is a tuple of two numbers"
DECIMAL_COMMAS = [
    ("wrong-argument", "sleep() takes 2 positional arguments but 3 were given", "sleep(0,5)",
     "with a point: 0.5"),
    ("wrong-argument", "round() takes at most 2 arguments (3 given)", "round(22,5, 1)", "22.5"),
    ("decimal-comma", 'can only concatenate tuple (not "float") to tuple', "t += x", TUPLE),
    ("decimal-comma", "'<' not supported between instances of 'tuple' and 'float'", "t < x", TUPLE),
    ("decimal-comma", "unsupported format string passed to tuple.__format__", "f'{t:.2f}'", TUPLE),
]  # fmt: skip


@pytest.mark.parametrize(("mistake", "text", "code", "to_try"), DECIMAL_COMMAS)
def test_a_decimal_comma(mistake, text, code, to_try):
    found = diagnose_fault(fault("TypeError", text, code))
    assert found.mistake == mistake
    assert to_try in found.hint


def test_a_decimal_comma_in_a_timer_s_period():
    code, asked = "self.create_timer(0,5, self.tick)", "create_timer(int, int, method[tick(self)])"
    found = diagnose_fault(fault("AttributeError", "'int' object", code, asked))
    assert found.mistake == "wrong-argument"
    assert "0,5 isn't one number in Python, but two arguments: 0 and 5." in found.evidence
    assert found.hint == "Write a decimal number with a point: 0.5."


@pytest.mark.parametrize(("text", "code"), [
    ("f() takes 1 positional argument but 3 were given", "f(1, 2)"),
    ("f() takes 1 positional argument but 4 were given", "f(1,2,3)"),
    ("f() takes 1 positional argument but 2 were given", "f('1,5', 2)"),
    ("boom", "f(0,5)"),
])  # fmt: skip
def test_two_numbers_that_are_no_decimal_comma(text, code):
    found = diagnose_fault(fault("TypeError", text, code))
    assert found is None or "two arguments" not in found.evidence


UNREADY = "int() argument must be a string, a bytes-like object or a real number, not 'NoneType'"
CREATED = "create_publisher(message_type[Float32], str, QoSProfile)"
HEARD = "create_subscription(message_type[Float32], str, function[f(msg)], int)"
MISSING = "Dog.on_silence() missing 1 required positional argument: 'event'"
NOT_KNOWN = [
    ("ValueError", "boom", ""),
    ("AssertionError", "The data must be warm", ""),
    ("AssertionError", "", "assert depth == 3"),
    ("AttributeError", "TRANSIENT", "q = Mood.TRANSIENT"),
    ("AttributeError", "__enter__", "with lock:"),
    ("TypeError", "", ""),
    ("TypeError", "", "x()", "publish(NoneType)"),
    ("TypeError", "A.other() takes 2 positional arguments but 3 were given", "x()"),
    ("TypeError", "'NoneType' object does not support the context manager protocol", "with lock:"),
    ("TypeError", "'NoneType' object is not iterable", "list(None)"),
    ("TypeError", MISSING, "on_silence()"),
    ("TypeError", "f() missing 1 required positional argument: 'x'", "y = f()"),
    ("TypeError", "unsupported operand type(s) for +: 'float' and 'list'", "x + y"),
    ("KeyError", "'temperature'", "readings['temperature']"),
    ("RuntimeError", "cannot schedule new futures after shutdown", "x()"),
    ("RCLError", "failed to create node: out of memory", "x()"),
    # A call that was right says nothing.
    ("RCLError", "out of memory", "x()", CREATED),
    ("RCLError", "out of memory", "x()", HEARD),
    ("OSError", "[Errno 28] No space left on device", "open('x')"),
]


@pytest.mark.parametrize("given_fault", NOT_KNOWN, ids=str)
def test_what_is_not_known_gets_no_name(given_fault):
    assert named(*given_fault) is None


ENDED = "still running after 5 s"
#: What a fault is, the mistake, and a part of its evidence and hint.
SAID = [
    # A future that is asked for its result too soon is known by its line.
    (("TypeError", UNREADY, "x = int(self.reading.result())"), "await-missing", ""),
    (("TypeError", UNREADY, "x = int(self.reading)"), "none-used", ""),
    (("TypeError", "'Future' object is not callable", "x()"), "not-callable", ""),
    # What ROS calls a callback with, whichever calls it.
    (("TypeError", "A.tick() takes 1 positional argument but 2 were given"), "callback-parameters",
     "ROS calls tick with 1 argument besides self, but tick takes none. Some callbacks"),
    (("TypeError", "A.tick() takes 2 positional arguments but 3 were given"), "callback-parameters",
     "ROS calls tick with 2 arguments besides self, but tick takes 1. A service's callback"),
    (("TypeError", "make.<locals>.tick() takes 1 positional argument but 2 were given"),
     "callback-parameters", "ROS calls tick with 2 arguments, but tick takes 1. A service's"),
    (("TypeError", "A.tick() missing 1 required positional argument: 'info'"),
     "callback-parameters", "an event's the event info"),
    # Quality of service, in calls of several lines.
    (("AssertionError", "", "deadline=2.0,", "", "__init__"), "wrong-argument", "for deadline"),
    (("AssertionError", "", "QoSProfile(depth=9, deadline=2, lifespan=3)"), "wrong-argument",
     "one of the policies"),
    *((("TypeError", MISSING, code, "", "__init__"), "callback-called", "on_silence") for code in
      ("events = SubscriptionEventCallbacks(deadline=self.on_silence())",
       "deadline=self.on_silence(),", 'Float32, "temperature", self.on_silence(), qos')),
    # Evidence is who raised what it means, and the line; and what Python or the session said.
    (("TypeError", KNOWN[0][2], "self.publisher_.publish(25.0)"), "number-published",
     "tick raised TypeError. publish was given a float instead of a message. "
     "Line 4: `self.publisher_.publish(25.0)`."),
    *((("AssertionError", FIELD, "msg.data = 9 * 2", asked), None,
       f"takes a float, but the value given {words}") for asked, words in
      (("field(int)", "is an int."), ("field(NoneType)", "is None."), ("field(tuple)", "is a tup"),
       ("field(Decimal)", "is an object of type Decimal."), ("", "is something else."))),
    (("UnboundLocalError", "cannot access local variable 'low' where it is not associated with a "
      "value", "low = self.get_parameter(low).value"), "no-value-yet", "quotes"),
    (("AttributeError", "__enter__", "with rclpy.init():"), "init-in-with", ""),  # Python 3.10
    (("TypeError", "'NoneType' object is not callable", "", "", "nothing"), "callback-called",
     "The first tick raised TypeError. "),
    (("NodeClassError", "3 is not a node, but of type int.", "", "", "add"), None,
     "3 is not a node, but of type int."),
    (("DeadlinePassed", ENDED, "while True:"), None,
     "tick does not return: still running after 5 s. Line 4: `while True:`."),
    *((("DeadlinePassed", ENDED, code, "", "__init__"), "constructor-blocks", hint)
      for code, hint in (("while True:", "timer"), ("time.sleep(9)", "timer"),
                         ("x = solve(y)", "What makes the constructor return?"))),
    (("DeadlinePassed", "600 timers in 599 calls", "self.create(x)"), "made-anew",
     "tick created 600 timers in 599 calls, and each one slows the node down."),
    (("DeadlinePassed", "612 calls of callbacks took 15 s", "x = sum(self.all)"), "slow-callback",
     "612 calls of callbacks took 15 s"),
]  # fmt: skip


@pytest.mark.parametrize(("given_fault", "mistake", "said"), SAID)
def test_what_is_said(given_fault, mistake, said):
    code = given_fault[2] if len(given_fault) > 2 else ""
    found = diagnose_fault(fault(*given_fault))
    assert mistake in (None, found.mistake)  # a value of None has a name of its own
    assert said in f"{found.evidence} {found.hint}"
    assert ("Line" in found.evidence) == bool(code)
    assert found.mistake != "constructor-blocks" or "A callback" not in found.hint


@pytest.mark.parametrize(
    ("text", "first"),
    [
        ("out of memory, at /project/src/rcl/node.c:129", "out of memory"),
        (
            "incompatible arguments:\n  1. str\nInvoked with: <Node at 0x7f>",
            "incompatible arguments",
        ),
        ("", ""),
    ],
)
def test_the_first_sentence(text, first):
    assert first_sentence(text) == first


# Calls that are only written.


@pytest.mark.parametrize(
    ("code", "call"),
    [
        (
            "self.publisher_ = self.create_publisher(Float32, 'temperature')",
            "create_publisher(message_type[Float32], str)",
        ),
        (
            "self.create_subscription(std_msgs.msg.String, topic, self.listen(), qos_profile=10)",
            "create_subscription(message_type[String], unknown, NoneType, qos_profile=int)",
        ),
        ("node.create_timer(1.0, lambda: None)", "create_timer(float, function)"),
        (
            "node.create_publisher(msg.Float32, 'a', 10)",
            "create_publisher(message_type[Float32], str, int)",
        ),
        (
            "self.create_publisher(float, 'a', self.depth)",
            "create_publisher(type[float], str, method[depth])",
        ),
        ("self.create_publisher(*arguments)", ""),
        ("self.create_publisher(Float32, **options)", ""),
        ("self.publisher_ = self.create_publisher(", ""),
        ("rclpy.spin(node)", ""),
    ],
)
def test_a_call_that_is_written(code, call):
    assert written_call(code) == failed_call(call)


# Whatever is thrown at it.

KINDS = sorted({kind for _, kind, _ in KNOWN} | {"SyntaxError", "DeadlinePassed", "X"})

PARTS = [text for _, _, text in KNOWN] + [asked for _, asked in BY_CALL]

texts = st.one_of(st.text(), st.sampled_from(PARTS), st.builds(
    lambda one, at, more: one[:at] + more + one[at:],
    st.sampled_from(PARTS), st.integers(0, 80), st.text(max_size=5),
))  # fmt: skip

faults = st.builds(
    Fault, st.just(0), st.just("/s"), st.sampled_from(["", "tick", "__init__", "<lambda>"]),
    st.one_of(st.sampled_from(KINDS), st.text()), texts, st.integers(0, 3), texts,
    st.sampled_from([None, *(failed_call(asked) for _, asked in BY_CALL)]),
)  # fmt: skip


@given(faults)
def test_no_fault_makes_a_diagnosis_raise(one):
    found = diagnose_fault(one)
    assert found is None or (found.mistake in MISTAKES and found.evidence and found.hint)


@given(st.lists(st.one_of(texts, st.sampled_from([
    "Traceback (most recent call last):", '  File "a.py", line 3, in main', "    rclpy.spin(node)",
    "KeyboardInterrupt", "SyntaxError: invalid syntax", "    ^^^", "TypeError: " + PARTS[5],
])), max_size=8).map("\n".join))  # fmt: skip
def test_no_output_makes_a_diagnosis_raise(text):
    found = diagnose_output(text)
    assert found is None or found.mistake in MISTAKES


@given(st.text())
def test_any_line_can_be_looked_at(code):
    written_call(code)


# The table.


def ids_in_the_room():
    """Every id of a mistake that a module of `diagnosis` names."""
    found = set()
    for path in Path(diagnosis.__file__).parent.glob("*.py"):
        if path.name != "mistakes.py":
            found |= {
                node.args[0].value
                for node in ast.walk(ast.parse(path.read_text(encoding="utf-8")))
                if isinstance(node, ast.Call)
                and ast.unparse(node.func) in ("Meaning", "Row", "Diagnosis", "finding")
                and node.args
                and isinstance(node.args[0], ast.Constant)
            }
    return found


def test_every_id_exists():
    assert ids_in_the_room() - set(MISTAKES) == set()
