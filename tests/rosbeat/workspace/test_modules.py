from pathlib import PurePosixPath

import pytest

from rosbeat.workspace.modules import blank_line, module_name
from rosbeat.workspace.stages import PACKAGE


@pytest.mark.parametrize(
    ("path", "name"),
    [
        ("sensor_simulator/node.py", "sensor_simulator.node"),
        ("sensor_simulator/__init__.py", "sensor_simulator"),
        ("sensor_simulator/deep/node.py", "sensor_simulator.deep.node"),
        ("setup.py", None),
        ("test/test_node.py", None),
        ("sensor_simulator/node.txt", None),
        ("sensor_simulator/a-b.py", None),
        ("other/node.py", None),
    ],
)
def test_which_files_are_modules(root, package, path, name):
    assert module_name(PurePosixPath("src") / PACKAGE / path, root) == name


def test_a_second_python_package_in_a_ros_package(root, package):
    (package / "other").mkdir()
    (package / "other" / "__init__.py").touch()
    assert module_name(PurePosixPath(f"src/{PACKAGE}/other/a.py"), root) == "other.a"


def test_outside_of_packages_there_are_none(root):
    assert module_name(PurePosixPath("scripts/a.py"), root) is None


@pytest.mark.parametrize(
    ("text", "line"), [("x = ____", 1), ("a\n'name = ____'", 2), ("____init____", 0), ("__x__", 0)]
)
def test_blanks(text, line):
    assert blank_line(text) == line
