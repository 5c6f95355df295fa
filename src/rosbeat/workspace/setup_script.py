"""What a `setup.py` says, read from its syntax tree and never run."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

from rosbeat.workspace.parsing import decoded, parse, pieces

#: A name and what stands for an equals sign; `talk ==` is a slip of its own, and one name.
_NAMED = re.compile(r"[\w.-]+\s*=+")


@dataclass(frozen=True)
class EntryPoint:
    """One line of `console_scripts`.

    Attributes:
        text: The whole string.
        line: Its line in `setup.py`, counted from 1.
        executable: The name before `=`.
        module: The module before `:`.
        function: The function behind `:`, or empty.
        pieces: How many texts in a row Python joins to this one.
    """

    text: str
    line: int
    executable: str
    module: str
    function: str
    pieces: int = 1

    @property
    def joined(self) -> bool:
        """Whether two entry points have become one, because a comma is missing between them."""
        return self.pieces > 1 and len(_NAMED.findall(self.text)) > 1


@dataclass(frozen=True)
class SetupScript:
    """The parts of a build script that the course speaks about.

    Attributes:
        package_name: What `name=` says.
        entry_points: The console scripts.
        end_of_scripts: The line of the bracket that closes their list, or 0 if there is no list.
        end_column: The column behind that bracket, in bytes of UTF-8.
        incomplete: Whether there may be console scripts that cannot be seen without running it.
        problem: Why the file cannot be read, or empty.
        line: The line of that problem, or 0.
    """

    package_name: str = ""
    entry_points: tuple[EntryPoint, ...] = ()
    end_of_scripts: int = 0
    end_column: int = 0
    incomplete: bool = False
    problem: str = ""
    line: int = 0


def read_setup(path: Path) -> SetupScript:
    """Read a build script; a bad one has a `problem` and nothing else.

    Args:
        path: The `setup.py`.
    """
    try:
        return parse_setup(path.read_bytes())
    except OSError as error:
        return SetupScript(problem=error.strerror or "it cannot be read")


def parse_setup(data: bytes) -> SetupScript:
    """Read the bytes of a build script; bad ones give a `problem` and nothing else.

    Args:
        data: What the file holds.
    """
    try:
        return _script(parse(data), decoded(data))
    except SyntaxError as error:
        return SetupScript(problem=error.msg, line=error.lineno or 0)
    except (ValueError, RecursionError, MemoryError) as error:
        return SetupScript(problem=str(error) or type(error).__name__)


def _script(tree: ast.Module, source: str) -> SetupScript:
    call = next((one for one in ast.walk(tree) if _is_setup(one)), None)
    if not isinstance(call, ast.Call):
        return SetupScript(problem="it does not call setup()")
    texts = _constants(tree)
    given = {one.arg: one.value for one in call.keywords if one.arg}
    value = given.get("entry_points")
    scripts = _console_scripts(value)
    items = scripts.elts if isinstance(scripts, ast.List | ast.Tuple) else []
    found = list(_entry_points(items, texts, source))
    complete = value is None or _is_list(scripts) or _has_no_scripts(value, scripts)
    end = scripts if isinstance(scripts, ast.List) else None
    return SetupScript(
        package_name=_text(given.get("name"), texts) or "",
        entry_points=tuple(found),
        end_of_scripts=(end.end_lineno or 0) if end else 0,
        end_column=(end.end_col_offset or 0) if end else 0,
        incomplete=len(found) < len(items) or not complete or len(given) < len(call.keywords),
    )


def _is_list(node: ast.expr | None) -> bool:
    return isinstance(node, ast.List | ast.Tuple)


def _has_no_scripts(value: ast.expr, scripts: ast.expr | None) -> bool:
    """Whether the keys can all be seen, and the one that is looked for is not among them."""
    if not isinstance(value, ast.Dict) or scripts is not None:
        return False
    return all(isinstance(key, ast.Constant) for key in value.keys)


def _is_setup(node: ast.AST) -> bool:
    return isinstance(node, ast.Call) and ast.unparse(node.func).split(".")[-1] == "setup"


def _constants(tree: ast.Module) -> dict[str, str]:
    """Names that stand for a text, as `package_name` does."""
    return {
        target.id: node.value.value
        for node in tree.body
        if isinstance(node, ast.Assign) and isinstance(node.value, ast.Constant)
        for target in node.targets
        if isinstance(target, ast.Name) and isinstance(node.value.value, str)
    }


def _console_scripts(value: ast.expr | None) -> ast.expr | None:
    if not isinstance(value, ast.Dict):
        return None
    for key, scripts in zip(value.keys, value.values, strict=True):
        if isinstance(key, ast.Constant) and key.value == "console_scripts":
            return scripts
    return None


def _text(node: ast.AST | None, names: dict[str, str]) -> str | None:
    """The text that an expression makes, or None if that cannot be seen without running it."""
    if isinstance(node, ast.Constant):
        return node.value if isinstance(node.value, str) else None
    if isinstance(node, ast.Name):
        return names.get(node.id)
    if isinstance(node, ast.BinOp) and isinstance(node.op, ast.Add):
        return _joined((node.left, node.right), names)
    if isinstance(node, ast.JoinedStr):
        return _joined(node.values, names)
    plain = isinstance(node, ast.FormattedValue) and node.conversion < 0 and not node.format_spec
    return _text(node.value, names) if isinstance(node, ast.FormattedValue) and plain else None


def _joined(nodes: Iterable[ast.expr], names: dict[str, str]) -> str | None:
    texts = [_text(one, names) for one in nodes]
    known = [text for text in texts if text is not None]
    return "".join(known) if len(known) == len(texts) else None


def _entry_points(
    nodes: list[ast.expr], names: dict[str, str], source: str
) -> Iterable[EntryPoint]:
    """The items that are plain texts; nothing can be said of the others."""
    for node in nodes:
        text = _text(node, names)
        if text is not None:
            parts = pieces(ast.get_source_segment(source, node) or "")
            yield _entry_point(text, node.lineno, parts)


def _entry_point(text: str, line: int, parts: int) -> EntryPoint:
    executable, _, target = text.partition("=")
    module, _, function = target.partition(":")
    function = function.split("[")[0]
    return EntryPoint(text, line, executable.strip(), module.strip(), function.strip(), parts)
