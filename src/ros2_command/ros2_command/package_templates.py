"""Hold the files of a new ament_python package, as text."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from xml.sax.saxutils import escape

_LINTERS = ("ament_copyright", "ament_flake8", "ament_pep257", "python3-pytest")

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
    if name not in LICENSES:
        return None
    return (files("ros2_command") / "data" / "licenses" / name).read_text(encoding="utf-8")


def package_xml(new: NewPackage) -> str:
    """Return the manifest."""
    schema = f"http://download.ros.org/schema/package_format{new.package_format}.xsd"
    email = escape(new.email, {'"': "&quot;"})
    depends = [f"  <depend>{escape(one)}</depend>" for one in new.dependencies]
    lines = [
        '<?xml version="1.0"?>',
        f'<?xml-model href="{schema}" schematypens="http://www.w3.org/2001/XMLSchema"?>',
        f'<package format="{new.package_format}">',
        f"  <name>{escape(new.name)}</name>",
        "  <version>0.0.0</version>",
        f"  <description>{escape(new.description)}</description>",
        f'  <maintainer email="{email}">{escape(new.maintainer)}</maintainer>',
        f"  <license>{escape(new.license)}</license>",
        "",
        *([*depends, ""] if depends else []),
        *(f"  <test_depend>{one}</test_depend>" for one in _LINTERS),
        "",
        "  <export>",
        "    <build_type>ament_python</build_type>",
        "  </export>",
        "</package>",
    ]
    return "\n".join(lines) + "\n"


def setup_py(new: NewPackage) -> str:
    """Return the build script.

    Texts are written as Python would show them, so quotes cannot break it.

    What tests require is an extra, as in newer versions of the original. Jazzy's own writes
    `tests_require`, which draws a warning from setuptools 72 and newer.
    """
    script = f"            '{new.node} = {new.name}.{new.node}:main'\n" if new.node else ""
    return f"""from setuptools import find_packages, setup

package_name = '{new.name}'

setup(
    name=package_name,
    version='0.0.0',
    packages=find_packages(exclude=['test']),
    data_files=[
        ('share/ament_index/resource_index/packages',
            ['resource/' + package_name]),
        ('share/' + package_name, ['package.xml']),
    ],
    install_requires=['setuptools'],
    zip_safe=True,
    maintainer={new.maintainer!r},
    maintainer_email={new.email!r},
    description={new.description!r},
    license={new.license!r},
    extras_require={{
        'test': [
            'pytest',
        ],
    }},
    entry_points={{
        'console_scripts': [
{script}        ],
    }},
)
"""


def setup_cfg(new: NewPackage) -> str:
    """Return setup.cfg, which says where executables are installed."""
    folder = f"$base/lib/{new.name}"
    return f"[develop]\nscript_dir={folder}\n[install]\ninstall_scripts={folder}\n"


def node_py(new: NewPackage) -> str:
    """Return a program that says hello."""
    return f"""def main():
    print('Hi from {new.name}.')


if __name__ == '__main__':
    main()
"""


@cache
def _notice() -> str:
    return (files("ros2_command") / "data" / "test_notice.txt").read_text(encoding="utf-8")


def linter_tests() -> dict[str, str]:
    """Return the three tests of a new package, by file name.

    The original imports the linters at the top. Without a full ROS 2 they may be missing, and
    ament_copyright is on no registry at all; an import that fails would end the whole test run.
    """
    copyright_notice = _notice().format(year=2015)
    return {
        "test_copyright.py": f"""{copyright_notice}
import pytest

# PyPI does not have ament_copyright, a full ROS 2 has: without it this test is skipped.
linter = pytest.importorskip('ament_copyright.main')


# Remove the `skip` decorator once the source file(s) have a copyright header
@pytest.mark.skip(reason='No copyright header has been placed in the generated source file.')
@pytest.mark.copyright
@pytest.mark.linter
def test_copyright():
    rc = linter.main(argv=['.', 'test'])
    assert rc == 0, 'Found errors'
""",
        "test_flake8.py": f"""{_notice().format(year=2017)}
import pytest

# Not every installation from PyPI has ament_flake8: without it this test is skipped.
linter = pytest.importorskip('ament_flake8.main')


@pytest.mark.flake8
@pytest.mark.linter
def test_flake8():
    rc, errors = linter.main_with_errors(argv=[])
    assert rc == 0, \\
        'Found %d code style errors / warnings:\\n' % len(errors) + \\
        '\\n'.join(errors)
""",
        "test_pep257.py": f"""{copyright_notice}
import pytest

# Not every installation from PyPI has ament_pep257: without it this test is skipped.
linter = pytest.importorskip('ament_pep257.main')


@pytest.mark.linter
@pytest.mark.pep257
def test_pep257():
    rc = linter.main(argv=['.', 'test'])
    assert rc == 0, 'Found code style errors / warnings'
""",
    }
