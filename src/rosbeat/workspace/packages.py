"""Read the packages of a workspace from their files.

A usual `setup.py` is made of literals and of names for strings, so it is read from its syntax tree
and costs no process. Any other runs in a subprocess with a deadline, in the learner's workspace,
where `colcon build` runs it too; there, `setup` only writes down what it was given. `package.xml`
is read without entities, and what is installed through the files that colcon made.
"""

from __future__ import annotations

import ast
import configparser
import json
import os
import posixpath
import re
import subprocess
import sys
import tokenize
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from importlib.util import decode_source
from io import StringIO
from pathlib import Path
from typing import Any, NoReturn
from xml.etree import ElementTree
from xml.parsers import expat

from rosbeat.diagnosis.packages import (
    NO_CALL,
    EntryPoint,
    Installed,
    Manifest,
    Package,
    SetupScript,
    entry_point,
    flaw_of,
    parse,
    place_of,
)
from rosbeat.diagnosis.topic_snapshot import StaleBuild
from rosbeat.workspace.location import VARIABLE, workspace

__all__ = ["Package", "find_packages", "parse_manifest", "read_package", "stale_builds"]

_LARGEST = 1_000_000
_DEPENDS = ("depend", "exec_depend", "build_depend", "build_export_depend")
#: Seconds that a build script may take; colcon itself would wait for ever.
_DEADLINE = 10.0
# The line is told beside the problem.
_DETECTED = re.compile(r" \(detected at line \d+\)")
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


def read_package(folder: Path, root: Path) -> Package:
    """Return what the files of a package say.

    Args:
        folder: The folder of the package; a file that is absent is absent in the result.
        root: The workspace that it is built in.
    """
    manifest = _read_manifest(folder / "package.xml")
    configured = _read_configuration(folder / "setup.cfg")
    setup = read_setup(folder / "setup.py")
    setup = _with_configured(setup, configured)
    name = manifest.name or setup.package_name or folder.name
    flaws = (flaw_of(entry, folder) for entry in setup.entry_points)
    return Package(
        folder, name, manifest, setup,
        scripts_folder=_scripts_folder(configured),
        has_marker=(folder / "resource" / name).is_file(),
        has_init=(folder / name / "__init__.py").is_file(),
        tests=tuple(sorted(one.name for one in (folder / "test").glob("*.py"))),
        modules=_modules(folder / name),
        flaws=tuple(flaw for flaw in flaws if flaw),
        installed=_read_installed(name, folder, root),
    )  # fmt: skip


def find_packages(root: Path) -> list[Path]:
    """Return the folders below a workspace that hold a `package.xml`, as colcon would find them.

    A `package.xml` in the workspace itself or in `src` ends colcon's search there. Here it does not
    hide the packages below, so that it can be told what hides them; see `is_stray`.

    Args:
        root: The workspace.
    """
    found = []
    todo = [root]
    while todo:
        folder = todo.pop()
        if (folder / "COLCON_IGNORE").exists():
            continue
        if (folder / "package.xml").is_file():
            found.append(folder)
        if folder not in found or is_stray(folder, root):
            todo += _folders(folder)
    return sorted(found)


def is_stray(folder: Path, root: Path) -> bool:
    """Return whether a folder can hold packages, and be none.

    Args:
        folder: The folder.
        root: The workspace.
    """
    return folder in (root, root / "src")


def _folders(folder: Path) -> list[Path]:
    try:
        inside = list(folder.iterdir())
    except OSError:
        return []
    return [one for one in inside
            if not one.name.startswith(".") and one.is_dir() and not one.is_symlink()]  # fmt: skip


def _modules(folder: Path) -> tuple[str, ...]:
    return tuple(sorted(one.stem for one in folder.glob("*.py") if one.stem != "__init__"))


