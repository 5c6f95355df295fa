"""`ros2 run`."""

from __future__ import annotations

import os
import re
import shlex
from argparse import REMAINDER, ArgumentParser, Namespace
from pathlib import Path

from ros2_command.children import run_child
from ros2_command.errors import CommandError
from ros2_command.nearest import nearest
from ros2_command.packages import executables, package_prefix

# Executables of one package are often called alike, and the other one is then not what was meant.
_ONLY_A_SLIP = 0.85
_QUOTED_PYTHON = re.compile(rb'#!"([^"]+)"\s*$')


def add_arguments(parser: ArgumentParser) -> None:
    """A package, one of its executables, and everything for that executable."""
    parser.add_argument(
        "--prefix",
        help="Prefix command, which should go before the executable. "
        "Command must be wrapped in quotes if it contains spaces "
        "(e.g. --prefix 'gdb -ex run --args').",
    )
    parser.add_argument("package_name", help="Name of the ROS package")
    parser.add_argument("executable_name", help="Name of the executable")
    parser.add_argument("argv", nargs=REMAINDER, help="Pass arbitrary arguments to the executable")


def main(args: Namespace) -> int:
    """Start the executable, and end with its exit code."""
    path = find_executable(args.package_name, args.executable_name)
    rest = args.argv[1:] if args.argv[:1] == ["--"] else args.argv
    try:
        prefix = shlex.split(args.prefix or "")
    except ValueError as error:
        raise CommandError(f"--prefix {args.prefix!r} cannot be read: {error}") from None
    return run_child([*prefix, *startable(path), *rest])


def startable(path: Path) -> list[str]:
    """The words that start an executable.

    A Python in a folder with a space stands in quotes on a script's first line, as setuptools
    writes it, and Linux does not understand that.
    """
    with path.open("rb") as file:
        quoted = _QUOTED_PYTHON.match(file.readline())
    return [os.fsdecode(quoted[1]), str(path)] if quoted else [str(path)]


def find_executable(package: str, name: str) -> Path:
    """The one file of this name that a package offers.

    Raises:
        CommandError: If there is none or more than one.
    """
    prefix = package_prefix(package)
    offered = executables(prefix, package)
    found = [path for path in offered if path.name == name]
    if len(found) > 1:
        raise CommandError("Multiple executables found:", *(f"- {path}" for path in found))
    if not found:
        raise CommandError("No executable found", *_why_not(prefix, package, name, offered))
    return found[0]


def _why_not(prefix: Path, package: str, name: str, offered: list[Path]) -> list[str]:
    folder = prefix / "lib" / package
    unmarked = [path for path in folder.rglob(name) if path.is_file()] if folder.is_dir() else []
    if unmarked:
        return [f"{unmarked[0]} is there, but it has no execute permission (chmod +x)."]
    if not offered and (prefix / "bin" / name).is_file():
        return [
            f"{prefix / 'bin' / name} is there, where `ros2 run` does not look.",
            f"In setup.cfg of the package, install_scripts should be $base/lib/{package}.",
        ]
    if not offered:
        return [
            f"Package '{package}' has no executables at all: {folder} is empty or missing.",
            "A Python package needs an entry point in setup.py, and `colcon build` after that.",
        ]
    names = sorted({path.name for path in offered})
    listed = f"Package '{package}' has: {', '.join(names)}"
    stem = os.path.splitext(name)[0]
    meant = stem if stem in names else nearest(name, names, _ONLY_A_SLIP)
    if meant:
        return [f"Did you mean '{meant}'?", listed]
    return [listed, "A new entry point in setup.py counts after the next `colcon build`."]
