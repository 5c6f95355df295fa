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
from dataclasses import dataclass
from difflib import get_close_matches

from rosbeat.diagnosis import calls
from rosbeat.diagnosis.calls import MESSAGES, article, called_by_ros, matched
from rosbeat.diagnosis.mistakes import Diagnosis, Meaning
from rosbeat.records import Fault

#: A rule knows one kind of mistake, and answers None if an exception is none of its kind.
Rule = Callable[[Fault], "Meaning | None"]
Found = re.Match[str]


@dataclass(frozen=True)
class Row:
    """Recognise a mistake by an exception's class and text.

    Attributes:
        mistake: The mistake's id.
        error: A regular expression that is looked for in the error, such as `TypeError: ...`.
        means: What happened; `{1}` is the first group of the pattern that took part in the match.
        to_try: Where to look, with groups as well.
        line: A regular expression that the learner's line has to hold, too.
        when: What else has to be true.
    """

    mistake: str
    error: str
    means: str
    to_try: str
    line: str = ""
    when: Callable[[Fault, Found], bool] = lambda _, __: True

    def __call__(self, fault: Fault) -> Meaning | None:
        """Return the meaning of an exception of this kind; None for any other."""
        found = matched(fault, self.error)
        if not found or not re.search(self.line, fault.code) or not self.when(fault, found):
            return None
        groups = (one.replace("'", "") for one in found.groups() if one is not None)
        words = [found[0], *groups]
        return Meaning(self.mistake, self.means.format(*words), self.to_try.format(*words))


def meaning_of(fault: Fault) -> Meaning | None:
    """Return what an exception means, if it comes from a known mistake; else None."""
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


def diagnosed(fault: Fault, meaning: Meaning) -> Diagnosis:
    """Return a meaning as a diagnosis: with who raised, and the learner's line, as evidence."""
    if fault.text == meaning.means:  # the session itself refused; its sentence is complete
        return Diagnosis(meaning.mistake, meaning.means, meaning.to_try)
    raised = _raised(fault) if fault.callback else ""
    return Diagnosis(meaning.mistake, f"{raised}{meaning.means}{line_of(fault)}", meaning.to_try)


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
    "What makes a node of your class is the constructor of its parent: it has to be called first "
    "of all in `__init__`, with the node's name."
)
_NAME = "The parent's constructor, super().__init__, takes the node's name, a text in quotes."


def _no_node(fault: Fault) -> Meaning | None:
    """Recognise something handed over that is no node; the sentence is the session's own."""
    if fault.kind != "NodeClassError" or not fault.text:
        return None
    to_try = "Hand over the class that you wrote, by its name, without quotes and brackets."
    if "is a class, but not a node" in fault.text:
        to_try = "A class becomes a node by what stands in brackets behind its name: its parent."
    elif " returned, " in fault.text:
        to_try = "A function that makes a node has to give it back. What does its last line do?"
    return Meaning("no-node", fault.text, to_try)


def _name_missing(fault: Fault) -> Meaning | None:
    """Recognise `super().__init__()` without a name (row 11)."""
    found = matched(fault, r"\b(\w*)Node\.__init__\(\) missing 1 .*'node_name'")
    # An `AlarmNode` is a class of the learner's, and only its heirs leave the name out.
    own = found and found[1] not in ("", "Lifecycle") and "super()" not in fault.code
    if not found or own:
        return None
    call = fault.asked
    if call and call.given and call.given[0].kind == "str":
        means = "Node.__init__ was called without the node that it is to make."
        return Meaning("super-missing", means, _SUPER)
    if fault.line and fault.callback == "__init__":
        return Meaning("node-name-missing", "The node was made without a name.", _NAME)
    return Meaning(
        "node-name-missing",
        "The class has no constructor of its own that gives the node a name.",
        "Look at the line that should begin the constructor: is it spelled `__init__`, with two "
        "underscores on both sides, and does it stand inside of the class?",
    )


def _wrong_name_argument(fault: Fault) -> Meaning | None:
    """Recognise `super().__init__(5)` and `super().__init__(self, 'name')`."""
    call = fault.asked
    if call is None or call.method != "Node.__init__":
        return None
    if len(call.given) > 1 and call.given[0].kind == call.given[1].kind:
        means = "super().__init__ was given self, which super() hands over by itself."
        return Meaning("wrong-argument", means, _NAME)
    name = call.named.get("node_name") or (call.given[1] if len(call.given) > 1 else None)
    if name is None or name.kind == "str":
        return None
    means = f"The node got {calls.in_words(name)} in the place of its name."
    return Meaning("wrong-argument", means, _NAME)


