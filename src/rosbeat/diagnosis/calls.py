"""Name the mistake in a call of rclpy: arguments missing, swapped, or of another kind.

rclpy's own text is the same for a missing callback and a missing queue depth. So a call that fails
is recorded as data, with the types of what it was given (`records.FailedCall`). In a terminal,
where a program's output is all that is known, it is read from the line of source.
"""

from __future__ import annotations

import ast
import re
from typing import NamedTuple, TypeGuard

from rosbeat.diagnosis.mistakes import Diagnosis
from rosbeat.records import Argument, FailedCall, Fault, is_argument

#: The types of `std_msgs`, which learners of this course use.
MESSAGES = frozenset(
    (
        *("Bool", "Byte", "Char", "ColorRGBA", "Empty", "Float32", "Float64", "Header", "String"),
        *("Int8", "Int16", "Int32", "Int64", "UInt8", "UInt16", "UInt32", "UInt64"),
        *("Float32MultiArray", "Float64MultiArray", "Int32MultiArray"),
    )
)

_SPIN = re.compile(r"\b(spin|spin_once|spin_until_future_complete)\(")


def matched(fault: Fault, pattern: str) -> re.Match[str] | None:
    """Look for a pattern in an error as a traceback ends with it, such as `TypeError: ...`."""
    return re.search(pattern, f"{fault.kind}: {fault.text}")


def called_by_ros(fault: Fault) -> bool:
    """Return whether the call that failed was made by ROS, and not by a line of the learner's."""
    return not fault.line or _SPIN.search(fault.code) is not None


def article(word: str) -> str:
    """Return a word with `a` or `an` before it."""
    return f"an {word}" if word[:1].lower() in tuple("aeio") else f"a {word}"


# What a call was given.

#: What an argument could be used as, by its kind; any other kind is used as nothing here.
_ROLES = {
    "message_type": "type",
    "type": "type",
    "module": "type",
    "str": "topic",
    "int": "depth",
    "QoSProfile": "depth",
    "method": "callback",
    "function": "callback",
    "partial": "callback",
    "builtin_function_or_method": "callback",
    "NoneType": "none",
    "message": "message",
    "float": "number",
    "unknown": "unknown",
}
#: How an argument is called in a sentence, by its kind.
_WORDS = {
    "message_type": "the message type {}",
    "type": "the type {}",
    "module": "a module",
    "str": "a string",
    "int": "a whole number",
    "float": "a number with a decimal point",
    "QoSProfile": "a QoS profile",
    "method": "the method {}",
    "function": "the function {}",
    "NoneType": "None",
    "message": "a message of type {}",
}


def role_of(argument: Argument) -> str:
    """Return what an argument could be used as: `type`, `topic`, `callback`, `depth`, ..."""
    return _ROLES.get(argument.kind, "other")


def in_words(argument: Argument) -> str:
    """Return an argument as a part of a sentence, such as `the method tick`."""
    return _WORDS.get(argument.kind, f"an object of type {argument.kind}").format(argument.name)


# Publishers and subscriptions.


class _Parameter(NamedTuple):
    role: str
    name: str
    words: str


_TYPE = _Parameter("type", "msg_type", "the message type")
_TOPIC = _Parameter("topic", "topic", "the topic's name")
_CALLBACK = _Parameter("callback", "callback", "the callback")
_DEPTH = _Parameter("depth", "qos_profile", "the queue depth")
_WANTED = {
    "create_publisher": (_TYPE, _TOPIC, _DEPTH),
    "create_subscription": (_TYPE, _TOPIC, _CALLBACK, _DEPTH),
}
#: What else these calls may be given by name.
_OPTIONS = frozenset(
    ("callback_group", "event_callbacks", "qos_overriding_options", "publisher_class", "raw")
)
_MISSING = {"depth": "depth-missing", "callback": "callback-missing"}
#: In which order each call takes its arguments.
ORDER = {
    "create_publisher": "create_publisher takes the message type, the topic and the queue depth, "
    "in that order.",
    "create_subscription": "create_subscription takes the message type, the topic, the callback "
    "and the queue depth, in that order.",
    "create_timer": "create_timer takes the period in seconds, and then the callback.",
    "create_service": "create_service takes the service type, the name and the callback. Unlike a "
    "subscription, a service needs no queue depth.",
}
#: What belongs in each place.
KINDS = {
    "topic": "A topic name is a string in quotes. A number in its place belongs to another "
    "argument.",
    "callback": "A callback is a function or a method. Give its name without quotes or "
    "parentheses.",
    "depth": "The queue depth is a whole number, 1 or more, without quotes.",
}