def _read_configuration(path: Path) -> configparser.ConfigParser:
    """Return a `setup.cfg`; one that is absent or cannot be read is empty."""
    parser = configparser.ConfigParser(interpolation=None)
    try:
        parser.read(path, encoding="utf-8")
    except (configparser.Error, OSError, UnicodeDecodeError):
        return configparser.ConfigParser(interpolation=None)
    return parser


def _with_configured(setup: SetupScript, parser: configparser.ConfigParser) -> SetupScript:
    """Add what `setup.cfg` says to a build script that says nothing of it, as setuptools does."""
    if setup.problem:
        return setup
    if not setup.packages and parser.has_option("options", "packages"):
        setup = replace(setup, packages=None)
    if parser.has_section("options.data_files"):
        setup = replace(setup, left_out=())
    section = "options.entry_points"
    if setup.groups or setup.incomplete or not parser.has_section(section):
        return setup
    lines = parser.get(section, "console_scripts", fallback="")
    entries = tuple(entry_point(one, file="setup.cfg") for one in _lines(lines))
    return replace(setup, entry_points=entries, groups=tuple(sorted(parser[section])))


def _scripts_folder(parser: configparser.ConfigParser) -> str:
    # Older files have a dash in the name.
    dashed = parser.get("install", "install-scripts", fallback="")
    return parser.get("install", "install_scripts", fallback=dashed).strip()


# The build script.


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
        return SetupScript(problem=_DETECTED.sub("", error.msg), place=place_of(error))
    except (ValueError, RecursionError, MemoryError) as error:
        return SetupScript(problem=str(error) or type(error).__name__)
    calls = [one for one in ast.walk(tree) if isinstance(one, ast.Call) and _ends(one, "setup")]
    given = _given(tree, calls[0], path) if calls else None
    if given is None:
        return SetupScript(problem=NO_CALL)
    return _script(given, source, tree)


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
        return replace(literal, complete=False)


def _literal(tree: ast.Module, call: ast.Call) -> _Given:
    """Return the arguments that are literals, or patterns for `find_packages`."""
    names = _constants(tree)
    values: dict[str, Any] = {}
    excluded: tuple[str, ...] = ()
    for keyword in call.keywords:
        try:
            if keyword.arg == "packages" and isinstance(keyword.value, ast.Call):
                values["packages"], excluded = _patterns(keyword.value, names)
            elif keyword.arg:
                values[keyword.arg] = _value(keyword.value, names)
        except ValueError:
            continue
    return _Given(values, excluded, len(values) == len(call.keywords) and not call.args)


def _constants(tree: ast.Module) -> dict[str, str]:
    """Return the names that stand for a string throughout a module."""
    stored = [one.id for one in ast.walk(tree)
              if isinstance(one, ast.Name) and not isinstance(one.ctx, ast.Load)]  # fmt: skip
    return {
        target.id: node.value.value
        for node in tree.body
        if isinstance(node, ast.Assign) and isinstance(node.value, ast.Constant)
        for target in node.targets
        if isinstance(target, ast.Name) and stored.count(target.id) == 1
        if isinstance(node.value.value, str)
    }


def _value(node: ast.expr | None, names: Mapping[str, str]) -> Any:  # noqa: ANN401 - plain data
    """Return what an expression of literals and known names means.

    Raises:
        ValueError: If it is anything else.
    """
    if isinstance(node, ast.Constant):
        return node.value
    if isinstance(node, ast.Name) and node.id in names:
        return names[node.id]
    if isinstance(node, ast.List | ast.Tuple):
        return [_value(one, names) for one in node.elts]
    if isinstance(node, ast.Dict):
        pairs = zip(node.keys, node.values, strict=True)
        return {str(_value(key, names)): _value(value, names) for key, value in pairs}
    if isinstance(node, ast.BinOp) and isinstance(node.op, ast.Add):
        both = [_value(one, names) for one in (node.left, node.right)]
        if all(isinstance(one, str) for one in both):
            return "".join(both)
    raise ValueError("it has to be calculated")


