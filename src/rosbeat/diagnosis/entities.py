"""Calls that make publishers, subscriptions and timers: rows 6 to 10 of the table."""

from __future__ import annotations

from rosbeat.diagnosis.calls import Asked, Given, asked_of
from rosbeat.diagnosis.meaning import Meaning, matched
from rosbeat.records import Fault

#: What each call is given, in order: the role, rclpy's own name, the words for it.
_TYPE = ("type", "msg_type", "the message type")
_TOPIC = ("topic", "topic", "the topic's name")
_CALLBACK = ("callback", "callback", "the callback")
_DEPTH = ("depth", "qos_profile", "the queue depth")
_WANTED = {
    "create_publisher": (_TYPE, _TOPIC, _DEPTH),
    "create_subscription": (_TYPE, _TOPIC, _CALLBACK, _DEPTH),
}
#: What else these calls may be given by name.
_OPTIONS = frozenset(
    ("callback_group", "event_callbacks", "qos_overriding_options", "publisher_class", "raw")
)
_MISSING = {"depth": "depth-missing", "callback": "callback-missing"}
_ORDER = {
    "create_publisher": "create_publisher takes the message type, the topic and the queue depth, "
    "in this order.",
    "create_subscription": "create_subscription takes the message type, the topic, the callback "
    "and the queue depth, in this order.",
}


def wrong_call(fault: Fault) -> Meaning | None:
    """Arguments that are missing, swapped or of another kind."""
    asked = asked_of(fault)
    if asked is None or asked.method not in _WANTED:
        return None
    return (
        _unknown_name(asked)
        or _too_many(asked)
        or _missing(asked)
        or _swapped(asked)
        or _of_another_kind(asked)
    )


def _unknown_name(asked: Asked) -> Meaning | None:
    known = {name for _, name, _ in _WANTED[asked.method]} | _OPTIONS
    unknown = [name for name in asked.named if name not in known]
    if not unknown:
        return None
    return Meaning(
        "wrong-argument",
        f"{asked.method} has no argument called {unknown[0]}.",
        _ORDER[asked.method],
    )


def _too_many(asked: Asked) -> Meaning | None:
    wanted = _WANTED[asked.method]
    if len(asked.given) <= len(wanted):
        return None
    return Meaning(
        "wrong-argument",
        f"{asked.method} was given {len(asked.given)} arguments, and takes {len(wanted)}.",
        _ORDER[asked.method],
    )


def _missing(asked: Asked) -> Meaning | None:
    left = [one for one in _WANTED[asked.method] if one[1] not in asked.named]
    lacking = len(left) - len(asked.given)
    if lacking <= 0:
        return None
    # What cannot be told by its kind is taken for what its place says.
    places = zip(asked.given, left, strict=False)
    known = {role for role, _, _ in left}
    roles = [given.role if given.role in known else wanted[0] for given, wanted in places]
    missing = [one for one in left if one[0] not in roles] or left[len(asked.given) :]
    words = " and ".join(one[2] for one in missing[:lacking])
    name = _MISSING.get(missing[0][0], "argument-missing") if lacking == 1 else "argument-missing"
    return Meaning(
        name,
        f"{asked.method} got no argument for {words}.",
        _ORDER[asked.method] + (" What is the last one for?" if name == "depth-missing" else ""),
    )


def _swapped(asked: Asked) -> Meaning | None:
    wanted = [one for one in _WANTED[asked.method] if one[1] not in asked.named]
    got = [one.role for one in asked.given]
    order = [role for role, _, _ in wanted]
    if got == order or sorted(got) != sorted(order):
        return None
    at = next(at for at, role in enumerate(order) if got[at] != role)
    return Meaning(
        "arguments-swapped",
        f"{asked.method} got {asked.given[at]} in the place of {wanted[at][2]}.",
        _ORDER[asked.method],
    )


def _of_another_kind(asked: Asked) -> Meaning | None:
    for (role, _, words), given in _pairs(asked):
        if given.role == "unknown" or given.role == role != "type":
            continue
        if role == "type" and given.kind != "message_type":
            return no_message_type(given)
        if role == "callback" and given.kind == "NoneType":
            return callback_called("The callback of the subscription")
        if role != "type" and not (role == "callback" and given.role == "other"):
            return Meaning(
                "wrong-depth" if role == "depth" else "wrong-argument",
                f"{asked.method} got {given} in the place of {words}.",
                _KINDS[role],
            )
    return None


_KINDS = {
    "topic": "A topic's name is a text: it stands in quotes.",
    "callback": "A callback is a function or a method: its name, without quotes and brackets.",
    "depth": "The queue depth is a whole number from 1 up, without quotes.",
}


def _pairs(asked: Asked) -> list[tuple[tuple[str, str, str], Given]]:
    wanted = _WANTED[asked.method]
    left = [one for one in wanted if one[1] not in asked.named]
    named = [(one, asked.named[one[1]]) for one in wanted if one[1] in asked.named]
    return [*zip(left, asked.given, strict=False), *named]


def no_message_type(given: Given | None) -> Meaning:
    """What stands in the place of the message type is none (row 8)."""
    if given is not None and given.kind == "message":
        return Meaning(
            "not-a-message-type",
            f"A message of type {given.name} stands where its class belongs.",
            "Here the class itself is wanted: nothing is sent yet. What do the brackets do?",
        )
    what = f"{given}, which" if given is not None else "something that"
    return Meaning(
        "not-a-message-type",
        f"In the place of the message type stands {what} is none.",
        "Message types are classes that are imported from a package of messages. Which one does "
        "this topic carry?",
        "(Never mind ROS 1 in the error: it guesses.)",
    )


def callback_called(subject: str) -> Meaning:
    """The callback was called where it should have been handed over (row 9)."""
    return Meaning(
        "callback-called",
        f"{subject} is None. That happens when a method is called on the spot and what it "
        "returns, nothing, is handed over.",
        "Hand over the method itself, without brackets after its name: ROS calls it later.",
    )


def not_a_message_type(fault: Fault) -> Meaning | None:
    """Row 8 by rclpy's text alone."""
    if not matched(fault, r"has no attribute '_TYPE_SUPPORT'", "AttributeError"):
        return None
    return no_message_type(None)


def bad_depth(fault: Fault) -> Meaning | None:
    """A queue depth that is a text, a fraction, or below zero."""
    if not matched(fault, r"Expected QoSProfile or int|history depth must be greater"):
        return None
    return Meaning(
        "wrong-depth",
        "What stands in the place of the queue depth is no depth.",
        _KINDS["depth"],
    )


def by_text(fault: Fault) -> Meaning | None:
    """Rows 6 and 7 by rclpy's texts, where the call itself is not known: in a terminal."""
    if matched(fault, r"create_\w+\(\) missing 1 .*: 'qos_profile'", "TypeError"):
        what = matched(fault, r"create_publisher") is not None
        name = "depth-missing" if what else "argument-missing"
        rest = "" if what else ", or the callback before it,"
        return Meaning(
            name,
            f"An argument is missing: the queue depth{rest} was left out.",
            _ORDER["create_publisher" if what else "create_subscription"],
        )
    if matched(fault, r"rclpy_resolve_name\(\): incompatible function arguments", "TypeError"):
        return Meaning(
            "arguments-swapped",
            "In the place of the topic's name stands something that is no text.",
            "The order is: first the message type, then the topic's name as text, then the rest.",
        )
    return None
