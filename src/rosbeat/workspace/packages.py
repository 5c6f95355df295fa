"""A package as it lies in the workspace: looked at, and never run."""

from __future__ import annotations

import configparser
from dataclasses import dataclass, replace
from pathlib import Path

from rosbeat.workspace.installed import Installed, read_installed
from rosbeat.workspace.manifest import Manifest, read_manifest
from rosbeat.workspace.setup_script import SetupScript, entry_points_in, read_setup
from rosbeat.workspace.targets import Flaw, flaw_of, top_level_names


@dataclass(frozen=True)
class Package:
    """A ROS package in a workspace.

    Attributes:
        folder: Where it lies.
        name: What its manifest calls it, or else its folder.
        manifest: Its `package.xml`.
        setup: Its `setup.py`.
        scripts_folder: Where `setup.cfg` installs executables, or empty.
        has_marker: Whether `resource/<name>` is there.
        has_init: Whether `<name>/__init__.py` is there.
        tests: The files of its test folder, sorted.
        modules: The modules of its Python package, without `__init__`, sorted.
        flaws: What is wrong with its entry points and the modules that they name.
        installed: What `colcon build` made of it, or None.
    """

    folder: Path
    name: str
    manifest: Manifest
    setup: SetupScript
    scripts_folder: str
    has_marker: bool
    has_init: bool
    tests: tuple[str, ...]
    modules: tuple[str, ...]
    flaws: tuple[Flaw, ...]
    installed: Installed | None

    @property
    def scripts_are_found(self) -> bool:
        """Whether `setup.cfg` installs executables where `ros2 run` looks for them."""
        return self.scripts_folder == f"$base/lib/{self.name}"

    def module_with_syntax_error(self) -> tuple[str, int] | None:
        """Return the first module that Python cannot read and the line, or None."""
        for module in self.modules:
            line = top_level_names(self.folder / self.name / f"{module}.py")[1]
            if line:
                return module, line
        return None


def read_package(folder: Path, root: Path) -> Package:
    """Look at a package.

    Args:
        folder: Where it lies; what is absent there is absent in the result.
        root: The workspace that it is built in.
    """
    manifest = read_manifest(folder / "package.xml")
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
        installed=read_installed(name, folder, root),
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
    """A `setup.cfg`; one that is absent or cannot be read is empty."""
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
    entries = tuple(entry_points_in(lines, 1, "setup.cfg"))
    return replace(setup, entry_points=entries, groups=tuple(sorted(parser[section])))


def _scripts_folder(parser: configparser.ConfigParser) -> str:
    # Older files have a dash in the name.
    dashed = parser.get("install", "install-scripts", fallback="")
    return parser.get("install", "install_scripts", fallback=dashed).strip()
