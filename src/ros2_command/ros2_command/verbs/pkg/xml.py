"""`ros2 pkg xml`."""

from __future__ import annotations

import re
from argparse import ArgumentParser, Namespace
from pathlib import Path
from xml.etree import ElementTree

from ros2_command.errors import CommandError
from ros2_command.nearest import did_you_mean
from ros2_command.packages import package_prefix

_ROOT = re.compile(r"<package[\s>].*</package\s*>", re.DOTALL)


def add_arguments(parser: ArgumentParser) -> None:
    """A package, and perhaps one tag of its manifest."""
    parser.add_argument("package_name", help="The package name")
    parser.add_argument("-t", "--tag", help="The XML tag to output, e.g. 'version'")


def main(args: Namespace) -> None:
    """Print a manifest, or the text of one of its tags."""
    path = package_prefix(args.package_name) / "share" / args.package_name / "package.xml"
    text, root = read_manifest(path)
    if args.tag is None:
        print(text)
        return
    found = [child.text or "" for child in root if child.tag == args.tag]
    if not found:
        raise CommandError(
            f"Could not find tag '{args.tag}' in the manifest of '{args.package_name}'",
            did_you_mean(args.tag, {str(child.tag) for child in root}),
        )
    print("\n".join(found))


def read_manifest(path: Path) -> tuple[str, ElementTree.Element]:
    """The text of the root element as it is written, and the element.

    Raises:
        CommandError: If the file is missing or is no XML.
    """
    try:
        data = path.read_text(encoding="utf-8")
        root = ElementTree.fromstring(data.encode())
    except OSError:
        raise CommandError("Package XML manifest not found", f"There is no {path}.") from None
    except (ElementTree.ParseError, ValueError) as error:
        raise CommandError(f"The manifest {path} is not valid XML: {error}") from None
    found = _ROOT.search(data)
    return (found[0] if found else data.strip()), root
