"""Name the mistake that an exception comes from.

`_RULES` is one table: the first rule that recognises an exception names it, and what none of them
recognises stays unnamed. Most rules are rows, which go by the error as a traceback ends with it
(`TypeError: ...`), and where that is not enough by the learner's line. What a row cannot say is a
function. Numbers of rows in brackets are those of the table in docs/mistakes.md.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Callable
from dataclasses import dataclass, replace
from difflib import get_close_matches

from rosbeat.diagnosis import calls
from rosbeat.diagnosis.calls import MESSAGES, article, called_by_ros, matched
from rosbeat.diagnosis.mistakes import Diagnosis
from rosbeat.diagnosis.modules import about_name, about_relative
from rosbeat.records import Fault

#: A rule knows one kind of mistake, and answers None if an exception is none of its kind.
Rule = Callable[[Fault], "Diagnosis | None"]
Found = re.Match[str]


@dataclass(frozen=True)
class Row:
    """Recognise a mistake by an exception's class and text.

    Attributes:
        mistake: The mistake's id.
        error: A regular expression that is looked for in the error, such as `TypeError: ...`.
        evidence: What happened; `{1}` is the first group of the pattern that has matched.
        hint: Where to look, with groups as well.
        line: A regular expression that the learner's line has to hold, too.
        when: What else has to be true.
    """

    mistake: str
    error: str
    evidence: str
    hint: str
    line: str = ""
    when: Callable[[Fault, Found], bool] = lambda _, __: True

    def __call__(self, fault: Fault) -> Diagnosis | None:
        """Return the meaning of an exception of this kind; None for any other."""
        found = matched(fault, self.error)
        if not found or not re.search(self.line, fault.code) or not self.when(fault, found):
            return None
        groups = (one.replace("'", "") for one in found.groups() if one is not None)
        words = [found[0], *groups]
        return Diagnosis(self.mistake, self.evidence.format(*words), self.hint.format(*words))


def meaning_of(fault: Fault) -> Diagnosis | None:
    """Return the known mistake that an exception comes from, without who raised it; else None."""
    found = (rule(fault) for rule in _RULES)
    return next((meaning for meaning in found if meaning is not None), None)


def diagnose_fault(fault: Fault) -> Diagnosis | None:
    """Return the mistake that caused an exception.

    Args:
        fault: The exception.

    Returns:
        The mistake, with the learner's own line as evidence; None if it is not a known one.
    """
    meaning = meaning_of(fault)
    return None if meaning is None else diagnosed(fault, meaning)


def diagnosed(fault: Fault, meaning: Diagnosis) -> Diagnosis:
    """Return a mistake with who raised, and the learner's line, as further evidence."""
    if fault.text == meaning.evidence:  # the session itself refused; its sentence is complete
        return meaning
    raised = _raised(fault) if fault.callback else ""
    return replace(meaning, evidence=f"{raised}{meaning.evidence}{line_of(fault)}")


def _raised(fault: Fault) -> str:
    if fault.kind == "DeadlinePassed":  # no exception of the learner's
        return ""
    ticks = matched(fault, r"object is not callable") and called_by_ros(fault)
    by = "" if ticks else fault.callback
    return f"{by or 'The first tick'} raised {fault.kind}. "


def line_of(fault: Fault) -> str:
    """Return the learner's line as the end of a sentence before it, or an empty text."""
    return f" Line {fault.line}: `{fault.code}`." if fault.line and fault.code else ""


def first_sentence(text: str) -> str:
    """Return the part of an error's text that says something.

    Errors of the middleware go on for lines, with addresses of objects and places in its own
    source files.
    """
    return text.split(", at /")[0].split("\n")[0].rstrip(".: ")


#: The message types that learners of this course use, as alternatives of a pattern.
_MESSAGE = "|".join(sorted(MESSAGES))


# Making a node, naming it, and ROS itself.

#: Attributes that `Node.__init__` makes, of which the first use without it complains.
_MADE_BY_NODE = (
    "_default_callback_group|_logger|_clock|_context|_parameter_overrides|_parameters|_timers|"
    "_publishers|_subscriptions|_descriptors|_allow_undeclared_parameters|_clients|_services|"
    "_guards|_rate_group|_on_set_parameters_callbacks|_Node__\\w+"
)
_SUPER = (
    "The parent's constructor turns your object into a node. Call it first in `__init__`, with "
    "the node's name."
)
_NAME = "The parent's constructor, super().__init__, takes the node's name, a string in quotes."


def _no_node(fault: Fault) -> Diagnosis | None:
    """Recognise something handed over that is no node; the sentence is the session's own."""
    if fault.kind != "NodeClassError" or not fault.text:
        return None
    to_try = "Pass the class that you wrote, by its name, without quotes or parentheses."
    if "is a class, but not a node" in fault.text:
        to_try = (
            "A class becomes a node through its parent, which is named in parentheses after the "
            "class's own name."
        )
    elif " returned, " in fault.text:
        to_try = (
            "A function that creates a node has to return it. What does the function's last line "
            "do?"
        )
    return Diagnosis("no-node", fault.text, to_try)


def _name_missing(fault: Fault) -> Diagnosis | None:
    """Recognise `super().__init__()` without a name (row 11)."""
    found = matched(fault, r"\b(\w*)Node\.__init__\(\) missing 1 .*'node_name'")
    # An `AlarmNode` is a class of the learner's, and only its heirs leave the name out.
    own = found and found[1] not in ("", "Lifecycle") and "super()" not in fault.code
    if not found or own:
        return None
    call = fault.asked
    if call and call.given and call.given[0].kind == "str":
        means = "Node.__init__ was called without self, the node that it initializes."
        return Diagnosis("super-missing", means, _SUPER)
    if fault.line and fault.callback == "__init__":
        return Diagnosis("node-name-missing", "The node was created without a name.", _NAME)
    return Diagnosis(
        "node-name-missing",
        "The class has no constructor of its own that gives the node a name.",
        "Look at the line that should begin the constructor: is it spelled `__init__`, with two "
        "underscores on each side, and is it inside the class?",
    )


