"""Python text to a syntax tree, without running it and without its warnings."""

from __future__ import annotations

import ast
import warnings


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