_NODE_RULES: tuple[Rule, ...] = (
    _no_node,
    Row(
        "exits",
        r"^SystemExit: ",
        "This line ends the whole program, and every node in it.",
        "A node runs until somebody outside ends it. Take that line out.",
    ),
    Row(
        "super-missing",
        rf"has no attribute '({_MADE_BY_NODE})'",
        "The node is used before it is made: super().__init__ has not been called yet.",
        _SUPER,
    ),
    Row(
        "super-missing",
        r"'super' object has no attribute '(\w+)'",
        "The parent's constructor is not called {1}.",
        _SUPER,
    ),
    Row(
        "super-missing",
        r"'__init__' requires a 'super' object",
        "super itself was asked, and it is super(), with brackets, that finds the parent.",
        _SUPER,
    ),
    _name_missing,
    _wrong_name_argument,
    Row(
        "invalid-name",
        r"unknown substitution|topic name .* is invalid",
        "The topic's name holds braces, and nothing is known that belongs in them.",
        "An f-string has an f before its quotes; in a plain text braces stay braces.",
    ),
    Row(  # row 12; ROS says in a sentence what is wrong with the name, and then the name
        "invalid-name",
        r"^Invalid(?:NodeName|TopicName|ServiceName|Namespace)\w*: [\w ]+: (.+):\n\s*'(.*)'",
        "ROS does not allow the name '{2}': {1}.",
        "Names hold letters of the English alphabet, digits and `_`, and begin with a letter. In "
        "the name of a topic or a service, a slash may stand between two parts, not at the end.",
    ),
    Row(
        "type-mismatch",
        r"invalid allocator|existing topic name .* incompatible type",
        "The topic exists already, with another message type.",
        "One topic carries one type. Which one do the others use on this topic?",
    ),
    Row(
        "not-initialised",
        r"^(?:NotInitializedException|NoSessionError): ",
        "A node was made before ROS was started.",
        "In a program one call starts ROS, and it comes before the first node. Look at the "
        "beginning of main.",
    ),
    Row(
        "init-in-with",
        # Where ROS runs already, `init` itself fails. Python 3.10 says no more than `__enter__`.
        r"Context\.init\(\) must only be called once|: __enter__$"
        r"|'NoneType' object does not support the context manager protocol",
        "In this version of ROS, `rclpy.init` returns nothing, so `with` has nothing to work with.",
        "Documentation of newer versions writes it so. Here ROS is started and ended by two calls "
        "of their own.",
        r"\bwith\b.*\binit\(",
    ),
    Row(
        "initialised-twice",
        r"Context\.init\(\) must only be called once",
        "ROS was started twice.",
        "Once is enough for a program. Look for a second rclpy.init, in main and elsewhere.",
    ),
    Row(
        "shut-down-twice",
        r"must be initialized before it can be shutdown|rcl_shutdown already",
        "ROS was shut down a second time.",
        "Ctrl+C shuts it down, too. `rclpy.try_shutdown` does so only if it still runs.",
    ),
)


# Callbacks: those that do not return, that have other parameters, or are nothing to call.

_WHO_SPINS = (
    "A node only says what is to be done, in callbacks that return soon; spinning is the "
    "business of whoever runs the node."
)


def _blocks(fault: Fault) -> Meaning | None:
    """Recognise a callback or a constructor that does not return (row 16)."""
    if fault.kind == "DeadlinePassed":
        return _stuck(fault)
    if fault.kind == "DeadlockError":
        return Meaning("callback-blocks", fault.text.partition("\n")[0], _WHO_SPINS)
    inside = r"was called (from )?inside|spin_once was called for"
    if fault.kind != "SessionError" or not matched(fault, inside):
        return None
    call = matched(fault, r"`?(rclpy\.\w+|[\w.]+)`? was called")
    return Meaning(
        "callback-blocks",
        f"{call[1] if call else 'A wait'} waits for callbacks, and none can run before this one "
        "has returned.",
        _WHO_SPINS,
    )


_NO_WAIT = (
    "A callback must not wait: the node takes no message meanwhile. What comes later, or again and "
    "again, is a timer's business."
)
_NO_LOOP = (
    "A callback does its work once and returns. What is to happen again and again is a timer's "
    "business."
)
_SET_UP = (
    "A constructor sets the node up and returns; only then do callbacks run. What comes later, or "
    "again and again, is a timer's business."
)


_ONCE = (
    "A node makes its publishers, subscriptions and timers once, in the constructor, and keeps "
    "them in self. A callback only uses them."
)


_QUICK = (
    "Each callback returns, and takes long. What does it do at each call that it could do once, or "
    "not at all? If the computer is busy with something else, run the check again."
)


