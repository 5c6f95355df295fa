"""What a cell imports, and under which names its modules stand."""

from __future__ import annotations

import ast
from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from rosbeat.grading.importable import ROS, is_module, may_import, may_use

#: A room of the course that knows what is the matter with whom, so it is in no sandbox.
CLINIC = "clinic"
USES_THE_CLINIC = "uses the clinic, which is not there while answers are graded"


@dataclass(frozen=True)
class Imports:
    """What a cell and its page import.

    Attributes:
        names: Names of what was imported, those of message classes left out.
        given: What the page imports from somewhere, under its own names.
        modules: Modules by the name that they have in the cell.
    """

    names: frozenset[str]
    given: frozenset[str]
    modules: Mapping[str, str]

    @property
    def whole(self) -> frozenset[str]:
        """The dotted names of modules that may be read from, and not be handed on."""
        found = {".".join(name.split(".")[:2]) for name in self.modules.values()}
        return frozenset((*found, "numpy.random", "numpy.linalg", "concurrent.futures"))

    def module_of(self, node: ast.AST) -> str:
        """The module that an expression is, such as `numpy.random` for `np.random`; or nothing."""
        if isinstance(node, ast.Name):
            return self.modules.get(node.id, "")
        if not isinstance(node, ast.Attribute):
            return ""
        before = self.module_of(node.value)
        name = f"{before}.{node.attr}" if before else ""
        is_part = before.split(".")[0] in ROS and node.attr.islower()
        return name if name and (is_module(name) or is_part) else ""


def imports_in(tree: ast.Module, page: ast.Module) -> Imports:
    """Find out what a cell imports.

    Args:
        tree: The cell.
        page: The page's cell of imports.
    """
    nodes = [one for one in (*ast.walk(page), *ast.walk(tree)) if _is_import(one)]
    from_page = [one for one in page.body if isinstance(one, ast.ImportFrom)]
    given = frozenset(alias.name for one in from_page for alias in one.names)
    names = frozenset(name for one in nodes for name in _named(one))
    return Imports(names, given, dict(pair for one in nodes for pair in _modules(one)))


def refused_import(node: ast.AST, imports: Imports) -> str:
    """Why a statement that imports is one to be looked at; empty if it is not.

    Args:
        node: Any node.
        imports: What the cell imports.
    """
    if isinstance(node, ast.Import):
        refused = (one.name for one in node.names if not may_import(one.name))
        return next((f"imports {name}" for name in refused), "")
    if not isinstance(node, ast.ImportFrom):
        return ""
    module = node.module or "."
    if module == "rosbeat" and any(one.name == CLINIC for one in node.names):
        return USES_THE_CLINIC
    if module.split(".")[0] == "rosbeat" and all(one.name in imports.given for one in node.names):
        return ""  # as the page itself does
    if node.level or not may_import(module):
        return f"imports {module}"
    wrong = (one.name for one in node.names if not may_use(module, one.name))
    return next((f"imports {name}" for name in wrong), "")


def _is_import(node: ast.AST) -> bool:
    return isinstance(node, (ast.Import, ast.ImportFrom))


def _named(node: ast.AST) -> Iterator[str]:
    assert isinstance(node, (ast.Import, ast.ImportFrom))
    if not _brings_messages(node):
        yield from (alias.asname or alias.name.split(".")[0] for alias in node.names)


def _brings_messages(statement: ast.Import | ast.ImportFrom) -> bool:
    """Whoever writes into a message class makes a known mistake, and harms only that class."""
    module = statement.module if isinstance(statement, ast.ImportFrom) else ""
    return str(module).rpartition(".")[2] in ("msg", "srv", "action")


def _modules(node: ast.AST) -> Iterator[tuple[str, str]]:
    assert isinstance(node, (ast.Import, ast.ImportFrom))
    for alias in node.names:
        if isinstance(node, ast.ImportFrom):
            name = f"{node.module}.{alias.name}"
            if is_module(name):
                yield alias.asname or alias.name, name
        elif alias.asname:
            yield alias.asname, alias.name
        else:
            yield alias.name.split(".")[0], alias.name.split(".")[0]
