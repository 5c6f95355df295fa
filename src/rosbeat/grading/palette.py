"""Signs, words and colours of the statuses, for pages that people read.

What differs in colour differs in sign and word as well. `LIGHT` and `DARK` hold the colours of both
themes; text in them has a contrast of at least 4.5:1 to what it stands on (WCAG 2.2, 1.4.3), and
what is drawn has an outline in the colour of the text.
"""

from __future__ import annotations

from dataclasses import dataclass

from rosbeat.exercises.cards import LOOKS
from rosbeat.exercises.exercise import FAILED, NOT_ATTEMPTED, PASSED
from rosbeat.grading.marks import HELD, LOOKED_AT, MISSING


@dataclass(frozen=True)
class Look:
    """How a status looks and what it is called.

    Attributes:
        sign: One character.
        word: What a learner is told.
        of_class: What an instructor is told of a class.
        kind: Its name in style sheets.
    """

    sign: str
    word: str
    of_class: str
    kind: str


#: How each status looks, in the order in which lists and bars show them.
STATUSES = {
    PASSED: Look(*LOOKS[PASSED], "passed", "passed"),
    LOOKED_AT: Look("✎", "looked at by your instructor", "looked at by you", "seen"),
    FAILED: Look(*LOOKS[FAILED], "not there yet", "failed"),
    NOT_ATTEMPTED: Look(*LOOKS[NOT_ATTEMPTED], "not attempted", "open"),
    MISSING: Look("\N{EN DASH}", "page not handed in", "page not handed in", "missing"),
    HELD: Look("?", "no points yet", "held", "held"),
}

#: Colours of the light theme: page, card, text, lines, and of each kind its fill and its text.
LIGHT = {
    "page": "#ffffff",
    "card": "#f6f7f5",
    "ink": "#1f2933",
    "muted": "#52606d",
    "rule": "#c3cad2",
    "link": "#005a8f",
    "passed": "#00694d",
    "on-passed": "#ffffff",
    "failed": "#a84300",
    "on-failed": "#ffffff",
    "open": "#52606d",
    "on-open": "#ffffff",
    "missing": "#dfe4e9",
    "on-missing": "#1f2933",
    "held": "#1b5fa8",
    "on-held": "#ffffff",
    "seen": "#6b3fa0",
    "on-seen": "#ffffff",
}
#: Colours of the dark theme.
DARK = {
    "page": "#14181c",
    "card": "#1e242a",
    "ink": "#e8ebee",
    "muted": "#b0bac4",
    "rule": "#4a545e",
    "link": "#7cc4f5",
    "passed": "#4cc9a0",
    "on-passed": "#0c1a15",
    "failed": "#ffa266",
    "on-failed": "#241104",
    "open": "#9aa7b4",
    "on-open": "#12171c",
    "missing": "#333c45",
    "on-missing": "#e8ebee",
    "held": "#7db8f2",
    "on-held": "#07182a",
    "seen": "#c9a6f2",
    "on-seen": "#1d0c33",
}


def look_of(status: str) -> Look:
    """How a status looks; one that nobody knows is shown by its own name.

    Args:
        status: The status of a mark.
    """
    return STATUSES.get(status) or Look("?", status, status, "held")


def variables(colours: dict[str, str]) -> str:
    """Colours as custom properties of CSS.

    Args:
        colours: `LIGHT` or `DARK`.
    """
    return " ".join(f"--{name}: {colour};" for name, colour in colours.items())
