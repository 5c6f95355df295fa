"""`import rosbeat` is light, and offers what it says."""

import os
import re
import subprocess
import sys
from importlib.metadata import PackageNotFoundError, version

import pytest

import rosbeat


def test_names_are_sorted():
    assert rosbeat.__all__ == sorted(rosbeat.__all__)


def test_pictures_load_when_first_used():
    assert rosbeat.viz.__name__ == "rosbeat.viz"


@pytest.mark.ros
def test_the_session_loads_when_first_used():
    assert rosbeat.Session.__name__ == "Session"


def test_an_unknown_name_is_an_attribute_error():
    with pytest.raises(AttributeError, match="no attribute 'Sesion'"):
        _ = rosbeat.Sesion


def test_the_version_is_a_version_and_the_installed_one():
    assert re.fullmatch(r"\d+\.\d+\.\d+", rosbeat.__version__)
    try:
        installed = version("rosbeat")
    except PackageNotFoundError:
        pytest.skip("rosbeat runs from its sources and is not installed")
    assert installed == rosbeat.__version__


def test_importing_it_imports_neither_ros_nor_drawing():
    code = "import sys, rosbeat; print(*{'rclpy', 'matplotlib', 'numpy'} & set(sys.modules))"
    env = {**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)}
    run = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, check=True, env=env
    )
    assert run.stdout.split() == []