def _stuck(fault: Fault) -> Meaning:
    anew = re.match(r"(\d+ (?:publishers|subscriptions|timers)\b.*) in (\d+) calls$", fault.text)
    if anew:
        means = (
            f"{fault.callback} made {anew[1]} in {anew[2]} calls, and each one slows the node down."
        )
        return Meaning("made-anew", means, _ONCE)
    slow = re.match(r"(\d+) calls of callbacks took", fault.text)
    if slow:
        means = f"The run is too slow: {fault.text}, and it was not over."
        return Meaning("slow-callback", means, _QUICK)
    waits = re.search(r"\b(sleep|wait|input|join)\(", fault.code) is not None
    loops = re.match(r"(while|for)\b", fault.code) is not None
    if fault.callback == "__init__":
        ends = "There is no node before its constructor has returned. What ends it?"
        means = f"The constructor does not return: {fault.text}."
        return Meaning("constructor-blocks", means, _SET_UP if waits or loops else ends)
    ends = "While it runs, the node can do nothing else. What ends it?"
    means = f"{fault.callback or 'The program'} does not return: {fault.text}."
    return Meaning("callback-blocks", means, _NO_WAIT if waits else _NO_LOOP if loops else ends)


def _endless(fault: Fault) -> Meaning | None:
    """Recognise callbacks that cause each other while no time passes."""
    if fault.kind != "EndlessChainError" or not fault.text:
        return None
    if fault.text.startswith("A timer of "):
        return Meaning("wrong-rate", fault.text, calls.PERIOD)
    return Meaning(
        "endless-chain",
        fault.text,
        "Each callback causes the next, and the clock stands still. Does a node hear what it "
        "publishes itself?",
    )


_HANDED_ONE = (
    "One argument is handed to the callback of a subscription, the message; of an event, its info; "
    "of an action, the goal's handle; of parameters, a list of them."
)
_HANDED_TWO = "A service's callback is handed two: the request, and a response to fill."


_NO_SELF = "takes no parameter, and Python hands every method its own object."
_OTHER_DEFS = "Compare its `def` line with those of the other methods of a class."


def _called_with_others(fault: Fault) -> Meaning | None:
    """Recognise a timer's callback that takes a message, or no self (row 10)."""
    found = matched(fault, r"^TypeError: [\w.<>]*?(\w+)\(\) (takes 0|missing \d+) ")
    if not found or found[1] == "__init__" or not called_by_ros(fault):
        return None
    name = found[1]
    means = f"{name} has more parameters than ROS fills in when it calls it."
    to_try = (
        f"A timer calls its callback without arguments. {_HANDED_ONE} {_HANDED_TWO} Which one "
        f"calls {name}?"
    )
    if found[2] == "takes 0":
        means = f"{name} {_NO_SELF}"
        to_try = _OTHER_DEFS
    return Meaning("callback-parameters", means, to_try)


def _nothing_to_call(fault: Fault) -> Meaning | None:
    """Recognise a timer that was given `self.tick()`: it fails at its first tick (row 9)."""
    found = matched(fault, r"^TypeError: '(\w+)' object is not callable$")
    if not found or not called_by_ros(fault):
        return None
    if found[1] == "NoneType":
        return calls.callback_called("The callback of the timer")
    return Meaning(
        "wrong-argument",
        f"The timer was given an object of type {found[1]} to call, which cannot be called.",
        calls.KINDS["callback"],
    )


def _not_a_message_type(fault: Fault) -> Meaning | None:
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
    Row(
        "wrong-depth",
        r"Expected QoSProfile or int|history depth must be greater",
        "What stands in the place of the queue depth is no depth.",
        calls.KINDS["depth"],
    ),
    # Where the call itself is not known, in a terminal.
    Row(
        "depth-missing",
        r"create_publisher\(\) missing 1 .*: 'qos_profile'",
        "An argument is missing: the queue depth was left out.",
        calls.ORDER["create_publisher"],
    ),
    Row(
        "argument-missing",
        r"create_\w+\(\) missing 1 .*: 'qos_profile'",
        "An argument is missing: the queue depth, or the callback before it, was left out.",
        calls.ORDER["create_subscription"],
    ),
    calls.wrong_timer,
    _called_with_others,
    _nothing_to_call,
)


# Services and actions: what a callback gives back, and how work on a goal ends.


def _not_given_back(fault: Fault) -> Meaning | None:
    """Recognise a service's callback that does not give back its response."""
    call = fault.asked
    if call is None or call.method != "send_response" or fault.kind != "TypeError":
        return None
    (given,) = call.given or (None,)
    if given is not None and given.kind == "NoneType":
        means = f"{fault.callback} gives nothing back, so the client never gets an answer."
        return Meaning("response-missing", means, "The last line of a service's callback: return.")
    what = calls.in_words(given) if given is not None else "something"
    return Meaning(
        "response-wrong",
        f"{fault.callback} gives back {what}, and not the response that it was handed.",
        "ROS hands the callback an empty response: fill its fields, and give that one back.",
    )


def _called_with_more(fault: Fault) -> Meaning | None:
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
    return Meaning(
        "callback-parameters",
        f"ROS calls {name} with {counted}{besides}, and it takes {takes or 'none'}.",
        _HANDED_ONE if given == 1 else _HANDED_TWO,
    )


