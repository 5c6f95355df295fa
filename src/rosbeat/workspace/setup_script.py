"""What a `setup.py` says, read from its syntax tree and never run."""

from __future__ import annotations

import ast
import re
from dataclasses import dataclass
from pathlib import Path

from rosbeat.workspace.parsing import parse

#: A name and an equals sign, but not two: `talk ==` is a slip of its own.
_NAMED = re.compile(r"[\w.-]+\s*=(?!=)")


@dataclass(frozen=True)
class EntryPoint:
    """One line of `console_scripts`.

    Attributes:
        text: The whole string.
        line: Its line in `setup.py`, counted from 1.
        executable: The name before `=`.
        module: The module before `:`.
        function: The function behind `:`, or empty.
    """

    text: str
    line: int
    executable: str
    module: str
    function: str

    @property
    def joined(self) -> bool:
        """Whether two entry points have become one, because a comma is missing between them."""
        return len(_NAMED.findall(self.text)) > 1


@dataclass(frozen=True)
class SetupScript:
    """The parts of a build script that the course speaks about.

    Attributes:
        package_name: What `name=` says.
        entry_points: The console scripts.
        end_of_scripts: The line of the bracket that closes their list, or 0 if there is no list.
        problem: Why the file cannot be read, or empty.
        line: The line of that problem, or 0.
    """

    package_name: str = ""
    entry_points: tuple[EntryPoint, ...] = ()
    end_of_scripts: int = 0
    problem: str = ""
    line: int = 0


def read_setup(path: Path) -> SetupScript:
    """Read a build script; a bad one has a `problem` and nothing else.

    Args:
        path: The `setup.py`.
    """
    try:
        tree = parse(path.read_bytes())
    except OSError as error:
        return SetupScript(problem=error.strerror or "it cannot be read")
    except SyntaxError as error:
        return SetupScript(problem=error.msg, line=error.lineno or 0)
    except (ValueError, RecursionError, MemoryError) as error:
        return SetupScript(problem=str(error) or type(error).__name__)
    return _script(tree)


def _script(tree: ast.Module) -> SetupScript:
    call = next((one for one in ast.walk(tree) if _is_setup(one)), None)
    if not isinstance(call, ast.Call):
        return SetupScript(problem="it does not call setup()")
    texts = _constants(tree)
    given = {one.arg: one.value for one in call.keywords if one.arg}
    scripts = _console_scripts(given.get("entry_points"))
    items = scripts.elts if scripts else []
    return SetupScript(
        package_name=_text(given.get("name"), texts),
        entry_points=tuple(_entry_point(_text(one, texts), one.lineno) for one in items),
        end_of_scripts=(scripts.end_lineno or 0) if scripts else 0,
    )


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


def _console_scripts(value: ast.expr | None) -> ast.List | ast.Tuple | None:
    if not isinstance(value, ast.Dict):
        return None
    for key, scripts in zip(value.keys, value.values, strict=True):
        named = isinstance(key, ast.Constant) and key.value == "console_scripts"
        if named and isinstance(scripts, ast.List | ast.Tuple):
            return scripts
    return None


def _text(node: ast.AST | None, names: dict[str, str]) -> str:
    """The text that an expression makes, as far as it can be seen without running it."""
    if isinstance(node, ast.Constant):
        return node.value if isinstance(node.value, str) else ""
    if isinstance(node, ast.Name):
        return names.get(node.id, "")
    if isinstance(node, ast.BinOp) and isinstance(node.op, ast.Add):
        return _text(node.left, names) + _text(node.right, names)
    if isinstance(node, ast.JoinedStr):
        return "".join(_text(part, names) for part in node.values)
    return _text(node.value, names) if isinstance(node, ast.FormattedValue) else ""


def _entry_point(text: str, line: int) -> EntryPoint:
    executable, _, target = text.partition("=")
    module, _, function = target.partition(":")
    function = function.split("[")[0]
    return EntryPoint(text, line, executable.strip(), module.strip(), function.strip())
