"""Implement `ros2 pkg`: list packages, and create new ones."""

from __future__ import annotations

import os
from argparse import Namespace
from pathlib import Path
from typing import TYPE_CHECKING

from ros2_command.errors import CommandError
from ros2_command.names import did_you_mean
from ros2_command.packages import all_packages, executables, package_prefix
from ros2_command.registry import Verb, argument, flag

if TYPE_CHECKING:
    from xml.etree import ElementTree


def _list(args: Namespace) -> None:
    for name in all_packages():
        print(name)


def _executables(args: Namespace) -> None:
    name = args.package_name
    packages = all_packages() if name is None else {name: package_prefix(name)}
    for package, prefix in packages.items():
        for path in executables(prefix, package):
            print(path if args.full_path else f"{package} {path.name}")


def _prefix(args: Namespace) -> None:
    prefix = package_prefix(args.package_name, "Package not found")
    print(prefix / "share" / args.package_name if args.share else prefix)


def _xml(args: Namespace) -> None:
    from xml.etree import ElementTree

    prefix = package_prefix(args.package_name, "Package not found")
    manifest = read_manifest(prefix / "share" / args.package_name / "package.xml")
    if args.tag is None:
        ElementTree.dump(manifest)
        return
    found = [child.text for child in manifest if child.tag == args.tag]
    if not found:
        tags = {str(child.tag) for child in manifest}
        raise CommandError("XML tag not found", did_you_mean(args.tag, tags))
    print(*found, sep="\n")


def read_manifest(path: Path) -> ElementTree.Element:
    """Return the root element of a package's manifest.

    Raises:
        CommandError: If the file is missing or is no XML.
    """
    from xml.etree import ElementTree

    try:
        return ElementTree.parse(path).getroot()
    except OSError:
        raise CommandError("Package XML manifest not found", f"There is no {path}.") from None
    except (ElementTree.ParseError, ValueError) as error:
        raise CommandError(f"The manifest {path} is not valid XML: {error}") from None


def _create(args: Namespace) -> None:
    from ros2_command.package_creation import create

    create(args)


_NAME = argument("package_name", help="The package name")
VERBS = {
    "create": Verb(
        "Create a new ROS 2 package",
        _create,
        _NAME,
        argument("--package-format", "--package_format", type=int, default=3, choices=[2, 3],
                 help="The package.xml format."),
        argument("--description", default="TODO: Package description",
                 help="The description given in the package.xml"),
        argument("--license", default="TODO: License declaration",
                 help="The license attached to this package; this can be an arbitrary string, but "
                 "a LICENSE file will only be generated if it is one of the supported licenses "
                 "(pass '?' to get a list)"),
        argument("--destination-directory", default=os.curdir,
                 help="Directory where to create the package directory"),
        argument("--build-type", default="ament_cmake",
                 choices=["cmake", "ament_cmake", "ament_python"],
                 help="The build type to process the package with (here: not cmake)"),
        argument("--dependencies", nargs="+", default=[], help="list of dependencies"),
        argument("--maintainer-email", help="email address of the maintainer of this package"),
        argument("--maintainer-name", help="name of the maintainer of this package"),
        argument("--node-name", help="name of the empty executable"),
        argument("--library-name", help="name of the empty library"),
    ),
    "executables": Verb(
        "Output a list of package specific executables",
        _executables,
        argument("package_name", nargs="?", help="The package name"),
        flag("--full-path", help="Show full path of each executable"),
    ),
    "list": Verb("Output a list of available packages", _list),
    "prefix": Verb(
        "Output the prefix path of a package",
        _prefix, _NAME, flag("--share", help="Show share directory of the package")
    ),
    "xml": Verb(
        "Output the XML of the package manifest or a specific tag",
        _xml, _NAME, argument("-t", "--tag", help="The XML tag to output, e.g. 'version'")
    ),
}  # fmt: skip