def wrong_call(fault: Fault) -> Diagnosis | None:
    """Recognise a publisher or a subscription that was given the wrong arguments."""
    call = fault.asked
    if call is None or call.method not in _WANTED:
        return None
    wanted, order = _WANTED[call.method], ORDER[call.method]
    unknown = [name for name in call.named if name not in {one.name for one in wanted} | _OPTIONS]
    if unknown:
        means = f"{call.method} has no argument called {unknown[0]}."
        return Diagnosis("wrong-argument", means, order)
    if len(call.given) > len(wanted):
        means = f"{call.method} was given {len(call.given)} arguments, but takes {len(wanted)}."
        return Diagnosis("wrong-argument", means, order)
    left = [one for one in wanted if one.name not in call.named]
    return _missing(call, left) or _swapped(call, left) or _of_another_kind(call, left)


def _missing(call: FailedCall, left: list[_Parameter]) -> Diagnosis | None:
    lacking = len(left) - len(call.given)
    if lacking <= 0:
        return None
    # What cannot be told by its kind is taken for what its place says.
    known = {one.role for one in left}
    roles = [
        role if (role := role_of(given)) in known else wanted.role
        for given, wanted in zip(call.given, left, strict=False)
    ]
    missing = [one for one in left if one.role not in roles] or left[len(call.given) :]
    words = " and ".join(one.words for one in missing[:lacking])
    name = _MISSING.get(missing[0].role, "argument-missing") if lacking == 1 else "argument-missing"
    asks = " What is the last one for?" if name == "depth-missing" else ""
    if name == "callback-missing" and call.method == "create_subscription":
        asks = " To send messages, a node creates a publisher instead."
    means = f"{call.method} was called without {words}."
    return Diagnosis(name, means, ORDER[call.method] + asks)


def _swapped(call: FailedCall, left: list[_Parameter]) -> Diagnosis | None:
    got, order = [role_of(one) for one in call.given], [one.role for one in left]
    if got == order or sorted(got) != sorted(order):
        return None
    at = next(at for at, role in enumerate(order) if got[at] != role)
    means = f"{call.method} got {in_words(call.given[at])} instead of {left[at].words}."
    return Diagnosis("arguments-swapped", means, ORDER[call.method])


def _of_another_kind(call: FailedCall, left: list[_Parameter]) -> Diagnosis | None:
    named = [(one, call.named[one.name]) for one in _WANTED[call.method] if one.name in call.named]
    for (role, _, words), given in [*zip(left, call.given, strict=False), *named]:
        found = role_of(given)
        if found == "unknown" or found == role != "type":
            continue
        if role == "type" and given.kind != "message_type":
            return no_message_type(given)
        if role == "callback" and given.kind == "NoneType":
            return callback_called("The subscription's callback")
        if role != "type" and not (role == "callback" and found == "other"):
            mistake = "wrong-depth" if role == "depth" else "wrong-argument"
            means = f"{call.method} got {in_words(given)} instead of {words}."
            return Diagnosis(mistake, means, KINDS[role])
    return None


def no_message_type(given: Argument | None) -> Diagnosis:
    """Return the meaning of something that stands in the place of the message type (row 8)."""
    if given is not None and given.kind == "message":
        return Diagnosis(
            "not-a-message-type",
            f"A message of type {given.name} was given where its class is expected.",
            "This call needs the class itself, because it doesn't send a message yet. What do "
            "the parentheses do?",
        )
    what = in_words(given) if given is not None else "something else"
    return Diagnosis(
        "not-a-message-type",
        f"The message type is missing: this call got {what} instead.",
        "A message type is a class that you import from a message package. Which type does this "
        "topic carry?",
    )


def callback_called(subject: str) -> Diagnosis:
    """Return the meaning of a callback that is None, since it was called (row 9)."""
    return Diagnosis(
        "callback-called",
        f"{subject} is None. That happens when the method is called right here: its return "
        "value, None, is passed instead of the method.",
        "Pass the method itself, without parentheses after its name: ROS calls it later.",
    )


# The callback of a subscription.

_HAND_OVER = "Pass the method itself, without parentheses after its name: ROS calls it later."
_WITH_MESSAGE = (
    "Python passes a method its own object, and ROS passes a subscription's callback the "
    "message. Which two parameters does the callback need?"
)


def refused_callback(fault: Fault) -> Diagnosis | None:
    """Recognise a callback that cannot be called with a message (rows 9 and 10)."""
    refused = r"callback should be either be callable|invalid method signature"
    if not matched(fault, refused):
        return None
    callback = _part(fault.asked, 2, "callback") if fault.asked else None
    if callback is None:
        return Diagnosis(
            "wrong-argument",
            "The callback argument is something that cannot be called with a message.",
            f"A callback takes self and the message. {_HAND_OVER}",
        )
    role = role_of(callback)
    if role == "none":
        return callback_called("The subscription's callback")
    return _parameters(callback) if role in ("callback", "unknown") else None


