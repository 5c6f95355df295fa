"""What other cells of a page define, for answers that build on it."""

from __future__ import annotations

import ast
import builtins
from collections.abc import Iterable, Iterator
from contextlib import suppress
from functools import lru_cache
from typing import Any

#: What may stand at the top of a cell so that running it defines something.
_DEFINES = (
    *(ast.Import, ast.ImportFrom, ast.FunctionDef, ast.ClassDef, ast.AsyncFunctionDef),
    *(ast.Assign, ast.AnnAssign),
)


def define_missing(texts: Iterable[str], cells: Iterable[str], space: dict[str, Any]) -> None:
    """Define the names that texts use and nobody has defined, as far as other cells define them.

    Only the statements that are needed run, and what these need; nothing else of those cells does.

    Args:
        texts: Cells that are about to run; what they define themselves is theirs to define.
        cells: The other cells, those that count more first.
        space: Where names go.
    """
    for statement in needed(texts, cells, {*space, *dir(builtins)}):
        _run(statement, space)


def needed(texts: Iterable[str], cells: Iterable[str], names: Iterable[str]) -> list[ast.stmt]:
    """Say which statements of other cells define what texts use, in the order to run them.

    Args:
        texts: Cells that are about to run.
        cells: The other cells, those that count more first.
        names: What is defined already.
    """
    others = tuple(cells)
    todo: list[ast.AST] = [tree for tree in map(_parsed, texts) if tree is not None]
    known = set(names).union(*map(names_of, todo))
    wanted: list[ast.stmt] = []
    while todo:
        for name in sorted(_named(todo.pop(), ast.Load) - known):
            found = next((one for one, names in _offers(name, others) if name in names), None)
            if found is not None:
                wanted = [*(one for one in wanted if one is not found), found]
                known |= names_of(found)
                todo.append(found)
    return wanted[::-1]  # what others build on was found last


def _offers(name: str, cells: Iterable[str]) -> Iterator[tuple[ast.stmt, frozenset[str]]]:
    """What cells define that may define a name: reading all of them would take its time."""
    for cell in cells:
        # Python takes some letters for others (`ﬁ` for `fi`), but no letter of ASCII.
        if name in cell or not cell.isascii():
            yield from _offered(cell)


@lru_cache(maxsize=512)
def _offered(cell: str) -> tuple[tuple[ast.stmt, frozenset[str]], ...]:
    """What a cell defines, the last first, and under which names; most cells are everybody's."""
    return tuple((one, frozenset(names_of(one))) for one in reversed(definitions(cell)))


def _run(statement: ast.stmt, space: dict[str, Any]) -> None:
    """Run one definition; one that fails is as on a page where its cell has failed."""
    with suppress(Exception):
        program = compile(ast.Module([statement], []), "<earlier>", "exec", dont_inherit=True)
        exec(program, space)


def definitions(cell: str) -> list[ast.stmt]:
    """The statements of a cell that define something: imports, functions, classes, values."""
    tree = _parsed(cell)
    return [one for one in tree.body if isinstance(one, _DEFINES)] if tree else []


def names_of(tree: ast.AST) -> set[str]:
    """The names that a statement, or the top of a cell, defines."""
    found: set[str] = set()
    for one in tree.body if isinstance(tree, ast.Module) else [tree]:
        if isinstance(one, (ast.FunctionDef, ast.ClassDef, ast.AsyncFunctionDef)):
            found.add(one.name)
        elif isinstance(one, (ast.Import, ast.ImportFrom)):
            found |= {alias.asname or alias.name.split(".")[0] for alias in one.names}
        else:
            found |= _named(one, ast.Store)
    return found


def _named(tree: ast.AST, how: type[ast.expr_context]) -> set[str]:
    names = (one for one in ast.walk(tree) if isinstance(one, ast.Name))
    return {one.id for one in names if isinstance(one.ctx, how)}


def _parsed(text: str) -> ast.Module | None:
    try:
        return ast.parse(text)
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return None