def _wrong_name_argument(fault: Fault) -> Diagnosis | None:
    """Recognise `super().__init__(5)` and `super().__init__(self, 'name')`."""
    call = fault.asked
    if call is None or call.method != "Node.__init__":
        return None
    if len(call.given) > 1 and call.given[0].kind == call.given[1].kind:
        means = "super().__init__ was given self, although super() already passes it."
        return Diagnosis("wrong-argument", means, _NAME)
    name = call.named.get("node_name") or (call.given[1] if len(call.given) > 1 else None)
    if name is None or name.kind == "str":
        return None
    means = f"The node got {calls.in_words(name)} instead of its name."
    return Diagnosis("wrong-argument", means, _NAME)


_NODE_RULES: tuple[Rule, ...] = (
    _no_node,
    Row("exits", r"^SystemExit: ",
        "This line ends the whole program, and every node in it.",
        "A node runs until it is stopped from outside. Remove that line."),
    Row("super-missing", rf"has no attribute '({_MADE_BY_NODE})'",
        "The node is used before it is initialized: super().__init__ has not been called yet.",
        _SUPER),
    Row("super-missing", r"'super' object has no attribute '(\w+)'",
        "The parent's constructor is not called {1}.",
        _SUPER),
    Row("super-missing", r"'__init__' requires a 'super' object",
        "The parentheses after super are missing: super() finds the parent, super alone does not.",
        _SUPER),
    _name_missing,
    _wrong_name_argument,
    Row("invalid-name", r"unknown substitution|topic name .* is invalid",
        "The topic's name contains braces, and ROS cannot substitute their content.",
        "Only an f-string, with an f before its quotes, replaces braces with values."),
    # Row 12: ROS says in a sentence what is wrong with the name, and then the name.
    Row("invalid-name",
        r"^Invalid(?:NodeName|TopicName|ServiceName|Namespace)\w*: [\w ]+: (.+):\n\s*'(.*)'",
        "ROS does not allow the name '{2}': {1}.",
        "Names consist of English letters, digits and `_`, and begin with a letter. In the name "
        "of a topic or a service, a slash may separate two parts, but may not be the last "
        "character."),
    Row("type-mismatch", r"invalid allocator|existing topic name .* incompatible type",
        "The topic already exists with another message type.",
        "All messages on a topic have the same type. Which type do the other nodes use on this "
        "topic?"),
    Row("not-initialised", r"^(?:NotInitializedException|NoSessionError): ",
        "A node was created before ROS was started.",
        "A program starts ROS with one call, before it creates its first node. Look at the "
        "beginning of main."),
    # Where ROS runs already, `init` itself fails. Python 3.10 says no more than `__enter__`.
    Row("init-in-with",
        r"Context\.init\(\) must only be called once|: __enter__$"
        r"|'NoneType' object does not support the context manager protocol",
        "In this version of ROS, `rclpy.init` returns nothing, so `with` has nothing to work with.",
        "Newer versions of ROS support that form. Here, use two separate calls to start ROS and "
        "to shut it down.",
        r"\bwith\b.*\binit\("),
    Row("initialised-twice", r"Context\.init\(\) must only be called once",
        "ROS was started twice.",
        "A program starts ROS only once. Look for a second rclpy.init, in main and elsewhere."),
    Row("shut-down-twice", r"must be initialized before it can be shutdown|rcl_shutdown already",
        "ROS was shut down a second time.",
        "Ctrl+C also shuts ROS down. `rclpy.try_shutdown` does nothing if ROS is already shut "
        "down."),
)  # fmt: skip


# Callbacks: those that do not return, that have other parameters, or are nothing to call.

_WHO_SPINS = (
    "A node only provides callbacks, which return quickly. The program that runs the node spins "
    "it, not the node itself."
)


def _blocks(fault: Fault) -> Diagnosis | None:
    """Recognise a callback or a constructor that does not return (row 16)."""
    if fault.kind == "DeadlinePassed":
        return _stuck(fault)
    if fault.kind == "BrokenOff":
        means = f"{fault.callback} had not returned when it was interrupted."
        return Diagnosis("callback-blocks", means, _NO_WAIT if _waits(fault) else _NO_LOOP)
    if fault.kind == "DeadlockError":
        return Diagnosis("callback-blocks", fault.text.partition("\n")[0], _WHO_SPINS)
    inside = r"was called (from )?inside|spin_once was called for"
    if fault.kind != "SessionError" or not matched(fault, inside):
        return None
    call = matched(fault, r"`?(rclpy\.\w+|[\w.]+)`? was called")
    return Diagnosis(
        "callback-blocks",
        f"{call[1] if call else 'A wait'} waits for callbacks, but no other callback can run "
        "until this one returns.",
        _WHO_SPINS,
    )


_NO_WAIT = (
    "A callback must not wait, because the node processes no messages in the meantime. Use a "
    "timer for anything that happens later or repeatedly."
)
_NO_LOOP = (
    "A callback does its work once and returns. Use a timer for anything that happens repeatedly."
)
_SET_UP = (
    "A constructor sets the node up and returns; only then do callbacks run. Use a timer for "
    "anything that happens later or repeatedly."
)


_ONCE = (
    "A node creates its publishers, subscriptions and timers once, in the constructor, and "
    "stores them in self. A callback only uses them."
)


_QUICK = (
    "Each callback returns, and takes long. What does it do at each call that it could do once, or "
    "not at all? If the computer is busy with something else, run the check again."
)


def _waits(fault: Fault) -> bool:
    """Return whether the line of a fault waits for something."""
    return re.search(r"\b(sleep|wait|input|join)\(", fault.code) is not None


def _stuck(fault: Fault) -> Diagnosis:
    anew = re.match(r"(\d+ (?:publishers|subscriptions|timers)\b.*) in (\d+) calls$", fault.text)
    if anew:
        means = (
            f"{fault.callback} created {anew[1]} in {anew[2]} calls, and each one slows the "
            "node down."
        )
        return Diagnosis("made-anew", means, _ONCE)
    slow = re.match(r"(\d+) calls of callbacks took", fault.text)
    if slow:
        means = f"The run is too slow: {fault.text}, and it was not over."
        return Diagnosis("slow-callback", means, _QUICK)
    waits = _waits(fault)
    loops = re.match(r"(while|for)\b", fault.code) is not None
    if fault.callback == "__init__":
        ends = (
            "The node does not exist until its constructor returns. What makes the constructor "
            "return?"
        )
        means = f"The constructor does not return: {fault.text}."
        return Diagnosis("constructor-blocks", means, _SET_UP if waits or loops else ends)
    ends = "While this callback runs, the node can do nothing else. What makes the callback return?"
    means = f"{fault.callback or 'The program'} does not return: {fault.text}."
    return Diagnosis("callback-blocks", means, _NO_WAIT if waits else _NO_LOOP if loops else ends)