_ANSWER_RULES: tuple[Rule, ...] = (
    Row(
        "wrong-argument",
        r"The service type provided is not valid \(<class '[\w.]*?(\w+)'>\)",
        "{1} is no service type: it holds one message, and a service type holds two.",
        "A service is made from a class that has a Request and a Response inside. Which one?",
    ),
    Row(
        "wrong-argument",
        r"^TypeError: Node\.create_service\(\) takes 4 positional",
        "create_service was given an argument too many.",
        calls.ORDER["create_service"],
    ),
    Row(
        "callback-missing",
        r"^TypeError: Node\.create_service\(\) missing 1 .*: 'callback'",
        "create_service was given no callback.",
        calls.ORDER["create_service"],
    ),
    _not_given_back,
    Row(
        "result-missing",
        r"'result' field must be a sub message of type",
        "The work on a goal ends and gives no Result back.",
        "Make a Result of the action, fill its field, and return it.",
    ),
    Row(
        "feedback-wrong",
        r"^TypeError: $",
        "publish_feedback was given something else than a Feedback of the action.",
        "An action brings three classes: its Goal, its Feedback and its Result.",
        "publish_feedback",
    ),
    Row(
        "canceled-unasked",
        r"invalid transition from state \w+ with event CANCELED",
        "A goal was reported canceled, and nobody had asked for that.",
        "Ask the goal handle first.",
    ),
    Row(
        "ended-twice",
        r"invalid transition from state (\w+) with event",
        "A goal that had ended ({1}) was ended again.",
        "Each goal ends once: on each way only one of the calls.",
    ),
    Row(
        "await-missing",
        r"^TypeError: (?!.* is not callable).*'Future'",
        "A future stands where its result is meant.",
        "A future is an answer that is still to come. What does await do with it?",
    ),
    Row(
        "wrong-argument",
        r"non-integer .*range|'float' object cannot be interpreted as an integer",
        "random.randint was given a number with a decimal point, and draws whole numbers only.",
        "Which function of random draws a number with decimals?",
        r"\brandint\(",
    ),
    Row(
        "await-missing",
        r"^TypeError: .*\bNoneType\b",
        "A future was asked for its result before it had one, and result() gave None.",
        "A future is an answer that is still to come. Which word waits for it?",
        r"\.result\(\)",
    ),
    Row(
        "not-an-integer",
        r"'float' object cannot be interpreted as an integer",
        "A number with a decimal point stands where a whole one belongs.",
        "A sequence of int32 takes whole numbers only, and 19.0 is none for Python.",
    ),
    _called_with_more,
)


# Parameters.

_PARAMETER_RULES: tuple[Rule, ...] = (
    Row(
        "parameter-type",
        r"parameter '([^']+)' to '(.*)' of type '(\w+)', expecting type '(\w+)'",
        "The parameter {1} got {2}, of type {3}, and it was declared with a value of type {4}.",
        "The first value that declare_parameter gets decides about the type: 20 is an INTEGER, a "
        "whole number, and 20.0 is a DOUBLE, a decimal one.",
    ),
    Row(
        "parameter-type",
        r"not one of the allowed types",
        "A parameter got something that no parameter can have as a value.",
        "Behind its name stands the first value: a number, a text, or True or False.",
    ),
    Row(
        "arguments-swapped",
        r"^TypeError: First element .* in parameters list is not a str",
        "declare_parameter got something else in the place of the name.",
        "The name comes first, in quotes, and then the first value.",
    ),
    Row(
        "wrong-argument",
        r"Node\.get_parameter\(\) takes 2 positional",
        "get_parameter takes the name of a parameter, and was given more.",
        "The first value is said once, where the parameter is declared.",
    ),
    Row(
        "parameter-undeclared",
        r"undeclared parameter\(s\): \W*(.+?)\W*$",
        "The node asks for a parameter that is not declared: {1}.",
        "A parameter is declared once, in the constructor, before its value is asked for. Compare "
        "the two names letter by letter.",
    ),
    Row(
        "parameter-twice",
        r"already declared: \W*(.+?)\W*$",
        "The parameter {1} is declared twice.",
        "It is declared once, in the constructor; a callback only asks for its value.",
    ),
    Row(
        "parameter-for-value",
        r"Error: .*'Parameter(?:Value)?'",
        "A parameter, which has a name and a type, too, is used as if it were its value.",
        "What does a parameter offer behind a dot?",
    ),
)


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


def _without_a_name(fault: Fault) -> Meaning | None:
    """Recognise `Duration(2)`: an argument that has to have a name."""
    found = matched(fault, rf"^TypeError: ({_QOS_CALLS})\.__init__\(\) takes 1 positional")
    if not found:
        return None
    return Meaning(
        "wrong-argument",
        f"{found[1]} was given something without a name.",
        f"What it takes has a name in front: {_TAKES.get(found[1], _EVENTS)}.",
    )


