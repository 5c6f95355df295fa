"""Read the packages of a workspace from their files.

`setup.py` is read by `rosbeat.workspace.setup_script`, `package.xml` without its entities, and what
is installed through the files that colcon made.
"""

from __future__ import annotations

import ast
import configparser
import os
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import NoReturn
from xml.etree import ElementTree
from xml.parsers import expat

from rosbeat.diagnosis.packages import Installed, Manifest, Package, SetupScript, flaw_of, parse
from rosbeat.diagnosis.situation import StaleBuild
from rosbeat.workspace.place import VARIABLE, workspace
from rosbeat.workspace.setup_script import entry_points_in, read_setup

__all__ = ["Package", "find_packages", "parse_manifest", "read_package", "stale_builds"]

_LARGEST = 1_000_000
_DEPENDS = ("depend", "exec_depend", "build_depend", "build_export_depend")


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
        else:
            todo += _folders(folder)
    return sorted(found)


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
    entries = entry_points_in(lines, "setup.cfg")
    return replace(setup, entry_points=entries, groups=tuple(sorted(parser[section])))


def _scripts_folder(parser: configparser.ConfigParser) -> str:
    # Older files have a dash in the name.
    dashed = parser.get("install", "install-scripts", fallback="")
    return parser.get("install", "install_scripts", fallback=dashed).strip()


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
            changed = () if linked else _changed(name, source, libraries)
            return Installed(prefix, _executables(prefix / "lib" / name), linked, changed)
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
