"""Exceptions and the mistakes they come from, without ROS: by text, by call, and by neither."""

import ast
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from failed_calls import failed_call
from rosbeat import diagnosis
from rosbeat.diagnosis.exceptions import diagnose_fault, first_sentence, meaning_of
from rosbeat.diagnosis.mistakes import MISTAKES
from rosbeat.diagnosis.programs import diagnose_output
from rosbeat.records import Fault


def fault(kind, text, code="", asked="", callback="tick", line=4):
    return Fault(0, "/sensor", callback, kind, text, line if code else 0, code, failed_call(asked))


def named(*arguments, **more):
    found = diagnose_fault(fault(*arguments, **more))
    return found and found.mistake


KNOWN = [
    ("not-a-float", "AssertionError", "The 'data' field must be of type 'float'"),
    ("wrong-values", "AssertionError", "The 'data' field must be a float in [-3.4e+38, 3.4e+38]"),
    ("wrong-keyword", "AssertionError", "Invalid arguments passed to constructor: dat"),
    ("field-without-name", "TypeError",
     "Float32.__init__() takes 1 positional argument but 2 were given"),
    ("wrong-field", "AttributeError", "'Float32' object has no attribute 'value'"),
    ("number-published", "TypeError",
     "Expected <class 'std_msgs.msg._float32.Float32'>, got <class 'float'>"),
    ("class-published", "TypeError", "Expected <class 'std_msgs.msg._float32.Float32'>, got "
     "<class 'std_msgs.msg._float32.Metaclass_Float32'>"),
    ("type-mismatch", "TypeError", "Expected <class 'std_msgs.msg._float32.Float32'>, got "
     "<class 'std_msgs.msg._string.String'>"),
    ("type-mismatch", "RCLError", "Failed to create subscription: invalid allocator, at /x.c:261"),
    ("type-mismatch", "RCLError", "Failed to create publisher: create_publisher() called for "
     "existing topic name rt/temperature with incompatible type std_msgs::msg::dds_::String_"),
    ("not-a-message-type", "AttributeError", "type object 'type' has no attribute '_TYPE_SUPPORT' "
     "This might be a ROS 1 message type but it should be a ROS 2 message type."),
    ("super-missing", "AttributeError", "'S' object has no attribute '_default_callback_group'"),
    ("super-missing", "AttributeError", "'S' object has no attribute '_Node__node'"),
    ("invalid-name", "InvalidNodeNameException", "Invalid node name: node name must not contain "
     "characters other than alphanumerics or '_':\n  'a-b'\n    ^"),
    ("not-initialised", "NotInitializedException", "rclpy.init() has not been called."),
    ("initialised-twice", "RuntimeError", "Context.init() must only be called once"),
    ("shut-down-twice", "RuntimeError", "Context must be initialized before it can be shutdown"),
    ("exits", "SystemExit", ""),
    ("no-value-yet", "UnboundLocalError",
     "cannot access local variable 'status' where it is not associated with a value"),
    ("no-value-yet", "UnboundLocalError", "local variable 'status' referenced before assignment"),
    ("name-taken", "AttributeError", "property 'publishers' of 'S' object has no setter"),
    ("name-taken", "AttributeError", "can't set attribute 'publishers'"),
    ("message-for-value", "TypeError",
     "float() argument must be a string or a number, not 'Float32'"),
    ("message-for-value", "TypeError",
     "float() argument must be a string or a real number, not 'Float32'"),
    ("message-for-value", "TypeError", "must be real number, not Float32"),
    ("callback-parameters", "TypeError", "S.tick() missing 1 required positional argument: 'msg'"),
    ("callback-called", "TypeError", "'NoneType' object is not callable"),
    ("none-used", "TypeError",
     "'>' not supported between instances of 'float' and 'NoneType'"),
    ("none-used", "TypeError", "'NoneType' object cannot be interpreted as an integer"),
    ("arguments-swapped", "TypeError",
     "First element 20.0 at index 0 in parameters list is not a str"),
    ("wrong-argument", "TypeError",
     "Node.get_parameter() takes 2 positional arguments but 3 were given"),
    ("index-error", "IndexError", "pop from an empty deque"),
    ("index-error", "IndexError", "pop from empty list"),
    ("wrong-rate", "EndlessChainError", "A timer of /s fired 10000 times and no time passed."),
    ("endless-chain", "EndlessChainError", "Messages go round without end: a -> b -> a."),
    ("constructor-parameters", "TypeError",
     "AlarmNode.__init__() missing 1 required positional argument: 'node_name'"),
]  # fmt: skip


@pytest.mark.parametrize(("mistake", "kind", "text"), KNOWN)
def test_by_its_text(mistake, kind, text):
    assert named(kind, text) == mistake


