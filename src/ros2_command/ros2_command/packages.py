"""Find packages in the ament index of `AMENT_PREFIX_PATH`, without importing ROS."""

from __future__ import annotations

import os
import sys
from pathlib import Path

from ros2_command.errors import CommandError
from ros2_command.names import did_you_mean

INDEX = Path("share", "ament_index", "resource_index", "packages")
SOURCE_FIRST = (
    "If you have built it in a workspace: run `source install/setup.bash` there, in this terminal."
)


def prefixes() -> list[Path]:
    """Return the prefixes to look in; the first one wins.

    The variable is set by `source .../setup.bash`. Without it there is still the environment that
    this Python lives in, if ROS is installed there.

    Raises:
        CommandError: If there is nowhere to look.
    """
    given = [Path(part) for part in os.environ.get("AMENT_PREFIX_PATH", "").split(":") if part]
    own = [path for path in [Path(sys.prefix)] if (path / INDEX).is_dir()]
    if not given and not own:
        raise CommandError(
            "Environment variable 'AMENT_PREFIX_PATH' is not set or empty",
            "The variable lists the folders of ROS packages, so without it no package can be "
            "found.",
            "Run `source install/setup.bash` in your workspace, in this terminal.",
        )
    return given or own


def all_packages() -> dict[str, Path]:
    """Return the prefix of every package, by name, sorted."""
    found: dict[str, Path] = {}
    for prefix in prefixes():
        folder = prefix / INDEX
        for entry in folder.iterdir() if folder.is_dir() else ():
            if not entry.name.startswith(".") and entry.is_file():
                found.setdefault(entry.name, prefix)
    return dict(sorted(found.items()))


def package_prefix(name: str, complaint: str = "Package '{}' not found") -> Path:
    """Return the prefix of one package.

    Args:
        name: The package.
        complaint: The first line of the error; verbs of the original differ here.

    Raises:
        CommandError: If there is no such package; the nearest name is suggested.
    """
    packages = all_packages()
    if name not in packages:
        raise CommandError(complaint.format(name), did_you_mean(name, packages, SOURCE_FIRST))
    return packages[name]


def executables(prefix: Path, name: str) -> list[Path]:
    """Return every file of a package that can be run, sorted by path."""
    folder = prefix / "lib" / name
    found = []
    for root, folders, files in os.walk(folder):
        folders[:] = [one for one in folders if not one.startswith(".")]
        found += [Path(root, file) for file in files]
    return sorted(path for path in found if os.access(path, os.X_OK) and path.is_file())