def _of_another_name(fault: Fault) -> Meaning | None:
    """Recognise an argument under a name that is not there."""
    said = rf"^TypeError: ({_QOS_CALLS})\.__init__\(\) got an unexpected .*'(\w+)'"
    found = matched(fault, said)
    called, name = (found[1], found[2]) if found else ("QoSProfile", _unknown_policy(fault))
    if not name:
        return None
    return Meaning(
        "wrong-argument",
        f"{called} has no argument {name}.",
        f"It takes {_TAKES.get(called, _EVENTS)}. Compare letter by letter.",
    )


def _unknown_policy(fault: Fault) -> str:
    found = matched(fault, r"Invalid arguments passed to .*dict_keys\(\[(.*)\]\)")
    names = re.findall(r"\w+", found[1]) if found else []
    return next((name for name in names if name not in _POLICIES), "")


def _policy_of_another_kind(fault: Fault) -> Meaning | None:
    """Recognise a text or a number where a policy or a duration belongs."""
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


def _no_such_policy(fault: Fault) -> Meaning | None:
    """Recognise `DurabilityPolicy.TRANSIENT`: Python 3.11 says no more than the name."""
    name = matched(fault, r"^AttributeError: ([A-Za-z_]+)$")
    found = re.search(rf"(\w*Policy)\.{name[1]}\b", fault.code) if name else None
    if not name or not found:
        return None
    return Meaning(
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
    Row(
        "depth-missing",
        r"^InvalidQoSProfileException: .*depth",
        "QoSProfile was not told how many messages the queue holds.",
        "A profile is made with depth= and with whatever else is not as usual.",
    ),
    _without_a_name,
    _of_another_name,
    _policy_of_another_kind,
    _no_such_policy,
    Row(
        "callback-called",
        r"^TypeError: .*?(\w+)\(\) missing 1 required positional argument",
        "{1} is called while the node is being made, and not handed over.",
        "Hand over the method itself, without brackets after its name: it is called later.",
        when=_called_for_an_event,
    ),
    Row(
        "wrong-argument",
        r"'(\w+)' object has no attribute 'create_event_h",
        "event_callbacks was given a {1}, which does not say for which event it is.",
        "A subscription takes SubscriptionEventCallbacks(...), a publisher "
        "PublisherEventCallbacks(...); inside, each event has a name.",
    ),
    Row(
        "wrong-argument",
        r"incompatible constructor arguments.*\n.*EventHandle",
        "The event callbacks are made for the other side of a topic.",
        "A subscription takes SubscriptionEventCallbacks, a publisher PublisherEventCallbacks.",
    ),
)


# Decimal numbers with a comma.

#: Two numbers with nothing but a comma between them, and neither is a part of another word.
_COMMA = re.compile(r"(?<![\w.,'\"])(\d+),(\d+)(?![\w.'\"]|,\d)")
_TOO_MANY = (
    r"\) takes (?:from |at most |exactly )?\d.* (?:but \d|\(\d+ given)|expected at most \d+ arg"
    r"|parameters list is not a ParameterDescriptor"
)


def _decimal_comma(fault: Fault) -> Meaning | None:
    """Recognise `sleep(0,5)` in the place of `sleep(0.5)`, which hands over two numbers."""
    found, call = _COMMA.search(fault.code), fault.asked
    timer = call is not None and call.method == "create_timer" and len(call.given) > 2
    other = re.search(rf"\b(?:{_MESSAGE}|create_publisher|create_subscription)\(", fault.code)
    if not found or other or not (timer or matched(fault, _TOO_MANY)):
        return None
    return Meaning(
        "wrong-argument",
        f"{found[0]} is not one number in Python, but two arguments: {found[1]} and {found[2]}.",
        f"A decimal number is written with a point: {found[1]}.{found[2]}.",
    )


_NO_COMMA = (
    "Where does it get its value? In Python 22,5 is a tuple of two numbers; the decimal number is "
    "written with a point: 22.5."
)
_COMMA_RULES: tuple[Rule, ...] = (
    _decimal_comma,
    Row(
        "decimal-comma",
        r"can only concatenate tuple \(not \"(?:float|int)\"\)"
        r"|(?:of|for) .*'(?:float|int)' and 'tuple'|(?:of|for) .*'tuple' and '(?:float|int)'"
        r"|real number, not '?tuple|passed to tuple\.__format__|type tuple doesn't define __round__"
        r"|bad operand type for abs\(\): 'tuple'",
        "A tuple, which is several values, stands where a number belongs.",
        _NO_COMMA,
    ),
)


# Messages and their fields.

_SHOW = "`ros2 interface show std_msgs/msg/{1}` in a terminal lists what a {1} has."
_ENVELOPE = "The message is an envelope: what it carries is in one of its fields."
_TO_MAKE = {
    "float": "A number such as 18 is an int, and one in quotes is a text. A decimal point makes a "
    "float, and so does float(...).",
    "str": "A text stands in quotes; str(...) or an f-string makes one of a number.",
}
_NO_RETURN = (
    "Where does this value come from? A function that ends without return gives None. Does each "
    "way through it end with a return?"
)
_PLAIN_KINDS = ("int", "bool", "str", "float", "bytes", "list", "tuple", "dict")


