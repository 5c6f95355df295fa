"""Copy definitions from the cells of a page into the text of a module."""

from __future__ import annotations

import ast
from collections.abc import Iterable, Sequence

from rosbeat.diagnosis.packages import nearest, parse
from rosbeat.errors import WorkspaceError

_EXAMPLE = "%%save src/greenhouse/greenhouse/nodes.py --with VentControl"


def with_definitions(text: str, names: Sequence[str], cells: Iterable[str]) -> str:
    """Return a module's text with definitions from a page below its first imports.

    Args:
        text: The module's own text.
        names: Classes, functions and variables, in the order in which they are to stand.
        cells: The cells that ran, the oldest first. The last definition of a name counts.

    Raises:
        WorkspaceError: If the text is not Python, no name is given, or one is not defined at the
            top level of any cell.
    """
    head, rest = _split(text)
    known = _definitions(cells)
    missing = next((name for name in names if name not in known), None)
    if missing is not None or not names:
        raise _not_defined(missing, known)
    # One definition may bind several names, and is copied once.
    copied = dict.fromkeys(known[name] for name in names)
    parts = [part.strip("\n") for part in (head, *copied, rest)]
    return "\n\n\n".join(part for part in parts if part) + "\n"


def _split(text: str) -> tuple[str, str]:
    """Cut a module's text below its docstring and its first imports."""
    try:
        body = parse(text).body
    except (SyntaxError, ValueError) as error:
        raise WorkspaceError(
            f"Nothing was saved: the text of this cell is not Python ({error}).",
            "Definitions from other cells go below its imports, so it has to be readable.",
            "Correct the line, then run the cell again.",
        ) from None
    end = 0
    for statement in body:
        is_docstring = isinstance(statement, ast.Expr) and not end
        if not (is_docstring or isinstance(statement, ast.Import | ast.ImportFrom)):
            break
        end = statement.end_lineno or end
    lines = text.split("\n")
    return "\n".join(lines[:end]), "\n".join(lines[end:])


def _definitions(cells: Iterable[str]) -> dict[str, str]:
    """Return the source of the last definition of each name at the top level of a cell."""
    found: dict[str, str] = {}
    for cell in cells:
        try:
            body = parse(cell).body
        except (SyntaxError, ValueError):
            continue
        lines = cell.split("\n")
        for statement in body:
            decorators = getattr(statement, "decorator_list", ())
            first = min(one.lineno for one in (statement, *decorators))
            source = "\n".join(lines[first - 1 : statement.end_lineno])
            found.update(dict.fromkeys(_bound(statement), source))
    return found


def _bound(statement: ast.stmt) -> list[str]:
    """Return the names that a definition or an assignment binds."""
    if isinstance(statement, ast.ClassDef | ast.FunctionDef | ast.AsyncFunctionDef):
        return [statement.name]
    if isinstance(statement, ast.Assign | ast.AnnAssign):
        targets = statement.targets if isinstance(statement, ast.Assign) else [statement.target]
        parts = (part for target in targets for part in ast.walk(target))
        names = [part for part in parts if isinstance(part, ast.Name)]
        return [part.id for part in names if isinstance(part.ctx, ast.Store)]
    return []


def _not_defined(name: str | None, known: Iterable[str]) -> WorkspaceError:
    if name is None:
        return WorkspaceError(
            "`--with` was given no name.",
            "It copies what you name from the cells that have run on this page.",
            f"Write the names after it:  {_EXAMPLE}",
        )
    meant = nearest(name, sorted(known))
    return WorkspaceError(
        f"Nothing was saved: no cell that has run on this page defines `{name}`.",
        "`--with` copies classes, functions and variables from these cells.",
        f"Did you mean `{meant}`?" if meant else "Run the cell that defines it, then this one.",
    )
