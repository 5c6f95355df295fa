"""Making a node, naming it, and ROS itself: rows 11, 12, 15, 17, 18 and 19 of the table."""

from __future__ import annotations

import re
from itertools import pairwise

from rosbeat.diagnosis.calls import asked_of
from rosbeat.diagnosis.meaning import Meaning, matched
from rosbeat.records import Fault

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


def parent_not_called(fault: Fault) -> Meaning | None:
    """`super().__init__('name')` forgotten, too late, or misspelt (row 11)."""
    if matched(fault, rf"has no attribute '({_MADE_BY_NODE})'", "AttributeError"):
        means = "The node is used before it is made: super().__init__ has not been called yet."
    elif found := matched(fault, r"'super' object has no attribute '(\w+)'", "AttributeError"):
        means = f"The parent's constructor is not called {found[1]}."
    elif matched(fault, r"'__init__' requires a 'super' object", "TypeError"):
        means = "super itself was asked, and it is super(), with brackets, that finds the parent."
    else:
        return None
    return Meaning("super-missing", means, _SUPER)


_NAME = "The parent's constructor, super().__init__, takes the node's name, a text in quotes."


def name_missing(fault: Fault) -> Meaning | None:
    """`super().__init__()` without a name (row 11)."""
    if matched(fault, r"error creating node: name argument is null"):
        return Meaning("node-name-missing", "The node's name is None.", _NAME)
    found = matched(fault, r"\b(\w*)Node\.__init__\(\) missing 1 .*'node_name'", "TypeError")
    # An `AlarmNode` is a class of the learner's, and only its heirs leave the name out.
    own = found and found[1] not in ("", "Lifecycle") and "super()" not in fault.code
    if not found or own:
        return None
    asked = asked_of(fault)
    if asked and asked.given and asked.given[0].kind == "str":
        return Meaning(
            "super-missing",
            "Node.__init__ was called without the node that it is to make.",
            _SUPER,
        )
    if fault.line and fault.callback == "__init__":
        return Meaning("node-name-missing", "The node was made without a name.", _NAME)
    return Meaning(
        "node-name-missing",
        "The class has no constructor of its own that gives the node a name.",
        "Look at the line that should begin the constructor: is it spelled `__init__`, with two "
        "underscores on both sides, and does it stand inside of the class?",
    )


def wrong_name_argument(fault: Fault) -> Meaning | None:
    """`super().__init__(5)`, `super().__init__(self, 'name')`."""
    asked = asked_of(fault)
    if asked is None or asked.method != "Node.__init__":
        return None
    if len(asked.given) > 1 and asked.given[0].kind == asked.given[1].kind:
        return Meaning(
            "wrong-argument",
            "super().__init__ was given self, which super() hands over by itself.",
            _NAME,
        )
    name = asked.named.get("node_name") or (asked.given[1] if len(asked.given) > 1 else None)
    if name is None or name.kind == "str":
        return None
    return Meaning("wrong-argument", f"The node got {name} in the place of its name.", _NAME)


_LETTERS = "Names hold letters of the English alphabet, digits and `_`, and begin with a letter."
_RULES = {
    "Node": _LETTERS,
    "Topic": f"{_LETTERS} A slash may stand between two parts, and not at the end.",
}
_REASONS = (
    ("must not be empty", "it is empty"),
    ("must not end with a forward slash", "it ends with a slash"),
    ("must not start with a number", "a digit stands at the beginning of it or of a part"),
    ("must not contain repeated '/'", "two slashes stand side by side"),
)


def invalid_name(fault: Fault) -> Meaning | None:
    """A name with characters that ROS does not allow (row 12)."""
    if matched(fault, r"unknown substitution|topic name .* is invalid", "ValueError"):
        return Meaning(
            "invalid-name",
            "The topic's name holds braces, and nothing is known that belongs in them.",
            "An f-string has an f before its quotes; in a plain text braces stay braces.",
        )
    found = re.match(r"Invalid(Node|Topic|Service|Namespace|Handle)Name\w*", fault.kind)
    if not found:
        return None
    kind = "node" if found[1] == "Node" else found[1].lower()
    name = matched(fault, r"\n\s*'(.*)'")
    subject = f"'{name[1]}'" if name and name[1] else "That"
    return Meaning(
        "invalid-name",
        f"{subject} cannot be the name of a {kind}: {_reason(fault.text)}.",
        _RULES.get(found[1], _RULES["Topic"]),
    )


