"""What the names of a page stand for while its answers are observed.

A page's cell of imports brings `check`, `hint`, pictures and more. They judge, draw or keep
progress, none of which belongs where a stranger's code runs; so they do nothing there.
"""

from __future__ import annotations

import ast
from importlib import import_module
from typing import Any

#: What is the same as on a page.
_REAL = {"rosbeat": {"Session", "bags", "workspace"}, "rosbeat.scenarios.stranger": {"greenhouse"}}


class StandIn:
    """Something that may be called, read and entered, and does nothing."""

    def __call__(self, *_: object, **__: object) -> StandIn:
        """Do nothing."""
        return self

    def __getattr__(self, name: str) -> StandIn:
        if name.startswith("__"):
            raise AttributeError(name)
        return self

    def __repr__(self) -> str:
        return "<left out while answers are observed>"


def run_imports(cell: str, space: dict[str, Any]) -> None:
    """Run a cell of imports; names of the course that do not belong here become stand-ins.

    Args:
        cell: The cell.
        space: Where the names go.
    """
    tree = ast.parse(cell)
    ours = [one for one in tree.body if _is_ours(one)]
    tree.body = [one for one in tree.body if one not in ours]
    exec(compile(tree, "<imports>", "exec", dont_inherit=True), space)
    for statement in ours:
        assert isinstance(statement, ast.ImportFrom)
        for alias in statement.names:
            space[alias.asname or alias.name] = _ours(str(statement.module), alias.name)


def _is_ours(statement: ast.stmt) -> bool:
    named = isinstance(statement, ast.ImportFrom) and statement.level == 0
    return named and str(getattr(statement, "module", "")).split(".")[0] == "rosbeat"


def _ours(module: str, name: str) -> Any:  # noqa: ANN401 - whatever it is
    real = name in _REAL.get(module, ())
    return getattr(import_module(module), name) if real else StandIn()
