"""Calls around a quality of service that fail: a profile, a duration, the callbacks of events.

rclpy checks most of what a `QoSProfile` is given with an `assert` that says nothing.
"""

from __future__ import annotations

import re

from rosbeat.diagnosis.meaning import Meaning, matched
from rosbeat.records import Fault

_CALLS = r"QoSProfile|Duration|SubscriptionEventCallbacks|PublisherEventCallbacks"
_POLICIES = (
    "history", "depth", "reliability", "durability", "lifespan", "deadline", "liveliness",
    "liveliness_lease_duration", "avoid_ros_namespace_conventions",
)  # fmt: skip
_TAKES = {
    "QoSProfile": "depth=, reliability=, durability=, deadline= or lifespan=",
    "Duration": "seconds= or nanoseconds=",
}
_EVENTS = "the name of an event, such as deadline= or incompatible_qos="


def no_depth(fault: Fault) -> Meaning | None:
    """A profile that does not say how long the queue is."""
    if fault.kind != "InvalidQoSProfileException" or "depth" not in fault.text:
        return None
    return Meaning(
        "depth-missing",
        "QoSProfile was not told how many messages the queue holds.",
        "A profile is made with depth= and with whatever else is not as usual.",
    )


def without_a_name(fault: Fault) -> Meaning | None:
    """`Duration(2)`: an argument that has to have a name."""
    found = matched(fault, rf"^({_CALLS})\.__init__\(\) takes 1 positional", "TypeError")
    if not found:
        return None
    return Meaning(
        "wrong-argument",
        f"{found[1]} was given something without a name.",
        f"What it takes has a name in front: {_TAKES.get(found[1], _EVENTS)}.",
    )


def of_another_name(fault: Fault) -> Meaning | None:
    """An argument under a name that is not there."""
    found = matched(fault, rf"^({_CALLS})\.__init__\(\) got an unexpected .*'(\w+)'", "TypeError")
    called, name = (found[1], found[2]) if found else ("QoSProfile", _unknown_policy(fault))
    if not name:
        return None
    return Meaning(
        "wrong-argument",
        f"{called} has no argument {name}.",
        f"It takes {_TAKES.get(called, _EVENTS)}. Compare letter by letter.",
    )


def _unknown_policy(fault: Fault) -> str:
    found = matched(
        fault, r"^Invalid arguments passed to .*dict_keys\(\[(.*)\]\)", "AssertionError"
    )
    names = re.findall(r"\w+", found[1]) if found else []
    return next((name for name in names if name not in _POLICIES), "")


def of_another_kind(fault: Fault) -> Meaning | None:
    """A text or a number where a policy or a duration belongs."""
    if fault.kind != "AssertionError" or fault.text:
        return None
    policies = [one for one in _POLICIES if re.search(rf"\b{one}\s*=(?!=)", fault.code)]
    if not policies and not re.search(r"\bQoSProfile\(", fault.code):
        return None
    if len(policies) > 1 and "depth" in policies:
        policies.remove("depth")  # a number, and people know how to write one
    which = policies[0] if len(policies) == 1 else "one of the policies"
    return Meaning(
        "wrong-argument",
        f"QoSProfile was given something for {which} that cannot be one.",
        "A depth is a whole number, a deadline or a lifespan is a Duration, and for reliability "
        "and durability there are names in ReliabilityPolicy and DurabilityPolicy.",
    )


def no_such_policy(fault: Fault) -> Meaning | None:
    """`DurabilityPolicy.TRANSIENT`: Python 3.11 says no more than the name."""
    if not matched(fault, r"^[A-Za-z_]+$", "AttributeError"):
        return None
    found = re.search(rf"(\w*Policy)\.{fault.text}\b", fault.code)
    if not found:
        return None
    return Meaning(
        "wrong-attribute",
        f"{found[1]} has no {fault.text}.",
        f"Compare the name with the ones on the page, or print list({found[1]}).",
    )


def event_callback_called(fault: Fault) -> Meaning | None:
    """`deadline=self.on_silence()`: called, and not handed over, or a callback among arguments."""
    found = matched(fault, r"(\w+)\(\) missing 1 required positional argument", "TypeError")
    if not found or fault.callback != "__init__":
        return None
    call = rf"\.{found[1]}\(\)"
    if not re.search(rf"EventCallbacks\(.*{call}|^\w+=\w+{call}|^\w+, .*{call},", fault.code):
        return None
    return Meaning(
        "callback-called",
        f"{found[1]} is called while the node is being made, and not handed over.",
        "Hand over the method itself, without brackets after its name: it is called later.",
    )


def no_events(fault: Fault) -> Meaning | None:
    """`event_callbacks=self.on_silence`: a method where a set of callbacks belongs."""
    found = matched(fault, r"'(\w+)' object has no attribute 'create_event_h", "AttributeError")
    if not found:
        return None
    method = found[1] in ("method", "function")
    given = "the method itself" if method else f"something of type {found[1]}"
    return Meaning(
        "wrong-argument",
        f"event_callbacks was given {given}, which does not say for which event it is.",
        "A subscription takes SubscriptionEventCallbacks(...), a publisher "
        "PublisherEventCallbacks(...); inside, each event has a name.",
    )


def events_of_the_other_side(fault: Fault) -> Meaning | None:
    """`PublisherEventCallbacks` for a subscription, or the other way round."""
    if not matched(fault, r"incompatible constructor arguments.*\n.*EventHandle", "TypeError"):
        return None
    return Meaning(
        "wrong-argument",
        "The event callbacks are made for the other side of a topic.",
        "A subscription takes SubscriptionEventCallbacks, a publisher PublisherEventCallbacks.",
    )