def _patterns(call: ast.Call, names: Mapping[str, str]) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """Return the patterns that `find_packages` includes and excludes.

    Raises:
        ValueError: If it is called with anything else, or is another function.
    """
    given = {one.arg: _value(one.value, names) for one in call.keywords}
    include, exclude = (
        _string_list(given.get("include", ["*"])),
        _string_list(given.get("exclude", [])),
    )
    is_usual = _ends(call, "find_packages") and not call.args
    if not is_usual or given.keys() - {"include", "exclude"} or None in (include, exclude):
        raise ValueError("it has to be called")
    return include or (), exclude or ()


def _string_list(value: object) -> tuple[str, ...] | None:
    """Return the strings of a list; None if it is anything else."""
    if not isinstance(value, list | tuple):
        return None
    return tuple(value) if all(isinstance(one, str) for one in value) else None


def _script(given: _Given, source: str, tree: ast.Module) -> SetupScript:
    values, name = given.values, given.values.get("name")
    groups = _groups(values.get("entry_points", {}))
    programs = [
        one
        for group in ("console_scripts", "gui_scripts")
        for one in _lines((groups or {}).get(group, ()))
    ]
    hidden = not given.complete and "packages" not in values
    about = {key: values.get(key) for key in _ABOUT}
    return SetupScript(
        package_name=name if isinstance(name, str) else "",
        entry_points=tuple(_in_source(one, source, tree) for one in programs),
        incomplete=not given.complete or groups is None,
        keywords=tuple(sorted(values)),
        groups=tuple(sorted(groups or ())),
        # Without any, setuptools finds none itself: it refuses where there are two folders, and
        # every ROS package has `resource` beside its code.
        packages=None if hidden else _string_list(values.get("packages", [])),
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


def _lines(scripts: object) -> list[str]:
    """Return the entry points of a group, which is a list or a text with one in each line."""
    if isinstance(scripts, str):
        plain = [one.strip() for one in scripts.splitlines()]
        return [one for one in plain if one and one[0] not in "#;"]
    return [one for one in scripts if isinstance(one, str)] if isinstance(scripts, list) else []


def _in_source(text: str, source: str, tree: ast.Module) -> EntryPoint:
    """Return an entry point with the number of its pieces, which is 1 if it was calculated."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Constant) and node.value == text:
            return entry_point(text, _count_strings(ast.get_source_segment(source, node) or ""))
    return entry_point(text)


def _count_strings(expression: str) -> int:
    """Count the strings in an expression; Python joins adjacent ones, without a comma, to one."""
    tokens = tokenize.generate_tokens(StringIO(f"({expression})").readline)
    return sum(token.type == tokenize.STRING for token in tokens)


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
        installed = {
            posixpath.normpath(f"{folder}/{posixpath.basename(file)}")
            for folder, files in given.get("data_files") or ()
            for file in files
        }
    except (TypeError, ValueError):  # not pairs of a folder and files
        return ()
    return tuple(source for source, place in wanted.items() if name and place not in installed)


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


# The manifest.


def _read_manifest(path: Path) -> Manifest:
    try:
        return parse_manifest(path.read_bytes())
    except OSError as error:
        return Manifest(problem=error.strerror or "it cannot be read")


def parse_manifest(data: bytes) -> Manifest:
    """Read the bytes of a manifest; bad ones give a `problem` and nothing else.

    Args:
        data: What the file holds.
    """
    if len(data) > _LARGEST:
        return Manifest(problem="it is larger than any package.xml")
    try:
        _refuse_definitions(data)
        root = ElementTree.fromstring(data)
    except (expat.ExpatError, ElementTree.ParseError, ValueError, LookupError) as error:
        return Manifest(problem=str(error))
    return _manifest(root)


def _manifest(root: ElementTree.Element) -> Manifest:
    maintainer = root.find("maintainer")
    return Manifest(
        name=_text(root, "name"),
        version=_text(root, "version"),
        description=_text(root, "description"),
        license=", ".join(_texts(root, "license")),
        maintainer=_text(root, "maintainer"),
        email=maintainer.get("email", "") if maintainer is not None else "",
        build_type=_text(root, "export/build_type"),
        depends=tuple(dict.fromkeys(one for tag in _DEPENDS for one in _texts(root, tag))),
        format=root.get("format", ""),
        tags=tuple(dict.fromkeys(one.tag for one in root)),
    )


def _texts(root: ElementTree.Element, path: str) -> list[str]:
    return ["".join(one.itertext()).strip() for one in root.findall(path)]


def _text(root: ElementTree.Element, path: str) -> str:
    return next(iter(_texts(root, path)), "")


def _refuse_definitions(data: bytes) -> None:
    """Refuse a document type: its entities can make a short file fill the memory."""
    parser = expat.ParserCreate()
    parser.StartDoctypeDeclHandler = _refuse
    parser.Parse(data, True)


def _refuse(*_: object) -> NoReturn:
    raise ValueError("it contains a document type (<!DOCTYPE ...>), which no package.xml needs")


# The build.


def _read_installed(name: str, source: Path, root: Path) -> Installed | None:
    """Return what `colcon build` has installed of a package, or None if it never was built."""
    for prefix in (root / "install" / name, root / "install"):
        if (prefix / "share" / name / "package.xml").exists():
            libraries = sorted(prefix.glob("lib/python3*/site-packages"))
            linked = any(_links(library, name) for library in libraries)
            # Sourcing reads this, and colcon writes it last.
            told = prefix / "share" / name / "package.dsv"
            unfinished = (
                linked and told.exists() and "pythonpath_develop" not in told.read_text("utf-8")
            )
            changed = () if linked else _changed(name, source, libraries)
            return Installed(
                prefix, _executables(prefix / "lib" / name), linked, unfinished, changed
            )
    return None


def _executables(folder: Path) -> tuple[str, ...]:
    files = folder.iterdir() if folder.is_dir() else ()
    return tuple(sorted(one.name for one in files if one.is_file() and os.access(one, os.X_OK)))


def _links(library: Path, name: str) -> bool:
    """Return whether a package is installed as a link: setuptools writes an `.egg-link`."""
    names = {name, name.replace("_", "-")}
    return any((library / f"{one}.egg-link").exists() for one in names)


def _changed(name: str, source: Path, libraries: list[Path]) -> tuple[str, ...]:
    modules = sorted((source / name).rglob("*.py"))
    places = {module: module.relative_to(source) for module in modules}
    return tuple(
        place.as_posix()
        for module, place in places.items()
        if not any(_same(module, library / place) for library in libraries)
    )


def _same(one: Path, other: Path) -> bool:
    try:
        return one.read_bytes() == other.read_bytes()
    except OSError:
        return False


def stale_builds(topic: str, root: Path | None = None) -> tuple[StaleBuild, ...]:
    """Return the programs that name a topic and differ from what `ros2 run` would start.

    Args:
        topic: The topic's full name.
        root: The workspace, by default the one that the terminal knows, or else the learner's.
    """
    place = root or Path(os.environ.get(VARIABLE) or workspace())
    folders = find_packages(place) if place.is_dir() else []
    return tuple(one for folder in folders for one in _of(read_package(folder, place), topic))


def _of(package: Package, topic: str) -> Iterator[StaleBuild]:
    for entry in package.setup.entry_points:
        module = entry.module.replace(".", "/") + ".py"
        installed = package.installed
        if installed and module not in installed.changed:
            continue
        if topic.strip("/") in _strings(package.folder / module):
            yield StaleBuild(package.name, entry.executable, module, installed is not None)


def _strings(path: Path) -> set[str]:
    """Return every string in a file of Python, without slashes around it."""
    try:
        tree = parse(path.read_bytes())
    except (OSError, SyntaxError, ValueError):
        return set()
    found = (node.value for node in ast.walk(tree) if isinstance(node, ast.Constant))
    return {text.strip("/") for text in found if isinstance(text, str)}
