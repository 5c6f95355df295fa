"""Read a `setup.py`: literals from its syntax tree, anything else by running it as colcon does.

The usual build script is made of literals and of names for strings, so it costs no process. One
that calculates its arguments runs in a subprocess with a deadline, in which `setup` only writes
down what it was given.
"""

from __future__ import annotations

import ast
import json
import os
import posixpath
import re
import subprocess
import sys
import tokenize
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from importlib.util import decode_source
from io import StringIO
from pathlib import Path
from typing import Any

from rosbeat.diagnosis.packages import NO_CALL, EntryPoint, SetupScript, entry_point, parse

#: Seconds that a build script may take; colcon itself would wait for ever.
_DEADLINE = 10.0
# The line is told beside the problem.
_DETECTED = re.compile(r" \(detected at line \d+\)")
_SCRIPTS, _FINDER = "console_scripts", "find_packages"
# What a build script says of a package besides its code, and the manifest says, too.
_ABOUT = ("version", "description", "license")
# An empty list of console scripts, with nothing but comments in it.
_EMPTY_LIST = re.compile(
    r"""(?m)^(?P<head>[^#\n]*['"]console_scripts['"]\s*:\s*\[)(?P<inside>(?:\s|#[^\n]*)*)\]"""
)
# What the script prints goes to the standard error, and its arguments to the standard output.
_RECORDER = """
import json, os, runpy, sys
output = os.fdopen(os.dup(1), "w")
os.dup2(2, 1)
import setuptools, distutils.core
def setup(**given):
    output.write(json.dumps(given, default=str, skipkeys=True))
    output.close()
    os._exit(0)
setuptools.setup = distutils.core.setup = setup
sys.argv = ["setup.py", "--name"]
sys.path.insert(0, os.getcwd())
runpy.run_path("setup.py", run_name="__main__")
"""


@dataclass(frozen=True)
class _Given:
    """Hold the arguments of `setup`.

    Attributes:
        values: Plain data by keyword.
        excluded: Patterns that `find_packages` leaves out.
        complete: Whether these are all of them.
    """

    values: Mapping[str, Any]
    excluded: tuple[str, ...] = ()
    complete: bool = True


def read_setup(path: Path) -> SetupScript:
    """Return what a build script says; a bad one has a `problem` and nothing else.

    Args:
        path: The `setup.py`. It is run, in its folder, if it calculates its arguments.
    """
    try:
        source = decode_source(path.read_bytes())
        tree = parse(source)
    except OSError as error:
        return SetupScript(problem=error.strerror or "it cannot be read")
    except SyntaxError as error:
        return SetupScript(problem=_DETECTED.sub("", error.msg), line=error.lineno or 0)
    except (ValueError, RecursionError, MemoryError) as error:
        return SetupScript(problem=str(error) or type(error).__name__)
    calls = [one for one in ast.walk(tree) if isinstance(one, ast.Call) and _ends(one, "setup")]
    given = _given(tree, calls[0], path) if calls else None
    if given is None:
        return SetupScript(problem=NO_CALL)
    return _script(given, source, tree, calls[0])


def _ends(call: ast.Call, name: str) -> bool:
    return ast.unparse(call.func).split(".")[-1] == name


def _given(tree: ast.Module, call: ast.Call, path: Path) -> _Given | None:
    """Return the arguments of `setup`; None if it is not called."""
    literal = _literal(tree, call)
    is_reached = any(isinstance(one, ast.Expr) and one.value is call for one in tree.body)
    if literal.complete and is_reached:
        return literal
    try:
        done = subprocess.run(
            [sys.executable, "-c", _RECORDER], cwd=path.parent, timeout=_DEADLINE, check=True,
            stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL,
            env={**os.environ, "PYTHONDONTWRITEBYTECODE": "1"},
        )  # fmt: skip
        return _Given(json.loads(done.stdout)) if done.stdout else None
    except (OSError, ValueError, subprocess.SubprocessError):  # it raises, or does not end
        return _Given(literal.values, literal.excluded, complete=False)


# Literals. None stands for whatever is none.


def _literal(tree: ast.Module, call: ast.Call) -> _Given:
    names = _constants(tree)
    values: dict[str, Any] = {}
    excluded: tuple[str, ...] = ()
    for keyword in call.keywords:
        value = _value(keyword.value, names)
        if keyword.arg == "packages" and isinstance(keyword.value, ast.Call):
            value, excluded = _patterns(keyword.value, names) or (None, ())
        if keyword.arg and value is not None:
            values[keyword.arg] = value
    known = len(values) == len(call.keywords) and all(map(_is_known, values.values()))
    return _Given(values, excluded, complete=known and not call.args)


def _constants(tree: ast.Module) -> dict[str, str]:
    """Return the names that stand for a string throughout a module."""
    stored = [
        one.id
        for one in ast.walk(tree)
        if isinstance(one, ast.Name) and not isinstance(one.ctx, ast.Load)
    ]
    return {
        target.id: node.value.value
        for node in tree.body
        if isinstance(node, ast.Assign) and isinstance(node.value, ast.Constant)
        for target in node.targets
        if isinstance(target, ast.Name) and stored.count(target.id) == 1
        if isinstance(node.value.value, str)
    }


def _value(node: ast.expr | None, names: Mapping[str, str]) -> Any:  # noqa: ANN401 - plain data
    if isinstance(node, ast.Constant):
        return node.value
    if isinstance(node, ast.Name):
        return names.get(node.id)
    if isinstance(node, ast.List | ast.Tuple):
        return [_value(one, names) for one in node.elts]
    if isinstance(node, ast.Dict):
        keys = [_value(key, names) for key in node.keys]
        return dict(zip(map(str, keys), [_value(one, names) for one in node.values], strict=True))
    if isinstance(node, ast.BinOp) and isinstance(node.op, ast.Add):
        both = [_value(one, names) for one in (node.left, node.right)]
        return "".join(both) if all(isinstance(one, str) for one in both) else None
    return None


