"""Whether the target of an entry point exists: its module as a file, its function in that file."""

from __future__ import annotations

import ast
import re
from dataclasses import dataclass
from pathlib import Path

from rosbeat.workspace.locating import nearest
from rosbeat.workspace.parsing import parse
from rosbeat.workspace.setup_script import EntryPoint

_NAME = re.compile(r"\w[\w.-]*")


@dataclass(frozen=True)
class Flaw:
    """What is wrong with an entry point, or with the module that it names.

    Attributes:
        kind: `missing-comma`, `no-equals`, `two-equals`, `bad-name`, `slash`, `suffix`,
            `no-function-part`, `called`, `no-module`, `syntax-error` or `no-function`.
        entry: The entry point.
        wrong: The part that is wrong.
        right: What was probably meant, or empty.
        line: The line of the module in which a syntax error is, or 0.
    """

    kind: str
    entry: EntryPoint
    wrong: str
    right: str = ""
    line: int = 0


def flaw_of(entry: EntryPoint, folder: Path) -> Flaw | None:
    """Return the first thing that is wrong with an entry point, or None.

    Args:
        entry: The entry point.
        folder: The folder of the ROS package, which holds its `setup.py`.
    """
    return _written_wrong(entry) or _module_flaw(entry, folder)


def _written_wrong(entry: EntryPoint) -> Flaw | None:
    if entry.joined:
        return Flaw("missing-comma", entry, entry.text)
    if "=" not in entry.text:
        return Flaw("no-equals", entry, entry.text)
    if entry.text.count("=") > 1 and "[" not in entry.text:
        return Flaw("two-equals", entry, entry.text)
    if not _NAME.fullmatch(entry.executable):
        return Flaw("bad-name", entry, entry.executable)
    if "/" in entry.module:
        right = entry.module.replace("/", ".").removesuffix(".py")
        return Flaw("slash", entry, entry.module, right)
    if entry.module.endswith(".py"):
        return Flaw("suffix", entry, entry.module, entry.module.removesuffix(".py"))
    if not entry.function:
        return Flaw("no-function-part", entry, entry.module, "main")
    if entry.function.endswith("()"):
        return Flaw("called", entry, entry.function, entry.function.removesuffix("()"))
    return None


def _module_flaw(entry: EntryPoint, folder: Path) -> Flaw | None:
    path = module_file(entry.module, folder)
    if path is None:
        return Flaw("no-module", entry, entry.module, _nearest_module(entry.module, folder))
    names, line = top_level_names(path)
    if line:
        return Flaw("syntax-error", entry, entry.module, line=line)
    if names is not None and entry.function.split(".")[0] not in names:
        return Flaw("no-function", entry, entry.function, nearest(entry.function, names) or "")
    return None


def module_file(module: str, folder: Path) -> Path | None:
    """Return the file of a module of a package, or None if there is none.

    Args:
        module: The dotted name.
        folder: The folder of the ROS package.
    """
    stem = folder.joinpath(*module.split("."))
    candidates = (stem.with_name(stem.name + ".py"), stem / "__init__.py")
    return next((one for one in candidates if one.is_file()), None)


def _nearest_module(module: str, folder: Path) -> str:
    files = [one.relative_to(folder) for one in folder.glob("*/*.py") if one.parent.name != "test"]
    known = [".".join(one.with_suffix("").parts) for one in files if one.stem != "__init__"]
    tails = {name.rpartition(".")[2]: name for name in known}
    return nearest(module, known) or tails.get(module.rpartition(".")[2], "")


def top_level_names(path: Path) -> tuple[list[str] | None, int]:
    """Return the names that a module defines, and the line of its syntax error or 0.

    Args:
        path: The module's file.

    Returns:
        None instead of names if they cannot be known without running the module.
    """
    try:
        tree = parse(path.read_bytes())
    except SyntaxError as error:
        return [], error.lineno or 1
    except (OSError, ValueError, RecursionError, MemoryError):
        return None, 0
    found: list[str] = []
    for node in tree.body:
        names = _names_of(node)
        if names is None:
            return None, 0
        found += names
    return found, 0


def _names_of(node: ast.stmt) -> list[str] | None:
    if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef):
        return [node.name]
    if isinstance(node, ast.Import | ast.ImportFrom):
        if any(one.name == "*" for one in node.names):
            return None
        return [(one.asname or one.name).split(".")[0] for one in node.names]
    inside = [one for one in ast.walk(node) if isinstance(one, ast.Name | ast.FunctionDef)]
    return [one.name if isinstance(one, ast.FunctionDef) else one.id for one in inside
            if isinstance(one, ast.FunctionDef) or isinstance(one.ctx, ast.Store)]  # fmt: skip
