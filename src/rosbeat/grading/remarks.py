"""Tell what is worth knowing about one file, or about one line that an instructor wrote."""

from __future__ import annotations

from dataclasses import dataclass

#: What a remark is about that is for the instructor only: an answer that reaches for what runs and
#: observes it.
REACHES_INSIDE = "reaches-inside"


@dataclass(frozen=True)
class Remark:
    """Tell something about one file.

    Attributes:
        about: What it is: `late`, `duplicate`, `renamed`, `empty`, `wrong-course`, `unreadable`
            or `left-out`; or `manual`, a line of `manual.csv`; or
            `roster`, a line of the roster or somebody who is not on it; or `reaches-inside`, an
            answer that reaches for what observes it; or `team`, a page that a team shares.
        path: The file, as it was named, made safe to print.
        text: One sentence about what was found and what was done.
    """

    about: str
    path: str
    text: str