def _field_of_another_type(fault: Fault) -> Meaning | None:
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
        got = f"{constant} is {'nothing at all' if kind == 'NoneType' else article(kind)}"
    elif given:
        plain = given.kind in _PLAIN_KINDS
        got = f"what it was given is {article(given.kind) if plain else calls.in_words(given)}"
        others = {
            "message": ("message-for-value", _ENVELOPE),
            "NoneType": ("none-used", _NO_RETURN),
            "tuple": (mistake, _NO_COMMA if wanted == "float" else to_try),
        }
        mistake, to_try = others.get(given.kind, (mistake, to_try))
    else:
        got = "what it was given is something else"
    means = f"The field {name} of the message takes {article(wanted)}, and {got}."
    return Meaning(mistake, means, to_try)


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


def _field_of_another_name(fault: Fault) -> Meaning | None:
    """Recognise `Float32(dat=25.0)` (row 4)."""
    found = matched(fault, r"Invalid arguments passed to constructor: (.+)")
    if not found:
        return None
    kind = re.search(rf"\b({_MESSAGE})\(", fault.code)
    return Meaning(
        "wrong-keyword",
        f"The message has no field called {found[1]}, so it cannot be given one.",
        "Compare the name letter by letter. " + _SHOW.format("", kind[1] if kind else "Float32"),
    )


def _published(fault: Fault) -> Meaning | None:
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
        return Meaning(
            "class-published",
            f"publish was given the class {name} itself, and no message of it.",
            f"{name} is the form; a filled-in form is made by calling it. How do you call a class?",
        )
    if ".msg." in found[2]:
        return Meaning(
            "type-mismatch",
            f"The publisher was made for messages of type {wanted}, and was given a {got}.",
            "One topic carries one type. Compare the line that makes the publisher with the line "
            "that makes the message.",
        )
    return _value_published(wanted, got)


def _value_published(wanted: str, got: str) -> Meaning:
    words = {"NoneType": "None", "bytes": "bytes"}.get(got, f"a bare value, {article(got)}")
    return Meaning(
        "number-published",
        f"publish was given {words}, and not a message.",
        f"Make a {wanted} first and put the value into its field; publish sends that.",
    )


_FIELD_RULES: tuple[Rule, ...] = (
    _field_of_another_type,
    Row(
        "wrong-values",
        r"The '(\w+)' field must be an? [\w ]+ in \[",
        "The number is too large for the field {1}.",
        "Print it before that line, for each call: does it grow from one to the next?",
    ),
    _field_of_another_name,
    Row(
        "field-without-name",
        rf"^TypeError: ({_MESSAGE})\.__init__\(\) takes 1 positional argument but \d",
        "{1}(...) was given a value without the name of the field it belongs in.",
        f"A message can have many fields, so each value is given by its field's name. {_SHOW}",
    ),
    Row(
        "no-publisher",
        rf"'({_MESSAGE})' object has no attribute 'publish'",
        "A message of type {1} stands where a publisher is meant.",
        "A message only carries a value. Which method of a node makes a publisher?",
    ),
    Row(
        "wrong-field",
        rf"'({_MESSAGE})' object has no attribute '((?!__)\w+)'",
        "A {1} has no field called {2}.",
        _SHOW,
    ),
    Row(
        "class-changed",
        r"'(\w+)' object attribute '(\w+)' is read-only",
        "Some line before this one has put a value into {2} of the class {1} itself. That has "
        "spoilt the class for all messages; it is whole again now.",
        "Look for a {1} without brackets behind it, then run your cells again.",
    ),
    _published,
    Row(
        "number-published",
        r"Publisher\.publish\(\) (takes|missing|got)",
        "publish takes exactly one thing, a message, and was called with something else.",
        "Make the message first, put the value into its field, and hand over the message alone.",
        when=lambda fault, _: not called_by_ros(fault),
    ),
    Row(
        "message-for-value",
        rf"^TypeError: (?!.* is not callable).*?(?:['\"]|not |type |to )({_MESSAGE})\b",
        "A whole message of type {1} stands where the value in it is meant.",
        f"{_ENVELOPE} {_SHOW}",
    ),
)


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


def _name_error(fault: Fault) -> Meaning | None:
    """Recognise a name that is defined nowhere."""
    found = matched(fault, r"^NameError: name '(\w+)' is not defined")
    if not found:
        return None
    meant = matched(fault, _SUGGESTED)
    means = f"Python does not know the name {found[1]} here."
    return Meaning("name-error", means, _about(found[1], meant[1] if meant else ""))


