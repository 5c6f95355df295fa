"""Colour code in what a cell shows: Python, or the commands of a terminal.

Each colour has a value for light and one for dark pages, of which the browser chooses by the
`color-scheme` that JupyterLab sets with its theme. In a notebook that is not trusted JupyterLab
drops them, and the code has the colour of the page.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from html import escape
from itertools import groupby
from textwrap import dedent
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from pygments.lexer import Lexer
    from pygments.token import _TokenType

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
