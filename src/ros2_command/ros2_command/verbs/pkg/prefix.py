"""`ros2 pkg prefix`."""

from __future__ import annotations

from argparse import ArgumentParser, Namespace

from ros2_command.packages import package_prefix


def add_arguments(parser: ArgumentParser) -> None:
    """A package, and whether its share folder is wanted."""
    parser.add_argument("package_name", help="The package name")
    parser.add_argument("--share", action="store_true", help="Show share directory of the package")


def main(args: Namespace) -> None:
    """Print where a package is installed."""
    prefix = package_prefix(args.package_name, "Package not found")
    print(prefix / "share" / args.package_name if args.share else prefix)