def _about(name: str, meant: str) -> str:
    if name in _CAPITALS:
        return "Python's words for yes, no and nothing begin with a capital letter."
    if name in NODE_METHODS or meant.startswith("self."):
        return "It belongs to the node, and inside of its methods the node is called self."
    if meant and meant != name:
        return f"There is something of the name {meant}. Compare the two letter by letter."
    if name in _IMPORTED:
        return "It comes from a package: what stands in the imports at the top?"
    return (
        "A text needs quotes; a method or attribute of the node needs self. before it; and what "
        "is imported or assigned elsewhere has to be spelled alike."
    )


def _not_assigned_yet(fault: Fault) -> Meaning | None:
    """Recognise a variable of a function that has no value yet."""
    if fault.kind != "UnboundLocalError":
        return None
    found = matched(fault, r"variable '(\w+)'")
    name = found[1] if found else "A variable"
    if re.search(rf"^{name} = .*\(\s*{name}\b", fault.code):
        means = f"{name} has no value yet: this line asks for it, and only then gives it one."
        to_try = "If its name is meant, it is a text, and a text needs quotes."
        return Meaning("no-value-yet", means, to_try)
    return Meaning(
        "no-value-yet",
        f"{name} has no value yet at this line.",
        "It gets one in a branch that was not taken, or further below. What should be kept from "
        "one call to the next belongs to the node: self. before it.",
    )


def _no_such_attribute(fault: Fault) -> Meaning | None:
    """Recognise `self.create_publisherr(...)`, `self.tempreature`, `random.unifrom(...)`."""
    owners = r"(?:'(\w+)' object|module '([\w.]+)'|type object '(\w+)')"
    found = matched(fault, rf"^AttributeError: {owners} has no attribute '(\w+)'")
    if not found or found[1] in ("NoneType", "super") or found[1] in MESSAGES:
        return None
    owner, name = found[1] or found[2] or found[3], found[4]
    meant = _meant(fault, owner, name)
    if meant:
        plain = meant.removeprefix("self.").lower()
        alike = get_close_matches(name.lower(), [plain], 1, 0.7)
        return Meaning(
            "wrong-attribute",
            f"{owner} has nothing called {name}; it has {meant}.",
            "Compare the two letter by letter." if alike else "Is that the one?",
        )
    return Meaning("wrong-attribute", f"{owner} has nothing called {name}.", _where(fault, found))


def _meant(fault: Fault, owner: str, name: str) -> str:
    said = matched(fault, _SUGGESTED)
    if said:
        return said[1]
    of_its_own = {"Publisher": ("publish",), "SessionLogger": _LEVELS, "RcutilsLogger": _LEVELS}
    plain = re.sub(r"(?<=[a-z])(?=[A-Z])", "_", name).lower()
    near = get_close_matches(plain, of_its_own.get(owner, NODE_METHODS), 1, 0.8)
    return near[0] if near else ""


def _where(fault: Fault, found: Found) -> str:
    if found[2] or not re.search(rf"\bself\.{re.escape(found[4])}\b", fault.code):
        return "Compare the name with the documentation, or with the line that makes it."
    if fault.callback == "__init__":
        return (
            "What is used in the constructor has to be made on a line above; and a method belongs "
            "to the class only if its def stands as far left as that of the constructor."
        )
    return (
        "Compare the spelling with the line in the constructor that makes it. Does it begin with "
        "self. there, and does that line run?"
    )


def _not_importable(fault: Fault) -> Meaning | None:
    """Recognise `from std_msgs.msg import Float` and `import rclpi`."""
    name = matched(fault, r"cannot import name '(\w+)' from '([\w.]+)'")
    if name:
        near = get_close_matches(name[1], sorted(MESSAGES), 1, 0.6) if "msg" in name[2] else []
        meant = f" It has {near[0]}." if near and near[0] != name[1] else ""
        hint = "Compare the name, and where the package keeps it, with the imports on the page."
        return Meaning("not-importable", f"{name[2]} has no {name[1]}.{meant}", hint)
    module = matched(fault, r"No module named '([\w.]+)'")
    if not module:
        return None
    near = get_close_matches(module[1], _KNOWN_MODULES, 1, 0.7)
    meant = f" There is {near[0]}." if near and near[0] != module[1] else ""
    hint = "Compare its name letter by letter with the imports on the page."
    return Meaning("not-importable", f"There is no module called {module[1]} here.{meant}", hint)


