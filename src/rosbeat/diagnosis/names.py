"""Names that Python does not know: of variables, methods, attributes, modules."""

from __future__ import annotations

import re
from difflib import get_close_matches

from rosbeat.diagnosis.meaning import MESSAGES, Meaning, matched
from rosbeat.records import Fault

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


def name_error(fault: Fault) -> Meaning | None:
    """A name that is defined nowhere."""
    found = matched(fault, r"name '(\w+)' is not defined", "NameError")
    if not found:
        return None
    name, meant = found[1], matched(fault, _SUGGESTED)
    return Meaning(
        "name-error",
        f"Python does not know the name {name} here.",
        _about(name, meant[1] if meant else ""),
    )


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


def not_assigned_yet(fault: Fault) -> Meaning | None:
    """A variable of a function that has no value yet."""
    if fault.kind != "UnboundLocalError":
        return None
    found = matched(fault, r"variable '(\w+)'")
    name = found[1] if found else "A variable"
    if re.search(rf"^{name} = .*\(\s*{name}\b", fault.code):
        return Meaning(
            "no-value-yet",
            f"{name} has no value yet: this line asks for it, and only then gives it one.",
            "If its name is meant, it is a text, and a text needs quotes.",
        )
    return Meaning(
        "no-value-yet",
        f"{name} has no value yet at this line.",
        "It gets one in a branch that was not taken, or further below. What should be kept from "
        "one call to the next belongs to the node: self. before it.",
    )


def method_not_called(fault: Fault) -> Meaning | None:
    """`self.get_logger.info(...)`: the brackets behind a method are missing."""
    said = r"'(function|method|builtin_function_or_method)' object has no attribute '(\w+)'"
    found = matched(fault, said, "AttributeError")
    if not found:
        return None
    return Meaning(
        "brackets-missing",
        f"A method itself was asked for {found[2]}, and not what the method returns.",
        "A method runs only if brackets follow its name. Which one on this line has none?",
    )


def name_taken(fault: Fault) -> Meaning | None:
    """`self.publishers = ...`: the node needs that name for itself."""
    found = matched(
        fault,
        r"property '(\w+)' of '\w+' object has no setter|can't set attribute '?(\w*)'?",
        "AttributeError",
    )
    if not found:
        return None
    name = found[1] or found[2] or "That name"
    return Meaning(
        "name-taken",
        f"{name} is something that every node has already, and it cannot be replaced.",
        "Take another name for your own attribute; an underscore at its end is enough.",
    )


def no_such_attribute(fault: Fault) -> Meaning | None:
    """`self.create_publisherr(...)`, `self.tempreature`, `random.unifrom(...)`."""
    said = r"^(?:'(\w+)' object|module '([\w.]+)'|type object '(\w+)') has no attribute '(\w+)'"
    found = matched(fault, said, "AttributeError")
    if not found or found[1] in ("NoneType", "super") or found[1] in MESSAGES:
        return None
    owner, name = found[1] or found[2] or found[3], found[4]
    meant = _meant(fault, owner, name)
    if meant:
        return Meaning(
            "wrong-attribute",
            f"{owner} has nothing called {name}; it has {meant}.",
            "Compare the two letter by letter." if _alike(name, meant) else "Is that the one?",
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


def _alike(name: str, meant: str) -> bool:
    plain = meant.removeprefix("self.")
    return bool(get_close_matches(name.lower(), [plain.lower()], 1, 0.7))


_LEVELS = ("debug", "info", "warning", "warn", "error", "fatal")


def _where(fault: Fault, found: re.Match[str]) -> str:
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


def nothing_there(fault: Fault) -> Meaning | None:
    """`None.publish(...)`: a name that holds None."""
    found = matched(fault, r"'NoneType' object has no attribute '(\w+)'", "AttributeError")
    if not found:
        return None
    return Meaning(
        "none-used",
        f"What stands before .{found[1]} on this line is None.",
        "Where does it get its value? A function without return gives None.",
    )


def not_importable(fault: Fault) -> Meaning | None:
    """`from std_msgs.msg import Float`, `import rclpi`."""
    if fault.kind not in ("ImportError", "ModuleNotFoundError"):
        return None
    name = matched(fault, r"cannot import name '(\w+)' from '([\w.]+)'")
    if name:
        near = get_close_matches(name[1], sorted(MESSAGES), 1, 0.6) if "msg" in name[2] else []
        meant = f" It has {near[0]}." if near and near[0] != name[1] else ""
        hint = "Compare the name, and where the package keeps it, with the imports on the page."
        return Meaning("not-importable", f"{name[2]} has no {name[1]}.{meant}", hint)
    return _no_module(fault)


def _no_module(fault: Fault) -> Meaning | None:
    module = matched(fault, r"No module named '([\w.]+)'")
    if not module:
        return None
    near = get_close_matches(module[1], _KNOWN_MODULES, 1, 0.7)
    meant = f" There is {near[0]}." if near and near[0] != module[1] else ""
    hint = "Compare its name letter by letter with the imports on the page."
    return Meaning("not-importable", f"There is no module called {module[1]} here.{meant}", hint)
