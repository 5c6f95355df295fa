"""Services and actions: what a callback gives back, and how work on a goal ends."""

from __future__ import annotations

from rosbeat.diagnosis.calls import asked_of
from rosbeat.diagnosis.meaning import Meaning, called_by_ros, matched
from rosbeat.records import Fault

_ORDER = (
    "create_service takes the service type, the name and the callback. Unlike a subscription, a "
    "service needs no queue depth."
)


def no_response(fault: Fault) -> Meaning | None:
    """A service that cannot be made, or a callback that does not give back its response."""
    return _not_made(fault) or _not_given_back(fault)


def _not_made(fault: Fault) -> Meaning | None:
    """`create_service` of a message's type, or with too few or too many arguments."""
    found = matched(fault, r"^The service type provided is not valid \(<class '[\w.]*?(\w+)'>\)")
    if found:
        return Meaning(
            "wrong-argument",
            f"{found[1]} is no service type: it holds one message, and a service type holds two.",
            "A service is made from a class that has a Request and a Response inside. Which one?",
        )
    if matched(fault, r"^Node\.create_service\(\) takes 4 positional", "TypeError"):
        return Meaning("wrong-argument", "create_service was given an argument too many.", _ORDER)
    if matched(fault, r"^Node\.create_service\(\) missing 1 .*: 'callback'", "TypeError"):
        return Meaning("callback-missing", "create_service was given no callback.", _ORDER)
    return None


def _not_given_back(fault: Fault) -> Meaning | None:
    asked = asked_of(fault)
    if asked is None or asked.method != "send_response" or fault.kind != "TypeError":
        return None
    (given,) = asked.given or (None,)
    if given is not None and given.role == "none":
        means = f"{fault.callback} gives nothing back, so the client never gets an answer."
        return Meaning("response-missing", means, "The last line of a service's callback: return.")
    means = f"{fault.callback} gives back {given}, and not the response that it was handed."
    return Meaning(
        "response-wrong",
        means,
        "ROS hands the callback an empty response: fill its fields, and give that one back.",
    )


def no_result(fault: Fault) -> Meaning | None:
    """Work on a goal that gives back None, or something else than a result."""
    if not matched(fault, r"'result' field must be a sub message of type", "AssertionError"):
        return None
    return Meaning(
        "result-missing",
        "The work on a goal ends and gives no Result back.",
        "Make a Result of the action, fill its field, and return it.",
    )


def not_feedback(fault: Fault) -> Meaning | None:
    """`publish_feedback` of something else than a Feedback."""
    if fault.kind != "TypeError" or fault.text or "publish_feedback" not in fault.code:
        return None
    return Meaning(
        "feedback-wrong",
        "publish_feedback was given something else than a Feedback of the action.",
        "An action brings three classes: its Goal, its Feedback and its Result.",
    )


def bad_transition(fault: Fault) -> Meaning | None:
    """`canceled()` of a goal that nobody canceled, or a second end of a goal."""
    found = matched(fault, r"invalid transition from state (\w+) with event (\w+)")
    if not found:
        return None
    state, event = found.groups()
    if event == "CANCELED":
        means = "A goal was reported canceled, and nobody had asked for that."
        return Meaning("canceled-unasked", means, "Ask the goal handle first.")
    means = f"A goal that had ended ({state.lower()}) was ended again."
    return Meaning("ended-twice", means, "Each goal ends once: on each way only one of the calls.")


def not_whole(fault: Fault) -> Meaning | None:
    """Something else where a whole number belongs: a decimal, or a future that is not awaited."""
    if matched(fault, r"^(?!.* is not callable).*'Future'", "TypeError"):
        return Meaning(
            "await-missing",
            "A future stands where its result is meant.",
            "A future is an answer that is still to come. What does await do with it?",
        )
    if not matched(fault, r"'float' object cannot be interpreted as an integer", "TypeError"):
        return None
    return Meaning(
        "not-an-integer",
        "A number with a decimal point stands where a whole one belongs.",
        "A sequence of int32 takes whole numbers only, and 19.0 is none for Python.",
    )


def called_with_more(fault: Fault) -> Meaning | None:
    """A service's callback without `response`, or a parameter's without its list."""
    pattern = r"^(?:[\w.<>]*\.)?(\w+)\(\) takes (\d+) positional arguments? but (\d+) (?:was|were)"
    found = matched(fault, pattern, "TypeError")
    if not found or not called_by_ros(fault) or int(found[2]) > int(found[3]):
        return None
    name, takes, given = found[1], int(found[2]), int(found[3])
    if name != fault.callback or takes == 0:
        return None
    return Meaning(
        "callback-parameters",
        f"{name} takes {takes} arguments, and ROS calls it with {given}, self included.",
        "A service's callback is handed the request and a response to fill; that of an action the "
        "goal's handle; that of parameters a list of them.",
    )