def _endless(fault: Fault) -> Diagnosis | None:
    """Recognise callbacks that cause each other while no time passes."""
    if fault.kind != "EndlessChainError" or not fault.text:
        return None
    if fault.text.startswith("A timer of "):
        return Diagnosis("wrong-rate", fault.text, calls.PERIOD)
    return Diagnosis(
        "endless-chain",
        fault.text,
        "Each callback triggers the next one, and no time passes. Does a node receive the "
        "messages that it publishes itself?",
    )


_HANDED_ONE = (
    "Some callbacks take one argument: a subscription's callback takes the message, an event's "
    "the event info, an action's the goal handle, and a parameter callback a list of parameters."
)
_HANDED_TWO = "A service's callback takes two arguments: the request, and a response to fill."


_NO_SELF = "has no parameters, but Python passes every method its own object."
_OTHER_DEFS = "Compare the method's `def` line with those of the other methods in the class."


def _called_with_others(fault: Fault) -> Diagnosis | None:
    """Recognise a timer's callback that takes a message, or no self (row 10)."""
    found = matched(fault, r"^TypeError: [\w.<>]*?(\w+)\(\) (takes 0|missing \d+) ")
    if not found or found[1] == "__init__" or not called_by_ros(fault):
        return None
    name = found[1]
    means = f"{name} has more parameters than ROS passes arguments."
    to_try = (
        f"A timer calls its callback without arguments. {_HANDED_ONE} {_HANDED_TWO} Which of "
        f"them is {name}?"
    )
    if matched(fault, r"missing 1 required positional argument: '(?:msg|message)'$"):
        to_try = (
            "A timer calls its callback without arguments, and a subscription with the message. "
            f"{name} takes a message: does the constructor hand it to create_subscription?"
        )
    if found[2] == "takes 0":
        means = f"{name} {_NO_SELF}"
        to_try = _OTHER_DEFS
    return Diagnosis("callback-parameters", means, to_try)


def _nothing_to_call(fault: Fault) -> Diagnosis | None:
    """Recognise a timer that was given `self.tick()`: it fails at its first tick (row 9)."""
    found = matched(fault, r"^TypeError: '(\w+)' object is not callable$")
    if not found or not called_by_ros(fault):
        return None
    if found[1] == "NoneType":
        return calls.callback_called("The timer's callback")
    return Diagnosis(
        "wrong-argument",
        f"The timer's callback is an object of type {found[1]}, which cannot be called.",
        calls.KINDS["callback"],
    )


def _not_a_message_type(fault: Fault) -> Diagnosis | None:
    """Recognise row 8 by rclpy's text alone."""
    if not matched(fault, r"has no attribute '_TYPE_SUPPORT'"):
        return None
    return calls.no_message_type(None)


_CALL_RULES: tuple[Rule, ...] = (
    _blocks,
    _endless,
    calls.called_at_once,
    calls.wrong_call,
    calls.refused_callback,
    _not_a_message_type,
    Row("wrong-depth", r"Expected QoSProfile or int|history depth must be greater",
        "The value given as the queue depth is not a valid depth.",
        calls.KINDS["depth"]),
    # Where the call itself is not known, in a terminal.
    Row("depth-missing", r"create_publisher\(\) missing 1 .*: 'qos_profile'",
        "The last argument, the queue depth, is missing.",
        calls.ORDER["create_publisher"]),
    Row("argument-missing", r"create_\w+\(\) missing 1 .*: 'qos_profile'",
        "An argument is missing: either the queue depth, or the callback before it.",
        calls.ORDER["create_subscription"]),
    calls.wrong_timer,
    _called_with_others,
    _nothing_to_call,
)  # fmt: skip


# Services and actions: what a callback gives back, and how work on a goal ends.


def _not_given_back(fault: Fault) -> Diagnosis | None:
    """Recognise a service's callback that does not give back its response."""
    call = fault.asked
    if call is None or call.method != "send_response" or fault.kind != "TypeError":
        return None
    (given,) = call.given or (None,)
    if given is not None and given.kind == "NoneType":
        means = f"{fault.callback} returns nothing, so the client never gets a response."
        return Diagnosis(
            "response-missing",
            means,
            "A service's callback ends with a return. What does it return?",
        )
    what = calls.in_words(given) if given is not None else "something"
    return Diagnosis(
        "response-wrong",
        f"{fault.callback} returns {what} instead of the response that it received.",
        "ROS passes the callback an empty response. Fill its fields, and return that object.",
    )


def _called_with_more(fault: Fault) -> Diagnosis | None:
    """Recognise a service's callback without `response`, or a parameter's without its list."""
    counts = r"(\w+)\(\) takes (\d+) positional arguments? but (\d+) (?:was|were)"
    found = matched(fault, rf"^TypeError: (?:[\w.<>]*\.)?{counts}")
    if not found or not called_by_ros(fault) or int(found[2]) > int(found[3]):
        return None
    name, takes, given = found[1], int(found[2]), int(found[3])
    if name != fault.callback or takes == 0:
        return None
    besides = ""
    if re.match(r"[\w.<>]*(?<!<locals>)\.\w+\(\)", fault.text):  # a method
        besides, takes, given = " besides self", takes - 1, given - 1
    counted = f"{given} argument" if given == 1 else f"{given} arguments"
    return Diagnosis(
        "callback-parameters",
        f"ROS calls {name} with {counted}{besides}, but {name} takes {takes or 'none'}.",
        _HANDED_ONE if given == 1 else _HANDED_TWO,
    )