_NAME_RULES: tuple[Rule, ...] = (
    _not_assigned_yet,
    _name_error,
    Row(
        "brackets-missing",
        r"'(function|method|builtin_function_or_method)' object has no attribute '(\w+)'",
        "A method itself was asked for {2}, and not what the method returns.",
        "A method runs only if brackets follow its name. Which one on this line has none?",
    ),
    Row(
        "name-taken",
        r"property '(\w+)' of '\w+' object has no setter|can't set attribute '(\w+)'"
        r"|^AttributeError: (\w+) cannot be modified after node creation",
        "{1} is something that every node has already, and it cannot be replaced.",
        "Take another name for your own attribute; an underscore at its end is enough.",
    ),
    Row(
        "name-taken",
        r"^TypeError: 'method' object is not iterable$",
        "A method of the class has a name that every node needs for something else, such as "
        "clients, services or timers.",
        "Give the method another name, at its def and wherever it is handed over.",
        when=lambda fault, _: (
            fault.callback in ("add", "run")
        ),  # the session failed, not a callback
    ),
    Row(
        "name-taken",
        r"'method' object does not support the context manager protocol|: __enter__$",
        "A method of the class has the name handle, and every node has a handle of its own.",
        "Give the method another name, at its def and wherever it is handed over.",
        r"\bsuper\(\)\.__init__\(",
    ),
    Row(
        "none-used",
        r"'NoneType' object has no attribute '(\w+)'",
        "What stands before .{1} on this line is None.",
        "Where does it get its value? A function without return gives None.",
    ),
    _no_such_attribute,
    _not_importable,
)


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
    Row(
        "text-and-number",
        _TEXT_AND_NUMBER,
        "A text and a number stand side by side where Python wants two of a kind.",
        "An f-string puts a number into a text. A number in quotes is a text.",
    ),
    Row(
        "none-used",
        r"supported .*'NoneType'|real number, not '?NoneType"
        r"|'NoneType' object cannot be interpreted as an integer",
        "Something on this line is None: it has no value, and a number belongs there.",
        "Where does it get its value, and has it got one before the first message comes? A "
        "function without return gives None, and so does a parameter that was declared without a "
        "first value.",
    ),
    Row(
        "none-used",
        r"object of type 'NoneType' has no len\(\)"
        r"|'NoneType' object is not (?:iterable|subscriptable)",
        "What this line takes for a list is None.",
        "Where does it get its value? A function without return gives None, and so do append and "
        "sort, which change the list itself.",
        r"\bself\.\w+",
    ),
    Row(
        "format-code",
        r"Unknown format code '(.)' for object of type '(\w+)'",
        "The letter {1} after the colon in the braces does not fit: the value there is of type "
        "{2}.",
        "f writes a float, with .2f to two decimals; d is for whole numbers, s for texts.",
    ),
    Row(
        "logged-no-text",
        r"rclpy_logging_rcutils_log\(\): incompatible function arguments"
        r"|Logger\.\w+\(\) (takes|missing|got) ",
        "The logger takes one text, and was given something else.",
        "Unlike print it puts nothing together. An f-string makes one text of many parts.",
    ),
    Row(
        "wrong-argument",
        r"^TypeError: Node\.((?!__init__)\w+)\(\) takes 1 positional argument but",
        "{1} was given something, and takes nothing.",
        "Its brackets stay empty; what it returns does the work.",
    ),
    Row(
        "not-callable",
        r"^TypeError: '(\w+)' object is not callable",
        "Brackets follow something of type {1}, which is no function.",
        "Which name on this line stands before the brackets? A module or an object keeps its "
        "functions behind a dot; a value needs no brackets.",
        when=lambda fault, _: not called_by_ros(fault),
    ),
    Row(
        "division-by-zero",
        r"^ZeroDivisionError: |^StatisticsError: .*at least one data point",
        "A number is divided by zero, as by the count of a list that is still empty.",
        "How many readings are there at the first call?",
    ),
    Row(
        "index-error",
        r"^IndexError: .*from (an )?empty",
        "The list is empty, so nothing can be taken out of it.",
        "When does this line run although nothing is there? Ask for that before you take something "
        "out.",
    ),
    Row(
        "index-error",
        r"^IndexError: .*index out of range",
        "The list has no such place: it is shorter than this line expects.",
        "How long is it at the first call? Counting begins at 0, so the last place is its length "
        "less one.",
    ),
    Row(
        "self-missing",
        r"(\w+)\(\) takes 0 positional arguments but (\d)",
        f"{{1}} {_NO_SELF}",
        _OTHER_DEFS,
    ),
    Row(
        "argument-missing",
        r"(\w+)\(\) missing \d required positional arguments?: (.+)",
        "{1} wants {2}, and is called with empty brackets.",
        "Look at the line that begins with def {1}: what does it take besides self?",
        when=lambda fault, found: f"self.{found[1]}()" in fault.code,
    ),
    Row(
        "constructor-parameters",
        r"__init__\(\) missing \d .*?arguments?: (.+)",
        "The constructor wants {1}, and the class is called without arguments.",
        "Whoever runs your node cannot know what to give it: let the constructor take self alone.",
        when=lambda fault, _: not fault.line,
    ),
    Row(
        "calls-itself",
        r"^RecursionError: ",
        "A function calls itself again and again, until Python gives up.",
        "What is to happen again later is a timer's business; a callback only has to return.",
    ),
)

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