BY_CALL = [
    ("depth-missing", "create_publisher(message_type[Float32], str)"),
    ("depth-missing", "create_subscription(message_type[Float32], str, method[cb(self, msg)])"),
    ("depth-missing", "create_subscription(message_type[Float32], str, callback=partial)"),
    ("callback-missing", "create_subscription(message_type[Float32], str, int)"),
    ("callback-missing", "create_subscription(message_type[Float32], str, qos_profile=QoSProfile)"),
    ("callback-missing", "create_timer(float)"),
    ("argument-missing", "create_timer(method[tick(self)])"),
    ("argument-missing", "create_subscription(message_type[Float32], str)"),
    ("arguments-swapped", "create_publisher(str, message_type[Float32], int)"),
    ("arguments-swapped", "create_timer(method[tick(self)], float)"),
    ("not-a-message-type", "create_publisher(type[float], str, int)"),
    ("wrong-depth", "create_publisher(message_type[Float32], str, str)"),
    ("wrong-argument", "create_publisher(message_type[Float32], list, int)"),
    ("callback-called", "create(called[tick])"),
]


@pytest.mark.parametrize(("mistake", "asked"), BY_CALL)
def test_by_the_call_that_failed(mistake, asked):
    assert named("TypeError", "whatever it says", "x()", asked) == mistake


