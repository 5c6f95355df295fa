"""What the source of a program shows at a look, without being run."""

from __future__ import annotations

import ast
from dataclasses import dataclass
from pathlib import Path

from rosbeat.workspace.parsing import parse


@dataclass(frozen=True)
class Source:
    """A module of a package; empty if it is not there or cannot be read.

    Attributes:
        module: Its name.
        classes: The classes that it defines.
        numbers: The numbers that are written in it.
        ends: The names of what `main` calls.
    """

    module: str
    classes: tuple[str, ...] = ()
    numbers: tuple[float, ...] = ()
    ends: tuple[str, ...] = ()


def read_source(path: Path) -> Source:
    """Look at a module.

    Args:
        path: Its file.
    """
    try:
        tree = parse(path.read_bytes())
    except (OSError, SyntaxError, ValueError, RecursionError, MemoryError):
        return Source(path.stem)
    nodes = list(ast.walk(tree))
    mains = [one for one in tree.body if isinstance(one, ast.FunctionDef) and one.name == "main"]
    return Source(
        path.stem,
        tuple(one.name for one in nodes if isinstance(one, ast.ClassDef)),
        tuple(number for one in nodes for number in _number(one)),
        tuple(name for main in mains for one in ast.walk(main) for name in _called(one)),
    )


def _number(node: ast.AST) -> list[float]:
    value = node.value if isinstance(node, ast.Constant) else None
    plain = isinstance(value, int | float) and not isinstance(value, bool)
    return [float(value)] if plain and abs(value) < 1e300 else []  # type: ignore[arg-type]


def _called(node: ast.AST) -> list[str]:
    return [ast.unparse(node.func).split(".")[-1]] if isinstance(node, ast.Call) else []
