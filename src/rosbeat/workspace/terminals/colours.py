"""Colour what a terminal shows in a cell: prompt, command, output and remarks of the course.

A cell prints while the command runs, so colours are control sequences in what is printed, which
Jupyter turns into HTML, in notebooks that are not trusted as well. HTML of our own would have to
replace itself line by line, and such outputs cannot be compared.

Control sequences do not know whether the page is light or dark. Each colour here has a contrast of
at least 4.3:1 against the white page of JupyterLab and against its dark one (#111111); one colour
cannot have more than 4.35:1 against both. What programs print keeps the colour of the page.
"""

from __future__ import annotations

import re
import sys
from functools import lru_cache
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from pygments.lexer import Lexer
    from pygments.token import _TokenType

PROMPT, REMARK = "#008a67", "#0076ed"
STRING, VARIABLE, WORD, QUIET = "#be5f00", "#a245ff", "#3d6dff", "#7b7b7b"

#: A prompt: up to the first `$ ` or `> `; see `rosbeat.workspace.terminals.environment.prompt`.
_PROMPT = re.compile(r".*?[$>] ")
_BOLD, _END = "\x1b[1m", "\x1b[0m"


class Typed(str):
    """Hold a line that was typed: a prompt and a command, or a key such as `^C`."""

    __slots__ = ()


class Remark(str):
    """Hold a line that the course says."""

    __slots__ = ()


def show(line: str) -> None:
    """Print a line of a terminal; in colour if Jupyter shows what is printed.

    Args:
        line: A `Typed`, a `Remark`, or text that a program printed.
    """
    print(coloured(line) if _is_page() else line)


def coloured(line: str) -> str:
    """Return a line with control sequences for its colours; without them it is the same.

    Args:
        line: A `Typed`, a `Remark`, or text that a program printed.
    """
    if isinstance(line, Remark):
        return _in(REMARK, line)
    if not isinstance(line, Typed):
        return line
    found = _PROMPT.match(line)
    if found is None:
        return _in(PROMPT, line)
    return _in(PROMPT, found[0]) + _command(line[found.end() :])


def _is_page() -> bool:
    """Return whether what is printed goes to a notebook, and not into a file or a test."""
    return type(sys.stdout).__module__ == "ipykernel.iostream"


def _command(text: str) -> str:
    """Return a command in bold, with the colours of its strings, variables and words of bash."""
    colour, parts = "", []
    for kind, part in _lexer().get_tokens(text):
        wanted = _colour(kind) if part.strip() else colour
        parts += [part] if wanted == colour else [_ink(wanted), part]
        colour = wanted
    return f"{_BOLD}{''.join(parts)}{_END}"


def _in(colour: str, text: str) -> str:
    return f"{_ink(colour)}{text}{_END}"


def _ink(colour: str) -> str:
    """Return the control sequence for a colour; for no colour, the one for the page's own."""
    if not colour:
        return "\x1b[39m"
    red, green, blue = (int(colour[at : at + 2], 16) for at in (1, 3, 5))
    return f"\x1b[38;2;{red};{green};{blue}m"


def _colour(kind: _TokenType) -> str:
    from pygments.token import Comment, Keyword, Name, String

    if kind in Comment:
        return QUIET
    if kind in String.Interpol or kind in Name.Variable:
        return VARIABLE
    if kind in String:
        return STRING
    return WORD if kind in Keyword or kind in Name.Builtin else ""


@lru_cache(maxsize=1)
def _lexer() -> Lexer:
    from pygments.lexers.shell import BashLexer

    # A blank or an empty line at either end belongs to the command.
    return BashLexer(stripnl=False, ensurenl=False)
