"""Callbacks and timers: rows 9, 10 and 16 of the table."""

from __future__ import annotations

import re

from rosbeat.diagnosis.calls import Asked, Given, asked_of
from rosbeat.diagnosis.entities import callback_called
from rosbeat.diagnosis.meaning import Meaning, called_by_ros, matched
from rosbeat.records import Fault

_REFUSED = r"callback should be either be callable|invalid method signature"
#: How `Fault.asked` describes a callback that was called while the call was being prepared.
CALLED = "called"
_HAND_OVER = "Hand over the method itself, without brackets after its name: ROS calls it later."


def refused_callback(fault: Fault) -> Meaning | None:
    """A subscription's callback that cannot be called with a message (rows 9 and 10)."""
    if not matched(fault, _REFUSED, "RuntimeError", "ValueError"):
        return None
    asked = asked_of(fault)
    callback = _callback_of(asked) if asked else None
    if callback is None:
        return Meaning(
            "wrong-argument",
            "What stands in the place of the callback cannot be called with a message.",
            f"A callback takes self and the message. {_HAND_OVER}",
        )
    if callback.role == "none":
        return callback_called("The callback of the subscription")
    return _parameters(callback) if callback.role in ("callback", "unknown") else None


def _callback_of(asked: Asked) -> Given | None:
    if "callback" in asked.named:
        return asked.named["callback"]
    return asked.given[2] if len(asked.given) > 2 else None


def _parameters(callback: Given) -> Meaning:
    names = callback.parameters
    if names is None:
        means = f"{callback.name or 'The callback'} cannot be called with a message."
    elif names and names[0] != "self" and callback.kind == "method":
        means = f"{callback.name} has no parameter self, so the message finds no place."
    else:
        means = f"{callback.name} has no parameter for the message."
    return Meaning("callback-parameters", means, _WITH_MESSAGE)


_WITH_MESSAGE = (
    "Python hands a method its own object first, and ROS hands a subscription's callback the "
    "message: which two parameters does it need?"
)


def called_with_others(fault: Fault) -> Meaning | None:
    """A timer's callback that takes a message, or no self (row 10)."""
    if not called_by_ros(fault):
        return None
    found = matched(fault, r"^([\w.<>]*?)(\w+)\(\) (takes|missing) (\d+)", "TypeError")
    if not found or found[2] == "__init__":
        return None
    if found[3] == "takes" and found[4] == "0":
        return Meaning(
            "callback-parameters",
            f"{found[2]} takes no parameter, and Python hands every method its own object.",
            "Compare its `def` line with those of the other methods of a class.",
        )
    if found[3] == "missing":
        return Meaning(
            "callback-parameters",
            f"{found[2]} wants more than it is given: a timer calls its callback without "
            "arguments.",
            "A message comes only to the callback of a subscription. Which parameters does a "
            "timer's callback need?",
        )
    return None


def called_at_once(fault: Fault) -> Meaning | None:
    """`create_subscription(..., self.listen(), 10)`: called, and without its arguments (row 9)."""
    asked = asked_of(fault)
    if asked and asked.given and asked.given[0].kind == CALLED:
        return _called(asked.given[0].name)
    found = matched(fault, r"(\w+)\(\) missing \d required positional argument", "TypeError")
    name = found[1] if found else ""
    if not found and matched(fault, r"name 'msg' is not defined", "NameError"):
        handed = re.search(r"\.(\w+)\(msg\)", fault.code)
        name = handed[1] if handed else ""
    return _called(name) if name and is_argument(fault.code, name) else None


def _called(name: str) -> Meaning:
    return Meaning(
        "callback-called",
        f"{name} is called while the node is being made, and not handed over.",
        _HAND_OVER,
    )


def is_argument(code: str, name: str) -> bool:
    """Whether a line calls a method in order to hand over what it returns.

    Args:
        code: A line of source, perhaps one of several of a call.
        name: The method.
    """
    call = rf"\.{re.escape(name)}\([^()]*\)"
    at_once = r"(?:(?!\blambda\b).)*"  # what stands in a lambda is called later
    return (
        re.search(rf"create_\w+\({at_once}{call}|^\w+{call},$|^callback=\w+{call}", code)
        is not None
    )


