"""Parameters: of another type, not declared, declared twice, or taken for their values."""

from __future__ import annotations

from rosbeat.diagnosis.meaning import Meaning, matched
from rosbeat.records import Fault

_KINDS = {
    "DOUBLE": "a decimal number",
    "INTEGER": "a whole number",
    "STRING": "a text",
    "BOOL": "True or False",
}
_REFUSED = r"parameter '([^']+)' to '(.*)' of type '(\w+)', expecting type '(\w+)'"


def of_another_type(fault: Fault) -> Meaning | None:
    """`declare_parameter("low", 20)` for a node that is started with `-p low:=40.0`."""
    found = matched(fault, _REFUSED, "InvalidParameterTypeException")
    if not found:
        return None
    name, value, got, declared = found.groups()
    return Meaning(
        "parameter-type",
        f"The parameter {name} got {value}, {_kind(got)}, and it was declared with "
        f"{_kind(declared)}.",
        "The first value that declare_parameter gets decides about the type: 20 is a whole "
        "number, 20.0 is a decimal one.",
    )


def _kind(word: str) -> str:
    return _KINDS.get(word, word.lower().replace("_", " "))


def no_value(fault: Fault) -> Meaning | None:
    """`declare_parameter("high", float)`: a type where the first value belongs."""
    if not matched(fault, r"not one of the allowed types", "TypeError"):
        return None
    return Meaning(
        "parameter-type",
        "A parameter got something that no parameter can have as a value.",
        "Behind its name stands the first value: a number, a text, or True or False.",
    )


def name_last(fault: Fault) -> Meaning | None:
    """`declare_parameter(20.0, "low")`: the first value before the name."""
    if not matched(fault, r"^First element .* in parameters list is not a str", "TypeError"):
        return None
    return Meaning(
        "arguments-swapped",
        "declare_parameter got something else in the place of the name.",
        "The name comes first, in quotes, and then the first value.",
    )


def asked_with_more(fault: Fault) -> Meaning | None:
    """`get_parameter("low", 20.0)`: a first value where there is only a name to give."""
    if not matched(fault, r"Node\.get_parameter\(\) takes 2 positional", "TypeError"):
        return None
    return Meaning(
        "wrong-argument",
        "get_parameter takes the name of a parameter, and was given more.",
        "The first value is said once, where the parameter is declared.",
    )


def not_declared(fault: Fault) -> Meaning | None:
    """`self.get_parameter("high")` before, or without, a `declare_parameter("high", ...)`."""
    if fault.kind != "ParameterNotDeclaredException":
        return None
    found = matched(fault, r"undeclared parameter\(s\): (.+)")
    name = f": {found[1].strip(chr(39) + '[]. ')}" if found else ""
    return Meaning(
        "parameter-undeclared",
        f"The node asks for a parameter that is not declared{name}.",
        "A parameter is declared once, in the constructor, before its value is asked for. Compare "
        "the two names letter by letter.",
    )


def declared_twice(fault: Fault) -> Meaning | None:
    """The same `declare_parameter` a second time, as in a callback."""
    found = matched(fault, r"already declared: (.+)", "ParameterAlreadyDeclaredException")
    if not found:
        return None
    name = found[1].strip("[]'. ")
    return Meaning(
        "parameter-twice",
        f"The parameter {name} is declared twice.",
        "It is declared once, in the constructor; a callback only asks for its value.",
    )


def taken_for_its_value(fault: Fault) -> Meaning | None:
    """`msg.data > self.get_parameter("high")`: the parameter is more than its value."""
    if not matched(fault, r"'Parameter(?:Value)?'", "TypeError", "AttributeError"):
        return None
    return Meaning(
        "parameter-for-value",
        "A parameter, which has a name and a type, too, is used as if it were its value.",
        "What does a parameter offer behind a dot?",
    )
