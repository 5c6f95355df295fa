"""Define a remark: a fact about a submitted file that an instructor should know."""

from __future__ import annotations

import unicodedata
from dataclasses import dataclass

#: What a remark is about that is for the instructor only: an answer that reaches for what runs and
#: observes it.
REACHES_INSIDE = "reaches-inside"
#: Characters of a name that a report shows.
_MOST = 120


@dataclass(frozen=True)
class Remark:
    """Tell something about one file.

    Attributes:
        about: What it is: `late`, `duplicate`, `renamed`, `empty`, `half-uploaded`, `mended`,
            `wrong-course`, `unreadable` or `left-out`; or `manual`, a line of `manual.csv`; or
            `roster`, a line of the roster or somebody who is not on it; or `reaches-inside`, an
            answer that reaches for what observes it.
        path: The file, as it was named, made safe to print.
        text: One sentence about what was found and what was done.
    """

    about: str
    path: str
    text: str


def printable(name: str, most: int = _MOST) -> str:
    r"""Return a name without characters that would change a terminal or the direction of text.

    Control, format and unassigned characters (Unicode categories C*) are written as `\u....`.
    """
    shown = name[: most + 1]
    if not shown.isprintable():  # most names are, and the rest takes its time
        shown = "".join(map(_shown, shown))
    return shown if len(shown) <= most else shown[: most - 3] + "..."


def _shown(one: str) -> str:
    return f"\\u{ord(one):04x}" if unicodedata.category(one).startswith("C") else one
