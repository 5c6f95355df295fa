import os
import subprocess
import sys

import pytest

from rosbeat import viz


@pytest.mark.parametrize("name", viz.__all__)
def test_every_public_name_loads_and_is_no_module(name):
    assert callable(getattr(viz, name))


def test_names_are_sorted_and_offered():
    assert viz.__all__ == sorted(viz.__all__)
    assert dir(viz) == viz.__all__


def test_an_unknown_name_is_an_attribute_error():
    with pytest.raises(AttributeError, match="no attribute 'pie'"):
        _ = viz.pie


def test_matplotlib_waits_until_a_picture_is_wanted():
    code = (
        "import sys, rosbeat.viz; print('matplotlib' in sys.modules, 'rclpy' in sys.modules)\n"
        "rosbeat.viz.graph; print('matplotlib' in sys.modules, 'rclpy' in sys.modules)"
    )
    env = {**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)}
    run = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, check=True, env=env
    )
    assert run.stdout.split() == ["False", "False", "True", "False"]
