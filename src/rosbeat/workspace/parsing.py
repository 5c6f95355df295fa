"""Python text to a syntax tree, without running it and without its warnings."""

from __future__ import annotations

import ast
import tokenize
import warnings
from io import BytesIO, StringIO


def parse(text: str | bytes) -> ast.Module:
    """Read Python as far as the compiler does: `return` outside of a function is an error too.

    Args:
        text: The text of a module.

    Raises:
        SyntaxError: If it is no Python.
        ValueError: If it cannot be text at all.
    """
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # a doubtful escape is not what anybody asked about
        tree = ast.parse(text)
        compile(tree, "<module>", "exec", dont_inherit=True)
    return tree


def encoding_of(data: bytes) -> str:
    """Return the encoding in which Python reads a file.

    Args:
        data: What the file holds.

    Raises:
        SyntaxError: If its first lines name one that there is not.
    """
    return tokenize.detect_encoding(BytesIO(data).readline)[0]


def decoded(data: bytes) -> str:
    """Return the text of a file of Python, with its line ends as they are.

    Args:
        data: What the file holds.

    Raises:
        SyntaxError: If its first lines name an encoding that there is not.
        ValueError: If it does not hold to its encoding.
    """
    return data.decode(encoding_of(data))


def pieces(text: str) -> int:
    """Count the texts in an expression; two in a row, without a comma, are joined by Python.

    Args:
        text: An expression.
    """
    start = getattr(tokenize, "FSTRING_START", None)  # Python 3.12 and later
    end = getattr(tokenize, "FSTRING_END", None)
    depth = count = 0
    for token in tokenize.generate_tokens(StringIO(f"({text})").readline):
        count += depth == 0 and token.type in (tokenize.STRING, start)
        depth += (token.type == start) - (token.type == end)
    return count
