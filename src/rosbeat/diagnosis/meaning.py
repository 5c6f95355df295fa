"""What an error means, and the small tools that every recogniser uses."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass

from rosbeat.records import Fault


@dataclass(frozen=True)
class Meaning:
    """An error that was recognised, in the words of this course.

    Attributes:
        mistake: Its id, from `mistakes.MISTAKES`.
        means: What happened, as a sentence or two.
        to_try: Where to look, without the answer, one or two sentences.
        aside: A sentence about the error's own words, for where they stand above; may be empty.
    """

    mistake: str
    means: str
    to_try: str
    aside: str = ""

    @property
    def beside_error(self) -> str:
        """What happened, said where the error's own words can be read."""
        return f"{self.means} {self.aside}".strip()


#: A function that knows one kind of mistake; None if this is none of its kind.
Recogniser = Callable[[Fault], "Meaning | None"]

#: The types of `std_msgs`, which learners of this course use.
MESSAGES = frozenset(
    (
        *("Bool", "Byte", "Char", "ColorRGBA", "Empty", "Float32", "Float64", "Header", "String"),
        *("Int8", "Int16", "Int32", "Int64", "UInt8", "UInt16", "UInt32", "UInt64"),
        *("Float32MultiArray", "Float64MultiArray", "Int32MultiArray"),
    )
)

_SPIN = re.compile(r"\b(spin|spin_once|spin_until_future_complete)\(")


def matched(fault: Fault, pattern: str, *kinds: str) -> re.Match[str] | None:
    """Look for a pattern in an exception's text.

    Args:
        fault: The exception.
        pattern: A regular expression.
        kinds: Only of these classes; of every class if there are none.
    """
    return re.search(pattern, fault.text) if not kinds or fault.kind in kinds else None


def called_by_ros(fault: Fault) -> bool:
    """Whether the call that failed was made by ROS, and not by a line of the learner's."""
    return not fault.line or _SPIN.search(fault.code) is not None


def article(word: str) -> str:
    """A word with `a` or `an` before it."""
    return f"an {word}" if word[:1].lower() in tuple("aeio") else f"a {word}"
