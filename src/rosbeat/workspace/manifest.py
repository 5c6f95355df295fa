"""What a `package.xml` says."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import NoReturn
from xml.etree import ElementTree
from xml.parsers import expat

_LARGEST = 1_000_000
_DEPENDS = ("depend", "exec_depend", "build_depend", "build_export_depend")


@dataclass(frozen=True)
class Manifest:
    """The parts of a manifest that the course speaks about; an absent one is empty.

    Attributes:
        name: The package.
        version: Its version.
        description: A sentence.
        license: Its license; several are joined with commas.
        maintainer: A name.
        email: The maintainer's address.
        build_type: `ament_python`, `ament_cmake` or another.
        depends: Packages that it needs to run or to be built.
        problem: Why the file cannot be read, or empty.
        format: Which version of the format of manifests it says that it has.
        tags: Every tag below the outermost one, each once, in order.
    """

    name: str = ""
    version: str = ""
    description: str = ""
    license: str = ""
    maintainer: str = ""
    email: str = ""
    build_type: str = ""
    depends: tuple[str, ...] = ()
    problem: str = ""
    format: str = ""
    tags: tuple[str, ...] = ()


def read_manifest(path: Path) -> Manifest:
    """Read a manifest without trusting it: a bad one has a `problem` and nothing else.

    Args:
        path: The `package.xml`.
    """
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
    raise ValueError("it holds a document type (<!DOCTYPE ...>), which no package.xml needs")
