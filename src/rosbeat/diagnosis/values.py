"""Values of a kind that Python cannot work with at that place."""

from __future__ import annotations

import re

from rosbeat.diagnosis.meaning import Meaning, called_by_ros, matched
from rosbeat.records import Fault

_TEXT_AND_NUMBER = (
    r"can only concatenate str \(not \"(?:float|int)\"\)",
    r"unsupported operand type\(s\) for [^:]+: '(?:float|int)' and 'str'",
    r"unsupported operand type\(s\) for [^:]+: 'str' and '(?:float|int)'",
    r"not supported between instances of '(?:float|int)' and 'str'",
    r"not supported between instances of 'str' and '(?:float|int)'",
    r"must be str, not (?:float|int)",
)


def text_and_number(fault: Fault) -> Meaning | None:
    """`"Temperature " + msg.data`, `msg.data > "26"`."""
    if not any(matched(fault, pattern, "TypeError") for pattern in _TEXT_AND_NUMBER):
        return None
    return Meaning(
        "text-and-number",
        "A text and a number stand side by side where Python wants two of a kind.",
        "An f-string puts a number into a text. A number in quotes is a text.",
    )


def nothing_compared(fault: Fault) -> Meaning | None:
    """`msg.data > high`, where `high` is None."""
    said = r"not supported between instances of (?:'NoneType' and '\w+'|'\w+' and 'NoneType')"
    if not matched(fault, said, "TypeError"):
        return None
    return Meaning(
        "none-used",
        "One of the two things that are compared on this line is None: it has no value.",
        "Where does it get its value? A function without return gives None, and so does a "
        "parameter that was declared without a first value.",
    )


def bad_format(fault: Fault) -> Meaning | None:
    """`f"{value:d}"` of a float, `f"{text:.2f}"`."""
    found = matched(fault, r"Unknown format code '(.)' for object of type '(\w+)'", "ValueError")
    if not found:
        return None
    return Meaning(
        "format-code",
        f"The letter {found[1]} after the colon in the braces does not fit: the value there is "
        f"of type {found[2]}.",
        "f writes a float, with .2f to two decimals; d is for whole numbers, s for texts.",
    )


def logged(fault: Fault) -> Meaning | None:
    """`get_logger().info(msg.data)`, `info("Temperature", 22.0)`."""
    refused = r"rclpy_logging_rcutils_log\(\): incompatible function arguments"
    misused = r"Logger\.\w+\(\) (takes|missing|got) "
    if not matched(fault, f"{refused}|{misused}", "TypeError"):
        return None
    return Meaning(
        "logged-no-text",
        "The logger takes one text, and was given something else.",
        "Unlike print it puts nothing together. An f-string makes one text of many parts.",
    )


def too_much_given(fault: Fault) -> Meaning | None:
    """`get_logger("name")`, and other methods of a node that take nothing."""
    found = matched(fault, r"^Node\.(\w+)\(\) takes 1 positional argument but", "TypeError")
    if not found or found[1] == "__init__":
        return None
    return Meaning(
        "wrong-argument",
        f"{found[1]} was given something, and takes nothing.",
        "Its brackets stay empty; what it returns does the work.",
    )


def not_callable(fault: Fault) -> Meaning | None:
    """`random(-0.5, 0.5)`, `self.publisher_(msg)`, `msg.data()`."""
    found = matched(fault, r"^'(\w+)' object is not callable", "TypeError")
    if not found or called_by_ros(fault):
        return None
    return Meaning(
        "not-callable",
        f"Brackets follow something of type {found[1]}, which is no function.",
        "Which name on this line stands before the brackets? A module or an object keeps its "
        "functions behind a dot; a value needs no brackets.",
    )


def by_zero(fault: Fault) -> Meaning | None:
    """A mean of nothing."""
    nothing = matched(fault, r"at least one data point", "StatisticsError")
    if fault.kind != "ZeroDivisionError" and not nothing:
        return None
    return Meaning(
        "division-by-zero",
        "A number is divided by zero, as by the count of a list that is still empty.",
        "How many readings are there at the first call?",
    )


def no_such_place(fault: Fault) -> Meaning | None:
    """Recognise an index beyond the end of a list, and something taken out of an empty one."""
    if matched(fault, r"from (an )?empty", "IndexError"):
        return Meaning(
            "index-error",
            "The list is empty, so nothing can be taken out of it.",
            "When does this line run although nothing is there? Ask for that before you take "
            "something out.",
        )
    if not matched(fault, r"index out of range", "IndexError"):
        return None
    return Meaning(
        "index-error",
        "The list has no such place: it is shorter than this line expects.",
        "How long is it at the first call? Counting begins at 0, so the last place is its length "
        "less one.",
    )


def without_self(fault: Fault) -> Meaning | None:
    """`def helper():` in a class, or a constructor without self."""
    found = matched(fault, r"(\w+)\(\) takes 0 positional arguments but (\d)", "TypeError")
    if not found:
        return None
    return Meaning(
        "self-missing",
        f"{found[1]} takes no parameter, and Python hands every method its own object.",
        "Compare its `def` line with those of the other methods of a class.",
    )


def method_wants_more(fault: Fault) -> Meaning | None:
    """`self.change()`, where `def change(self, mode)` wants a mode."""
    said = r"(\w+)\(\) missing \d required positional arguments?: (.+)"
    found = matched(fault, said, "TypeError")
    if not found or not re.search(rf"\bself\.{found[1]}\(\)", fault.code):
        return None
    return Meaning(
        "argument-missing",
        f"{found[1]} wants {found[2].replace(chr(39), '')}, and is called with empty brackets.",
        f"Look at the line that begins with def {found[1]}: what does it take besides self?",
    )


def constructor_wants_more(fault: Fault) -> Meaning | None:
    """`def __init__(self, name):`: whoever runs the node cannot know what to give."""
    found = matched(fault, r"__init__\(\) missing \d .*?arguments?: (.+)", "TypeError")
    if not found or fault.line or "Node.__init__" in fault.text:
        return None
    return Meaning(
        "constructor-parameters",
        f"The constructor wants {found[1]}, and the class is called without arguments.",
        "Whoever runs your node cannot know what to give it: let the constructor take self alone.",
    )


def too_deep(fault: Fault) -> Meaning | None:
    """A function that calls itself for ever."""
    if fault.kind != "RecursionError":
        return None
    return Meaning(
        "calls-itself",
        "A function calls itself again and again, until Python gives up.",
        "What is to happen again later is a timer's business; a callback only has to return.",
    )