def _reason(text: str) -> str:
    for sign, words in _REASONS:
        if sign in text:
            return words
    character = _marked(text)
    if character == " ":
        return "it holds a blank"
    return f"it holds the character {character}" if character else "ROS does not allow it"


def _marked(text: str) -> str:
    """The character under which the message of ROS puts its `^`."""
    rows = text.split("\n")
    for row, below in pairwise(rows):
        at = below.find("^")
        if at >= 0 and not below.strip("^ ") and at < len(row):
            return row[at]
    return ""


def two_types(fault: Fault) -> Meaning | None:
    """Two message types on one topic, as one participant notices it (row 15)."""
    found = matched(fault, r"invalid allocator|existing (\w* ?)topic name .* incompatible type")
    if not found:
        return None
    if found[1]:  # of a service, which is made of two topics
        means = "The service exists already, with another type."
        hint = "A service and its clients have to name the same type. Which one do the others use?"
        return Meaning("type-mismatch", means, hint)
    return Meaning(
        "type-mismatch",
        "The topic exists already, with another message type.",
        "One topic carries one type. Which one do the others use on this topic?",
    )


def not_initialised(fault: Fault) -> Meaning | None:
    """ROS was not started, twice started, or twice ended (row 17)."""
    if fault.kind in ("NotInitializedException", "NoSessionError"):
        return Meaning(
            "not-initialised",
            "A node was made before ROS was started.",
            "In a program one call starts ROS, and it comes before the first node. Look at the "
            "beginning of main.",
        )
    if matched(fault, r"Context\.init\(\) must only be called once", "RuntimeError"):
        return Meaning(
            "initialised-twice",
            "ROS was started twice.",
            "Once is enough for a program. Look for a second rclpy.init, in main and elsewhere.",
        )
    return _twice_ended(fault)


def _twice_ended(fault: Fault) -> Meaning | None:
    if not matched(fault, r"must be initialized before it can be shutdown|rcl_shutdown already"):
        return None
    return Meaning(
        "shut-down-twice",
        "ROS was shut down a second time.",
        "Ctrl+C shuts it down, too. `rclpy.try_shutdown` does so only if it still runs.",
    )


def init_in_with(fault: Fault) -> Meaning | None:
    """`with rclpy.init():`, from newer documentation (row 19)."""
    said = r"^__enter__$|'NoneType' object does not support the context manager protocol"
    if not matched(fault, said, "TypeError", "AttributeError"):
        return None
    if not re.search(r"\binit\(", fault.code):
        return None
    return Meaning(
        "init-in-with",
        "In this version of ROS, `rclpy.init` returns nothing, so `with` has nothing to work with.",
        "Documentation of newer versions writes it so. Here ROS is started and ended by two calls "
        "of their own.",
    )


def no_node(fault: Fault) -> Meaning | None:
    """Something was handed over that is no node (its sentence is the session's own)."""
    if fault.kind != "NodeClassError" or not fault.text:
        return None
    to_try = "Hand over the class that you wrote, by its name, without quotes and brackets."
    if "is a class, but not a node" in fault.text:
        to_try = "A class becomes a node by what stands in brackets behind its name: its parent."
    elif " returned, " in fault.text:
        to_try = "A function that makes a node has to give it back. What does its last line do?"
    return Meaning("no-node", fault.text, to_try)


def exits(fault: Fault) -> Meaning | None:
    """`sys.exit()` in a node."""
    if fault.kind != "SystemExit":
        return None
    return Meaning(
        "exits",
        "This line ends the whole program, and every node in it.",
        "A node runs until somebody outside ends it. Take that line out.",
    )
