"""Show messages and outcomes of checks in a cell."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator, Sequence
from dataclasses import asdict, dataclass
from html import escape
from itertools import groupby
from textwrap import dedent
from typing import TYPE_CHECKING, Any, ClassVar

from rosbeat.diagnosis.mistakes import MISTAKES, in_html
from rosbeat.exercises.exercise import FAILED, NOT_ATTEMPTED, PASSED
from rosbeat.records import Observation, Outcome, Part

if TYPE_CHECKING:
    from pygments.lexer import Lexer
    from pygments.token import _TokenType

# The frame around what a learner is told in a cell: a coloured edge, and nothing else of its own.

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
    """Make HTML of a text; several lines keep their shape, and `code` becomes an element.

    Args:
        text: Any text.
        mark: An HTML element to put it into, such as `strong`.
    """
    text = clipped(text)
    if "\n" in text:
        return f"<pre>{escape(text)}</pre>"
    said = in_html(text, highlighted)
    return f"<{mark}>{said}</{mark}>" if mark else said


def code(text: str) -> str:
    """Make HTML of a cell or a program, with the colours of its language.

    Args:
        text: The code; any other text keeps its shape and has no colours.
    """
    return f"<pre>{highlighted(text)}</pre>"


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


# Code in colours: Python, or the commands of a terminal.
#
# Each colour has a value for light and one for dark pages, of which the browser chooses by the
# `color-scheme` that JupyterLab sets with its theme. In a notebook that is not trusted JupyterLab
# drops them, and the code has the colour of the page.

#: Colours on a light and on a dark page, each with a contrast of at least 4.5:1.
KEYWORD, STRING = ("#b31d28", "#ff8a80"), ("#0a3069", "#a5d6ff")
NUMBER, NAME, COMMENT = ("#0550ae", "#79c0ff"), ("#6f42c1", "#d2a8ff"), ("#57606a", "#9da5ae")

#: The first line of a cell that is no Python: its magic, and the name of a terminal or a file.
_MAGIC = re.compile(r"%%(?P<magic>\w+)[ \t]*(?P<name>\S*)[^\n]*(?:\n|\Z)")


def highlighted(text: str) -> str:
    """Return the HTML of code, with colours if it is Python or a cell for a terminal.

    Args:
        text: Code, a cell, or any other text, which has no colours then.
    """
    magic = _MAGIC.match(text)
    head, body = (text[: magic.end()], text[magic.end() :]) if magic else ("", text)
    lexer = _lexer(body, magic["magic"] if magic else "", magic["name"] if magic else "")
    return escape(head) + ("".join(_spans(lexer, body)) if lexer else escape(body))


def _lexer(text: str, magic: str, name: str) -> Lexer | None:
    from pygments.lexers.python import PythonLexer
    from pygments.lexers.shell import BashLexer

    if magic in ("terminal", "bash"):
        return BashLexer(stripnl=False, ensurenl=False)
    if (not magic or name.endswith(".py")) and _is_python(text):
        return PythonLexer(stripnl=False, ensurenl=False)
    return None


def _is_python(text: str) -> bool:
    try:
        ast.parse(dedent(text))
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return False
    return True


def _spans(lexer: Lexer, text: str) -> Iterator[str]:
    for colours, tokens in groupby(lexer.get_tokens(text), lambda token: _colours(token[0])):
        part = escape("".join(one for _, one in tokens))
        light, dark = colours or ("", "")
        style = f"color:light-dark({light},{dark})"
        yield f'<span style="{style}">{part}</span>' if colours else part


def _colours(kind: _TokenType) -> tuple[str, str] | None:
    from pygments.token import Comment, Keyword, Name, Number, Operator, String

    if kind in Comment:
        return COMMENT
    if kind in String:
        return STRING
    if kind in Keyword or kind in Operator.Word:
        return KEYWORD
    if kind in Number:
        return NUMBER
    named = (Name.Function, Name.Class, Name.Builtin, Name.Decorator, Name.Variable)
    return NAME if any(kind in one for one in named) else None


# What an answer printed and logged while it was checked.

#: Lines of each that are shown.
_FIRST = 5


def output_of(seen: object, printed: Sequence[str], status: str) -> tuple[tuple[str, str], ...]:
    """Return the first lines that an answer printed and logged, each with what it is.

    What a right answer logs is what the exercise asked for, and goes without saying.

    Args:
        seen: What the scenario has written down; only a node's observation has log lines.
        printed: What the answer has printed, piece by piece.
        status: What the judge says.
    """
    rows = {"Your code printed": "".join(printed).splitlines()}
    if isinstance(seen, Observation) and seen.subject and status == FAILED:
        name = seen.subject.strip("/").replace("/", ".")
        rows["Your node logged"] = [f"{one.time_ns / 1e9:.2f} s  {one.level}  {one.text}"
                                    for one in seen.logs if one.name == name]  # fmt: skip
    return tuple((what, _first_of(lines)) for what, lines in rows.items() if lines)


def _first_of(lines: Sequence[str]) -> str:
    more = len(lines) - _FIRST
    rest = [f"... and {more} more line{'s' if more > 1 else ''}"] if more > 0 else []
    return "\n".join([*map(_short, lines[:_FIRST]), *rest])


def _short(line: str) -> str:
    """Return a line that fits on a page."""
    return line if len(line) <= _WIDEST else f"{line[: _WIDEST - 4]} ..."


#: Characters of such a line.
_WIDEST = 160

# An outcome as a learner sees it in a cell.

#: The record of an outcome in a cell's output, for programs.
MIME = "application/vnd.rosbeat.outcome+json"
VERSION = 1

#: Sign and word of each status.
LOOKS = {
    PASSED: (RIGHT, "passed"),
    FAILED: (WRONG, "not there yet"),
    NOT_ATTEMPTED: (OPEN, "still open"),
}


@dataclass(frozen=True)
class Shown:
    """Hold an outcome, with the ways in which Jupyter and a terminal show it.

    Attributes:
        outcome: The outcome.
        output: What the answer printed and logged while it was checked: what that is, and lines.
    """

    outcome: Outcome
    output: tuple[tuple[str, str], ...] = ()

    def __str__(self) -> str:
        return "\n".join([f"{self._head} {indented(self.outcome.evidence)}".strip(), *self._rows()])

    def __repr__(self) -> str:
        return str(self)

    def html(self) -> str:
        """Return the outcome as HTML."""
        head = f"{words(self._head, 'strong')} {words(self.outcome.evidence)}"
        rows = (_labelled(label, text) for label, text in self._details())
        return framed(self._look[0], head, *rows)

    def record(self) -> dict[str, Any]:
        """Return the outcome as JSON-like data, with the version of its form."""
        said = {"version": VERSION, **asdict(self.outcome), "remarks": list(self.outcome.remarks)}
        parts = list(said.pop("parts"))
        return {**said, "parts": parts} if parts else said

    #: Whether buttons below it lead to hints.
    _has_buttons: ClassVar[bool] = False

    @property
    def _look(self) -> tuple[str, str]:
        return LOOKS[self.outcome.status]

    @property
    def _head(self) -> str:
        sign, word = self._look
        return f"{sign} Exercise {self.outcome.exercise}: {word}{self._points()}."

    def _points(self) -> str:
        """Return the points; those of a try that has none yet go without saying."""
        if self.outcome.out_of == 1 or self.outcome.points == 0:
            return ""
        return f", {self.outcome.points} of {self.outcome.out_of} points"

    def _rows(self) -> Iterator[str]:
        for label, text in self._details():
            between = "\n    " if "\n" in text else " "
            yield f"  {f'{label}:{between}' if label else ''}{indented(text, '    ')}"

    def _details(self) -> Iterator[tuple[str, str]]:
        """Generate what comes below the head: a label, which may be empty, and a text."""
        for part in self.outcome.parts:
            yield _looked_at(part)
        if self.outcome.status == FAILED and self.outcome.mistake not in MISTAKES:
            yield "", "The check doesn't recognize this mistake."
        if self.outcome.hint:
            yield "Hint", self.outcome.hint
        for remark in self.outcome.remarks:
            yield "Remark", remark
        yield from self.output
        if self.outcome.status == FAILED and not self._has_buttons:
            yield "More help", f'hint("{self.outcome.exercise}")'

    def _repr_mimebundle_(self, **_: object) -> dict[str, Any]:
        return {"text/plain": str(self), "text/html": self.html(), MIME: self.record()}


def _looked_at(part: Part) -> tuple[str, str]:
    """Return what a requirement asks for if it is met, and what was seen instead if it is not."""
    word = "met" if part.met else "not yet"
    extra = ", optional" if part.optional else ""
    head = f"{RIGHT if part.met else WRONG} {part.id} {word}, {part.points} of {part.out_of}{extra}"
    return head, part.text if part.met else part.evidence


def _labelled(label: str, text: str) -> str:
    return f"{words(f'{label}:', 'em')} {words(text)}" if label else words(text)
