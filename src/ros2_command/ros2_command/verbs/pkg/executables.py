"""`ros2 pkg executables`."""

from __future__ import annotations

from argparse import ArgumentParser, Namespace

from ros2_command.packages import all_packages, executables, package_prefix


def add_arguments(parser: ArgumentParser) -> None:
    """A package or none, and the form of the output."""
    parser.add_argument("package_name", nargs="?", help="The package name")
    parser.add_argument(
        "--full-path", action="store_true", help="Show full path of each executable"
    )


def main(args: Namespace) -> None:
    """Print what `ros2 run` can start."""
    name = args.package_name
    packages = all_packages() if name is None else {name: package_prefix(name)}
    for package, prefix in packages.items():
        for path in executables(prefix, package):
            print(path if args.full_path else f"{package} {path.name}")
