"""What `colcon build` has put into the folder `install` of a workspace for one package."""

from __future__ import annotations

import os
from dataclasses import dataclass
from pathlib import Path


@dataclass(frozen=True)
class Installed:
    """The installed state of a package.

    Attributes:
        prefix: Where it is installed.
        executables: What `ros2 run` can start, sorted.
        linked: Whether it was built with `--symlink-install`, so that edits of modules count.
        changed: Source files, relative to the package, whose installed copy is another or absent.
    """

    prefix: Path
    executables: tuple[str, ...] = ()
    linked: bool = False
    changed: tuple[str, ...] = ()


def read_installed(name: str, source: Path, root: Path) -> Installed | None:
    """Return what is installed of a package, or None if it never was built.

    Args:
        name: The package.
        source: The folder of its source.
        root: The workspace that was built.
    """
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
    """Whether this package is installed as a link: setuptools writes an `.egg-link`."""
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
