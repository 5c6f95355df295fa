"""Fill in the files of a new ament_python package, which `data/package` holds."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from importlib.resources import files
from string import Template
from xml.sax.saxutils import escape

_DATA = files("ros2_command") / "data"

#: The licenses of which the full text is known, in the order in which they are offered.
LICENSES = (
    *("Apache-2.0", "BSL-1.0", "BSD-2.0", "BSD-2-Clause", "BSD-3-Clause"),
    *("GPL-3.0-only", "LGPL-3.0-only", "MIT", "MIT-0"),
)


@dataclass(frozen=True)
class NewPackage:
    """Hold what was asked for.

    Attributes:
        name: The package, and the Python package in it.
        package_format: The format of package.xml, 2 or 3.
        description: A sentence.
        maintainer: A name.
        email: The maintainer's address.
        license: An identifier, or any text.
        dependencies: Packages to depend on.
        node: A node to begin with.
        library: A sub-package to begin with.
    """

    name: str
    package_format: int
    description: str
    maintainer: str
    email: str
    license: str
    dependencies: Sequence[str] = ()
    node: str | None = None
    library: str | None = None


def license_text(name: str) -> str | None:
    """Return the text of a license, or None if it is not one of `LICENSES`."""
    return (_DATA / "licenses" / name).read_text(encoding="utf-8") if name in LICENSES else None


def _filled(file: str, /, **values: object) -> str:
    """Return a file of `data/package` with values in the place of its names."""
    template = (_DATA / "package" / f"{file}.in").read_text(encoding="utf-8")
    return Template(template).substitute(values)


def package_xml(new: NewPackage) -> str:
    """Return the manifest."""
    depends = "".join(f"  <depend>{escape(one)}</depend>\n" for one in new.dependencies)
    return _filled(
        "package.xml", format=new.package_format, name=escape(new.name),
        description=escape(new.description), maintainer=escape(new.maintainer),
        email=escape(new.email, {'"': "&quot;"}), license=escape(new.license),
        depends=f"{depends}\n" if depends else "",
    )  # fmt: skip


def setup_py(new: NewPackage) -> str:
    """Return the build script.

    Texts are written as Python would show them, so quotes cannot break it.

    What tests require is an extra, as in newer versions of the original. Jazzy's own writes
    `tests_require`, which draws a warning from setuptools 72 and newer.
    """
    script = f"            '{new.node} = {new.name}.{new.node}:main'\n" if new.node else ""
    return _filled(
        "setup.py", name=new.name, maintainer=repr(new.maintainer), email=repr(new.email),
        description=repr(new.description), license=repr(new.license), scripts=script,
    )  # fmt: skip


def setup_cfg(new: NewPackage) -> str:
    """Return setup.cfg, which says where executables are installed."""
    return _filled("setup.cfg", name=new.name)


def node_py(new: NewPackage) -> str:
    """Return a program that says hello."""
    return _filled("node.py", name=new.name)


def linter_tests() -> dict[str, str]:
    """Return the three tests of a new package, by file name.

    The original imports the linters at the top. Without a full ROS 2 they may be missing, and
    ament_copyright is on no registry at all; an import that fails would end the whole test run.
    """
    names = ("test_copyright.py", "test_flake8.py", "test_pep257.py")
    return {name: _filled(name) for name in names}