_ANSWER_RULES: tuple[Rule, ...] = (
    Row("wrong-argument", r"The service type provided is not valid \(<class '[\w.]*?(\w+)'>\)",
        "{1} is not a service type: it is a single message, and a service type consists of two.",
        "A service type is a class that contains a Request and a Response. Which one does this "
        "service use?"),
    Row("wrong-argument", r"^TypeError: Node\.create_service\(\) takes 4 positional",
        "create_service was given too many arguments.",
        calls.ORDER["create_service"]),
    Row("callback-missing", r"^TypeError: Node\.create_service\(\) missing 1 .*: 'callback'",
        "create_service was called without a callback.",
        calls.ORDER["create_service"]),
    _not_given_back,
    Row("result-missing", r"'result' field must be a sub message of type",
        "The execute callback of a goal ended without returning a Result.",
        "Create a Result of the action, fill its field, and return it."),
    Row("feedback-wrong", r"^TypeError: $",
        "publish_feedback was given something other than a Feedback message of the action.",
        "An action type contains three classes: Goal, Feedback and Result.",
        "publish_feedback"),
    Row("canceled-unasked", r"invalid transition from state \w+ with event CANCELED",
        "A goal was reported as canceled, but no client had requested that.",
        "Ask the goal handle first whether a cancel was requested."),
    Row("ended-twice", r"invalid transition from state (\w+) with event",
        "A goal that had already ended ({1}) was ended again.",
        "A goal ends once, so each path through the callback makes only one of these calls."),
    Row("await-missing", r"^TypeError: (?!.* is not callable).*'Future'",
        "A future is used instead of its result.",
        "A future stands for a result that isn't available yet. What does await do with a future?"),
    Row("wrong-argument",
        r"non-integer .*range|'float' object cannot be interpreted as an integer",
        "random.randint was given a number with a decimal point, but it draws whole numbers only.",
        "Which function of the random module draws a decimal number?",
        r"\brandint\("),
    Row("await-missing", r"^TypeError: .*\bNoneType\b",
        "result() was called on a future that had no result yet, so it returned None.",
        "A future stands for a result that isn't available yet. Which keyword waits for it?",
        r"\.result\(\)"),
    Row("not-an-integer", r"'float' object cannot be interpreted as an integer",
        "A number with a decimal point is used where a whole number is required.",
        "A sequence of int32 takes whole numbers only, and to Python 19.0 is a float."),
    _called_with_more,
)  # fmt: skip


# Parameters.

_PARAMETER_RULES: tuple[Rule, ...] = (
    Row("parameter-type", r"parameter '([^']+)' to '(.*)' of type '(\w+)', expecting type '(\w+)'",
        "The parameter {1} was set to {2}, of type {3}, but was declared with a value of type {4}.",
        "The default value in declare_parameter determines the type: 20 is an INTEGER, a whole "
        "number, and 20.0 is a DOUBLE, a decimal number."),
    Row("parameter-type", r"not one of the allowed types",
        "A parameter was given a value of a type that no parameter can have.",
        "The argument after the name is the default value: a number, a string, True or False."),
    Row("arguments-swapped", r"^TypeError: First element .* in parameters list is not a str",
        "declare_parameter got something else instead of the parameter's name.",
        "The name comes first, in quotes, and the default value second."),
    Row("wrong-argument", r"Node\.get_parameter\(\) takes 2 positional",
        "get_parameter takes only the name of a parameter, but was given more arguments.",
        "The default value is given once, where the parameter is declared."),
    Row("parameter-undeclared", r"undeclared parameter\(s\): \W*(.+?)\W*$",
        "The node reads a parameter that is not declared: {1}.",
        "Declare a parameter once, in the constructor, before the node reads its value. Compare "
        "the two names letter by letter."),
    Row("parameter-twice", r"already declared: \W*(.+?)\W*$",
        "The parameter {1} is declared twice.",
        "Declare a parameter once, in the constructor; a callback only reads its value."),
    Row("parameter-for-value", r"Error: .*'Parameter(?:Value)?'",
        "A Parameter object, which has a name, a type and a value, is used as if it were the "
        "value.",
        "Which attribute of a parameter holds its value?"),
)  # fmt: skip


# Quality of service. rclpy checks most of a `QoSProfile` with an `assert` that says nothing.

_QOS_CALLS = r"QoSProfile|Duration|SubscriptionEventCallbacks|PublisherEventCallbacks"
_POLICIES = (
    "history", "depth", "reliability", "durability", "lifespan", "deadline", "liveliness",
    "liveliness_lease_duration", "avoid_ros_namespace_conventions",
)  # fmt: skip
_EVENTS = "the name of an event, such as deadline= or incompatible_qos="
_TAKES = {
    "QoSProfile": "depth=, reliability=, durability=, deadline= or lifespan=",
    "Duration": "seconds= or nanoseconds=",
}


def _without_a_name(fault: Fault) -> Diagnosis | None:
    """Recognise `Duration(2)`: an argument that has to have a name."""
    found = matched(fault, rf"^TypeError: ({_QOS_CALLS})\.__init__\(\) takes 1 positional")
    if not found:
        return None
    return Diagnosis(
        "wrong-argument",
        f"{found[1]} was given a positional argument.",
        f"{found[1]} takes keyword arguments only: {_TAKES.get(found[1], _EVENTS)}.",
    )


def _of_another_name(fault: Fault) -> Diagnosis | None:
    """Recognise an argument under a name that is not there."""
    said = rf"^TypeError: ({_QOS_CALLS})\.__init__\(\) got an unexpected .*'(\w+)'"
    found = matched(fault, said)
    called, name = (found[1], found[2]) if found else ("QoSProfile", _unknown_policy(fault))
    if not name:
        return None
    return Diagnosis(
        "wrong-argument",
        f"{called} has no argument {name}.",
        f"{called} takes {_TAKES.get(called, _EVENTS)}. Compare the names letter by letter.",
    )


def _unknown_policy(fault: Fault) -> str:
    found = matched(fault, r"Invalid arguments passed to .*dict_keys\(\[(.*)\]\)")
    names = re.findall(r"\w+", found[1]) if found else []
    return next((name for name in names if name not in _POLICIES), "")