def _is_known(value: object) -> bool:
    if isinstance(value, dict):
        return all(map(_is_known, value.values()))
    return all(map(_is_known, value)) if isinstance(value, list) else value is not None


def _patterns(
    call: ast.Call, names: Mapping[str, str]
) -> tuple[tuple[str, ...], tuple[str, ...]] | None:
    """Return the patterns that `find_packages` includes and excludes."""
    given = {one.arg: _value(one.value, names) for one in call.keywords}
    is_usual = _ends(call, _FINDER) and not call.args and given.keys() <= {"include", "exclude"}
    include, exclude = _texts(given.get("include", ["*"])), _texts(given.get("exclude", []))
    return (include, exclude) if is_usual and include is not None and exclude is not None else None


def _texts(value: object) -> tuple[str, ...] | None:
    """Return the strings of a list; None if it is anything else."""
    if not isinstance(value, list | tuple):
        return None
    return tuple(value) if all(isinstance(one, str) for one in value) else None


# From arguments to a record.


def _placed(text: str, source: str, tree: ast.Module, call: ast.Call) -> EntryPoint:
    """Return an entry point with its place; a calculated one is where `setup` is called."""
    texts = [one for one in ast.walk(tree)
             if isinstance(one, ast.Constant) and isinstance(one.value, str)]  # fmt: skip
    for node in texts:
        if node.value == text:
            segment = ast.get_source_segment(source, node) or ""
            return entry_point(text, node.lineno, _count_strings(segment))
    lines = (node.lineno for node in texts if text in str(node.value))
    return entry_point(text, next(lines, call.lineno))


def _count_strings(expression: str) -> int:
    """Count the strings in an expression; Python joins adjacent ones, without a comma, to one."""
    tokens = tokenize.generate_tokens(StringIO(f"({expression})").readline)
    return sum(token.type == tokenize.STRING for token in tokens)


def _script(given: _Given, source: str, tree: ast.Module, call: ast.Call) -> SetupScript:
    values = given.values
    groups = _groups(values.get("entry_points", {}))
    programs = [
        one for name in (_SCRIPTS, "gui_scripts") for one in _lines((groups or {}).get(name, ()))
    ]
    known = groups is not None and all(isinstance(one, str) for one in programs)
    hidden = not given.complete and "packages" not in values
    about = {key: values.get(key) for key in _ABOUT}
    name = values.get("name")
    return SetupScript(
        package_name=name if isinstance(name, str) else "",
        entry_points=tuple(
            _placed(one, source, tree, call) for one in programs if isinstance(one, str)
        ),
        incomplete=not (given.complete and known),
        keywords=tuple(sorted(values)),
        groups=tuple(sorted(groups or ())),
        # Without any, setuptools finds none itself: it refuses where there are two folders, and
        # every ROS package has `resource` beside its code.
        packages=None if hidden else _texts(values.get("packages", [])),
        excluded=given.excluded,
        about=tuple((key, text) for key, text in about.items() if isinstance(text, str) and text),
        left_out=_left_out(values) if given.complete else (),
    )


def _groups(value: object) -> Mapping[str, Any] | None:
    """Return the groups of entry points; None if it is nothing that setuptools understands."""
    if isinstance(value, str):
        parts = re.split(r"^\s*\[(.+?)\]\s*$", value, flags=re.MULTILINE)
        return dict(zip(parts[1::2], parts[2::2], strict=True))
    return value if isinstance(value, dict) else None


def _lines(scripts: object) -> list[Any]:
    """Return the entry points of a group, which is a list or a text with one in each line."""
    if isinstance(scripts, str):
        plain = [one.strip() for one in scripts.splitlines()]
        return [one for one in plain if one and one[0] not in "#;"]
    return list(scripts) if isinstance(scripts, list | tuple) else [scripts]


def entry_points_in(lines: str, file: str) -> tuple[EntryPoint, ...]:
    """Return the entry points of a text that has one in each line.

    Args:
        lines: The text.
        file: The file that it is in.
    """
    return tuple(entry_point(one, 1, 1, file) for one in _lines(lines))


def _left_out(given: Mapping[str, Any]) -> tuple[str, ...]:
    """Return the files of every ROS package that `data_files` leaves out.

    Paths are compared as setuptools understands them: `./package.xml` is `package.xml`.
    """
    name = given.get("name")
    wanted = {
        f"resource/{name}": f"share/ament_index/resource_index/packages/{name}",
        "package.xml": f"share/{name}/package.xml",
    }
    try:
        installed = set(_installed(given.get("data_files") or ()))
    except (TypeError, ValueError):  # not pairs of a folder and files
        return ()
    return tuple(source for source, place in wanted.items() if name and place not in installed)


def _installed(pairs: Any) -> Iterator[str]:  # noqa: ANN401 - whatever a learner wrote
    for folder, files in pairs:
        for file in files:
            yield posixpath.normpath(f"{folder}/{posixpath.basename(file)}")


# Editing.


def with_entry_points(text: str, scripts: list[str]) -> str | None:
    """Return a build script with entry points in its empty list of console scripts.

    Args:
        text: The `setup.py`.
        scripts: Entry points, such as `talk = my_package.talk:main`.

    Returns:
        None if it has no such list, or two.
    """
    if len(_EMPTY_LIST.findall(text)) != 1:
        return None
    items = "".join(f"            '{one}',\n" for one in scripts)
    return _EMPTY_LIST.sub(
        lambda found: f"{found['head']}{found['inside'].rstrip()}\n{items}        ]", text
    )