def nothing_to_call(fault: Fault) -> Meaning | None:
    """A timer that was given `self.tick()`: it fails at its first tick (row 9)."""
    found = matched(fault, r"^'(\w+)' object is not callable$", "TypeError")
    if not found or not called_by_ros(fault):
        return None
    if found[1] == "NoneType":
        return callback_called("The callback of the timer")
    return Meaning(
        "wrong-argument",
        f"The timer was given an object of type {found[1]} to call, which cannot be called.",
        "A callback is a function or a method: its name, without quotes and brackets.",
    )


_PERIOD = "The period is a number of seconds above zero, such as 0.5 or 2."
_ORDER = "create_timer takes the time between two calls, in seconds, and then the callback."


def wrong_timer(fault: Fault) -> Meaning | None:
    """A call of `create_timer` that fails."""
    asked = asked_of(fault)
    if asked is None or asked.method != "create_timer":
        return None
    period, callback = _part(asked, 0, "timer_period_sec"), _part(asked, 1, "callback")
    if period and period.role == "callback":
        return _callback_first(callback)
    if callback is None:
        return Meaning("callback-missing", "create_timer was not told what to call.", _ORDER)
    if period is None:
        return Meaning("argument-missing", "create_timer was not told how often.", _ORDER)
    if len(asked.given) > 2:
        return Meaning("wrong-argument", "create_timer was given an argument too many.", _ORDER)
    return _bad_period(period)


def _callback_first(second: Given | None) -> Meaning:
    if second is None:
        return Meaning("argument-missing", "create_timer was not told how often.", _ORDER)
    return Meaning(
        "arguments-swapped", "create_timer got the callback in the place of the period.", _ORDER
    )


def _part(asked: Asked, at: int, name: str) -> Given | None:
    return asked.named.get(name) or (asked.given[at] if len(asked.given) > at else None)


def _bad_period(period: Given) -> Meaning:
    means = f"create_timer got {period} as the time between two calls."
    if period.kind in ("int", "float"):
        means = "The time between two calls of the timer is a number that no clock can wait for."
    return Meaning("wrong-rate", means, _PERIOD)


def blocks(fault: Fault) -> Meaning | None:
    """A callback or a constructor that does not return (row 16)."""
    if fault.kind == "DeadlinePassed":
        return _stuck_making(fault) if fault.callback == "__init__" else _stuck(fault)
    if fault.kind == "DeadlockError":
        return Meaning("callback-blocks", fault.text.partition("\n")[0], _WHO_SPINS)
    if not matched(fault, r"was called (from )?inside|spin_once was called for", "SessionError"):
        return None
    call = matched(fault, r"`?(rclpy\.\w+|[\w.]+)`? was called")
    return Meaning(
        "callback-blocks",
        f"{call[1] if call else 'A wait'} waits for callbacks, and none can run before this one "
        "has returned.",
        _WHO_SPINS,
    )


_WHO_SPINS = (
    "A node only says what is to be done, in callbacks that return soon; spinning is the "
    "business of whoever runs the node."
)


def _stuck(fault: Fault) -> Meaning:
    where = fault.callback or "The program"
    to_try = "While it runs, the node can do nothing else. What ends it?"
    if _waits(fault):
        to_try = "A callback must not wait: the node is deaf meanwhile. What comes later, or again "
        to_try += "and again, is a timer's business."
    elif _loops(fault):
        to_try = "A callback does its work once and returns. What is to happen again and again is "
        to_try += "a timer's business."
    return Meaning("callback-blocks", f"{where} does not return: {fault.text}.", to_try)


def _stuck_making(fault: Fault) -> Meaning:
    to_try = "There is no node before its constructor has returned. What ends it?"
    if _waits(fault) or _loops(fault):
        to_try = "A constructor sets the node up and returns; only then do callbacks run. What "
        to_try += "comes later, or again and again, is a timer's business."
    return Meaning("constructor-blocks", f"The constructor does not return: {fault.text}.", to_try)


def _waits(fault: Fault) -> bool:
    return re.search(r"\b(sleep|wait|input|join)\(", fault.code) is not None


def _loops(fault: Fault) -> bool:
    return re.match(r"(while|for)\b", fault.code) is not None


def endless(fault: Fault) -> Meaning | None:
    """Callbacks that cause each other while no time passes."""
    if fault.kind != "EndlessChainError" or not fault.text:
        return None
    if matched(fault, r"^A timer of "):
        return Meaning("wrong-rate", fault.text, _PERIOD)
    return Meaning(
        "endless-chain",
        fault.text,
        "Each callback causes the next, and the clock stands still. Does a node hear what it "
        "publishes itself?",
    )