def _policy_of_another_kind(fault: Fault) -> Diagnosis | None:
    """Recognise a text or a number where a policy or a duration belongs."""
    if fault.kind != "AssertionError" or fault.text:
        return None
    policies = [one for one in _POLICIES if re.search(rf"\b{one}\s*=(?!=)", fault.code)]
    if not policies and not re.search(r"\bQoSProfile\(", fault.code):
        return None
    if len(policies) > 1 and "depth" in policies:
        policies.remove("depth")  # a number, and people know how to write one
    which = policies[0] if len(policies) == 1 else "one of the policies"
    return Diagnosis(
        "wrong-argument",
        f"QoSProfile was given an invalid value for {which}.",
        "A depth is a whole number, and a deadline or a lifespan is a Duration. The values for "
        "reliability and durability are in ReliabilityPolicy and DurabilityPolicy.",
    )


def _no_such_policy(fault: Fault) -> Diagnosis | None:
    """Recognise `DurabilityPolicy.TRANSIENT`: Python 3.11 says no more than the name."""
    name = matched(fault, r"^AttributeError: ([A-Za-z_]+)$")
    found = re.search(rf"(\w*Policy)\.{name[1]}\b", fault.code) if name else None
    if not name or not found:
        return None
    return Diagnosis(
        "wrong-attribute",
        f"{found[1]} has no {name[1]}.",
        f"Compare the name with the ones on the page, or print list({found[1]}).",
    )


def _called_for_an_event(fault: Fault, found: Found) -> bool:
    """Return whether a line calls a method among the arguments of event callbacks."""
    call = rf"\.{found[1]}\(\)"
    handed = rf"EventCallbacks\(.*{call}|^\w+=\w+{call}|^\w+, .*{call},"
    return fault.callback == "__init__" and re.search(handed, fault.code) is not None


_QOS_RULES: tuple[Rule, ...] = (
    Row("depth-missing", r"^InvalidQoSProfileException: .*depth",
        "QoSProfile was called without depth=, the number of messages that the queue holds.",
        "A profile needs depth=, and takes any other policy that differs from the default."),
    _without_a_name,
    _of_another_name,
    _policy_of_another_kind,
    _no_such_policy,
    Row("callback-called", r"^TypeError: .*?(\w+)\(\) missing 1 required positional argument",
        "{1} is called while the node is being created, instead of being passed.",
        "Pass the method itself, without parentheses after its name: ROS calls it later.",
        when=_called_for_an_event),
    Row("wrong-argument", r"'(\w+)' object has no attribute 'create_event_h",
        "event_callbacks was given a {1}, which does not name an event.",
        "A subscription takes SubscriptionEventCallbacks(...), a publisher "
        "PublisherEventCallbacks(...). Their keyword arguments name the events."),
    Row("wrong-argument", r"incompatible constructor arguments.*\n.*EventHandle",
        "These event callbacks belong to the other side of a topic.",
        "A subscription takes SubscriptionEventCallbacks, and a publisher "
        "PublisherEventCallbacks."),
)  # fmt: skip


# Decimal numbers with a comma.

#: Two numbers with nothing but a comma between them, and neither is a part of another word.
_COMMA = re.compile(r"(?<![\w.,'\"])(\d+),(\d+)(?![\w.'\"]|,\d)")
_TOO_MANY = (
    r"\) takes (?:from |at most |exactly )?\d.* (?:but \d|\(\d+ given)|expected at most \d+ arg"
    r"|parameters list is not a ParameterDescriptor"
)


def _decimal_comma(fault: Fault) -> Diagnosis | None:
    """Recognise `sleep(0,5)` in the place of `sleep(0.5)`, which hands over two numbers."""
    found, call = _COMMA.search(fault.code), fault.asked
    timer = call is not None and call.method == "create_timer" and len(call.given) > 2
    other = re.search(rf"\b(?:{_MESSAGE}|create_publisher|create_subscription)\(", fault.code)
    if not found or other or not (timer or matched(fault, _TOO_MANY)):
        return None
    return Diagnosis(
        "wrong-argument",
        f"{found[0]} isn't one number in Python, but two arguments: {found[1]} and {found[2]}.",
        f"Write a decimal number with a point: {found[1]}.{found[2]}.",
    )


_NO_COMMA = (
    "Where does this value come from? In Python, 22,5 is a tuple of two numbers; the decimal "
    "number is written with a point: 22.5."
)
_COMMA_RULES: tuple[Rule, ...] = (
    _decimal_comma,
    Row("decimal-comma",
        r"can only concatenate tuple \(not \"(?:float|int)\"\)"
        r"|(?:of|for) .*'(?:float|int)' and 'tuple'|(?:of|for) .*'tuple' and '(?:float|int)'"
        r"|real number, not '?tuple|passed to tuple\.__format__|type tuple doesn't define __round__"
        r"|bad operand type for abs\(\): 'tuple'",
        "A tuple, which holds several values, is used where a number is required.",
        _NO_COMMA),
)  # fmt: skip


# Messages and their fields.

_SHOW = "`ros2 interface show std_msgs/msg/{1}` in a terminal lists the fields of a {1}."
_ENVELOPE = "A message isn't the value itself: it holds the value in one of its fields."
_TO_MAKE = {
    "float": "A number such as 18 is an int, and a number in quotes is a string. A decimal point "
    "makes a float, and so does float(...).",
    "str": "Write a string in quotes; str(...) or an f-string turns a number into a string.",
}
_NO_RETURN = (
    "Where does this value come from? A function that ends without return gives None. Does every "
    "path through the function end with a return?"
)
_PLAIN_KINDS = ("int", "bool", "str", "float", "bytes", "list", "tuple", "dict")


def _field_of_another_type(fault: Fault) -> Diagnosis | None:
    """Recognise `msg.data = 25`: a value of another type than the field's (row 1)."""
    found = matched(fault, r"The '(\w+)' field must be of type '(\w+)'")
    if not found:
        return None
    name, wanted = found.groups()
    constant, call = _constant_for(fault.code, name), fault.asked
    given = call.given[0] if call and call.method == "field" and call.given else None
    mistake, to_try = "not-a-float", _TO_MAKE.get(wanted, f"Give it {article(wanted)}.")
    if constant:
        kind = type(ast.literal_eval(constant)).__name__
        got = f"{constant} is {'no value' if kind == 'NoneType' else article(kind)}"
    elif given:
        plain = given.kind in _PLAIN_KINDS
        got = f"the value given is {article(given.kind) if plain else calls.in_words(given)}"
        others = {
            "message": ("message-for-value", _ENVELOPE),
            "NoneType": ("none-used", _NO_RETURN),
            "tuple": (mistake, _NO_COMMA if wanted == "float" else to_try),
        }
        mistake, to_try = others.get(given.kind, (mistake, to_try))
    else:
        got = "the value given is something else"
    means = f"The field {name} of the message takes {article(wanted)}, but {got}."
    return Diagnosis(mistake, means, to_try)