TUPLE = "In Python 22,5 is a tuple of two numbers"
DECIMAL_COMMAS = [
    ("wrong-argument", "Random.uniform() takes 3 positional arguments but 5 were given",
     "self.t += random.uniform(-0,5, 0,5)", "with a point: 0.5"),
    ("wrong-argument", "sleep() takes 2 positional arguments but 3 were given", "sleep(0,5)",
     "with a point: 0.5"),
    ("wrong-argument", "float expected at most 1 argument, got 2", "x = float(22,5)", "22.5"),
    ("wrong-argument", "round() takes at most 2 arguments (3 given)", "round(22,5, 1)", "22.5"),
    ("wrong-argument", "Third element 5 at index 0 in parameters list is not a "
     "ParameterDescriptor", 'self.declare_parameter("high", 26,5)', "26.5"),
    ("decimal-comma", 'can only concatenate tuple (not "float") to tuple', "t += x", TUPLE),
    ("decimal-comma", "'<' not supported between instances of 'tuple' and 'float'", "t < x", TUPLE),
    ("decimal-comma", "unsupported operand type(s) for -: 'float' and 'tuple'", "x - t", TUPLE),
    ("decimal-comma", "unsupported format string passed to tuple.__format__", "f'{t:.2f}'", TUPLE),
    ("decimal-comma", "float() argument must be a string or a real number, not 'tuple'",
     "float(t)", TUPLE),
    ("decimal-comma", "type tuple doesn't define __round__ method", "round(t)", TUPLE),
    ("decimal-comma", "bad operand type for abs(): 'tuple'", "abs(t)", TUPLE),
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
    assert "0,5 is not one number in Python, but two arguments: 0 and 5." in found.evidence
    assert found.hint == "A decimal number is written with a point: 0.5."


def test_a_field_that_got_two_numbers_tells_of_the_point():
    text = "The 'data' field must be of type 'float'"
    found = diagnose_fault(fault("AssertionError", text, "msg.data = self.t", "field(tuple)"))
    assert found.mistake == "not-a-float"
    assert TUPLE in found.hint


@pytest.mark.parametrize(("text", "code"), [
    ("f() takes 1 positional argument but 3 were given", "f(1, 2)"),
    ("f() takes 1 positional argument but 4 were given", "f(1,2,3)"),
    ("f() takes 1 positional argument but 2 were given", "f('1,5', 2)"),
    ("boom", "f(0,5)"),
])  # fmt: skip
def test_two_numbers_that_are_no_decimal_comma(text, code):
    found = diagnose_fault(fault("TypeError", text, code))
    assert found is None or "two arguments" not in found.evidence


NOT_KNOWN = [
    ("ValueError", "boom", ""),
    ("AssertionError", "The data must be warm", ""),
    ("TypeError", "'NoneType' object does not support the context manager protocol", "with lock:"),
    ("TypeError", "'NoneType' object is not iterable", "list(None)"),
    ("KeyError", "'temperature'", "readings['temperature']"),
    ("RuntimeError", "cannot schedule new futures after shutdown", "x()"),
    ("RCLError", "failed to create node: out of memory", "x()"),
    ("TypeError", "f() missing 1 required positional argument: 'x'", "y = f()"),
    ("TypeError", "unsupported operand type(s) for +: 'float' and 'list'", "x + y"),
    ("OSError", "[Errno 28] No space left on device", "open('x')"),
]


def test_a_method_of_one_s_own_that_wants_more_is_told_what():
    missing = "M.change() missing 1 required positional argument: 'mode'"
    found = diagnose_fault(fault("TypeError", missing, "self.change()"))
    assert found.mistake == "argument-missing"
    assert "change wants mode" in found.evidence


def test_a_name_that_is_asked_for_on_its_own_line_may_lack_its_quotes():
    said = "cannot access local variable 'low' where it is not associated with a value"
    found = diagnose_fault(fault("UnboundLocalError", said, "low = self.get_parameter(low).value"))
    assert (found.mistake, "quotes" in found.hint) == ("no-value-yet", True)


@pytest.mark.parametrize(("kind", "text", "code"), NOT_KNOWN)
def test_what_is_not_known_gets_no_name(kind, text, code):
    assert named(kind, text, code) is None


def test_init_in_a_with_statement_is_known_by_its_line():
    # Python 3.10 words it so.
    assert named("AttributeError", "__enter__", "with rclpy.init():") == "init-in-with"
    assert named("AttributeError", "__enter__", "with lock:") is None


def test_a_future_that_is_asked_for_its_result_too_soon_is_known_by_its_line():
    text = "int() argument must be a string, a bytes-like object or a real number, not 'NoneType'"
    assert named("TypeError", text, "x = int(self.reading.result())") == "await-missing"
    assert named("TypeError", text, "x = int(self.reading)") == "none-used"


def test_a_call_that_was_right_says_nothing():
    asked = "create_publisher(message_type[Float32], str, QoSProfile)"
    assert named("RCLError", "out of memory", "x()", asked) is None
    asked = "create_subscription(message_type[Float32], str, function[f(msg)], int)"
    assert named("RCLError", "out of memory", "x()", asked) is None


def test_evidence_is_who_raised_what_it_means_and_the_line():
    found = diagnose_fault(fault("TypeError", KNOWN[5][2], "self.publisher_.publish(25.0)"))
    assert found.evidence == (
        "tick raised TypeError. publish was given a bare value, a float, and not a message. "
        "Line 4: `self.publisher_.publish(25.0)`."
    )


@pytest.mark.parametrize(
    ("asked", "words"),
    [
        ("field(int)", "is an int."), ("field(NoneType)", "is None."), ("field(str)", "is a str."),
        ("field(Decimal)", "is an object of type Decimal."), ("", "is something else."),
    ],
)  # fmt: skip
def test_the_type_of_a_value_that_the_line_does_not_show(asked, words):
    found = diagnose_fault(fault(*KNOWN[0][1:], "msg.data = 9 * 2", asked))
    assert f"takes a float, and what it was given {words}" in found.evidence


def test_the_error_s_own_words_are_spoken_of_only_where_they_stand():
    one = fault(*KNOWN[10][1:], "self.create_publisher(float, 't', 10)")
    assert "ROS 1" not in diagnose_fault(one).evidence
    assert "Never mind ROS 1" in meaning_of(one).beside_error


def test_what_is_said_after_a_lead_has_none_of_its_own():
    two_types = fault("RCLError", "Failed to create subscription: invalid allocator, at /x.c:261")
    assert meaning_of(two_types).beside_error.startswith("The topic exists already")


def test_a_name_that_only_begins_alike_is_asked_about():
    said = "'A' object has no attribute 'publish_temperature'. Did you mean: 'publish_humidity'?"
    found = diagnose_fault(fault("AttributeError", said))
    assert found.evidence.endswith("publish_temperature; it has publish_humidity.")
    assert found.hint == "Is that the one?"


def test_without_a_line_none_is_mentioned():
    assert "Line" not in diagnose_fault(fault("SystemExit", "3")).evidence


def test_a_deadline_is_no_exception_of_the_learner_s():
    late = fault("DeadlinePassed", "still running after 5 s", "while True:")
    assert diagnose_fault(late).evidence == (
        "tick does not return: still running after 5 s. Line 4: `while True:`."
    )


@pytest.mark.parametrize("what", ["publishers on /temperature", "subscriptions to /t", "timers"])
def test_what_is_made_at_each_call_is_no_callback_that_does_not_return(what):
    late = fault("DeadlinePassed", f"600 {what} in 599 calls", "self.create(x)")
    found = diagnose_fault(late)
    assert found.mistake == "made-anew"
    assert found.evidence == (
        f"tick made 600 {what} in 599 calls, and each one slows the node down. Line 4: "
        "`self.create(x)`."
    )
    assert "once, in the constructor" in found.hint


@pytest.mark.parametrize(
    ("code", "hint"),
    [("while True:", "timer"), ("time.sleep(9)", "timer"), ("x = solve(y)", "What ends it?")],
)
def test_a_constructor_that_does_not_return_is_no_callback(code, hint):
    late = fault("DeadlinePassed", "still running after 5 s", code, callback="__init__")
    found = diagnose_fault(late)
    assert found.mistake == "constructor-blocks"
    assert found.evidence.startswith("The constructor does not return: still running after 5 s.")
    assert hint in found.hint
    assert "A callback" not in found.hint


def test_the_first_tick_raised_and_not_a_callback_called_nothing():
    none = fault("TypeError", "'NoneType' object is not callable", callback="nothing")
    assert diagnose_fault(none).evidence.startswith("The first tick raised TypeError. ")


def test_what_the_session_refused_is_complete():
    text = "3 is not a node, but of type int."
    assert diagnose_fault(fault("NodeClassError", text, callback="add")).evidence == text


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


def test_every_row_of_a_node_is_recognised():
    # Some ids are chosen from a table; the tests above show them.
    shown = {mistake for mistake, *_ in (*KNOWN, *BY_CALL)}
    rows = {MISTAKES[name].row for name in ids_in_the_room() | shown}
    assert {*range(1, 20), 28, 29, 30} <= rows
