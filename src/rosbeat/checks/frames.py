"""The frame around what a learner is told in a cell: a coloured edge, and nothing else of its own.

Background and text colour are the reader's theme. What the colour of the edge says, a sign and a
word say as well. Every text is escaped here, and only here.
"""

from __future__ import annotations

from html import escape

#: Signs for what went well, for what did not, for what was not tried, and for a hint.
RIGHT, WRONG, OPEN, HELP = "\N{CHECK MARK}", "\N{BALLOT X}", "\N{WHITE CIRCLE}", "\N{BULLET}"

#: Colours of the edge, at least 3:1 against a white and against a dark page.
EDGES = {RIGHT: "#00875f", WRONG: "#c65102", OPEN: "#6b7b8b", HELP: "#3a7ab8"}
_MOST_LINES = 40
_MOST_LETTERS = 4000


def framed(sign: str, *rows: str) -> str:
    """Put rows of HTML into a frame.

    Args:
        sign: Which frame, such as `RIGHT`.
        rows: HTML that is escaped already; empty rows are left out.
    """
    style = f"border-left:4px solid {EDGES[sign]};padding:0.3em 0.8em;margin:0.3em 0"
    body = "".join(f"<div>{row}</div>" for row in rows if row)
    return f'<div style="{style}">{body}</div>'


def words(text: str, mark: str = "") -> str:
    """Make HTML of a text; several lines keep their shape.

    Args:
        text: Any text.
        mark: An HTML element to put it into, such as `strong`.
    """
    text = clipped(text)
    if "\n" in text:
        return code(text)
    return f"<{mark}>{escape(text)}</{mark}>" if mark else escape(text)


def code(text: str) -> str:
    """Make HTML of a text that keeps its shape.

    Args:
        text: Any text, such as a program.
    """
    return f"<pre>{escape(text)}</pre>"


def indented(text: str, by: str = "  ") -> str:
    """Return a text with every line but the first one set in, for plain text."""
    return clipped(text).replace("\n", f"\n{by}")


def clipped(text: str) -> str:
    """Return a text that somebody can read: its beginning, if it is very long."""
    lines = text.strip("\n").split("\n")
    shown = "\n".join(lines[:_MOST_LINES])[:_MOST_LETTERS]
    if len(shown) == len(text.strip("\n")):
        return shown
    return f"{shown}\n... and more, {len(text):,} characters in all"