def _constant_for(code: str, name: str) -> str:
    """Return the constant that a line puts into a field, as it is written; or an empty text."""
    try:
        tree = ast.parse(code)
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return ""
    for node in ast.walk(tree):
        value: ast.expr | None = None
        if isinstance(node, ast.keyword) and node.arg == name:
            value = node.value
        elif isinstance(node, ast.Assign) and isinstance(node.targets[0], ast.Attribute):
            value = node.value if node.targets[0].attr == name else None
        if isinstance(value, ast.Constant):
            return ast.unparse(value)
    return ""


def _field_of_another_name(fault: Fault) -> Diagnosis | None:
    """Recognise `Float32(dat=25.0)` (row 4)."""
    found = matched(fault, r"Invalid arguments passed to constructor: (.+)")
    if not found:
        return None
    kind = re.search(rf"\b({_MESSAGE})\(", fault.code)
    return Diagnosis(
        "wrong-keyword",
        f"The message has no field called {found[1]}.",
        "Compare the name letter by letter. " + _SHOW.format("", kind[1] if kind else "Float32"),
    )


def _published(fault: Fault) -> Diagnosis | None:
    """Recognise `publish(25.0)`, `publish(Float32)` (rows 2 and 3), or another type's message."""
    call = fault.asked
    if call and call.method == "publish" and [one.kind for one in call.given] == ["bytes"]:
        return _value_published("message", "bytes")
    found = matched(fault, r"Expected <class '([\w.]+)'>, got <class '([\w.]+)'>")
    if not found:
        return None
    wanted, got = found[1].split(".")[-1], found[2].split(".")[-1]
    if got.startswith("Metaclass_"):
        name = got.removeprefix("Metaclass_")
        return Diagnosis(
            "class-published",
            f"publish was given the class {name} itself instead of a message.",
            "Calling a class creates an object, here a message. How do you call a class?",
        )
    if ".msg." in found[2]:
        return Diagnosis(
            "type-mismatch",
            f"The publisher was created for messages of type {wanted}, but was given a {got}.",
            "All messages on a topic have the same type. Compare the line that creates the "
            "publisher with the line that creates the message.",
        )
    return _value_published(wanted, got)


def _value_published(wanted: str, got: str) -> Diagnosis:
    words = {"NoneType": "None", "bytes": "bytes"}.get(got, article(got))
    return Diagnosis(
        "number-published",
        f"publish was given {words} instead of a message.",
        f"Create a {wanted} first and assign the value to its field, then publish that message.",
    )


_FIELD_RULES: tuple[Rule, ...] = (
    _field_of_another_type,
    Row("wrong-values", r"The '(\w+)' field must be an? [\w ]+ in \[",
        "The number is too large for the field {1}.",
        "Print the number before that line. Does it grow from one call to the next?"),
    _field_of_another_name,
    Row("field-without-name",
        rf"^TypeError: ({_MESSAGE})\.__init__\(\) takes 1 positional argument but \d",
        "{1}(...) was given a value without the name of its field.",
        f"A message can have many fields, so pass each value with the name of its field. {_SHOW}"),
    Row("no-publisher", rf"'({_MESSAGE})' object has no attribute 'publish'",
        "A message of type {1} is used instead of a publisher.",
        "A message only carries a value. Which method of a node creates a publisher?"),
    Row("wrong-field", rf"'({_MESSAGE})' object has no attribute '((?!__)\w+)'",
        "A {1} has no field called {2}.",
        _SHOW),
    Row("class-changed", r"'(\w+)' object attribute '(\w+)' is read-only",
        "An earlier line has assigned a value to {2} of the class {1} itself, which broke the "
        "class for all messages. The class has been restored.",
        "Look for a {1} without parentheses after it, then run your cells again."),
    _published,
    Row("number-published", r"Publisher\.publish\(\) (takes|missing|got)",
        "publish takes exactly one argument, a message, but was called with something else.",
        "Create the message first, assign the value to its field, and pass only the message.",
        when=lambda fault, _: not called_by_ros(fault)),
    Row("message-for-value",
        rf"^TypeError: (?!.* is not callable).*?(?:['\"]|not |type |to )({_MESSAGE})\b",
        "A whole message of type {1} is used instead of the value in its field.",
        f"{_ENVELOPE} {_SHOW}"),
)  # fmt: skip


# Names that Python does not know: of variables, methods, attributes, modules.

#: Methods of a node that learners of this course call.
NODE_METHODS = (
    *("create_publisher", "create_subscription", "create_timer", "create_service"),
    *("create_client", "create_rate", "get_logger", "get_clock", "get_name", "get_parameter"),
    *("declare_parameter", "destroy_node", "destroy_timer", "get_namespace"),
)
_IMPORTED = MESSAGES | {
    *("random", "math", "statistics", "time", "rclpy", "Node", "QoSProfile", "deque", "partial"),
    *("std_msgs", "functools", "collections"),
}
_CAPITALS = {"true": "True", "false": "False", "none": "None"}
_SUGGESTED = r"Did you mean: '([^']+)'"
_KNOWN_MODULES = ("rclpy", "rclpy.node", "rclpy.qos", "std_msgs", "std_msgs.msg", "random", "math")
_LEVELS = ("debug", "info", "warning", "warn", "error", "fatal")


def _name_error(fault: Fault) -> Diagnosis | None:
    """Recognise a name that is defined nowhere."""
    found = matched(fault, r"^NameError: name '(\w+)' is not defined")
    if not found:
        return None
    meant = matched(fault, _SUGGESTED)
    means = f"The name {found[1]} is not defined here."
    return Diagnosis("name-error", means, _about(found[1], meant[1] if meant else ""))