def _part(call: FailedCall, at: int, name: str) -> Argument | None:
    return call.named.get(name) or (call.given[at] if len(call.given) > at else None)


def _parameters(callback: Argument) -> Diagnosis:
    names = callback.parameters
    if names is None:
        means = f"{callback.name or 'The callback'} cannot be called with a message."
    elif names and names[0] != "self" and callback.kind == "method":
        means = (
            f"{callback.name} has no self parameter, so there is no parameter left for the message."
        )
    else:
        means = f"{callback.name} has no parameter for the message."
    return Diagnosis("callback-parameters", means, _WITH_MESSAGE)


def called_at_once(fault: Fault) -> Diagnosis | None:
    """Recognise a callback that was called in order to be handed over (row 9)."""
    call = fault.asked
    if call and call.given and call.given[0].kind == "called":
        return _called(call.given[0].name)
    found = matched(fault, r"(\w+)\(\) missing \d required positional arguments?:")
    name = found[1] if found else ""
    if not found and matched(fault, r"name 'msg' is not defined"):
        handed = re.search(r"\.(\w+)\(msg\)", fault.code)
        name = handed[1] if handed else ""
    return _called(name) if name and is_argument(fault.code, name) else None


def _called(name: str) -> Diagnosis:
    means = f"{name} is called while the node is being created, instead of being passed."
    return Diagnosis("callback-called", means, _HAND_OVER)


# Timers.


def wrong_timer(fault: Fault) -> Diagnosis | None:
    """Recognise a `create_timer` that was given the wrong arguments."""
    call = fault.asked
    if call is None or call.method != "create_timer":
        return None
    order = ORDER["create_timer"]
    period, callback = _part(call, 0, "timer_period_sec"), _part(call, 1, "callback")
    if period and role_of(period) == "callback" and callback:
        means = "create_timer got the callback instead of the period."
        return Diagnosis("arguments-swapped", means, order)
    if period is None or role_of(period) == "callback":
        return Diagnosis("argument-missing", "create_timer was called without a period.", order)
    if callback is None:
        return Diagnosis("callback-missing", "create_timer was called without a callback.", order)
    if len(call.given) > 2:
        return Diagnosis("wrong-argument", "create_timer was given too many arguments.", order)
    means = f"create_timer got {in_words(period)} as its period."
    if period.kind in ("int", "float"):
        means = "The timer's period is a number of seconds that no clock can measure."
    return Diagnosis("wrong-rate", means, PERIOD)


#: What the period of a timer may be.
PERIOD = "A timer's period is a number of seconds above zero, such as 0.5 or 2."


# A call as a line of source shows it. What the line does not tell is `unknown`.


def written_call(code: str) -> FailedCall | None:
    """Return the call that makes an entity in a line of source; None if it holds none, whole."""
    try:
        tree = ast.parse(code)
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return None
    call = next((node for node in ast.walk(tree) if _makes_an_entity(node)), None)
    if call is None:
        return None
    return FailedCall(
        ast.unparse(call.func).split(".")[-1],
        tuple(_written(one) for one in call.args),
        {one.arg: _written(one.value) for one in call.keywords if one.arg},
    )


def _makes_an_entity(node: ast.AST) -> TypeGuard[ast.Call]:
    if not isinstance(node, ast.Call) or not isinstance(node.func, ast.Attribute):
        return False
    unpacks = any(isinstance(one, ast.Starred) for one in node.args)
    unpacks = unpacks or any(one.arg is None for one in node.keywords)
    return node.func.attr.startswith("create_") and not unpacks


def _written(node: ast.expr) -> Argument:
    if isinstance(node, ast.Constant):
        return Argument(type(node.value).__name__)
    if isinstance(node, ast.Lambda):
        return Argument("function")
    if isinstance(node, ast.Attribute):
        own = isinstance(node.value, ast.Name) and node.value.id == "self"
        return Argument("method", node.attr) if own else _named(node.attr)
    if isinstance(node, ast.Name):
        return _named(node.id)
    if isinstance(node, ast.Call) and ast.unparse(node.func).startswith("self."):
        return Argument("NoneType")  # what a callback returns that is called on the spot
    return Argument("unknown")


def _named(name: str) -> Argument:
    if name in MESSAGES:
        return Argument("message_type", name)
    plain = name in ("float", "int", "str", "bool")
    return Argument("type", name) if plain else Argument("unknown")