def _about(name: str, meant: str) -> str:
    if name in _CAPITALS:
        return "True, False and None begin with a capital letter."
    if name in NODE_METHODS or meant.startswith("self."):
        return (
            "This name belongs to the node, and inside the node's methods the node is called self."
        )
    if meant and meant != name:
        return f"There is a similar name, {meant}. Compare the two letter by letter."
    if name in MESSAGES:
        return (
            f"{name} is a type of message, and the imports at the top don't include it. Is it the "
            "type that is asked for? If so, import it; if not, name the right one."
        )
    if name in _IMPORTED:
        return "This name comes from a package. Do the imports at the top include it?"
    return (
        "A string needs quotes, and a method or attribute of the node needs self. before it. "
        "Compare the spelling with the line that imports or assigns the name."
    )


def _not_assigned_yet(fault: Fault) -> Diagnosis | None:
    """Recognise a variable of a function that has no value yet."""
    if fault.kind != "UnboundLocalError":
        return None
    found = matched(fault, r"variable '(\w+)'")
    name = found[1] if found else "A variable"
    if re.search(rf"^{name} = .*\(\s*{name}\b", fault.code):
        means = f"{name} has no value yet: this line reads {name} before it assigns a value."
        to_try = "If you mean the name itself, it's a string, and a string needs quotes."
        return Diagnosis("no-value-yet", means, to_try)
    return Diagnosis(
        "no-value-yet",
        f"{name} has no value yet at this line.",
        "Its assignment is in a branch that was not taken, or on a later line. A value to keep "
        "from one call to the next belongs to the node: write self. before its name.",
    )


def _no_such_attribute(fault: Fault) -> Diagnosis | None:
    """Recognise `self.create_publisherr(...)`, `self.tempreature`, `random.unifrom(...)`."""
    owners = r"(?:'(\w+)' object|module '([\w.]+)'|type object '(\w+)')"
    found = matched(fault, rf"^AttributeError: {owners} has no attribute '(\w+)'")
    if not found or found[1] in ("NoneType", "super") or found[1] in MESSAGES:
        return None
    owner, name = found[1] or found[2] or found[3], found[4]
    meant = _meant(fault, owner, name)
    # `status` is not a `status_pub` with letters wrong.
    if meant and abs(len(meant.removeprefix("self.")) - len(name)) < _LONGER:
        plain = meant.removeprefix("self.").lower()
        alike = get_close_matches(name.lower(), [plain], 1, 0.7)
        return Diagnosis(
            "wrong-attribute",
            f"{owner} has no attribute {name}; it has {meant}.",
            "Compare the two letter by letter."
            if alike and (owner in _OWN_NAMES or not plain.startswith(name.lower()))
            else f"Is that the one you mean? If not, {name} has to be assigned first.",
        )
    return Diagnosis("wrong-attribute", f"{owner} has no attribute {name}.", _where(fault, found))


#: Letters by which a name is longer than another that was not meant.
_LONGER = 3
#: Names of objects of rclpy, to which a learner adds none.
_OWN_NAMES = {"Publisher": ("publish",), "RcutilsLogger": _LEVELS}


def _meant(fault: Fault, owner: str, name: str) -> str:
    said = matched(fault, _SUGGESTED)
    if said:
        return said[1]
    plain = re.sub(r"(?<=[a-z])(?=[A-Z])", "_", name).lower()
    near = get_close_matches(plain, _OWN_NAMES.get(owner, NODE_METHODS), 1, 0.8)
    return near[0] if near else ""


def _where(fault: Fault, found: Found) -> str:
    if found[2] or not re.search(rf"\bself\.{re.escape(found[4])}\b", fault.code):
        return (
            "Compare the name with the documentation, or with the line that creates the attribute."
        )
    if fault.callback == "__init__":
        return (
            "An attribute has to be assigned on an earlier line of the constructor. A method "
            "belongs to the class only if its def has the same indentation as the constructor's."
        )
    return (
        "Compare the spelling with the line in the constructor that assigns the attribute. Does "
        "the name begin with self. there, and does that line run?"
    )


def _not_importable(fault: Fault) -> Diagnosis | None:
    """Recognise `from std_msgs.msg import Float` and `import rclpi`."""
    name = matched(fault, r"cannot import name '(\w+)' from '([\w.]+)'")
    if name:
        near = get_close_matches(name[1], sorted(MESSAGES), 1, 0.6) if "msg" in name[2] else []
        meant = f" It has {near[0]}." if near and near[0] != name[1] else ""
        hint = "Compare the name and its module with the imports on the page."
        return Diagnosis("not-importable", f"{name[2]} has no {name[1]}.{meant}", hint)
    module = matched(fault, r"No module named '([\w.]+)'")
    if not module:
        return about_relative(fault.text)
    if known := about_name(module[1]):
        return known
    near = get_close_matches(module[1], _KNOWN_MODULES, 1, 0.7)
    meant = f" There is {near[0]}." if near and near[0] != module[1] else ""
    hint = "Compare the module's name letter by letter with the imports on the page."
    return Diagnosis("not-importable", f"There is no module called {module[1]} here.{meant}", hint)


_NAME_RULES: tuple[Rule, ...] = (
    _not_assigned_yet,
    _name_error,
    Row("brackets-missing",
        r"'(function|method|builtin_function_or_method)' object has no attribute '(\w+)'",
        "This line looks for {2} on a method itself, instead of on the value that the method "
        "returns.",
        "A method runs only if parentheses follow its name. Which method on this line has none?"),
    Row("name-taken",
        r"property '(\w+)' of '\w+' object has no setter|can't set attribute '(\w+)'"
        r"|^AttributeError: (\w+) cannot be modified after node creation",
        "Every node already has an attribute called {1}, which cannot be replaced.",
        "Choose another name for your own attribute; an underscore at its end is enough."),
    # Here the session failed, and not a callback.
    Row("name-taken", r"^TypeError: 'method' object is not iterable$",
        "A method of the class has a name that every node already uses, such as clients, "
        "services or timers.",
        "Give the method another name, in its def line and wherever you pass it.",
        when=lambda fault, _: fault.callback in ("add", "run", "spin")),
    Row("name-taken",
        r"'method' object does not support the context manager protocol|: __enter__$",
        "A method of the class is called handle, but every node already has an attribute of that "
        "name.",
        "Give the method another name, in its def line and wherever you pass it.",
        r"\bsuper\(\)\.__init__\("),
    Row("none-used", r"'NoneType' object has no attribute '(\w+)'",
        "The value before .{1} on this line is None.",
        "Where does this value come from? A function without return gives None."),
    _no_such_attribute,
    _not_importable,
)  # fmt: skip


# Values of a kind that Python cannot work with at that place.

_NUMBER = "'(?:float|int)'"
_TEXT_AND_NUMBER = "|".join(
    (
        r"can only concatenate str \(not \"(?:float|int)\"\)",
        rf"unsupported operand type\(s\) for [^:]+: {_NUMBER} and 'str'",
        rf"unsupported operand type\(s\) for [^:]+: 'str' and {_NUMBER}",
        rf"not supported between instances of {_NUMBER} and 'str'",
        rf"not supported between instances of 'str' and {_NUMBER}",
        r"must be str, not (?:float|int)",
    )
)

_VALUE_RULES: tuple[Rule, ...] = (
    Row("text-and-number", _TEXT_AND_NUMBER,
        "This line combines a string and a number, but Python needs two values of the same kind.",
        "An f-string inserts a number into a string. A number in quotes is a string."),
    Row("none-used",
        r"supported .*'NoneType'|real number, not '?NoneType"
        r"|'NoneType' object cannot be interpreted as an integer",
        "A value on this line is None, but a number is required.",
        "Where does this value come from, and is it set before the first message arrives? A "
        "function without return gives None, and so does a parameter that was declared without a "
        "default value."),
    Row("none-used",
        r"object of type 'NoneType' has no len\(\)"
        r"|'NoneType' object is not (?:iterable|subscriptable)",
        "This line needs a list, but the value is None.",
        "Where does this value come from? A function without return gives None, and so do append "
        "and sort, which change the list itself.",
        r"\bself\.\w+"),
    Row("format-code", r"Unknown format code '(.)' for object of type '(\w+)'",
        "The format code {1} after the colon in the braces does not match the value, which is of "
        "type {2}.",
        "f formats a float, with .2f to two decimals; d is for whole numbers, and s for strings."),
    Row("logged-no-text",
        r"rclpy_logging_rcutils_log\(\): incompatible function arguments"
        r"|Logger\.\w+\(\) (takes|missing|got) ",
        "The logger takes one string, but was given something else.",
        "Unlike print, the logger does not join several values. An f-string combines them into "
        "one string."),
    Row("wrong-argument",
        r"^TypeError: Node\.((?!__init__)\w+)\(\) takes 1 positional argument but",
        "{1} takes no arguments, but was given one.",
        "Leave its parentheses empty, and use the value that it returns."),
    Row("not-callable", r"^TypeError: '(\w+)' object is not callable",
        "Parentheses follow an object of type {1}, which is not a function.",
        "Which name on this line is before the parentheses? A function of a module or an object "
        "comes after a dot; a value takes no parentheses.",
        when=lambda fault, _: not called_by_ros(fault)),
    Row("text-and-number", r"could not convert string to float: '(-?\d+),(\d+)'",
        "'{1},{2}' is no number for Python: a comma separates values.",
        "The decimal sign is a point: {1}.{2}"),
    Row("division-by-zero", r"^ZeroDivisionError: |^StatisticsError: .*at least one data point",
        "This line divides by zero, for example by the length of a list that is still empty.",
        "How many readings are there at the first call?",
        when=lambda fault, _: bool(fault.callback)),
    Row("division-by-zero", r"^ZeroDivisionError: |^StatisticsError: .*at least one data point",
        "This line divides by zero, for example by the length of a list that is empty.",
        "Which value on this line is zero? Check for that before the line divides."),
    Row("index-error", r"^IndexError: .*from (an )?empty",
        "The list is empty, so it has no element to take.",
        "When does this line run while the list is still empty? Check that first."),
    Row("index-error", r"^IndexError: .*index out of range",
        "The list has no such index: it is shorter than this line expects.",
        "How long is the list at the first call? Indexes begin at 0, so the last one is the "
        "length minus one.",
        when=lambda fault, _: bool(fault.callback)),
    Row("index-error", r"^IndexError: .*index out of range",
        "The list has no such index: it is shorter than this line expects.",
        "Indexes begin at 0, so the last one is the length minus one."),
    Row("self-missing", r"(\w+)\(\) takes 0 positional arguments but (\d)",
        f"{{1}} {_NO_SELF}",
        _OTHER_DEFS),
    Row("argument-missing", r"(\w+)\(\) missing \d required positional arguments?: (.+)",
        "{1} requires {2}, but is called without arguments.",
        "Look at the line that begins with def {1}: which parameters does it have besides self?",
        when=lambda fault, found: f"self.{found[1]}()" in fault.code),
    Row("argument-missing",
        r"^TypeError: (?:\w+\.)*(?!__init__)(\w+)\(\) missing \d required positional .+?: (.+)",
        "{1} was called without {2}, which it needs.",
        "How many values does {1} take, and how many are there between its parentheses?",
        when=lambda fault, found: bool(
            re.search(rf"\b(?:random|math|statistics|time)\.{found[1]}\(", fault.code))),
    Row("constructor-parameters", r"__init__\(\) missing \d .*?arguments?: (.+)",
        "The constructor requires {1}, but the class is called without arguments.",
        "A session calls your class without arguments, so the constructor's only parameter "
        "should be self.",
        when=lambda fault, _: not fault.line),
    Row("calls-itself", r"^RecursionError: ",
        "A function calls itself endlessly, until Python stops it.",
        "Use a timer for anything that happens again later; a callback only needs to return."),
)  # fmt: skip

_RULES: tuple[Rule, ...] = (
    *_COMMA_RULES,
    *_NODE_RULES,
    *_CALL_RULES,
    *_ANSWER_RULES,
    *_PARAMETER_RULES,
    *_QOS_RULES,
    *_FIELD_RULES,
    *_NAME_RULES,
    *_VALUE_RULES,
)
